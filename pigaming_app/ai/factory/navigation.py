"""Shortest ways round the machines: a graph of the corners of their bodies that see each other.

Each body has four corners, its centre and CORNER px and a robot's radius along either axis. Corners in a wall or
outside the arena do not count. A side at which a person stands costs DETOUR px more.
"""

from math import atan2, sqrt
from typing import Annotated

from pigaming_app.games.factory.observation import OTHERS, FactoryObservation
from pigaming_app.games.factory.state import MACHINE_SLOTS, MACHINES, WORKERS, Factory
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import Robot

CORNERS = 4 * MACHINES
CORNER = 72.0  # px from the centre of a machine to a robot there
DETOUR = 200.0  # px, cost of a side at which a person stands
STANDS = 80.0  # px between a person and the middle of such a side
FAR = 1e6  # px
CLEAR = 1.0  # px beside a robot, between corners
SLIDE = 14.0  # px narrower than itself, from the robot: it slides round what it touches
KEEP = 30.0  # px by which a way on another side than before must be shorter
CROWDED = 140.0  # px between another robot and the middle of a side


@record
class Ways:
    """The graph, and the ways to the present goal. All distances in px."""

    built: int
    x: Annotated[list[float], CORNERS]
    y: Annotated[list[float], CORNERS]
    edges: Annotated[list[float], CORNERS * CORNERS]  # between two corners that see each other, else FAR
    goal_x: float
    goal_y: float
    last: Annotated[list[float], CORNERS]  # from a corner straight to the goal, FAR if something is in between
    left: Annotated[list[float], CORNERS]  # from a corner to the goal
    to_go: float  # from the robot to the goal
    corner: int  # 1 + the corner it drives to, 0: to the goal itself


@kernel
def build_ways(match: Factory, obs: FactoryObservation, ways: Ways) -> None:
    """Build the graph."""
    ways.built, ways.goal_x, corner = 1, -FAR, CORNER + match.radius
    for m in range(MACHINES):
        into, out = obs.slots[MACHINE_SLOTS + 2 * m], obs.slots[MACHINE_SLOTS + 2 * m + 1]
        for k in range(4):
            i = 4 * m + k
            ways.x[i] = 0.5 * (into.x + out.x) + (corner if k == 1 or k == 2 else -corner)
            ways.y[i] = 0.5 * (into.y + out.y) + (corner if k > 1 else -corner)
    clear = match.radius + CLEAR
    for i in range(CORNERS):
        for j in range(i + 1):
            edge = FAR
            x, y, u, v = ways.x[i], ways.y[i], ways.x[j], ways.y[j]
            if i != j and not in_wall(match, x, y) and not in_wall(match, u, v) and is_clear(match, x, y, u, v, clear):
                edge = sqrt((x - u) * (x - u) + (y - v) * (y - v))
            ways.edges[i * CORNERS + j] = ways.edges[j * CORNERS + i] = edge


@kernel
def side_cost(obs: FactoryObservation, ways: Ways, i: int, j: int) -> float:
    """DETOUR if a person stands at the side of a machine between two neighbouring corners, else 0."""
    x, y = 0.5 * (ways.x[i] + ways.x[j]), 0.5 * (ways.y[i] + ways.y[j])
    for w in range(WORKERS):
        person = obs.people[w]
        dx, dy = person.x - x, person.y - y
        if not person.walking and dx * dx + dy * dy < STANDS * STANDS:
            return DETOUR
    for i in range(OTHERS):
        other = obs.others[i]
        if other.present:
            dx, dy = other.x - x, other.y - y
            if dx * dx + dy * dy < CROWDED * CROWDED:
                return DETOUR
    return 0.0


@kernel
def measure_ways(match: Factory, obs: FactoryObservation, ways: Ways, x: float, y: float) -> None:
    """Update the ways from all corners to the goal (x, y)."""
    if ways.goal_x != x or ways.goal_y != y:
        ways.goal_x, ways.goal_y, clear = x, y, match.radius + CLEAR
        for i in range(CORNERS):
            ways.last[i] = FAR
            if is_clear(match, ways.x[i], ways.y[i], x, y, clear) and not in_wall(match, ways.x[i], ways.y[i]):
                dx, dy = ways.x[i] - x, ways.y[i] - y
                ways.last[i] = sqrt(dx * dx + dy * dy)
    for i in range(CORNERS):
        ways.left[i] = ways.last[i]
    changed = True
    while changed:
        changed = False
        for i in range(CORNERS):
            for j in range(CORNERS):
                edge = ways.edges[i * CORNERS + j]
                if edge >= FAR or ways.left[j] + edge >= ways.left[i]:
                    continue
                if i // 4 == j // 4:
                    edge += side_cost(obs, ways, i, j)
                if ways.left[j] + edge < ways.left[i]:
                    ways.left[i] = ways.left[j] + edge
                    changed = True


@kernel
def leads_on(ways: Ways, i: int, j: int) -> bool:
    """True if the way from corner i to the goal leads over corner j."""
    return bool(i == j or ways.edges[i * CORNERS + j] + ways.left[j] <= ways.left[i] + 1.0)


@kernel
def choose_waypoint(match: Factory, robot: Robot, obs: FactoryObservation, ways: Ways, x: float, y: float) -> None:
    """Set the position of the waypoint on the shortest way to (x, y).

    A way on another side than before must be KEEP px shorter.
    """
    obs.waypoint_x, obs.waypoint_y, obs.straight = x, y, 1
    ways.to_go = obs.goal_distance
    before = ways.corner - 1 if ways.goal_x == x and ways.goal_y == y else -1
    ways.corner = 0
    if is_clear(match, robot.x, robot.y, x, y, match.radius - SLIDE):
        return
    measure_ways(match, obs, ways, x, y)
    best, first, shortest, beyond = -1, -1, FAR, -1.0
    while beyond < FAR:  # the corners in the order of their ways
        nearest, least = -1, FAR
        for i in range(CORNERS):
            dx, dy = ways.x[i] - robot.x, ways.y[i] - robot.y
            way = ways.left[i] + sqrt(dx * dx + dy * dy)
            if beyond < way < least:
                nearest, least = i, way
        beyond = least
        if nearest < 0 or least >= shortest:
            break
        if first < 0:
            first = nearest
        if is_clear(match, robot.x, robot.y, ways.x[nearest], ways.y[nearest], match.radius - SLIDE):
            if before >= 0 and not leads_on(ways, before, nearest):
                least += KEEP
            if least < shortest:
                best, shortest = nearest, least
    if best < 0:  # it touches a wall
        best = first
    if best >= 0:
        obs.waypoint_x, obs.waypoint_y, obs.straight = ways.x[best], ways.y[best], 0
        ways.corner, ways.to_go = best + 1, min(shortest, FAR)


@kernel
def find_way(match: Factory, robot: Robot, obs: FactoryObservation, ways: Ways, x: float, y: float) -> None:
    """Set goal and waypoint of the observation for the shortest way to (x, y)."""
    if not ways.built:
        build_ways(match, obs, ways)
    dx, dy = x - robot.x, y - robot.y
    obs.goal_distance = sqrt(dx * dx + dy * dy)
    obs.goal_bearing = turn_to(atan2(dy, dx) - robot.heading)
    choose_waypoint(match, robot, obs, ways, x, y)
    dx, dy = obs.waypoint_x - robot.x, obs.waypoint_y - robot.y
    obs.waypoint_distance = sqrt(dx * dx + dy * dy)
    obs.waypoint_bearing = turn_to(atan2(dy, dx) - robot.heading)
