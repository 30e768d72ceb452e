"""Starts that things cover move to the nearest free place."""

from collections.abc import Sequence
from dataclasses import replace
from math import cos, hypot, pi, sin

from pigaming_app.sim.arena import Arena, Layout, StartPose, build
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.flow_field import Route, expand, free_node
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.sim.world import World

CLEAR = 8.0  # px between a start that has been moved and walls, or other robots
SEARCH, STEP = 300, 10  # px around a start, where a free place is looked for


def clear_starts(layout: Layout) -> tuple[StartPose, ...]:
    """The starts, those that things cover moved to the nearest free place. Raises FieldError if there is none."""
    if not layout.things:
        return layout.starts
    world = World()
    build(world, Arena("", {}, layout.walls, layout.starts, "", things=layout.things))
    starts = list(layout.starts)
    blocked = [i for i, start in enumerate(starts) if in_wall(world, start.x, start.y)]
    for i in blocked:
        others = [start for j, start in enumerate(starts) if j != i and (j not in blocked or j < i)]
        starts[i] = _free_place(world, starts[i], others, i)
    return tuple(starts)


def _free_place(world: World, start: StartPose, others: Sequence[StartPose], i: int) -> StartPose:
    """The free place nearest to a start, from which the others can be reached. Raises FieldError."""
    field = Route()
    if others and (root := free_node(world, others[0].x, others[0].y)):
        expand(world, field, root, -1)
    reach = range(-SEARCH, SEARCH + 1, STEP)
    for dx, dy in sorted(((dx, dy) for dx in reach for dy in reach), key=lambda way: hypot(*way)):
        x, y = start.x + dx, start.y + dy
        node = free_node(world, x, y)
        if (
            is_roomy(world, x, y)
            and (not field.root or (node and field.reach[node]))
            and all(hypot(x - other.x, y - other.y) >= 2 * RADIUS + CLEAR for other in others)
        ):
            return replace(start, x=x, y=y)
    raise FieldError("thing", f"one covers start[{i + 1}], and there is no free place near it")


def is_roomy(world: World, x: float, y: float) -> bool:
    """True if a robot at (x, y) is at least CLEAR px from all walls."""
    around = [(x, y), *((x + CLEAR * cos(k * pi / 4), y + CLEAR * sin(k * pi / 4)) for k in range(8))]
    return not any(in_wall(world, *point) for point in around)
