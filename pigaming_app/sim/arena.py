"""Arenas: TOML files under assets/arenas/GAME/, checked at the door.

[title]
en = "Courtyard"
pt = "Pátio"

[[start]]                # four of them, in the order of the players
at = [110, 110]          # px, x right, y down, in an arena of 1600 x 900
heading = 45             # degrees, 0 to the right, clockwise

[[wall]]
from = [300, 200]
to = [300, 420]
thick = 30               # px
health = 5               # bullets it takes; left out: 5
solid = true             # instead of health: it takes any number
"""

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import pi, radians, sqrt
from pathlib import Path
from typing import Any

from pigaming_app import ASSETS
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.grid import block_rim, wall_on_grid
from pigaming_app.sim.navigate import Errand, free_node, grow
from pigaming_app.sim.robots import GAIN, RADIUS
from pigaming_app.sim.world import HEIGHT, ROBOTS, SOLID, WALLS, WIDTH, World

LANGUAGES = ("en", "pt")
HEALTH = 5


class ArenaError(ValueError):
    """An arena file that cannot be used: one line with file, key and reason."""


@dataclass(frozen=True)
class WallSpec:
    """A wall from (ax, ay) to (bx, by), `half` px to either side; health as in `Wall`."""

    ax: float
    ay: float
    bx: float
    by: float
    half: float
    health: int


@dataclass(frozen=True)
class Start:
    """Where a robot begins: px, px, rad."""

    x: float
    y: float
    heading: float


@dataclass(frozen=True)
class Arena:
    """A checked arena. `source` is the text of its file."""

    name: str
    title: Mapping[str, str]
    walls: tuple[WallSpec, ...]
    starts: tuple[Start, ...]
    source: str


def arenas(game: str) -> list[str]:
    """The names of a game's arenas, `classic` first."""
    names = sorted(path.stem for path in (ASSETS / "arenas" / game).glob("*.toml"))
    return sorted(names, key=lambda name: name != "classic")


def load(game: str, name: str) -> Arena:
    """An arena of a game by its name, or by the path of a file that ends in .toml. Raises ArenaError."""
    path = Path(name) if name.endswith(".toml") else ASSETS / "arenas" / game / f"{name}.toml"
    if not path.is_file():
        there = ", ".join(arenas(game))
        raise ArenaError(f"{name}: no such arena for {game}; there are {there}")
    try:
        source = path.read_bytes().decode("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ArenaError(f"{path.name}: file: cannot be read ({error})") from None
    return parse(source, path.name)


def parse(source: str, file: str) -> Arena:
    """Check the text of an arena file. Raises ArenaError, which names `file`, the key and the reason."""
    try:
        table = tomllib.loads(source)
    except tomllib.TOMLDecodeError as error:
        raise ArenaError(f"{file}: syntax: {error}") from None
    try:
        arena = _read(table, file.removesuffix(".toml"), source)
        _check_ways(arena)
    except _Wrong as wrong:
        raise ArenaError(f"{file}: {wrong.key}: {wrong.reason}") from None
    return arena


def build(world: World, arena: Arena) -> None:
    """Put an arena's walls into a fresh world, and robots on its starts (present or not is the game's to say)."""
    world.wall_count = len(arena.walls)
    block_rim(world)
    for wall, spec in zip(world.walls, arena.walls, strict=False):
        wall.ax, wall.ay, wall.bx, wall.by = spec.ax, spec.ay, spec.bx, spec.by
        wall.half, wall.health, wall.whole = spec.half, spec.health, spec.health
        edge = spec.half + RADIUS
        wall.left, wall.right = min(spec.ax, spec.bx) - edge, max(spec.ax, spec.bx) + edge
        wall.top, wall.bottom = min(spec.ay, spec.by) - edge, max(spec.ay, spec.by) + edge
        wall_on_grid(world, wall, 1)
    for robot, start in zip(world.robots, arena.starts, strict=False):
        robot.x, robot.y, robot.heading = start.x, start.y, start.heading
        robot.gain, robot.turbo = GAIN, 1.0


class _Wrong(Exception):
    def __init__(self, key: str, reason: str) -> None:
        self.key, self.reason = key, reason


def _read(table: Mapping[str, Any], name: str, source: str) -> Arena:
    _only(table, "", "title", "start", "wall")
    title = table.get("title")
    if not isinstance(title, dict):
        raise _Wrong("title", "a table with a text for each language is missing")
    _only(title, "title.", *LANGUAGES)
    for language in LANGUAGES:
        if not isinstance(title.get(language), str) or not title[language].strip():
            raise _Wrong(f"title.{language}", "a text is missing")
    walls = tuple(_wall(entry, key) for entry, key in _entries(table, "wall"))
    if len(walls) > WALLS:
        raise _Wrong("wall", f"{len(walls)} walls, but at most {WALLS} are possible")
    starts = tuple(_start(entry, key) for entry, key in _entries(table, "start"))
    if len(starts) != ROBOTS:
        raise _Wrong("start", f"{len(starts)} starts, but there must be {ROBOTS}")
    return Arena(name, title, walls, starts, source)


def _entries(table: Mapping[str, Any], key: str) -> Iterator[tuple[Mapping[str, Any], str]]:
    entries = table.get(key, [])
    if not isinstance(entries, list):
        raise _Wrong(key, f"must be written as [[{key}]]")
    for i, entry in enumerate(entries):
        if not isinstance(entry, dict):
            raise _Wrong(f"{key}[{i + 1}]", "must be a table")
        yield entry, f"{key}[{i + 1}]"


def _wall(entry: Mapping[str, Any], key: str) -> WallSpec:
    _only(entry, key + ".", "from", "to", "thick", "health", "solid")
    (ax, ay), (bx, by) = _point(entry, key, "from"), _point(entry, key, "to")
    thick = _number(entry.get("thick", 30), f"{key}.thick")
    if not 10 <= thick <= 200:
        raise _Wrong(f"{key}.thick", f"{thick:g} px, but 10 to 200 are possible")
    solid = entry.get("solid", False)
    if not isinstance(solid, bool):
        raise _Wrong(f"{key}.solid", "must be true or false")
    if solid and "health" in entry:
        raise _Wrong(f"{key}.health", "goes without solid = true")
    health = entry.get("health", HEALTH)
    if isinstance(health, bool) or not isinstance(health, int) or not 1 <= health <= HEALTH:
        raise _Wrong(f"{key}.health", f"{health!r}, but a whole number from 1 to {HEALTH} is needed")
    return WallSpec(ax, ay, bx, by, thick / 2, SOLID if solid else health)


def _start(entry: Mapping[str, Any], key: str) -> Start:
    _only(entry, key + ".", "at", "heading")
    x, y = _point(entry, key, "at")
    heading = radians(_number(entry.get("heading", 0), f"{key}.heading"))
    if not 0 <= heading < 2 * pi:
        raise _Wrong(f"{key}.heading", "must be from 0 to below 360 degrees")
    return Start(x, y, heading)


def _point(entry: Mapping[str, Any], key: str, name: str) -> tuple[float, float]:
    point = entry.get(name)
    if not isinstance(point, list) or len(point) != 2:
        raise _Wrong(f"{key}.{name}", "a point [x, y] is needed")
    x, y = (_number(value, f"{key}.{name}") for value in point)
    if not (0 <= x <= WIDTH and 0 <= y <= HEIGHT):
        raise _Wrong(f"{key}.{name}", f"({x:g}, {y:g}) lies outside the arena, 0..{WIDTH:g} x 0..{HEIGHT:g}")
    return x, y


def _number(value: Any, key: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < 1e6:
        raise _Wrong(key, f"{value!r} is not a number that makes sense here")
    return float(value)


def _only(table: Mapping[str, Any], path: str, *known: str) -> None:
    for key in table:
        if key not in known:
            raise _Wrong(path + key, f"unknown key; possible are {', '.join(known)}")


def _check_ways(arena: Arena) -> None:
    """Every start is free, no two touch, and there is a way from the first to each other."""
    world = World()
    build(world, arena)
    nodes = []
    for i, start in enumerate(arena.starts):
        key = f"start[{i + 1}]"
        if in_wall(world, start.x, start.y):
            raise _Wrong(key, f"a robot at ({start.x:g}, {start.y:g}) would stand inside a wall")
        for j, other in enumerate(arena.starts[:i]):
            if sqrt((start.x - other.x) ** 2 + (start.y - other.y) ** 2) < 2 * RADIUS:
                raise _Wrong(key, f"too near to start[{j + 1}]: robots are {2 * RADIUS:g} px wide")
        nodes.append(free_node(world, start.x, start.y))
    field = Errand()
    grow(world, field, nodes[0], -1)
    for i, node in enumerate(nodes):
        if not field.reach[node] or not nodes[0]:
            raise _Wrong(f"start[{i + 1}]", "there is no way to it from start[1]")
