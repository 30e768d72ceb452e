"""Ways round the walls of an arena, as robots with a flow field take them."""

from collections.abc import Iterator, Sequence

from pigaming_app.sim.arena import Arena, build
from pigaming_app.sim.flow_field import Route, descend, expand, free_node
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import CELL, COLUMNS, NODES, World
from pigaming_app.ui.draw import Point


def legs(arena: Arena, ends: Sequence[tuple[Point, Point]]) -> list[list[Point]]:
    """The way from the first to the second of each pair of points, px. Raises FieldError as `build`."""
    world = World()
    build(world, arena)
    return [way for a, b in ends if (way := list(_way(world, a, b)))]


def _way(world: World, a: Point, b: Point) -> Iterator[Point]:
    """Corners of the way; none if there is no way."""
    field, root, node = Route(), free_node(world, *b), free_node(world, *a)
    if not root or not node:
        return
    expand(world, field, root, node)
    if not field.reach[node]:
        return
    here = a
    yield here
    for _ in range(NODES):
        if is_clear(world, *here, *b, world.radius):
            break
        ahead = node
        while ahead != root:
            after = descend(field, ahead)
            x, y = after % COLUMNS * CELL, after // COLUMNS * CELL
            if ahead != node and not is_clear(world, *here, x, y, world.radius):
                break
            ahead = after
        if ahead == node:
            break
        node, here = ahead, (float(ahead % COLUMNS * CELL), float(ahead // COLUMNS * CELL))
        yield here
    yield b
