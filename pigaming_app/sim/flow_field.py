"""Path planning around walls: flow fields on a grid of nodes 50 px apart.

A breadth-first search expands from the goal over the free nodes of the grid until it reaches the robot. The robot then
heads for the farthest node down the field to which the straight line is clear.
"""

from typing import Annotated

from pigaming_app.sim.grid import BLOCKED, node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import uniform
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import CELL, COLUMNS, HEIGHT, NODES, NODES_PADDED, ROWS, WIDTH, World

SLACK = 2  # nodes that a goal may move before the field is rebuilt
LOOK = 7  # lookahead down the field, nodes


@record
class Route:
    """A robot's goal and the flow field towards it."""

    active: int  # 0: no goal
    goal_x: float
    goal_y: float
    waypoint_x: float  # the point to drive to now
    waypoint_y: float
    straight: int  # 1: it is the goal itself
    root: int  # the node from which the field was built; 0: there is no field
    walls: int  # number of walls standing at that time, and how often they were replaced before
    reach: Annotated[list[int], NODES_PADDED, "h"]  # steps to the root, 1 at the root, 0 not reached
    queue: Annotated[list[int], NODES_PADDED, "h"]  # frontier of the breadth-first search


@kernel
def free_node(world: World, x: float, y: float) -> int:
    """The free node nearest to a point, among those up to two nodes away; 0 (never free) if there is none."""
    middle = node_at(x, y)
    if not world.grid[middle] & BLOCKED:
        return middle
    best, nearest2 = 0, 1e9
    row, column = middle // COLUMNS, middle % COLUMNS
    for r in range(max(row - 2, 1), min(row + 3, ROWS - 1)):
        for c in range(max(column - 2, 1), min(column + 3, COLUMNS - 1)):
            node = r * COLUMNS + c
            if not world.grid[node] & BLOCKED:
                dx, dy = c * CELL - x, r * CELL - y
                distance2 = dx * dx + dy * dy
                if distance2 < nearest2:
                    best, nearest2 = node, distance2
    return best


@kernel
def expand(world: World, route: Route, root: int, until: int) -> None:
    """Build the field from `root`, breadth first, to 3 steps past the node `until`, or over all that is reachable."""
    reach, queue, grid = route.reach, route.queue, world.grid
    for node in range(NODES):
        reach[node] = 0
    route.root = root
    reach[root] = 1
    queue[0] = root
    head, tail = 0, 1
    limit = 32000
    while head < tail:
        node = queue[head]
        head += 1
        steps = reach[node] + 1
        if steps > limit:
            return
        if node == until:
            limit = steps + 3
        neighbour = node + 1
        if reach[neighbour] == 0 and not grid[neighbour] & BLOCKED:
            reach[neighbour] = steps
            queue[tail] = neighbour
            tail += 1
        neighbour = node - 1
        if reach[neighbour] == 0 and not grid[neighbour] & BLOCKED:
            reach[neighbour] = steps
            queue[tail] = neighbour
            tail += 1
        neighbour = node + COLUMNS
        if reach[neighbour] == 0 and not grid[neighbour] & BLOCKED:
            reach[neighbour] = steps
            queue[tail] = neighbour
            tail += 1
        neighbour = node - COLUMNS
        if reach[neighbour] == 0 and not grid[neighbour] & BLOCKED:
            reach[neighbour] = steps
            queue[tail] = neighbour
            tail += 1


@kernel
def descend(route: Route, node: int) -> int:
    """The neighbour nearest to the root; a diagonal one only if both nodes next to the diagonal are free too."""
    reach = route.reach
    best, steps_left = node, reach[node]
    east, west, south, north = reach[node + 1], reach[node - 1], reach[node + COLUMNS], reach[node - COLUMNS]
    if east and south and 0 < reach[node + COLUMNS + 1] < steps_left:
        best, steps_left = node + COLUMNS + 1, reach[node + COLUMNS + 1]
    if west and south and 0 < reach[node + COLUMNS - 1] < steps_left:
        best, steps_left = node + COLUMNS - 1, reach[node + COLUMNS - 1]
    if east and north and 0 < reach[node - COLUMNS + 1] < steps_left:
        best, steps_left = node - COLUMNS + 1, reach[node - COLUMNS + 1]
    if west and north and 0 < reach[node - COLUMNS - 1] < steps_left:
        best, steps_left = node - COLUMNS - 1, reach[node - COLUMNS - 1]
    if 0 < east < steps_left:
        best, steps_left = node + 1, east
    if 0 < west < steps_left:
        best, steps_left = node - 1, west
    if 0 < south < steps_left:
        best, steps_left = node + COLUMNS, south
    if 0 < north < steps_left:
        best, steps_left = node - COLUMNS, north
    return best


@kernel
def corner_after(route: Route) -> tuple[float, float]:
    """The node that follows the waypoint on a way round walls, px."""
    node = descend(route, node_at(route.waypoint_x, route.waypoint_y))
    return node % COLUMNS * CELL, node // COLUMNS * CELL


@kernel
def random_place(world: World) -> tuple[float, float]:
    """A place, px, drawn by lot with the match's generator, where a robot can stand and drive."""
    node = 0
    while node == 0:
        node = free_node(world, uniform(world) * WIDTH, uniform(world) * HEIGHT)
    return node % COLUMNS * CELL, node // COLUMNS * CELL


@kernel
def update_route(world: World, route: Route, x: float, y: float) -> None:
    """Set the waypoint for a robot at (x, y), along its route."""
    route.waypoint_x, route.waypoint_y, route.straight = route.goal_x, route.goal_y, 1
    if not route.active or is_clear(world, x, y, route.goal_x, route.goal_y, world.radius + 1.0):
        return
    root = free_node(world, route.goal_x, route.goal_y)
    node = free_node(world, x, y)
    if root == 0 or node == 0:
        return
    standing = 64 * world.shifts
    for i in range(world.wall_count):
        if world.walls[i].health:
            standing += 1
    if not near_root(route, root) or route.walls != standing or route.reach[node] == 0:
        route.walls = standing
        expand(world, route, root, node)
        if route.reach[node] == 0:  # unreachable: keep the straight line
            return
    route.straight = 0
    route.waypoint_x, route.waypoint_y = node % COLUMNS * CELL, node // COLUMNS * CELL
    for _ in range(LOOK):
        node = descend(route, node)
        waypoint_x, waypoint_y = node % COLUMNS * CELL, node // COLUMNS * CELL
        if not is_clear(world, x, y, waypoint_x, waypoint_y, world.radius + 1.0):
            return
        route.waypoint_x, route.waypoint_y = waypoint_x, waypoint_y
        if node == route.root:
            return


@kernel
def near_root(route: Route, root: int) -> int:
    """1 if the root of the field is at most SLACK nodes away from `root`."""
    if route.root == 0:
        return 0
    rows = route.root // COLUMNS - root // COLUMNS
    columns = route.root % COLUMNS - root % COLUMNS
    return 1 if -SLACK <= rows <= SLACK and -SLACK <= columns <= SLACK else 0
