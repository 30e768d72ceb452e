"""Starts: which robot has which, as the seed of a match deals them, and where one lies that a thing covers."""

from collections.abc import Sequence
from dataclasses import replace
from math import cos, dist, hypot, pi, sin
from typing import Any

from pigaming_app.sim.arena import Arena, Layout, StartPose
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.flow_field import Route, expand, free_node
from pigaming_app.sim.rng import uniform
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.sim.world import ROBOTS, World

CLEAR = 8.0  # px between a start that has been moved and walls, or other robots
SEARCH, STEP = 300, 10  # px around a start, where a free place is looked for


def take_starts(match: Any, arena: Arena, starts: Sequence[int]) -> None:
    """Put every robot on its start of the arena; `starts`: by seat, as the functions below deal them."""
    match.starts[:] = starts
    for robot, k in zip(match.robots, starts, strict=True):
        pose = arena.starts[k]
        robot.x, robot.y, robot.heading = pose.x, pose.y, pose.heading


def in_order(match: Any) -> list[int]:
    """The start of each seat: its own number."""
    return list(range(ROBOTS))


def dealt_to_all(match: Any) -> list[int]:
    """The start of each seat, drawn at random, whether a robot plays on it or not."""
    seats = shuffled(match)
    return [seats.index(seat) for seat in range(ROBOTS)]


def dealt(match: Any) -> list[int]:
    """The start of each seat, drawn at random; the robots that play have the first ones."""
    seats = present_first(match)
    return [seats.index(seat) for seat in range(ROBOTS)]


def dealt_to_teams(match: Any, swapped: int = 0) -> list[int]:
    """The start of each seat, drawn at random: the 1st and 3rd for even teams, the others for odd ones.

    `swapped`: 1: the other way round. Empty seats have the starts that are left.
    """
    free, starts = [[0, 2], [1, 3]], [0] * ROBOTS
    for seat in present_first(match):
        side = (match.robots[seat].team + swapped) % 2
        starts[seat] = (free[side] or free[1 - side]).pop(0)
    return starts


def dealt_to_ends(match: Any) -> list[int]:
    """The start of each seat, as above, after both teams have drawn their ends."""
    return dealt_to_teams(match, int(2.0 * uniform(match)))


def present_first(match: Any) -> list[int]:
    """All seats in random order, but those without a robot last."""
    return sorted(shuffled(match), key=lambda seat: not match.robots[seat].present)


def shuffled(match: Any) -> list[int]:
    """All seats in random order."""
    seats = list(range(ROBOTS))
    for i in range(ROBOTS - 1, 0, -1):
        j = int(uniform(match) * (i + 1))
        seats[i], seats[j] = seats[j], seats[i]
    return seats


def clear_starts(layout: Layout) -> tuple[StartPose, ...]:
    """The starts, those that things cover moved to the nearest free place. Raises FieldError if there is none."""
    if not layout.things:
        return layout.starts
    world = layout.built()
    starts = list(layout.starts)
    blocked = [i for i, start in enumerate(starts) if in_wall(world, start.x, start.y)]
    for i in blocked:
        others = [(start.x, start.y) for j, start in enumerate(starts) if j != i and (j not in blocked or j < i)]
        x, y = free_place(world, starts[i].x, starts[i].y, others)
        starts[i] = replace(starts[i], x=x, y=y)
    return tuple(starts)


def free_place(world: World, x: float, y: float, others: Sequence[tuple[float, float]] = ()) -> tuple[float, float]:
    """The free place nearest to (x, y), px, from which others can be reached, and away from them.

    Raises FieldError if there is none within SEARCH px.
    """
    field = Route()
    if others and (root := free_node(world, *others[0])):
        expand(world, field, root, -1)
    reach = range(-SEARCH, SEARCH + 1, STEP)
    for dx, dy in sorted(((dx, dy) for dx in reach for dy in reach), key=lambda way: hypot(*way)):
        at = x + dx, y + dy
        node = free_node(world, *at)
        connected = not field.root or (node and field.reach[node])
        if connected and is_roomy(world, *at) and all(dist(at, other) >= 2 * world.radius + CLEAR for other in others):
            return at
    raise FieldError("thing", f"one covers the place at ({x:g}, {y:g}), and there is no free one near it")


def is_roomy(world: World, x: float, y: float) -> bool:
    """True if a robot at (x, y) is at least CLEAR px from all walls."""
    around = [(x, y), *((x + CLEAR * cos(k * pi / 4), y + CLEAR * sin(k * pi / 4)) for k in range(8))]
    return not any(in_wall(world, *point) for point in around)
