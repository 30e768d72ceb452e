"""Arenas from a seed: walls and starts at random, the same from both ends.

Everything is mirrored at the middle, so opposite seats face the same. Between two walls that do not touch, and between
a wall and the rim, there is room for a robot to pass; `sim.arena` checks that all starts are connected.
"""

from math import cos, hypot, pi, sin
from random import Random

from pigaming_app.sim.world import HEIGHT, WIDTH

Point = tuple[int, int]
Wall = tuple[Point, Point, int, bool]  # ends, thickness, solid

PASSAGE = 115  # px between walls: a robot is 72 wide
CLEARANCE = 110  # px from the middle of a start to a wall
GRID = 10  # px: every coordinate is a multiple
STEP = 15  # px between the points of a wall at which distances are taken
PAIRS = (3, 8)  # walls, each with its mirror image: at least, at most
TRIES = 60  # to place them
CORNERS = ((110, 110, 45), (1490, 790, 225), (110, 790, 315), (1490, 110, 135))
SIDES = ((110, 450, 0), (1490, 450, 180), (800, 110, 90), (800, 790, 270))


def surprise(seed: int) -> str:
    """The text of an arena file. The same seed gives the same arena on every system."""
    random = Random(seed)
    starts = CORNERS if random.random() < 0.6 else SIDES
    wanted = PAIRS[0] + int(random.random() * (PAIRS[1] - PAIRS[0] + 1))
    walls: list[Wall] = []
    for _ in range(TRIES):
        if len(walls) >= 2 * wanted:
            break
        after = walls[-2] if walls and random.random() < 0.3 else None
        wall = _wall(random, after)
        if _fits(wall, walls, starts, after):
            walls += [wall, _mirrored(wall)]
    lines = [f'[title]\nen = "Surprise {seed}"\npt = "Surpresa {seed}"']
    lines += [f"[[start]]\nat = [{x}, {y}]\nheading = {heading}" for x, y, heading in starts]
    for (ax, ay), (bx, by), thick, solid in walls:
        text = f"[[wall]]\nfrom = [{ax}, {ay}]\nto = [{bx}, {by}]\nthick = {thick}"
        lines.append(text + "\nsolid = true" if solid else text)
    return "\n\n".join(lines) + "\n"


def _wall(random: Random, after: Wall | None) -> Wall:
    """A rock, or a bar, along an axis three times of four. `after`: a wall at whose end it begins, at a right angle."""
    x, y = random.random() * WIDTH, random.random() * HEIGHT
    solid, rock, turn = random.random() < 0.4, random.random() < 0.2, random.random()
    angle = pi / 2 * int(2 * turn) if random.random() < 0.75 else pi * turn
    length, thick = 120 + 300 * random.random(), 30
    if after:
        (ax, ay), (x, y), _, solid = after
        along = hypot(x - ax, y - ay)
        cross, straight = (ax - x) / along, (y - ay) / along
        side = 1 if turn < 0.5 else -1
        return (int(x), int(y)), (_round(x + side * length * straight), _round(y + side * length * cross)), 30, solid
    if rock:
        length, thick = 30.0, 80 + GRID * int(4 * turn)
    return (_round(x), _round(y)), (_round(x + length * cos(angle)), _round(y + length * sin(angle))), thick, solid


def _fits(wall: Wall, walls: list[Wall], starts: tuple[tuple[int, int, int], ...], after: Wall | None) -> bool:
    """There is room to pass the wall everywhere, and it does not meet its own mirror image."""
    points, half = _points(wall), wall[2] / 2
    margin = half + PASSAGE
    inside = all(margin <= x <= WIDTH - margin and margin <= y <= HEIGHT - margin for x, y in points)
    rest = [other for other in walls if other != after] + [_mirrored(wall)]
    return (
        inside
        and all(_apart(points, _points(other)) >= margin + other[2] / 2 for other in rest)
        and all(hypot(x - px, y - py) >= half + CLEARANCE for px, py, _ in starts for x, y in points)
    )


def _apart(some: list[tuple[float, float]], others: list[tuple[float, float]]) -> float:
    return min(hypot(ax - bx, ay - by) for ax, ay in some for bx, by in others)


def _points(wall: Wall) -> list[tuple[float, float]]:
    """Points of its middle line, from end to end."""
    (ax, ay), (bx, by), _, _ = wall
    count = max(1, round(hypot(bx - ax, by - ay) / STEP))
    return [(ax + (bx - ax) * k / count, ay + (by - ay) * k / count) for k in range(count + 1)]


def _mirrored(wall: Wall) -> Wall:
    (ax, ay), (bx, by), thick, solid = wall
    return (int(WIDTH) - ax, int(HEIGHT) - ay), (int(WIDTH) - bx, int(HEIGHT) - by), thick, solid


def _round(value: float) -> int:
    return GRID * round(value / GRID)
