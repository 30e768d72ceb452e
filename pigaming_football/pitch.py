"""Pitches: the arena files of Robot Football, and what makes one unplayable.

Besides walls, which are all solid, and starts (the 1st and 3rd of the left team, the others of the right), a file has

[goal]
width = 260              # px, of both goals, in the middle of the left and right rim

[[drop]]                 # points at which the ball is dropped anew, the middle first; real things may cover some
at = [800, 450]
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import dist, hypot

from pigaming_app.api.arenas import FieldError, Layout, TomlTable, layout_faults, read_layout
from pigaming_app.api.rules import HEIGHT, ROBOTS, WIDTH, offset_from_wall

from .space import Place, Space, traps
from .state import MAX_DROPS, MIDDLE, Rules
from .wedges import wedges

NARROWEST, WIDEST = 120.0, 500.0  # px, of a goal
FEWEST = ROBOTS + 2  # drop points: every robot covers at most one, and one is where the ball lies
BALL = Rules().radius
APART = 4.0  # px between robots with a ball each at two drop points
SLOP = 0.01  # px, for rounding
Point = tuple[float, float]


@dataclass(frozen=True)
class Pitch:
    """Goals and drop points of an arena: px."""

    mouth: float  # half the width of the goals
    drops: tuple[Point, ...]


class Ways:
    """Where ball and robots get on a layout, with its things or without."""

    def __init__(self, layout: Layout) -> None:
        walls = layout.built_walls()
        self.walls, self.mouth = walls, layout.plan.mouth
        self.ball, self.robots = Space(walls, BALL, layout.plan.mouth), Space(walls, layout.radius)
        self.touch = layout.radius + BALL  # px between the centres of a robot and a ball that it touches
        self.catch = self.touch + Rules().catch_reach  # that it can catch
        # Cosine of the angle in which a robot just touches a wedged ball
        self.sharp = 1.0 - 2.0 * ((layout.radius - BALL) / self.touch) ** 2
        areas = (self.ball.area(*point) for point in layout.plan.drops)
        self.pitch = next((area for area in areas if area >= 0), -1)
        self.room = self.robots.area(layout.starts[0].x, layout.starts[0].y)

    def refusal(self, point: Point) -> str:
        """The reason why no ball may be dropped at a point, or nothing."""
        area = self.ball.area(*point)
        if area < 0 or not BALL <= point[0] <= WIDTH - BALL:
            return f"a ball at ({point[0]:g}, {point[1]:g}) would lie in a wall"
        if area != self.pitch >= 0:
            return "no ball gets from there to the middle"
        if self.room >= 0 and not self.robots.is_near(self.room, *point, self.catch):
            return "no robot gets to a ball there"
        return ""

    def traps(self) -> Iterator[Place]:
        """Where a ball gets stuck: no robot catches it, or it is wedged too deep for a robot to touch it."""
        yield from traps(self.ball, self.pitch, self.robots, self.room, self.catch)
        for x, y, out_x, out_y in wedges(self.walls, self.mouth, BALL, self.sharp):
            on = [(x + step * out_x, y + step * out_y) for step in range(0, 40, 5)]
            area = next((area for point in on if (area := self.ball.area(*point)) >= 0), -1)
            if area == self.pitch and self._is_free(x, y) and not self.robots.is_near(self.room, x, y, self.touch):
                yield x, y, 2 * BALL

    def _is_free(self, x: float, y: float) -> bool:
        """True if a ball at (x, y), px, overlaps no wall."""
        inside = BALL - SLOP <= x <= WIDTH - BALL + SLOP and BALL - SLOP <= y <= HEIGHT - BALL + SLOP
        return inside and all(hypot(*offset_from_wall(wall, x, y)) > wall.half + BALL - SLOP for wall in self.walls)


def read(table: TomlTable) -> Layout:
    """Parse a pitch. Raises FieldError."""
    layout, ways = _parsed(table)
    for fault in _faults(table, layout, ways):
        raise fault
    points = tuple(point for point in layout.plan.drops if not ways.refusal(point))
    return replace(layout, plan=replace(layout.plan, drops=points))


def faults(table: TomlTable) -> Iterator[FieldError]:
    """All that makes a pitch unplayable, then what is only bad."""
    try:
        layout, ways = _parsed(table)
        yield from _faults(table, layout, ways)
        yield from layout_faults(layout)
        if ways.pitch >= 0 and ways.room >= 0:
            reason = "no robot gets a ball out of there"  # it is dropped anew, so the pitch can be played
            yield from (FieldError("ball", reason, place, "ball") for place in ways.traps())
    except FieldError as fault:
        yield fault


def _parsed(table: TomlTable) -> tuple[Layout, Ways]:
    """A pitch that may be unplayable. Raises FieldError."""
    layout = read_layout(table, "goal", "drop", solid=True)
    goal = table.table("goal")
    goal.only("width")
    mouth = goal.number("width", None, NARROWEST, WIDEST, " px") / 2
    points = []
    for entry in table.tables("drop"):
        entry.only("at")
        points.append(entry.point("at"))
    layout = replace(layout, plan=Pitch(mouth, tuple(points)), floor=layout.floor or "turf")
    return layout, Ways(layout)


def _faults(table: TomlTable, layout: Layout, ways: Ways) -> Iterator[FieldError]:
    """Drop points that are useless, and goals that no ball reaches."""
    points, bare, apart = layout.plan.drops, ways, 2.0 * ways.touch + APART
    if layout.things:
        bare = Ways(replace(layout, things=()))
    for i, point in enumerate(points):
        key, place = f"drop[{i + 1}].at", (*point, BALL)
        if reason := bare.refusal(point):
            yield FieldError(key, reason, place)
        if any(dist(point, other) < apart for other in points[:i]):
            yield FieldError(key, f"nearer than {apart:g} px to another drop point", place)
    if not points or points[0] != (WIDTH / 2, MIDDLE):
        yield table.error("drop", f"the first must be at [{WIDTH / 2:g}, {MIDDLE:g}], the middle")
    free = sum(not ways.refusal(point) for point in points)
    if not FEWEST <= free <= len(points) <= MAX_DROPS:
        yield table.error("drop", f"{free} free points, but {FEWEST} to {MAX_DROPS} are needed")
    for name, x in (("left", 0.0), ("right", WIDTH)):
        if ways.pitch >= 0 and not ways.ball.meets(ways.pitch, x):
            yield FieldError("goal", f"no ball gets to the {name} one", (x, MIDDLE, layout.plan.mouth))
