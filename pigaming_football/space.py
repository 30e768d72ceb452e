"""Where a disc gets on a pitch: the free stretches of scan lines, joined to areas where they touch.

The disc is a ball or a robot. Its centre keeps `radius` px from walls and rim; a ball's may cross the goals' lines.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import hypot, sqrt

from pigaming_app.api.rules import HEIGHT, WIDTH, Wall

from .state import MIDDLE

PITCH = 5.0  # px from line to line
LINES = round(HEIGHT / PITCH) + 1
SMALLEST = 100.0  # px^2, of a trap that is worth a mark
Post = tuple[float, float]
Place = tuple[float, float, float]  # middle and extent, px


@dataclass
class Stretch:
    """A free stretch of a line. `area`: the same number for all that are connected; -1: not known yet."""

    left: float
    right: float
    area: int = -1


class Space:
    """The places of a disc's centre. `mouth`: half the width of the goals; 0: it enters none."""

    def __init__(self, walls: Sequence[Wall], radius: float, mouth: float = 0.0) -> None:
        posts = [(x, MIDDLE + side * mouth) for x in (0.0, WIDTH) for side in (-1, 1) if mouth]
        self.lines = [[*_free(walls, posts, radius, mouth, k * PITCH)] for k in range(LINES)]
        areas = 0
        for k, line in enumerate(self.lines):
            for stretch in line:
                if stretch.area < 0:
                    self._spread(k, stretch, areas)
                    areas += 1

    def _spread(self, k: int, stretch: Stretch, area: int) -> None:
        """Give an area to a stretch and all that are connected with it."""
        stretch.area = area
        todo = [(k, stretch)]
        while todo:
            k, here = todo.pop()
            for other in (k - 1, k + 1):
                for there in self.lines[other] if 0 <= other < LINES else ():
                    if there.area < 0 and there.left < here.right and there.right > here.left:
                        there.area = area
                        todo.append((other, there))

    def area(self, x: float, y: float) -> int:
        """The area of a point; -1 if the disc cannot be there."""
        k = min(max(round(y / PITCH), 0), LINES - 1)
        return next((stretch.area for stretch in self.lines[k] if stretch.left <= x <= stretch.right), -1)

    def meets(self, area: int, x: float) -> bool:
        """True if an area reaches the line at x on either side of the pitch."""
        return any(s.area == area and s.left <= x <= s.right for line in self.lines for s in line)

    def is_near(self, area: int, x: float, y: float, reach: float) -> bool:
        """True if an area has a point at most `reach` px from (x, y)."""
        return any(left <= x <= right for left, right in self.around(area, y, reach))

    def around(self, area: int, y: float, reach: float) -> Iterator[tuple[float, float]]:
        """The stretches of the line at y, px, that are at most `reach` px from an area."""
        first, last = max(0, int((y - reach) / PITCH)), min(LINES - 1, int((y + reach) / PITCH) + 1)
        for k in range(first, last + 1):
            rest = reach * reach - (k * PITCH - y) ** 2
            if rest >= 0.0:
                yield from ((s.left - sqrt(rest), s.right + sqrt(rest)) for s in self.lines[k] if s.area == area)


def traps(ball: Space, area: int, robots: Space, room: int, reach: float) -> list[Place]:
    """Where a ball of an area is farther than `reach` px from every robot of the area `room`."""
    groups: list[list[tuple[int, float, float]]] = []
    for k in range(0, LINES, 2):
        near = sorted(robots.around(room, k * PITCH, reach))
        for stretch in ball.lines[k]:
            if stretch.area == area:
                for left, right in gaps(near, stretch.left, stretch.right):
                    _group(groups, (k, left, right))
    return [place for group in groups if (place := _place(group))]


def gaps(covered: Iterable[tuple[float, float]], left: float, right: float) -> Iterator[tuple[float, float]]:
    """The parts from left to right that no interval covers; these come in the order of their left ends."""
    for begin, end in covered:
        if begin > right:
            break
        if begin > left:
            yield left, begin
        left = max(left, end)
    if left < right:
        yield left, right


def _free(walls: Sequence[Wall], posts: Sequence[Post], radius: float, mouth: float, y: float) -> Iterator[Stretch]:
    """The free stretches of the line at y."""
    if not radius <= y <= HEIGHT - radius:
        return
    inset = 0.0 if abs(y - MIDDLE) < mouth else radius
    chords = [_chord(wall.ax, wall.ay, wall.bx, wall.by, wall.half + radius, y) for wall in walls]
    chords += [_chord(*post, *post, radius, y) for post in posts]
    blocked = sorted((min(chord), max(chord)) for chord in chords if chord)
    yield from (Stretch(*gap) for gap in gaps(blocked, inset, WIDTH - inset))


def _chord(ax: float, ay: float, bx: float, by: float, reach: float, y: float) -> list[float]:
    """Abscissae of a capsule's outline on the line at y, among them the outermost; none if it does not get there."""
    if not min(ay, by) - reach < y < max(ay, by) + reach:
        return []
    found: list[float] = []
    for x, middle in ((ax, ay), (bx, by)):
        if (rest := reach * reach - (y - middle) ** 2) > 0.0:
            found += [x - sqrt(rest), x + sqrt(rest)]
    length = hypot(bx - ax, by - ay)
    for side in (reach / length, -reach / length) if length and ay != by else ():
        top = ay - side * (bx - ax)
        share = (y - top) / (by - ay)
        if 0.0 <= share <= 1.0:
            found.append(ax + side * (by - ay) + share * (bx - ax))
    return found


def _group(groups: list[list[tuple[int, float, float]]], part: tuple[int, float, float]) -> None:
    """Add a part of a line to the groups that it touches on the line before, which become one."""
    k, left, right = part
    touched = [g for g in groups if any(i == k - 2 and a < right and b > left for i, a, b in g)]
    groups[:] = [g for g in groups if g not in touched] + [[*(one for g in touched for one in g), part]]


def _place(group: Sequence[tuple[int, float, float]]) -> Place | None:
    """Middle and extent of a group of parts; None if it is too small to matter."""
    lines, lefts, rights = zip(*group, strict=True)
    size = sum(right - left for _, left, right in group)
    if 2 * PITCH * size < SMALLEST:
        return None
    x = sum((right - left) * (right + left) / 2 for _, left, right in group) / size
    y = sum((right - left) * k for k, left, right in group) / size * PITCH
    return x, y, max(max(rights) - min(lefts), PITCH * (max(lines) - min(lines)), 40.0) / 2
