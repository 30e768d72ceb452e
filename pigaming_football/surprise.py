"""Pitches from a seed: goals, corners and bumpers at random, the same for both teams and from either side."""

from collections.abc import Iterator
from math import dist
from random import Random

from pigaming_app.api.arenas import Drawing, Part, TomlTable

from .pitch import faults

TRIES = 500  # most pitches can be played
GRID = 10  # px: every coordinate is a multiple
GOALS, CUTS = (190, 340), (90, 200)  # px: width; what is cut off the corners
BARE = 0.25  # share of pitches with all corners
BUMPERS = (1, 3)  # in a quarter of the pitch, at least and most
THICK, LONG = (40, 90), (0, 160)  # px, of a bumper
INSET, MARGIN = (190, 80), 90  # px: of bumpers from goal line and touchline; from them to where balls are dropped
APART, CENTRE = 110, (800, 450)  # px: of bumpers from the axes, and the middle
PLACES = (CENTRE, (400, 450), (800, 170), (400, 200))  # where balls are dropped, and their images
STARTS = ((300, 290, 0), (1300, 610, 180), (300, 610, 0), (1300, 290, 180))
Point = tuple[int, int]
Wall = tuple[Point, Point, int]  # ends and thickness


def surprise(seed: int) -> str:
    """The text of an arena file. The same seed gives the same pitch on every system."""
    random = Random(seed)
    found = next((pitch for _ in range(TRIES) if _is_playable(pitch := _pitch(seed, random))), None)
    assert found, f"seed {seed} makes no pitch"
    return found.text()


def _is_playable(drawing: Drawing) -> bool:
    return next(iter(faults(TomlTable(drawing.document()))), None) is None


def _pitch(seed: int, random: Random) -> Drawing:
    """A pitch that may be unplayable."""
    parts = [Part.of("title", several=False, en=f"Surprise {seed}", pt=f"Surpresa {seed}")]
    parts.append(Part.of("goal", several=False, width=_between(random, *GOALS)))
    parts += [Part.of("start", at=(x, y), heading=heading) for x, y, heading in STARTS]
    cut = 0 if random.random() < BARE else _between(random, *CUTS)
    walls: list[Wall] = [((0, cut), (cut, 0), 30)] if cut else []
    for _ in range(int(random.random() * (BUMPERS[1] - BUMPERS[0] + 1)) + BUMPERS[0]):
        bumper = _bumper(random)
        if all(dist(a, b) >= APART for wall in walls for a in bumper[:2] for b in wall[:2]):
            walls.append(bumper)
    walls = [image for wall in walls for image in dict.fromkeys(_images(wall))]
    for place in PLACES:
        if all(dist(place, end) >= MARGIN for *ends, _ in walls for end in ends):
            parts += [Part.of("drop", at=at) for at in dict.fromkeys(_around(*place))]
    parts += [Part.of("wall", from_=a, to=b, thick=thick, solid=True) for a, b, thick in walls]
    return Drawing(tuple(parts))


def _bumper(random: Random) -> Wall:
    """A bumper: at the touchline, on the line between the goals, across it, or in the left upper quarter."""
    thick, length, where = _between(random, *THICK), max(GRID, _between(random, *LONG)), random.random()
    x, y = (
        _between(random, INSET[0], CENTRE[0] - APART - length),
        _between(random, INSET[1], CENTRE[1] - APART - length),
    )
    if where < 0.25:
        return (CENTRE[0], 0), (CENTRE[0], length), thick
    if where < 0.4:
        return (x, CENTRE[1]), (x + length, CENTRE[1]), thick
    if where < 0.55:
        return (x, CENTRE[1] - length), (x, CENTRE[1] + length), thick
    return (x, y), (x + length, y) if where < 0.8 else (x, y + length), thick


def _images(wall: Wall) -> Iterator[Wall]:
    """A wall and its images on the other quarters, each with its ends in order."""
    for a, b in zip(_around(*wall[0]), _around(*wall[1]), strict=True):
        yield min(a, b), max(a, b), wall[2]


def _around(x: int, y: int) -> list[Point]:
    """A point and its images."""
    u, v = 2 * CENTRE[0] - x, 2 * CENTRE[1] - y
    return [(x, y), (u, y), (x, v), (u, v)]


def _between(random: Random, low: int, high: int) -> int:
    return GRID * round((low + (high - low) * random.random()) / GRID)
