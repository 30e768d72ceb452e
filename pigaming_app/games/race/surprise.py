"""Tracks from a seed: the same after half a turn, so that the first two lines see the same course as the other two."""

from math import atan2, cos, hypot, pi, sin, tan
from random import Random

from pigaming_app.games.race.circuit import Corner, course_of
from pigaming_app.games.race.furniture import BEHIND, ROW, Bends
from pigaming_app.games.race.state import LINES
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.sim.world import HEIGHT, WIDTH

HALVES = (3, 6)  # corners, each with its mirror image: at least, at most
TRIES = 200  # then the plain course, which always fits
WIDTHS = (172, 184, 200)  # px
GRID = 10  # px: every coordinate is a multiple
TIGHTEST, WIDEST_ARC = 112, 300  # px, radius of a corner
SPARE = 8.0  # px of straight between two arcs, at least
PLACES = 20  # in a quarter of a lap, at which the lines are tried
PLAIN = ((110, 110), (1490, 110))  # corners of the plain course, with their mirror images
Point = tuple[int, int]


def surprise(seed: int) -> str:
    """The text of an arena file. The same seed gives the same arena on every system."""
    random = Random(seed)
    corners = next((found for _ in range(TRIES) if (found := _corners(random))), None)
    corners = corners or rounded(_both(PLAIN), WIDTHS[0])
    assert corners
    lines = [f'[title]\nen = "Surprise {seed}"\npt = "Surpresa {seed}"']
    lines.append(f"[track]\nlines = [{', '.join(f'{share:.4f}' for share in _lines(corners))}]")
    lines += [
        f"[[corner]]\nat = [{corner.x:g}, {corner.y:g}]\nradius = {corner.radius:g}\nwidth = {corner.width:g}"
        for corner in corners
    ]
    return "\n\n".join(lines) + "\n"


def rounded(points: tuple[Point, ...], width: float) -> tuple[Corner, ...] | None:
    """A course round control points, px, with arcs as wide as their distances allow; None if some is too tight."""
    corners = []
    for i, (x, y) in enumerate(points):
        (ax, ay), (bx, by) = points[i - 1], points[(i + 1) % len(points)]
        come, go = hypot(ax - x, ay - y), hypot(bx - x, by - y)
        angle = abs((atan2(by - y, bx - x) - atan2(ay - y, ax - x) + pi) % (2 * pi) - pi) / 2
        radius = min(float(WIDEST_ARC), (min(come, go) / 2 - SPARE / 2) * tan(min(angle, 1.5)))
        if radius < max(TIGHTEST, width / 2):
            return None
        corners.append(Corner(float(x), float(y), float(int(radius)), float(width)))
    return tuple(corners)


def _corners(random: Random) -> tuple[Corner, ...] | None:
    """The corners of a course that can be driven; None if the dice do not make one."""
    width = WIDTHS[int(len(WIDTHS) * random.random())]
    half = HALVES[0] + int(random.random() * (HALVES[1] - HALVES[0] + 1))
    first = 2 * pi * random.random()
    points = []
    for k in range(half):
        angle = first + pi * (k + 0.5 * (random.random() - 0.5)) / half
        share = 1.0 if random.random() < 0.55 else 0.35 + 0.5 * random.random()
        reach = min(_room(WIDTH, width) / max(abs(cos(angle)), 1e-9), _room(HEIGHT, width) / max(abs(sin(angle)), 1e-9))
        x, y = WIDTH / 2 + share * reach * cos(angle), HEIGHT / 2 + share * reach * sin(angle)
        points.append((GRID * round(x / GRID), GRID * round(y / GRID)))
    corners = rounded(_both(tuple(points)), width)
    if not corners:
        return None
    corners = tuple(
        corner._replace(radius=corners[k % half].radius)  # rounding may differ between the halves
        for k, corner in enumerate(corners)
    )
    try:
        course_of(corners)
    except FieldError:
        return None
    return corners


def _room(size: float, width: float) -> float:
    """Px from the middle of the arena to the outermost centre line."""
    return size / 2 - width / 2 - GRID


def _both(points: tuple[Point, ...]) -> tuple[Point, ...]:
    """Points, and the same after half a turn."""
    return *points, *((int(WIDTH) - x, int(HEIGHT) - y) for x, y in points)


def _lines(corners: tuple[Corner, ...]) -> list[float]:
    """Four lines a quarter of a lap apart, where robots start as straight as possible."""
    course = course_of(corners)
    between = Bends(course).between
    shares = [[place / PLACES / LINES + k / LINES for k in range(LINES)] for place in range(PLACES)]
    bends = [
        max(between(share * course.length - BEHIND - ROW, share * course.length) for share in some) for some in shares
    ]
    return shares[bends.index(min(bends))]
