"""Occupancy grid with nodes 50 px apart, for path planning and for skipping wall checks in open space.

Each node counts the walls that block a robot's centre (low six bits) and the walls nearby (the bits above). Where none
is near, contact and bullets skip all walls.
"""

from math import sqrt

from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import CELL, COLUMNS, HEIGHT, ROWS, WIDTH, Wall, World

SPARE = 4.0  # px between a robot on a free node and the wall
HALF = 36.0  # px, more than half a cell's diagonal: from a node without a wall within this and a robot's radius, no
# robot and no point within its radius touches one
BLOCKED = 63  # mask of the bits that count blocking walls
NEAR_UNIT = 64  # one nearby wall: a node of at least this value has a wall near it


@kernel
def node_at(x: float, y: float) -> int:
    """The node nearest to a point; points outside the arena are clamped to its rim."""
    column, row = int(x / CELL + 0.5), int(y / CELL + 0.5)
    if column < 0:
        column = 0
    elif column > COLUMNS - 1:
        column = COLUMNS - 1
    if row < 0:
        row = 0
    elif row > ROWS - 1:
        row = ROWS - 1
    return row * COLUMNS + column


@kernel
def wall_on_grid(world: World, wall: Wall, change: int) -> None:
    """Add a wall to the grid (change 1) or remove it (-1)."""
    near = world.radius + HALF
    edge = near + wall.half
    for row in range(ROWS):
        y = row * CELL
        if (y < wall.ay - edge and y < wall.by - edge) or (y > wall.ay + edge and y > wall.by + edge):
            continue
        for column in range(COLUMNS):
            dx, dy = offset_from_wall(wall, column * CELL, y)
            gap = sqrt(dx * dx + dy * dy) - wall.half
            if gap < near:
                world.grid[row * COLUMNS + column] += NEAR_UNIT * change
                if gap < world.radius + SPARE:
                    world.grid[row * COLUMNS + column] += change


@kernel
def block_rim(world: World) -> None:
    """Block the nodes at the outer walls."""
    room = world.radius + SPARE
    for row in range(ROWS):
        for column in range(COLUMNS):
            x, y = column * CELL, row * CELL
            if x < room or y < room or WIDTH - x < room or HEIGHT - y < room:
                world.grid[row * COLUMNS + column] += 1
