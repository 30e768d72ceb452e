"""Problems of a drawing, each with its place, fast enough for every frame of an editor that draws.

The checks are those of the game that reads arena files, and gaps that are too narrow, see `Game.faults`.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass

from pigaming_app.games.drawing.gaps import layout_faults
from pigaming_app.games.drawing.values import Drawing, Part, Value
from pigaming_app.games.game import Game
from pigaming_app.sim.arena import read_title
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import HEIGHT, RADIUS, WIDTH

NUMBERED = re.compile(r"(\w+)\[(\d+)\]")


@dataclass(frozen=True)
class Problem:
    """Something that cannot be played: the key, such as wall[2], the place, px, and the reason.

    `kind`: of the sentence about it on the screen.
    """

    key: str
    x: float
    y: float
    extent: float  # px to either side
    reason: str
    blocks: bool  # False: it can be played nevertheless
    kind: str


def problems(game: Game, drawing: Drawing) -> list[Problem]:
    """All that is known to make a drawing unplayable, and gaps too narrow for robots."""
    table, faults = TomlTable(drawing.document()), list[FieldError]()
    try:
        read_title(table)
    except FieldError as fault:
        faults.append(fault)
    faults += _faults(game, table)
    return [_problem(drawing, fault) for fault in faults]


def _problem(drawing: Drawing, fault: FieldError) -> Problem:
    place, kind = fault.place or _place(drawing, fault.key), re.split(r"[\[.]", fault.key)[0]
    if fault.flaw:
        return Problem(fault.key, *place, fault.reason, False, fault.flaw)
    return Problem(fault.key, *place, fault.reason, True, kind)


def _faults(game: Game, table: TomlTable) -> Iterable[FieldError]:
    """What the game finds, else the first error of its reader, or starts and gaps."""
    if game.faults:
        yield from game.faults(table)
        return
    try:
        yield from layout_faults(game.read(table))
    except FieldError as fault:
        yield fault


def _place(drawing: Drawing, key: str) -> tuple[float, float, float]:
    """Middle and extent of the part that a key names, px; of the whole arena if it has no place."""
    found = NUMBERED.match(key)
    parts = drawing.of(found[1]) if found else ()
    points = _points(parts[int(found[2]) - 1]) if found and 0 < int(found[2]) <= len(parts) else []
    if not points:
        return WIDTH / 2, HEIGHT / 2, WIDTH / 2
    (left, right), (top, bottom) = ((min(values), max(values)) for values in zip(*points, strict=True))
    x, y = min(max((left + right) / 2, 0.0), WIDTH), min(max((top + bottom) / 2, 0.0), HEIGHT)
    return x, y, max(right - left, bottom - top, 2 * RADIUS) / 2


def _points(part: Part) -> list[tuple[float, float]]:
    """The points of a part, as far as they are some."""
    listed = part.get("outline")
    values = [part.get(key) for key in ("at", "from", "to")] + list(listed if isinstance(listed, tuple) else ())
    return [point for value in values if (point := _point(value))]


def _point(value: Value) -> tuple[float, float] | None:
    match value:
        case (int() | float() as x, int() | float() as y) if abs(x) < 1e9 and abs(y) < 1e9:
            return float(x), float(y)
    return None
