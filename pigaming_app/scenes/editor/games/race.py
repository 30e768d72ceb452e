"""Robot Race: a course round control points, four lines across it, and mud on it."""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from math import atan2, hypot, pi, tan
from random import Random
from typing import ClassVar

import pygame

from pigaming_app.games.drawing.values import Drawing, Part
from pigaming_app.games.race.circuit import NARROWEST, WIDEST, Corner, traced
from pigaming_app.games.race.course import POINTS, Course, point_at
from pigaming_app.games.race.racing_line import line_round
from pigaming_app.games.race.state import LINES, RaceRules
from pigaming_app.scenes.editor.model.shapes import (
    Dial,
    Item,
    Outline,
    Paper,
    Routes,
    Shape,
    Tool,
    Tools,
    apart,
    following,
    whole,
)
from pigaming_app.scenes.editor.model.symmetry import Image
from pigaming_app.scenes.editor.parts.things import MUD, DrawnThing
from pigaming_app.scenes.views.race.lines import LineFrame, draw_line, frame
from pigaming_app.scenes.views.race.track import EDGE, MARKS, draw_kerbs, edges, ribs
from pigaming_app.scenes.views.things.styles import MUD as BROWN
from pigaming_app.scenes.views.things.styles import ROAD
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import ALARM, BLACK, ICE, Point, dim, regular_polygon
from pigaming_app.ui.draw.frame_budget import Steps

WIDE, WIDTHS = 180, (150, 180, 210, 250, 300)  # px, of the course
WIDEST_ARC, TIGHTEST = 300.0, 40.0  # px, radii of arcs
SPARE = 4.0  # px of straight between an arc and the middle between two corners
KNOB = 20.0  # px, of a control point
RAIL = 26.0  # px from the middle of a line to its rails
MOST, LEAST = 24, 3  # corners
EARTH = dim(BROWN, 0.5)
CLODS = 420


def _corner(at: Point) -> Part:
    return Part.of("corner", at=whole(*at), radius=200, width=WIDE)


class ControlPoint(Shape):
    """A corner of the course."""

    fixed = False
    is_handle = True

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        return (regular_polygon(4, KNOB, 0.0, *part.point("at")),)

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        x, y = part.point("at")
        diamond = regular_polygon(4, KNOB, 0.0, x, y)
        paper.flat().solid(diamond).neon(diamond, ICE, 4, True)  # yellow if it is selected
        if not k:
            paper.flat().disc(x, y, 6, ICE)

    def same(self, part: Part, other: Part) -> bool:
        return apart(part.point("at"), other.point("at")) < 2.0

    def dials(self, part: Part) -> Sequence[Dial]:
        return (Dial("thick", _wider, lambda part: str(round(part.number("width", WIDE) - 120))),)


class StartLine(Shape):
    """A line across the course: the start and finish of a robot. It is an entry of [track], placed on the course."""

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        line = _frame(part)
        ends = ((-RAIL, -line.half), (RAIL, -line.half), (RAIL, line.half), (-RAIL, line.half))
        return ([line.at(ahead, right) for ahead, right in ends],)

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        ink = paper.flat()
        draw_line(ink, ink, _frame(part), ICE)

    def image(self, part: Part, image: Image) -> Part:
        return part.changed("at", whole(*image.point(*part.point("at"))))

    def same(self, part: Part, other: Part) -> bool:
        return apart(part.point("at"), other.point("at")) < 25.0


class RaceTools(Tools):
    """The editor of Robot Race."""

    game = "race"
    shapes: ClassVar[Mapping[str, Shape]] = {"thing": DrawnThing(ROAD), "line": StartLine(), "corner": ControlPoint()}
    palette = (Tool("corner", "corner", lambda a, b: _corner(a), MOST), MUD)
    empty = Drawing(
        (
            Part("track", (("lines", (0.05, 0.3, 0.55, 0.8)),), several=False),
            *(_corner(at) for at in ((150, 150), (1450, 150), (1450, 750), (150, 750))),
        )
    )

    def items(self, drawing: Drawing) -> list[Item]:
        """The lines lie between mud and control points."""
        found = super().items(drawing)
        if not _shares(drawing) or course_in(drawing.of("corner")) is None:
            return found
        mud = sum(item.kind == "thing" for item in found)
        return [*found[:mud], *(Item("line", k) for k in range(LINES)), *found[mud:]]

    def part(self, drawing: Drawing, item: Item) -> Part:
        course = course_in(drawing.of("corner"))
        if item.kind != "line" or course is None:
            return super().part(drawing, item)
        share = _shares(drawing)[item.k]
        line = frame(course, share * course.length)
        return Part.of("line", at=(line.x, line.y), way=(line.c, line.s), half=line.half, share=share)

    def with_part(self, drawing: Drawing, item: Item, part: Part) -> Drawing:
        course = course_in(drawing.of("corner"))
        if item.kind != "line" or course is None:
            return super().with_part(drawing, item, part)
        x, y = part.point("at")
        k = min(range(POINTS), key=lambda i: hypot(course.xs[i] - x, course.ys[i] - y))
        shares = [*_shares(drawing)]
        shares[item.k] = round(k / POINTS, 4)
        return drawing.changed("track", 0, drawing.of("track")[0].changed("lines", tuple(shares)))

    def added(self, drawing: Drawing, part: Part) -> tuple[Drawing, Item]:
        """A control point is added between the two next to it."""
        if part.kind != "corner":
            return super().added(drawing, part)
        corners, at = [*drawing.of("corner")], part.point("at")
        points = [corner.point("at") for corner in corners]
        if not points:
            return super().added(drawing, part)
        k = min(range(len(points)), key=lambda i: _detour(points[i], at, points[(i + 1) % len(points)])) + 1
        width = corners[k - 1].number("width", WIDE)
        corners.insert(k, part.changed("width", round(width)))
        return _with_corners(drawing, corners), Item("corner", k)

    def removable(self, drawing: Drawing, item: Item) -> bool:
        return super().removable(drawing, item) and (item.kind != "corner" or len(drawing.of("corner")) > LEAST)

    def settled(self, before: Drawing, after: Drawing) -> Drawing:
        """With the widest arcs at all corners that were moved, or whose neighbours were."""
        old, corners = before.of("corner"), [*after.of("corner")]
        if old == tuple(corners):
            return after
        known = {_around(old, i) for i in range(len(old))}
        free = [i for i in range(len(corners)) if _around(corners, i) not in known]
        cuts = {i: _cut(corners, i) for i in range(len(corners)) if i not in free}
        for i in free:
            corners[i] = corners[i].changed("radius", round(_radius(corners, i, cuts)))
        return _with_corners(after, corners)

    def draw_ground(self, paper: Paper, drawing: Drawing) -> Steps[None]:
        """The road between the edges, with kerbs; where it cannot be built, its corners."""
        ink, course = paper.flat(), course_in(drawing.of("corner"))
        random = Random(1)
        for _ in range(CLODS):
            ink.disc(random.uniform(20, WIDTH - 20), random.uniform(20, HEIGHT - 20), random.choice((2, 3, 4)), EARTH)
        if course is None:
            if corners := [corner.point("at") for corner in drawing.of("corner")]:
                ink.line(corners, ALARM, 5, True)
            return
        yield
        left, right = edges(course)
        for i, (a, b) in enumerate(zip(left, right, strict=True)):
            ink.fill([left[i - 1], a, b, right[i - 1]], BLACK)
        yield
        ink.dashes([(rib.x, rib.y) for rib in ribs(course)], MARKS, 4, 34, 40)
        yield
        ink.neon(left, EDGE, 5, True)
        yield
        ink.neon(right, EDGE, 5, True)
        yield
        draw_kerbs(ink, course)

    def ground_of(self, drawing: Drawing) -> Drawing:
        return Drawing(drawing.of("corner"))

    def sketch_ground(self, screen: pygame.Surface, drawing: Drawing, at: Point, scale: float, share: float) -> None:
        """The road as plain lines; `share`: as far as it is drawn."""

        def placed(points: Sequence[Point]) -> list[Point]:
            return [(at[0] + scale * x, at[1] + scale * y) for x, y in points]

        course = course_in(drawing.of("corner"))
        if course is None:
            corners = [corner.point("at") for corner in drawing.of("corner")]
            if len(corners) > 1:
                pygame.draw.lines(screen, ALARM, True, placed(corners), 4)
            return
        count = max(2, round(share * POINTS))
        left, right = (placed(edge[:count]) for edge in edges(course))
        for edge in (left, right):
            pygame.draw.lines(screen, EDGE, share >= 1.0, edge, 4)

    def routes(self, arena: Arena) -> Routes:
        """The fastest line, which takes a second."""
        course, rules = arena.plan.course, RaceRules()
        (asides, _), _ = line_round(course, rules.speed, rules.turn_rate, arena.plan.solid, arena.plan.lines)
        points = [point_at(course, k * course.step, aside) for k, aside in enumerate(asides)]
        return ([*points, points[0]],)


@lru_cache(maxsize=16)
def course_in(corners: tuple[Part, ...]) -> Course | None:
    """The course round corners; None if there is none."""
    try:
        return traced(tuple(_spec(corner) for corner in corners)) if len(corners) >= LEAST else None
    except (FieldError, ZeroDivisionError):
        return None


def _spec(part: Part) -> Corner:
    x, y = part.point("at")
    width = part.number("width", WIDE, NARROWEST, WIDEST)
    return Corner(x, y, part.number("radius", TIGHTEST, TIGHTEST, 2000), width)


def _with_corners(drawing: Drawing, corners: Sequence[Part]) -> Drawing:
    """A drawing with other corners."""
    return Drawing((*(part for part in drawing.parts if part.kind != "corner"), *corners))


def _wider(part: Part) -> Part:
    return part.changed("width", round(following(WIDTHS, part.number("width", WIDE))))


def _shares(drawing: Drawing) -> tuple[float, ...]:
    """The lines of a track; none if they are not valid."""
    for part in drawing.of("track"):
        found = part.get("lines")
        if isinstance(found, tuple) and len(found) == LINES:
            shares = tuple(float(share) for share in found if isinstance(share, int | float) and 0.0 <= share <= 1.0)
            return shares if len(shares) == LINES else ()
    return ()


def _frame(part: Part) -> LineFrame:
    (x, y), (c, s) = part.point("at"), part.point("way")
    return LineFrame(x, y, c, s, part.number("half", WIDE / 2))


def _detour(a: Point, at: Point, b: Point) -> float:
    """Px by which the way from a to b becomes longer through a point."""
    return apart(a, at) + apart(at, b) - apart(a, b)


def _around(corners: Sequence[Part], i: int) -> tuple[object, ...]:
    """What the arc of a corner depends on."""
    three = corners[i - 1], corners[i], corners[(i + 1) % len(corners)]
    return (*(part.get("at") for part in three), corners[i].get("width"))


def _half_angle(corners: Sequence[Part], i: int) -> float:
    """Half the angle between the two straights at a corner, rad."""
    x, y = corners[i].point("at")
    (ax, ay), (bx, by) = (corners[k % len(corners)].point("at") for k in (i - 1, i + 1))
    turn = abs((atan2(by - y, bx - x) - atan2(ay - y, ax - x) + pi) % (2 * pi) - pi)
    return min(max(turn / 2, 0.11), 1.5)


def _cut(corners: Sequence[Part], i: int) -> float:
    """Px from a corner to the start of its arc."""
    return corners[i].number("radius", TIGHTEST) / tan(_half_angle(corners, i))


def _radius(corners: Sequence[Part], i: int, cuts: Mapping[int, float]) -> float:
    """The widest arc at a corner; `cuts`: of the corners whose arcs stay as they are."""
    at, rooms = corners[i].point("at"), list[float]()
    for k in ((i - 1) % len(corners), (i + 1) % len(corners)):
        way = apart(at, corners[k].point("at"))
        rooms.append(way - cuts[k] - 1.0 if k in cuts else way / 2 - SPARE / 2)
    return min(max(min(rooms) * tan(_half_angle(corners, i)), TIGHTEST), WIDEST_ARC)


TOOLS = RaceTools()
