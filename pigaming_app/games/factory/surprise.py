"""Floors from a seed: the same for both teams, mirrored at the middle, or after half a turn."""

from math import hypot
from random import Random

from pigaming_app.games.drawing.values import Drawing, Part
from pigaming_app.games.factory.layout import SHELF, WAYS, faults, read
from pigaming_app.games.factory.state import SHELVES
from pigaming_app.sim.arena import Layout
from pigaming_app.sim.toml_table import TomlTable
from pigaming_app.sim.world import HEIGHT, WIDTH

TRIES = 500  # every other floor can be played
GRID = 10  # px: most coordinates are multiples
SHELF_X = 66  # px from the sides of the arena to the slots of a warehouse
UPPER, LOWER = 96, 540  # px, first slots of the warehouses
START_X, START_Y = 230, 105  # px from the side, and from the middle of the entry
MACHINES_X, MACHINES_Y = (400, 600), ((216, 310), (590, 684))  # px, of the left one and of each of its two rows
AISLE = Part.of("aisle", several=False, at=(650, 50), size=(300, 800))
HOMES = 100  # px between the resting places
SHARED_Y = (110, 270)  # px, from the upper or the lower side
WALLS, WALL_TRIES = 3, 40  # at most, each with its image, and how often one is tried
LENGTH = (80, 240)  # px of a wall
THICK = 30
FREE = 130.0  # px between a wall and starts, pallets and people
STEP = 20.0  # px between the points of a wall at which that is checked
OPPOSITE = {"up": "down", "down": "up", "left": "right", "right": "left"}
Point = tuple[int, int]


def surprise(seed: int) -> str:
    """The text of an arena file. The same seed gives the same floor on every system."""
    random = Random(seed)
    turned = random.random() < 0.5
    found = next((floor for _ in range(TRIES) if _is_playable(floor := _floor(seed, random, turned))), None)
    assert found, f"seed {seed} makes no floor"
    places = _places(read(TomlTable(found.document())))
    for _ in range(WALL_TRIES):
        more = _with_wall(found, places, random, turned)
        found = more if more != found and _is_playable(more) else found
        if len(found.of("wall")) == 2 * WALLS:
            break
    return found.text()


def _is_playable(drawing: Drawing) -> bool:
    return next(iter(faults(TomlTable(drawing.document()))), None) is None


def _floor(seed: int, random: Random, turned: bool) -> Drawing:
    """A floor without walls, which may be unplayable."""
    parts = [Part.of("title", several=False, en=f"Surprise {seed}", pt=f"Surpresa {seed}"), AISLE]
    entry = UPPER if random.random() < 0.5 else LOWER
    crossing = random.random() < 0.4  # the exit is on the other side of the hall, beside the entry of the other team
    exit_x, exit_y = int(WIDTH) - SHELF_X if crossing else SHELF_X, UPPER + LOWER - entry
    if crossing and turned:
        exit_y = entry
    middle = entry + int((SHELVES - 1) * SHELF) // 2
    for y in (middle - START_Y, middle + START_Y):
        parts += [
            Part.of("start", at=(START_X, y), heading=0),
            Part.of("start", at=_image(START_X, y, turned), heading=180),
        ]
    for kind, x, y in (("entry", SHELF_X, entry), ("exit", exit_x, exit_y)):
        image = int(WIDTH) - x, UPPER + LOWER - y if turned else y
        parts += [Part.of("warehouse", team="ice", kind=kind, at=(x, y))]
        parts += [Part.of("warehouse", team="fire", kind=kind, at=image)]
    kinds = ("A", "B") if random.random() < 0.5 else ("B", "A")
    for kind, row in zip(kinds, MACHINES_Y, strict=True):
        parts += _machines(random, kind, row, turned)
    across, down = (HOMES, 0) if random.random() < 0.5 else (0, HOMES)
    for k in (-1, 0, 1):
        parts.append(Part.of("worker", at=(int(WIDTH) // 2 + k * across, int(HEIGHT) // 2 + k * down)))
    upper, lower = _between(random, *SHARED_Y), _between(random, *SHARED_Y)
    for y in (upper, int(HEIGHT) - (upper if turned else lower)):
        parts.append(Part.of("shared", at=(int(WIDTH) // 2, y)))
    return Drawing(tuple(parts))


def _machines(random: Random, kind: str, row: tuple[int, int], turned: bool) -> list[Part]:
    """A machine on the left and its image; their workers stand towards the middle."""
    x, y = _between(random, *MACHINES_X), _between(random, *row)
    flow = list(WAYS)[int(len(WAYS) * random.random())]
    worker = "right" if flow in ("up", "down") else "down" if y < HEIGHT / 2 else "up"
    other = _image(x, y, turned)
    return [
        Part.of("machine", kind=kind, at=(x, y), flow=flow, worker=worker),
        Part.of("machine", kind=kind, at=other, flow=_way(flow, turned), worker=_way(worker, turned)),
    ]


def _with_wall(drawing: Drawing, places: list[tuple[float, float]], random: Random, turned: bool) -> Drawing:
    """With another wall and its image, or as it was where that would be in the way."""
    length, upright = _between(random, *LENGTH), random.random() < 0.5
    x, y = _between(random, 0, int(WIDTH) // 2), _between(random, 0, int(HEIGHT))
    ends = (x, y), ((x, y + length) if upright else (x + length, y))
    if not all(0 <= px <= WIDTH and 0 <= py <= HEIGHT for px, py in ends):
        return drawing
    images = _image(*ends[0], turned), _image(*ends[1], turned)
    count = int(length / STEP)
    for some in (ends, images):
        for k in range(count + 1):
            px, py = (a + (b - a) * k / count for a, b in zip(*some, strict=True))
            if any(hypot(px - u, py - v) < FREE for u, v in places):
                return drawing
    for a, b in (ends, images):
        drawing = drawing.added(Part.of("wall", from_=a, to=b, thick=THICK, solid=True))
    return drawing


def _places(layout: Layout) -> list[tuple[float, float]]:
    """Starts, slots, and where people work and rest, px."""
    floor = layout.plan
    people = [*((machine.spot_x, machine.spot_y) for machine in floor.machines), *floor.homes]
    return [*((start.x, start.y) for start in layout.starts), *((slot.x, slot.y) for slot in floor.slots), *people]


def _image(x: int, y: int, turned: bool) -> Point:
    """The same place on the other half."""
    return int(WIDTH) - x, int(HEIGHT) - y if turned else y


def _way(word: str, turned: bool) -> str:
    """The same direction on the other half."""
    return OPPOSITE[word] if turned or word in ("left", "right") else word


def _between(random: Random, low: int, high: int) -> int:
    return GRID * round((low + (high - low) * random.random()) / GRID)
