"""Lists of entrants: typed, pasted, or in a text or CSV file.

Each line is a name, NAME=AI, NAME/TEAM or NAME/TEAM=AI, or a row of a table, separated by commas, semicolons or tabs:
name, AI, team, or in the order of its header. Empty lines, and lines that begin with #, do not count.
"""

import csv
import re
import unicodedata
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Iterable, Sequence
from pathlib import Path

from pigaming_app.events.spec import MOST, Entrant, NameRefused, check_name
from pigaming_app.storage.parsing import MAX_BYTES, ParseError, read

COLUMNS = ("name", "ai", "team")
HEADERS = {
    **dict.fromkeys(("name", "nome", "nombre", "nom"), "name"),
    **dict.fromkeys(("ai", "ia", "ki"), "ai"),
    **dict.fromkeys(("team", "equipa", "equipo", "équipe"), "team"),
}
SEPARATORS = (";", "\t", ",")
_QUOTED = re.compile(r'"[^"]*"')
_EXCEL = re.compile(r"sep=[;,\t]", re.IGNORECASE)  # a line by which spreadsheets note the separator
_BINARY = re.compile(r"[\0-\x08\x0e-\x1f\x7f]")


class ListError(ValueError):
    """A line is no entrant. `taken`: a name that is in the list twice; `full`: there are more than MOST."""

    def __init__(self, line: int, text: str, reason: str, *, name: bool = False, taken: str = "", full: bool = False):
        super().__init__(f"line {line}: {reason}")
        self.line, self.text, self.name, self.taken, self.full = line, text, name, taken, full


def read_list(path: Path, limit: int = MAX_BYTES) -> str:
    """The text of a file in UTF-8, in UTF-16 with its byte order mark, or else in the code page of Western Windows.

    Raises OSError or ParseError.
    """
    raw = read(path, limit)
    codes = ("utf-16",) if raw.startswith((BOM_UTF16_LE, BOM_UTF16_BE)) else ("utf-8-sig", "cp1252")
    for code in codes:
        try:
            text = raw.decode(code)
        except UnicodeDecodeError:
            continue
        if not _BINARY.search(text):
            return text
    raise ParseError("it is not text")


def entrants_of_text(text: str) -> tuple[Entrant, ...]:
    """The entrants of a list, one in a line. Raises ListError."""
    found: list[Entrant] = []
    columns: Sequence[str] | None = None  # once the first line is known
    for number, line in enumerate(_plain(text).splitlines(), 1):
        line = line.strip().lstrip("\ufeff")
        if not line or line.startswith("#") or (columns is None and _EXCEL.fullmatch(line)):
            continue
        try:
            cells = _cells(line)
            if columns is None and (columns := _header(cells)) is not None:
                continue
            columns = columns or COLUMNS
            entrant = _of_word(cells[0]) if len(cells) == 1 else _of_row(cells, columns) if any(cells) else None
        except ValueError as error:
            raise ListError(number, line, str(error), name=isinstance(error, NameRefused)) from None
        if entrant is None:
            continue
        if entrant.name in (other.name for other in found):
            raise ListError(number, line, f"{entrant.name} is entered twice", taken=entrant.name)
        found.append(entrant)
        if len(found) > MOST:
            raise ListError(number, line, f"an event has at most {MOST} entrants", full=True)
    return tuple(found)


def entrants_of_words(words: Iterable[str]) -> tuple[Entrant, ...]:
    """The entrants of words such as AAA=level1. Raises ValueError."""
    return tuple(_of_word(_plain(word).strip()) for word in words)


def _plain(text: str) -> str:
    """The text with composed letters, so that equal names are equal, and without hard spaces."""
    return unicodedata.normalize("NFC", text).replace("\xa0", " ")


def _cells(line: str) -> list[str]:
    """The cells of a row; a line without a separator outside quotes is one cell. Raises ValueError."""
    outside = _QUOTED.sub("", line)
    separator = next((one for one in SEPARATORS if one in outside), None)
    if separator is None and not line.startswith('"'):
        return [line]
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=separator or "\t"))]
    except csv.Error as error:
        raise ValueError(str(error)) from None


def _header(cells: Sequence[str]) -> Sequence[str] | None:
    """The columns of a header; None if it is none."""
    columns = [HEADERS.get(cell.lower(), "") for cell in cells if cell]
    return columns if "name" in columns and all(columns) and len({*columns}) == len(columns) else None


def _of_row(cells: Sequence[str], columns: Sequence[str]) -> Entrant:
    if any(cells[len(columns) :]):
        raise ValueError("a row has a name, an AI and a team")
    row = dict(zip(columns, cells, strict=False))
    return _checked(Entrant(row.get("name", ""), row.get("ai", ""), row.get("team", "")))


def _of_word(word: str) -> Entrant:
    who, _, brain = word.partition("=")
    name, _, team = who.partition("/")
    return _checked(Entrant(name.strip(), brain.strip(), team.strip()))


def _checked(entrant: Entrant) -> Entrant:
    check_name(entrant.name)
    if entrant.team:
        check_name(entrant.team, "team")
    return entrant
