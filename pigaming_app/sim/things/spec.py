"""Things in an arena file. Every arena may have some, beside all that its game reads:

[[thing]]
use = "wall"             # robots and bullets stop at it; "mud" slows robots down, "line" is paint
outline = [[700, 300], [820, 300], [820, 380], [700, 380]]  # px, convex, clockwise on screen
margin = 4               # px by which it may extend beyond its outline, default 0
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from pigaming_app.sim.things.convex import Outline, is_convex, signed_area
from pigaming_app.sim.things.cover import CoverPart, around, capsules
from pigaming_app.sim.toml_table import FieldError, TomlTable

MOST = 24  # things in an arena
CORNERS = 48  # of an outline, at most
FAR = 400.0  # px by which an outline may extend beyond the arena
MAX_MARGIN = 60.0  # px


class Use(StrEnum):
    """What a thing is in the game."""

    WALL = "wall"
    MUD = "mud"
    LINE = "line"


@dataclass(frozen=True)
class ThingSpec:
    """A thing on the mat. `outline`: px, convex, clockwise on screen; `margin`: px by which it may extend beyond."""

    use: Use
    outline: Outline
    margin: float = 0.0

    @property
    def middle(self) -> tuple[float, float]:
        """Mean of the corners, px."""
        count = len(self.outline)
        return sum(x for x, _ in self.outline) / count, sum(y for _, y in self.outline) / count


def read_things(table: TomlTable) -> tuple[ThingSpec, ...]:
    """Parse the tables [[thing]]. Raises FieldError."""
    entries = table.tables("thing")
    if len(entries) > MOST:
        raise table.error("thing", f"{len(entries)} things, but at most {MOST} are possible")
    return tuple(_thing(entry) for entry in entries)


def written(things: Sequence[ThingSpec]) -> str:
    """The tables [[thing]] of things, to append to the text of an arena file."""
    return "".join(
        f'\n[[thing]]\nuse = "{thing.use}"\n'
        f"outline = [{', '.join(f'[{x:.1f}, {y:.1f}]' for x, y in thing.outline)}]\nmargin = {thing.margin:.1f}\n"
        for thing in things
    )


def wall_capsules(things: Sequence[ThingSpec], room: int) -> list[CoverPart]:
    """The capsules of all things that are walls, at most `room`; if need be the smallest things get a single one each.

    Raises FieldError if there are too many.
    """
    solid = sorted((thing for thing in things if thing.use is Use.WALL), key=lambda thing: signed_area(thing.outline))
    parts = [capsules(thing.outline, thing.margin) for thing in solid]
    for i, thing in enumerate(solid):
        if sum(map(len, parts)) <= room:
            break
        parts[i] = [around(thing.outline, thing.margin)]
    if sum(map(len, parts)) > room:
        raise FieldError("thing", f"{len(solid)} things that are walls, but there is room for {room}")
    return [part for some in parts for part in some]


def mud_capsules(things: Sequence[ThingSpec], room: int) -> list[CoverPart]:
    """The capsules of all things that are mud. Raises FieldError if there are more than `room`."""
    parts = [part for thing in things if thing.use is Use.MUD for part in capsules(thing.outline, 0.0, hollow=0.0)]
    if len(parts) > room:
        raise FieldError("thing", "there is too much mud")
    return parts


def _thing(entry: TomlTable) -> ThingSpec:
    entry.only("use", "outline", "margin")
    points = entry.entries.get("outline")
    if not isinstance(points, list) or not 3 <= len(points) <= CORNERS:
        raise entry.error("outline", f"3 to {CORNERS} points are needed")
    row = TomlTable({f"[{i + 1}]": point for i, point in enumerate(points)}, f"{entry.path}outline")
    outline = tuple((x, y) for x, y in (row.numbers(key, 2, -FAR, FAR + 1600.0) for key in row.entries))
    if not is_convex(outline):
        raise entry.error("outline", "must be convex, and clockwise on screen")
    return ThingSpec(
        Use(entry.word("use", [str(use) for use in Use])), outline, entry.number("margin", 0.0, 0.0, MAX_MARGIN, " px")
    )
