"""Lists of entrants: typed, pasted, or in a text or CSV file.

Each line is a name, NAME=AI, NAME/TEAM or NAME/TEAM=AI, or a row of a table, separated by commas, semicolons or tabs:
name, AI, team, or in the order of its header, whose other columns are ignored. A quoted cell may contain separators and
line breaks. Empty lines, and lines that begin with #, do not count.

A list of a school has columns of first and last names and of classes. Entrants go by their first names; equal ones get
as many letters of the last name as tell them apart: Ana S. and Ana M.
"""

import csv
import re
import unicodedata
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from io import StringIO
from itertools import chain
from pathlib import Path

from pigaming_app.events import spreadsheets
from pigaming_app.events.spec import MAX_NAME, MOST, Entrant, NameRefused, check_name
from pigaming_app.storage.parsing import MAX_BYTES, ParseError, read

NAME, AI, TEAM, CLASS, FIRST, LAST = COLUMNS = ("name", "ai", "team", "class", "first name", "last name")
PLAIN = (NAME, AI, TEAM)  # columns of a table without a header
HEADERS = {  # in five languages, without accents
    **dict.fromkeys(("name", "nome", "nombre", "nom"), NAME),
    **dict.fromkeys(("player", "jogador", "jugador", "joueur", "spieler"), NAME),
    **dict.fromkeys(("full name", "nome completo", "nombre completo", "nombre y apellidos"), NAME),
    **dict.fromkeys(("nom complet", "nom et prenom", "vollstandiger name", "vor- und nachname"), NAME),
    **dict.fromkeys(("pupil", "student", "aluno", "alumno", "eleve", "schuler"), NAME),
    **dict.fromkeys(("participant", "participante", "teilnehmer", "entrant"), NAME),
    **dict.fromkeys(("ai", "ia", "ki"), AI),
    **dict.fromkeys(("team", "equipa", "equipe", "equipo", "mannschaft"), TEAM),
    **dict.fromkeys(("class", "turma", "clase", "curso", "classe", "klasse"), CLASS),
    **dict.fromkeys(("first name", "firstname", "given name", "forename", "vorname", "rufname", "prenom"), FIRST),
    **dict.fromkeys(("primeiro nome", "nome proprio", "nombre de pila"), FIRST),
    **dict.fromkeys(("last name", "lastname", "surname", "family name", "nachname", "familienname"), LAST),
    **dict.fromkeys(("apelido", "apelidos", "sobrenome", "apellido", "apellidos", "nom de famille"), LAST),
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
    """The entrants of a list, and the headings of columns that mean nothing here. `classes`: of those who have one, by
    name; `told_apart`: those of equal first names.
    """

    entrants: tuple[Entrant, ...]
    ignored: tuple[str, ...] = ()
    classes: Mapping[str, str] = field(default_factory=dict)
    told_apart: tuple[str, ...] = ()

    @property
    def by_class(self) -> "EntrantList":
        """With each class as a team. Raises ValueError without classes."""
        if not self.classes:
            raise ValueError("the list has no column of classes")
        entrants = tuple(replace(one, team=self.classes.get(one.name, "")) for one in self.entrants)
        return replace(self, entrants=entrants)


@dataclass(frozen=True)
class ListRow:
    """Somebody on a list, and the number of the line. `entrant.name` is the first name if there is a last one."""

    line: int
    entrant: Entrant
    last: str = ""
    group: str = ""  # the class


def read_list(path: Path, limit: int = MAX_BYTES) -> str:
    """The text of a file in UTF-8, in UTF-16 with its byte order mark, or as Western Windows or old Macs save it; of a
    spreadsheet (.xlsx, .ods) the first sheet, with tabs.

    Raises OSError or ParseError.
    """
    raw = read(path, limit)
    if raw.startswith(spreadsheets.ZIP):
        return spreadsheets.text_of(raw)
    utf = "utf-16" if raw.startswith((BOM_UTF16_LE, BOM_UTF16_BE)) else "utf-8-sig"
    texts = [*_decoded(raw, utf)] or [*_decoded(raw, "cp1252", "mac_roman")]
    if not texts:
        raise ParseError("it is not text")
    return max(texts, key=_likelihood)


def entrants_of_text(text: str, check: Check = str) -> EntrantList:
    """The entrants of a list, one in a line or row. Raises ListError."""
    found: list[ListRow] = []
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
            row = _row(number, cells, header)
        except ValueError as error:
            kind = "name" if isinstance(error, NameRefused) else "line"
            raise ListError(number, ", ".join(filter(None, cells)), str(error), kind) from None
        if row:
            found.append(row)
        if len(found) > MOST:
            break  # it is refused below
    names = _told_apart(found)
    entrants: dict[str, Entrant] = {}
    for row, name in zip(found, names, strict=True):
        entrant = replace(row.entrant, name=name)
        _check(entrant, entrants, row.line, check)
        entrants[name] = entrant
    classes = {name: row.group for row, name in zip(found, names, strict=True) if row.group}
    apart = tuple(name for row, name in zip(found, names, strict=True) if name != row.entrant.name)
    return EntrantList(tuple(entrants.values()), tuple(ignored), classes, apart)


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
    if FIRST in header and LAST not in header:  # Name, Vorname; Nom, Prénom
        header = [LAST if column == NAME else column for column in header]
    if LAST in header and FIRST not in header:  # Nombre, Apellidos; Nome, Apelido
        header = [FIRST if column == NAME else column for column in header]
    if NAME not in header and FIRST not in header:
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


def _row(number: int, cells: Sequence[str], header: Sequence[str]) -> ListRow | None:
    """Who stands in a row; None if there is nobody in it. Raises ValueError."""
    columns = header or PLAIN
    if len(cells) == 1 and columns[0] == NAME:
        plain = header and not {"/", "="} & {*cells[0]}
        return ListRow(number, _of_word(_shortened(cells[0]) if plain else cells[0]))
    if not header and any(cells[len(PLAIN) :]):
        raise ValueError("a row has a name, an AI and a team")
    row = dict.fromkeys(COLUMNS, "") | {
        column: cell for column, cell in zip(columns, cells, strict=False) if column in COLUMNS
    }
    name = _shortened(row[NAME] or row[FIRST] or row[LAST])
    if not (name or row[AI] or row[TEAM]):
        return None
    group = row[CLASS][:MAX_NAME].strip()
    return ListRow(number, _checked(Entrant(name, row[AI], row[TEAM])), row[LAST] if row[FIRST] else "", group)


def _shortened(name: str) -> str:
    """A full name that is too long, by its first and its last word, or the initial of that."""
    words = name.split()
    if len(name) <= MAX_NAME or len(words) < 2:
        return name
    short = f"{words[0]} {words[-1]}"
    return short if len(short) <= MAX_NAME else f"{words[0][: MAX_NAME - 3]} {words[-1][0]}."


def _told_apart(rows: Sequence[ListRow]) -> list[str]:
    """The names of all rows: of equal ones with the fewest letters of the last name that tell them apart."""
    names = [row.entrant.name for row in rows]
    found = list(names)
    for i, row in enumerate(rows):
        same = [other for other in rows if other.entrant.name == row.entrant.name]
        if len(same) == 1 or not row.last:
            continue
        others = [other.last.casefold() for other in same if other is not row and other.last]
        for letters in range(1, len(row.last) + 1):
            short = row.last[:letters]
            if letters == len(row.last) or not any(other.startswith(short.casefold()) for other in others):
                break
        dot = "." if len(short) < len(row.last) else ""
        found[i] = f"{row.entrant.name[: MAX_NAME - len(short) - 2]} {short}{dot}"[:MAX_NAME].strip()
    return found


def _of_word(word: str) -> Entrant:
    who, _, brain = word.partition("=")
    name, _, team = who.partition("/")
    return _checked(Entrant(name.strip(), brain.strip(), team.strip()))


def _checked(entrant: Entrant) -> Entrant:
    check_name(entrant.name)
    if entrant.team:
        check_name(entrant.team, "bad_team")
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
