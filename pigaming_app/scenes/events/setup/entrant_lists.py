"""Lists of entrants as text: from the clipboard, a text file or a CSV file."""

import csv
from pathlib import Path

from pigaming_app.storage.parsing import read_text

LONGEST = 12  # characters of a name
MOST_BYTES = 100_000  # of a file
HEADS = ("name", "names", "nome", "nomes", "entrant", "entrants", "initials")  # heading of a column


def names_in(text: str) -> list[str]:
    """The distinct names of a list, in upper case and its order: one a line, the first column of a CSV, or all on one
    line with commas or semicolons between them. Longer names are cut at LONGEST characters.
    """
    rows = [row for row in csv.reader(_lines(text), delimiter=_delimiter(text)) if any(cell.strip() for cell in row)]
    cells = rows[0] if len(rows) == 1 else [next(cell for cell in row if cell.strip()) for row in rows]
    names = [name for cell in cells if (name := _name(cell))]
    if names and names[0].lower() in HEADS:
        names = names[1:]
    return list(dict.fromkeys(names))


def names_of_file(path: Path) -> list[str]:
    """The names of a text or CSV file. Raises ValueError and OSError if it cannot be read as text."""
    return names_in(read_text(path, MOST_BYTES))


def _lines(text: str) -> list[str]:
    return text.lstrip("\ufeff").replace("\0", "").splitlines()


def _delimiter(text: str) -> str:
    """The sign between two cells: the one that occurs most."""
    return max(";\t,", key=text.count) if any(sign in text for sign in ";\t,") else ","


def _name(cell: str) -> str:
    printable = "".join(char for char in " ".join(cell.split()) if char.isprintable())
    return printable[:LONGEST].strip().upper()
