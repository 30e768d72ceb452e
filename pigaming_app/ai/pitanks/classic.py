"""`classic`, the thesis robot of the lobby: the finite state machine of the thesis, frozen, with one addition.

Winning or level it defends: it goes behind the nearest inner wall, waits there, and fires at an opponent in sight.
Losing it attacks: it closes in round the walls, aims and fires. It aims without lead, never dodges, ignores pickups and
never leaves cover in a level match. Results are comparable because it stays the same while `fsm` improves.

The addition is BREAK_FREE: a robot that drives and gets nowhere for STUCK_TICKS backs out, turning at random, and goes
on as before. The original's robots stayed stuck in walls, by a fault of its engine that caused some of its ties; its
paper mentions no such state, though the diagram of its states is not in our copy.

The original's paper does not give the numbers in `Parameters`. Only these were fitted, so that trained robots reach the
published results against it: see tests/bench/reproduce_table.py.
"""

from dataclasses import dataclass
from math import sqrt

from pigaming_app.ai.brain.kind import BrainKind, NoWeights
from pigaming_app.ai.brain.steering import bearing, follow, turn_stick
from pigaming_app.ai.qlearning.features import nearest_opponent
from pigaming_app.games.pitanks.scoring import lead
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.action import set_action
from pigaming_app.sim.flow_field import Route
from pigaming_app.sim.grid import BLOCKED, node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import seeded, uniform
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import HEIGHT, WIDTH, Action, Robot

DEFEND, ATTACK, BREAK_FREE = range(3)
STUCK_DISTANCE, STUCK_TICKS, FREEING = (
    20.0,
    30,
    20,
)  # px and ticks: a smaller displacement is stuck; ticks of backing out


@dataclass(frozen=True)
class Parameters:
    """Parameters that the original's paper leaves open."""

    engage: float = 200.0  # px; within this range it stops and fires at an opponent in sight
    period: int = 40  # ticks between decisions
    tolerance: float = 0.08  # largest aiming error at which it fires, rad
    beside: float = 50.0  # px between a hidden robot and its wall
    arrived: float = 85.0  # px from the hiding place that count as arrived


@record
class ParameterRecord(Parameters):
    """`Parameters` as a record for kernels."""


@record
class ClassicMind:
    """Memory of the machine."""

    numbers: ParameterRecord
    route: Route
    random: int
    state: int
    since: int  # ticks in this state
    anchor_x: float  # position at the last progress, px
    anchor_y: float
    stuck_ticks: int  # ticks since then
    escape: float  # forward stick while backing out
    escape_turn: float


@kernel
def think(match: PiTanks, seat: int, mind: ClassicMind, weights: NoWeights) -> None:
    """Observe and decide every `period` ticks; the action holds in between."""
    period = mind.numbers.period
    if (match.tick + seat) % period:
        return
    robot, action, opponent = match.robots[seat], match.actions[seat], nearest_opponent(match, seat)
    mind.since += period
    detect_stuck(robot, mind, action)
    if opponent < 0:
        set_action(action, 0.0, 0.0, 0, 0)
    elif mind.state == BREAK_FREE:
        break_free(robot, mind, action)
    elif lead(match, seat) >= 0 and hide(match, robot, match.robots[opponent], mind):
        mind.state = DEFEND
        defend(match, seat, match.robots[opponent], mind)
    else:
        mind.state = ATTACK
        attack(match, seat, match.robots[opponent], mind)


@kernel
def defend(match: PiTanks, seat: int, other: Robot, mind: ClassicMind) -> None:
    """Go to the hiding place and wait there; fire at an opponent in sight."""
    robot, route = match.robots[seat], mind.route
    dx, dy = route.goal_x - robot.x, route.goal_y - robot.y
    if shows(match, robot, other, mind):
        shoot(match, seat, other, mind)
    elif dx * dx + dy * dy > mind.numbers.arrived * mind.numbers.arrived:
        follow(match, seat, route, mind.numbers.period)
    else:
        angle, turn_rate = bearing(robot, other.x, other.y), match.rules.turn_rate
        set_action(match.actions[seat], 0.0, turn_stick(angle, robot.angular, turn_rate, mind.numbers.period), 0, 0)


@kernel
def attack(match: PiTanks, seat: int, other: Robot, mind: ClassicMind) -> None:
    """Close in on the opponent round the walls, aim and fire."""
    if shows(match, match.robots[seat], other, mind):
        shoot(match, seat, other, mind)
    else:
        go_to(mind, other.x, other.y)
        follow(match, seat, mind.route, mind.numbers.period)


@kernel
def break_free(robot: Robot, mind: ClassicMind, action: Action) -> None:
    """Back out with a turn, alternating direction every FREEING ticks until the robot is free."""
    set_action(action, mind.escape, mind.escape_turn, 0, 0)
    if mind.since < FREEING:
        return
    dx, dy = robot.x - mind.anchor_x, robot.y - mind.anchor_y
    mind.since = 0
    if dx * dx + dy * dy < STUCK_DISTANCE * STUCK_DISTANCE:  # that way is blocked too
        mind.escape, mind.escape_turn = -mind.escape, 2.0 * uniform(mind) - 1.0
    else:
        mind.state, mind.stuck_ticks, mind.anchor_x, mind.anchor_y = DEFEND, 0, robot.x, robot.y


# ------------------------------------------------------------------------------------------------------------- helpers


@kernel
def detect_stuck(robot: Robot, mind: ClassicMind, action: Action) -> None:
    """Enter BREAK_FREE if the robot drives without moving for STUCK_TICKS."""
    if mind.state == BREAK_FREE:
        return
    dx, dy = robot.x - mind.anchor_x, robot.y - mind.anchor_y
    if dx * dx + dy * dy > STUCK_DISTANCE * STUCK_DISTANCE or action.linear == 0.0:
        mind.stuck_ticks, mind.anchor_x, mind.anchor_y = 0, robot.x, robot.y
        return
    mind.stuck_ticks += mind.numbers.period
    if mind.stuck_ticks > STUCK_TICKS:
        mind.state, mind.since = BREAK_FREE, 0
        mind.escape = -1.0 if action.linear > 0.0 else 1.0
        mind.escape_turn = 2.0 * uniform(mind) - 1.0


@kernel
def shows(match: PiTanks, robot: Robot, other: Robot, mind: ClassicMind) -> int:
    """1 if the opponent is in sight and within `engage` px."""
    reach = mind.numbers.engage
    dx, dy = other.x - robot.x, other.y - robot.y
    if dx * dx + dy * dy > reach * reach:
        return 0
    return is_clear(match, robot.x, robot.y, other.x, other.y, match.rules.bullet_radius)


@kernel
def hide(match: PiTanks, robot: Robot, other: Robot, mind: ClassicMind) -> int:
    """Set the goal to the nearest hiding place behind an inner wall; 0 if there is none.

    A hiding place lies on the line from the opponent through the middle of a wall, `beside` px clear of the wall's far
    side, or past its end where that line runs along the wall.
    """
    least = 1e18
    for i in range(match.wall_count):
        wall = match.walls[i]
        ex, ey = 0.5 * (wall.bx - wall.ax), 0.5 * (wall.by - wall.ay)
        half = sqrt(ex * ex + ey * ey)
        if not wall.health or half < 1.0:
            continue
        mx, my = wall.ax + ex, wall.ay + ey
        gap = wall.half + match.radius + mind.numbers.beside
        nx, ny = -ey / half * gap, ex / half * gap
        ux, uy = mx - other.x, my - other.y
        line = sqrt(ux * ux + uy * uy)
        across = abs(ux * nx + uy * ny) / gap
        behind = half + gap
        if across * behind > gap * line:
            behind = gap * line / across
        x, y = mx + ux / line * behind, my + uy / line * behind
        dx, dy = x - robot.x, y - robot.y
        away = dx * dx + dy * dy
        inside = match.radius < x < WIDTH - match.radius and match.radius < y < HEIGHT - match.radius
        if away < least and inside and not match.grid[node_at(x, y)] & BLOCKED:
            least = away
            go_to(mind, x, y)
    return 1 if least < 1e18 else 0


@kernel
def go_to(mind: ClassicMind, x: float, y: float) -> None:
    mind.route.active, mind.route.goal_x, mind.route.goal_y = 1, x, y


@kernel
def shoot(match: PiTanks, seat: int, other: Robot, mind: ClassicMind) -> None:
    """Turn to the opponent and fire once the gun points at it."""
    robot = match.robots[seat]
    angle = bearing(robot, other.x, other.y)
    fire = 1 if not match.tanks[seat].cooldown and abs(angle) < mind.numbers.tolerance else 0
    stick = turn_stick(angle, robot.angular, match.rules.turn_rate, mind.numbers.period)
    set_action(match.actions[seat], 0.0, stick, fire, 0)


def machine(name: str, parameters: Parameters) -> BrainKind:
    """The machine as a brain, with these parameters."""

    def reset(mind: ClassicMind, seed: int) -> None:
        for key, number in vars(parameters).items():
            setattr(mind.numbers, key, number)
        mind.random = seeded(seed)

    return BrainKind(name, ClassicMind, think, reset)


CLASSIC = machine("classic", Parameters())
