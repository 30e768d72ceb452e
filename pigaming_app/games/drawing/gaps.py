"""Gaps between walls, or between a wall and the rim of the arena, that are too narrow for a robot."""

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import hypot

from pigaming_app.sim.arena import Layout, WallSpec, start_faults
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.sim.world import HEIGHT, WIDTH

TOUCHING = 1.0  # px between two walls that count as one
Gap = tuple[float, float, float]  # px between two walls, and the middle of that gap


def layout_faults(layout: Layout) -> Iterator[FieldError]:
    """What makes walls and starts of an arena unplayable, then gaps that are too narrow for a robot, which are flaws.

    Raises FieldError if its things do not fit.
    """
    yield from start_faults(layout)
    yield from narrow_gaps(layout.walls, layout.radius)


def narrow_gaps(walls: Sequence[WallSpec], radius: float, names: Sequence[str] = ()) -> Iterator[FieldError]:
    """The gaps too narrow for robots of a radius, px. Pockets of walls that touch, or touch a third one, are not gaps.

    `names`: of the walls in messages, if they are not all of the file in its order.
    """
    names = names or [f"wall[{i + 1}]" for i in range(len(walls))]
    between = {(i, j): _gap(walls[i], walls[j]) for i, j in combinations(range(len(walls)), 2)}
    joined = [{i} for i in range(len(walls))]
    for (i, j), (gap, _, _) in between.items():
        if gap <= TOUCHING:
            joined[i].add(j)
            joined[j].add(i)
    for (i, j), (gap, x, y) in between.items():
        if TOUCHING < gap < 2 * radius and not joined[i] & joined[j]:
            yield _narrow(names[j], names[i], (x, y, gap))
    for i, wall in enumerate(walls):
        for gap, x, y in _to_rim(wall):
            if TOUCHING < gap < 2 * radius:
                yield _narrow(names[i], "the rim of the arena", (x, y, gap))


def _narrow(name: str, other: str, place: tuple[float, float, float]) -> FieldError:
    """A gap through which no robot fits; bullets may."""
    return FieldError(name, f"{place[2]:.0f} px to {other}, too narrow for a robot", place, "gap")


def _gap(one: WallSpec, other: WallSpec) -> Gap:
    """The narrowest gap between two walls; 0 or less where they touch."""
    a, b = ((one.ax, one.ay), (one.bx, one.by)), ((other.ax, other.ay), (other.bx, other.by))
    if _cross(*a, *b):
        return 0.0, one.ax, one.ay
    pairs = [(point, _nearest(point, *b)) for point in a] + [(_nearest(point, *a), point) for point in b]
    (px, py), (qx, qy) = min(pairs, key=lambda pair: hypot(pair[0][0] - pair[1][0], pair[0][1] - pair[1][1]))
    way = hypot(qx - px, qy - py)
    share = (one.half + (way - one.half - other.half) / 2) / way if way else 0.0
    return way - one.half - other.half, px + share * (qx - px), py + share * (qy - py)


def _to_rim(wall: WallSpec) -> Iterator[Gap]:
    """The gap between a wall and each side of the arena, at the end that is nearer to it."""
    for x, y in sorted(((wall.ax, wall.ay), (wall.bx, wall.by)))[:1]:
        yield x - wall.half, (x - wall.half) / 2, y
    for x, y in sorted(((wall.ax, wall.ay), (wall.bx, wall.by)))[1:]:
        yield WIDTH - x - wall.half, (WIDTH + x + wall.half) / 2, y
    for y, x in sorted(((wall.ay, wall.ax), (wall.by, wall.bx)))[:1]:
        yield y - wall.half, x, (y - wall.half) / 2
    for y, x in sorted(((wall.ay, wall.ax), (wall.by, wall.bx)))[1:]:
        yield HEIGHT - y - wall.half, x, (HEIGHT + y + wall.half) / 2


def _nearest(point: tuple[float, float], a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """The point of the segment from a to b that is nearest to a point."""
    ex, ey = b[0] - a[0], b[1] - a[1]
    length2 = ex * ex + ey * ey
    share = ((point[0] - a[0]) * ex + (point[1] - a[1]) * ey) / length2 if length2 else 0.0
    share = min(max(share, 0.0), 1.0)
    return a[0] + share * ex, a[1] + share * ey


def _cross(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float], d: tuple[float, float]) -> bool:
    """True if the segments a b and c d cross."""
    return _side(a, b, c) * _side(a, b, d) < 0 and _side(c, d, a) * _side(c, d, b) < 0


def _side(a: tuple[float, float], b: tuple[float, float], point: tuple[float, float]) -> float:
    """Positive if a point lies to the right of the way from a to b, on screen."""
    return (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0])
