"""Lists of entrants: typed, pasted, or in a text or CSV file.

Each line is a name, NAME=AI, NAME/TEAM or NAME/TEAM=AI, or a row name, AI, team of a table, separated by commas,
semicolons or tabs, with or without a header. Empty lines, and lines that begin with #, do not count.
"""

import csv
from collections.abc import Iterable
from itertools import chain

from pigaming_app.events.spec import MOST, Entrant, check_name

HEADER = ("name", "ai", "team")
SEPARATORS = (";", "\t", ",")


def entrants_of_text(text: str) -> tuple[Entrant, ...]:
    """The entrants of a list, one in a line. Raises ValueError with the line."""
    found: list[Entrant] = []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.strip().lstrip("\ufeff")
        if not line or line.startswith("#"):
            continue
        try:
            entrant = _of_line(line)
            if entrant and entrant.name in (other.name for other in found):
                raise ValueError(f"{entrant.name} is entered twice")
        except ValueError as error:
            raise ValueError(f"line {number}: {error}") from None
        if entrant:
            found.append(entrant)
        if len(found) > MOST:
            raise ValueError(f"line {number}: an event has at most {MOST} entrants")
    return tuple(found)


def entrants_of_words(words: Iterable[str]) -> tuple[Entrant, ...]:
    """The entrants of words such as AAA=level1. Raises ValueError."""
    return tuple(_of_word(word.strip()) for word in words)


def _of_line(line: str) -> Entrant | None:
    """The entrant of a line; None for a header."""
    separator = next((one for one in SEPARATORS if one in line), None)
    if separator is None:
        return None if line.lower() == HEADER[0] else _of_word(line)
    try:
        cells = [cell.strip() for cell in next(csv.reader([line], delimiter=separator))]
    except csv.Error as error:
        raise ValueError(str(error)) from None
    if cells[0].lower() == HEADER[0]:
        return None
    name, brain, team, *more = chain(cells, [""] * max(0, 3 - len(cells)))
    if any(more):
        raise ValueError("a row has a name, an AI and a team")
    return _checked(Entrant(name, brain, team))


def _of_word(word: str) -> Entrant:
    who, _, brain = word.partition("=")
    name, _, team = who.partition("/")
    return _checked(Entrant(name.strip(), brain.strip(), team.strip()))


def _checked(entrant: Entrant) -> Entrant:
    check_name(entrant.name)
    if entrant.team:
        check_name(entrant.team, "team")
    return entrant
