"""Occupancy grid with nodes 50 px apart, for path planning and for skipping wall checks in open space.

Each node counts the walls that block a robot's centre (low six bits) and the walls nearby (the bits above). Where none
is near, contact and bullets skip all walls.
"""

from math import sqrt

from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import CELL, COLUMNS, ROWS, Wall, World

SPARE = 4.0  # px between a robot on a free node and the wall
NEAR = 72.0  # px: the node nearest to anything that touches the wall is within RADIUS + half a cell's diagonal
UNSEEN = NEAR - 36.0  # px: from a node without a wall near it, a point reaches none within this distance
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
    edge = NEAR + wall.half
    for row in range(ROWS):
        y = row * CELL
        if (y < wall.ay - edge and y < wall.by - edge) or (y > wall.ay + edge and y > wall.by + edge):
            continue
        for column in range(COLUMNS):
            dx, dy = offset_from_wall(wall, column * CELL, y)
            gap = sqrt(dx * dx + dy * dy) - wall.half
            if gap < NEAR:
                world.grid[row * COLUMNS + column] += NEAR_UNIT * change
                if gap < RADIUS + SPARE:
                    world.grid[row * COLUMNS + column] += change


@kernel
def block_rim(world: World) -> None:
    """Block the nodes on the outer walls."""
    for column in range(COLUMNS):
        world.grid[column] += 1
        world.grid[(ROWS - 1) * COLUMNS + column] += 1
    for row in range(1, ROWS - 1):
        world.grid[row * COLUMNS] += 1
        world.grid[row * COLUMNS + COLUMNS - 1] += 1
