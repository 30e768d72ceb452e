"""Arenas: parsing and validation of the TOML files under assets/arenas/GAME/.

Every file has a title. The game parses the rest, with the readers for walls and starts below; data that only one game
has goes into the arena's `plan`.

[title]
en = "Courtyard"
pt = "Pátio"
es = "Patio"             # es, fr and de may be left out

[floor]                  # may be left out
pattern = "waves"        # one of FLOORS

[[start]]                # four, in the order of the seats
at = [110, 110]          # px, x right, y down, in an arena of 1600 x 900
heading = 45             # degrees, 0 to the right, clockwise

[robots]                 # may be left out
radius = 63.4            # px, of real robots on a small surface, at least 36

[[wall]]
from = [300, 200]
to = [300, 420]
thick = 30               # px
health = 5               # bullets it takes, default 5
solid = true             # instead of health: indestructible

Real things on the mat follow as [[thing]], see things/spec.py.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import pi, radians, sqrt
from typing import Any

from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.flow_field import Route, expand, free_node
from pigaming_app.sim.grid import block_rim, wall_on_grid
from pigaming_app.sim.robot import GAIN
from pigaming_app.sim.things.spec import ThingSpec, mud_capsules, wall_capsules
from pigaming_app.sim.toml_table import FieldError, TomlTable, quote
from pigaming_app.sim.world import MUDS, RADIUS, ROBOTS, SOLID, WALLS, Wall, World

LANGUAGES = ("en", "pt", "es", "fr", "de")
NEEDED = ("en", "pt")  # of the languages; a title that lacks another is shown in English
HEALTH = 5
FLOORS = "grid", "paving", "waves", "hexagons", "strata", "circuit", "diamonds", "turf"  # patterns, for the eye only
BUILT = 24  # walls in a file; things need the rest of WALLS
WIDEST_ROBOT = 150.0  # px, radius of robots
MAX_TITLE = 40  # characters


class ArenaError(ValueError):
    """An arena file is invalid: one line with file, key and reason."""


@dataclass(frozen=True)
class WallSpec:
    """A wall from (ax, ay) to (bx, by), `half` px thick on either side; health as in `Wall`."""

    ax: float
    ay: float
    bx: float
    by: float
    half: float
    health: int


@dataclass(frozen=True)
class StartPose:
    """Start pose of a robot: px, px, rad."""

    x: float
    y: float
    heading: float


@dataclass(frozen=True)
class Layout:
    """The parts of a file that the game parses: walls, four starts, the game's own plan, things, and the pattern of the
    floor, one of FLOORS or empty, radius of robots.
    """

    walls: tuple[WallSpec, ...]
    starts: tuple[StartPose, ...]
    plan: Any = None
    things: tuple[ThingSpec, ...] = ()
    floor: str = ""
    radius: float = RADIUS  # px, of robots

    def built_walls(self) -> list[Wall]:
        """The walls as a match has them, those of things included. Raises FieldError if they do not fit."""
        world = self.built()
        return world.walls[: world.wall_count]

    def built(self) -> World:
        """A world with the walls, things and robots. Raises FieldError if they do not fit."""
        world = World()
        build(world, self)
        return world


@dataclass(frozen=True)
class Arena:
    """A validated arena. `source` is the text of its file."""

    name: str
    title: Mapping[str, str]
    walls: tuple[WallSpec, ...]
    starts: tuple[StartPose, ...]
    source: str
    plan: Any = None
    things: tuple[ThingSpec, ...] = ()
    floor: str = ""
    radius: float = RADIUS  # px, of robots


def parse(source: str, file: str, read: Callable[[TomlTable], Layout]) -> Arena:
    """Parse and validate an arena file; `read` is the game's. Raises ArenaError, with `file`, key and reason."""
    try:
        table = TomlTable.parse(source)
        title = read_title(table)
        layout = read(table)
        raise_first(start_faults(layout))
    except FieldError as error:
        raise ArenaError(f"{file}: {error}") from None
    parts = layout.walls, layout.starts, source, layout.plan, layout.things, layout.floor, layout.radius
    return Arena(file.removesuffix(".toml"), title, *parts)


def raise_first(faults: Iterable[FieldError]) -> None:
    """Raises the first of these errors, if there is one."""
    for fault in faults:
        raise fault


def build(world: World, arena: Arena | Layout) -> None:
    """Put an arena's walls and things into a fresh world and robots on its starts. The game sets `present`.

    Raises FieldError if there are more things than fit.
    """
    world.radius = arena.radius
    block_rim(world)
    for spec in arena.walls:
        _add_wall(world, spec)
    add_things(world, arena.things)
    for mud, part in zip(world.muds, mud_capsules(arena.things, MUDS), strict=False):
        mud.ax, mud.ay, mud.bx, mud.by, mud.half = part
        world.mud_count += 1
    for robot, start in zip(world.robots, arena.starts, strict=False):
        robot.x, robot.y, robot.heading = start.x, start.y, start.heading
        robot.gain, robot.turbo = GAIN, 1.0


def add_things(world: World, things: Sequence[ThingSpec]) -> None:
    """Add the walls of things after those of the world. Raises FieldError if there are more than fit."""
    for part in wall_capsules(things, WALLS - world.wall_count):
        _add_wall(world, WallSpec(*part, SOLID))


def replace_things(world: World, things: Sequence[ThingSpec], first: int) -> None:
    """Replace all walls from index `first` on by those of things that were moved. Raises FieldError as `add_things`."""
    parts = wall_capsules(things, WALLS - first)
    for wall in world.walls[first : world.wall_count]:
        if wall.health:
            wall_on_grid(world, wall, -1)
    world.wall_count = first
    world.shifts += 1
    for part in parts:
        _add_wall(world, WallSpec(*part, SOLID))


def _add_wall(world: World, spec: WallSpec) -> None:
    wall = world.walls[world.wall_count]
    wall.ax, wall.ay, wall.bx, wall.by = spec.ax, spec.ay, spec.bx, spec.by
    wall.half, wall.health, wall.initial_health = spec.half, spec.health, spec.health
    edge = spec.half + world.radius
    wall.left, wall.right = min(spec.ax, spec.bx) - edge, max(spec.ax, spec.bx) + edge
    wall.top, wall.bottom = min(spec.ay, spec.by) - edge, max(spec.ay, spec.by) + edge
    wall_on_grid(world, wall, 1)
    world.wall_count += 1


def read_walls(table: TomlTable) -> tuple[WallSpec, ...]:
    """Parse the tables [[wall]]. Raises FieldError."""
    walls = tuple(_wall(entry) for entry in table.tables("wall"))
    if len(walls) > BUILT:
        raise table.error("wall", f"{len(walls)} walls, but at most {BUILT} are possible")
    return walls


def read_starts(table: TomlTable) -> tuple[StartPose, ...]:
    """Parse the tables [[start]]. Raises FieldError."""
    starts = tuple(_start(entry) for entry in table.tables("start"))
    if len(starts) != ROBOTS:
        raise table.error("start", f"{len(starts)} starts, but there must be {ROBOTS}")
    return starts


def read_radius(table: TomlTable) -> float:
    """The radius in the table [robots], px; without one, the usual. Raises FieldError."""
    if "robots" not in table:
        return RADIUS
    robots = table.table("robots")
    robots.only("radius")
    return robots.number("radius", None, RADIUS, WIDEST_ROBOT, " px")


def written_radius(radius: float) -> str:
    """The table [robots], to append to the text of an arena file. `radius`: px."""
    return f"\n[robots]\nradius = {radius:.1f}\n"


def read_floor(table: TomlTable) -> str:
    """Parse the table [floor]; empty without one. Raises FieldError."""
    if "floor" not in table:
        return ""
    floor = table.table("floor")
    floor.only("pattern")
    pattern = floor.entries.get("pattern")
    if pattern not in FLOORS:
        raise floor.error("pattern", f"{quote(pattern)}; possible are {', '.join(FLOORS)}")
    return str(pattern)


def read_title(table: TomlTable) -> Mapping[str, str]:
    """Parse the table [title]. Raises FieldError."""
    title = table.table("title", "a table with a text for each language is missing")
    title.only(*LANGUAGES)
    for language in LANGUAGES:
        text = title.entries.get(language)
        if text is None and language not in NEEDED:
            continue
        if not isinstance(text, str) or not text.strip():
            raise title.error(language, "a text is missing")
        if len(text) > MAX_TITLE or not text.isprintable():
            raise title.error(language, f"a text of at most {MAX_TITLE} characters on one line is needed")
    return title.entries


def _wall(entry: TomlTable) -> WallSpec:
    entry.only("from", "to", "thick", "health", "solid")
    (ax, ay), (bx, by) = entry.point("from"), entry.point("to")
    thick = entry.number("thick", 30, 10, 200, " px")
    solid = entry.entries.get("solid", False)
    if not isinstance(solid, bool):
        raise entry.error("solid", "must be true or false")
    if solid and "health" in entry:
        raise entry.error("health", "goes without solid = true")
    health = entry.entries.get("health", HEALTH)
    if isinstance(health, bool) or not isinstance(health, int) or not 1 <= health <= HEALTH:
        raise entry.error("health", f"{quote(health)}, but a whole number from 1 to {HEALTH} is needed")
    return WallSpec(ax, ay, bx, by, thick / 2, SOLID if solid else health)


def _start(entry: TomlTable) -> StartPose:
    entry.only("at", "heading")
    x, y = entry.point("at")
    heading = radians(entry.number("heading", 0))
    if not 0 <= heading < 2 * pi:
        raise entry.error("heading", "must be from 0 to below 360 degrees")
    return StartPose(x, y, heading)


def start_faults(layout: Layout) -> Iterator[FieldError]:
    """Starts in walls, too near to others, or with no way to the first. Raises FieldError as `build`."""
    world, radius = layout.built(), layout.radius
    nodes: list[int] = []
    for i, start in enumerate(layout.starts):
        key, place = f"start[{i + 1}]", (start.x, start.y, radius)
        if in_wall(world, start.x, start.y):
            yield FieldError(key, f"a robot at ({start.x:g}, {start.y:g}) would stand inside a wall", place)
        for j, other in enumerate(layout.starts[:i]):
            if sqrt((start.x - other.x) ** 2 + (start.y - other.y) ** 2) < 2 * radius:
                yield FieldError(key, f"too near to start[{j + 1}]: robots are {2 * radius:g} px wide", place)
        nodes.append(free_node(world, start.x, start.y))
    field = Route()
    expand(world, field, nodes[0], -1)
    for i, node in enumerate(nodes):
        if not field.reach[node] or not nodes[0]:
            place = layout.starts[i].x, layout.starts[i].y, radius
            yield FieldError(f"start[{i + 1}]", "there is no way to it from start[1]", place)
