"""Lists of entrants: typed, pasted, or in a text or CSV file.

Each line is a name, NAME=AI, NAME/TEAM or NAME/TEAM=AI, or a row of a table, separated by commas, semicolons or tabs:
name, AI, team, or in the order of its header, whose other columns are ignored. A quoted cell may contain separators and
line breaks. Empty lines, and lines that begin with #, do not count.
"""

import csv
import re
import unicodedata
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from io import StringIO
from itertools import chain
from pathlib import Path

from pigaming_app.events.spec import MOST, Entrant, NameRefused, check_name
from pigaming_app.storage.parsing import MAX_BYTES, ParseError, read

NAME, AI, TEAM = COLUMNS = ("name", "ai", "team")
HEADERS = {  # in five languages, without accents
    **dict.fromkeys(("name", "nome", "nombre", "nom"), NAME),
    **dict.fromkeys(("player", "jogador", "jugador", "joueur", "spieler"), NAME),
    **dict.fromkeys(("participant", "participante", "teilnehmer", "entrant"), NAME),
    **dict.fromkeys(("ai", "ia", "ki"), AI),
    **dict.fromkeys(("team", "equipa", "equipe", "equipo", "mannschaft"), TEAM),
}
SEPARATORS = (";", "\t", ",")
ACCENTED = frozenset("áâãàäåæçéêëèíîïñóôõöøúùûüÿß")  # small letters of names
_QUOTED = re.compile(r'(?:^|(?<=[;,\t]))\s*"[^"]*"', re.MULTILINE)
_BEYOND = re.compile(r"[^\0-\x7f]")
_EXCEL = re.compile(r"sep=([;,\t])", re.IGNORECASE)  # a line by which spreadsheets note the separator
_BINARY = re.compile(r"[\0-\x08\x0e-\x1f\x7f]")

Check = Callable[[str], object]
"""check(AI) raises ValueError for an AI that does not play in the event."""


class ListError(ValueError):
    """A line is no entrant. `kind`: what is wrong, one of line, name, taken, full, ai; `text`: where it is seen."""

    def __init__(self, line: int, text: str, reason: str, kind: str = "line") -> None:
        super().__init__(f"line {line}: {reason}")
        self.line, self.text, self.kind = line, text, kind


@dataclass(frozen=True)
class EntrantList:
    """The entrants of a list, and the headings of columns that mean nothing here."""

    entrants: tuple[Entrant, ...]
    ignored: tuple[str, ...] = ()


def read_list(path: Path, limit: int = MAX_BYTES) -> str:
    """The text of a file in UTF-8, in UTF-16 with its byte order mark, or as Western Windows or old Macs save it.

    Raises OSError or ParseError.
    """
    raw = read(path, limit)
    utf = "utf-16" if raw.startswith((BOM_UTF16_LE, BOM_UTF16_BE)) else "utf-8-sig"
    texts = [*_decoded(raw, utf)] or [*_decoded(raw, "cp1252", "mac_roman")]
    if not texts:
        raise ParseError("it is not text")
    return max(texts, key=_likelihood)


def entrants_of_text(text: str, check: Check = str) -> EntrantList:
    """The entrants of a list, one in a line or row. Raises ListError."""
    found: dict[str, Entrant] = {}
    ignored: dict[str, None] = {}
    header: list[str] | None = None  # once the first row is known; empty: there is none
    for number, cells in _rows(_plain(text)):
        try:
            if header is None:
                header = _header(cells)
                ignored |= dict.fromkeys(heading for heading in header if heading not in ("", *COLUMNS))
                if header:
                    continue
            ignored |= dict.fromkeys(_unnamed(cells, header))
            entrant = _entrant(cells, header)
        except ValueError as error:
            kind = "name" if isinstance(error, NameRefused) else "line"
            raise ListError(number, ", ".join(filter(None, cells)), str(error), kind) from None
        if entrant:
            _check(entrant, found, number, check)
            found[entrant.name] = entrant
    return EntrantList(tuple(found.values()), tuple(ignored))


def entrants_of_words(words: Iterable[str]) -> tuple[Entrant, ...]:
    """The entrants of words such as AAA=level1. Raises ValueError."""
    return tuple(_of_word(_plain(word).strip()) for word in words)


def _decoded(raw: bytes, *codes: str) -> Iterator[str]:
    """The text in each of these codes in which it is one."""
    for code in codes:
        with suppress(UnicodeDecodeError):
            text = raw.decode(code)
            if not _BINARY.search(text):
                yield text


def _likelihood(text: str) -> float:
    """How much the letters beyond ASCII look like those of names: more is better. The first of equal texts counts."""
    points = 0.0
    text = f" {text} "
    for found in _BEYOND.finditer(text):
        before, letter, after = text[found.start() - 1], found[0], text[found.end()]
        if letter in "’‘":  # O’Brien
            points += 1.0 if after.isupper() or before.isspace() else -1.0
        elif letter != "œ":  # rarer than the ú of old Macs
            fits = letter.lower() in ACCENTED and not (letter.isupper() and before.islower())
            points += (1.5 if letter.isupper() else 1.0) if fits else -1.0
    return points


def _plain(text: str) -> str:
    """The text with composed letters, so that equal names are equal, and one kind of line ends and spaces."""
    text = unicodedata.normalize("NFC", text).lstrip("\ufeff").replace("\xa0", " ")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _rows(text: str) -> Iterator[tuple[int, list[str]]]:
    """The cells of each row, and the number of its first line, from 1. Raises ListError."""
    separator = _separator(text)
    lines = enumerate(StringIO(text), 1)
    for number, line in lines:
        if not line.strip() or line.lstrip().startswith("#") or _EXCEL.fullmatch(line.strip(" \n")):
            continue
        rest = (more for _, more in lines)  # of a quoted cell
        try:
            row = next(csv.reader(chain([line], rest), delimiter=separator, skipinitialspace=True, strict=True))
        except csv.Error:
            raise ListError(number, line.strip(), "a quoted cell does not end with a quote") from None
        yield number, [" ".join(cell.split()) for cell in row]


def _separator(text: str) -> str:
    """The separator that a line sep=; notes, or the first line that has one outside quotes."""
    if noted := _EXCEL.fullmatch(text.partition("\n")[0].strip(" ")):
        return noted[1]
    lines = (line for line in _QUOTED.sub("", text).splitlines() if not line.lstrip().startswith("#"))
    return next((one for line in lines for one in SEPARATORS if one in line), SEPARATORS[0])


def _header(cells: Sequence[str]) -> list[str]:
    """The column of each heading, or the heading of one that means nothing here; empty if this is no header.

    Raises ValueError if two headings mean the same.
    """
    header = [HEADERS.get(_folded(cell), cell) for cell in cells]
    if NAME not in header:
        return []
    if twice := [column for column in COLUMNS if header.count(column) > 1]:
        raise ValueError(f"two columns are the {twice[0]}")
    return header


def _folded(heading: str) -> str:
    """A heading in small letters without accents."""
    parts = unicodedata.normalize("NFKD", heading.casefold())
    return "".join(part for part in parts if not unicodedata.combining(part)).strip(" .:*")


def _unnamed(cells: Sequence[str], header: Sequence[str]) -> list[str]:
    """Words for the columns without a heading in which a row has something; none if there is no header."""
    names = [*header, *[""] * (len(cells) - len(header))]
    found = [f"column {i}" for i, (name, cell) in enumerate(zip(names, cells, strict=False), 1) if cell and not name]
    return found if header else []


def _entrant(cells: Sequence[str], header: Sequence[str]) -> Entrant | None:
    """The entrant of a row; None if there is nobody in it. Raises ValueError."""
    columns = header or COLUMNS
    if len(cells) == 1 and columns[0] == NAME:
        return _of_word(cells[0])
    if not header and any(cells[len(COLUMNS) :]):
        raise ValueError("a row has a name, an AI and a team")
    row = {column: cell for column, cell in zip(columns, cells, strict=False) if column in COLUMNS}
    return _checked(Entrant(row.get(NAME, ""), row.get(AI, ""), row.get(TEAM, ""))) if any(row.values()) else None


def _of_word(word: str) -> Entrant:
    who, _, brain = word.partition("=")
    name, _, team = who.partition("/")
    return _checked(Entrant(name.strip(), brain.strip(), team.strip()))


def _checked(entrant: Entrant) -> Entrant:
    check_name(entrant.name)
    if entrant.team:
        check_name(entrant.team, "team")
    return entrant


def _check(entrant: Entrant, before: Mapping[str, Entrant], number: int, check: Check) -> None:
    """Raises ListError unless an entrant can join those before."""
    if entrant.name in before:
        raise ListError(number, entrant.name, f"{entrant.name} is entered twice", "taken")
    if len(before) == MOST:
        raise ListError(number, entrant.name, f"an event has at most {MOST} entrants", "full")
    try:
        if entrant.brain:
            check(entrant.brain)
    except ValueError as error:
        raise ListError(number, entrant.brain, str(error), "ai") from None
