"""Getting free: how a brain notices that it gets nowhere and backs out; and a reflex for brains that learned neither.

A mind that uses the first has the fields `anchor_x`, `anchor_y`, `held_up`, `escape`, `escape_turn`, and a generator.

The reflex is for learned brains: a robot that pushes and gets nowhere lets go for a second. It stands outside what was
learned, and is off in training and in measuring. It drives towards the opponent, round the walls; if that was no help
the last time, it backs out with some turn. Who only stands there and sees nobody for long is sent off too. By the
`classic` rules (those without turbo) robots are to play on a seat as they were measured: there it only takes them off
the wall by a hand's breadth after some seconds, and nobody who waits is sent anywhere.
"""

from typing import Any

from pigaming_app.ai.brain.steering import follow
from pigaming_app.sim.action import set_action
from pigaming_app.sim.flow_field import Route
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import uniform
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import HZ

SOMEWHERE = 20.0  # px that count as having got somewhere
PATIENCE = round(1.5 * HZ)  # ticks of pushing without getting there
WAITING = 5 * HZ  # ticks of standing there and seeing nobody
LETTING_GO = HZ  # ticks
LONG, SHORTLY = round(2.5 * HZ), 10  # the same two by the classic rules
TOUCH = 2.0 * RADIUS + 6.0  # px between the middles of robots that push each other
HELD_UP = 20.0  # px; less than this within some ticks is getting nowhere
FREEING = 20  # ticks of backing out, one way or the other


@kernel
def held_up(mind: Any, x: float, y: float, idle: bool, near: float, period: int) -> int:
    """Ticks since a robot at (x, y) was last idle or more than `near` px away from where it was then."""
    dx, dy = x - mind.anchor_x, y - mind.anchor_y
    if idle or dx * dx + dy * dy > near * near:
        mind.held_up, mind.anchor_x, mind.anchor_y = 0, x, y
    else:
        mind.held_up += period
    return int(mind.held_up)


@kernel
def choose_escape(mind: Any, back: float, odds: float) -> None:
    """Choose the stick to get free with: `back` with these odds, else the other way, which is blocked less often."""
    mind.escape = back if uniform(mind) < odds else -back
    mind.escape_turn = 2.0 * uniform(mind) - 1.0


@kernel
def escape(mind: Any, x: float, y: float, action: Any) -> int:
    """Back out with a turn, and the other way if that leads nowhere; `mind.since` counts the ticks. 1: it is free."""
    set_action(action, mind.escape, mind.escape_turn, 0, 0)
    if mind.since < FREEING:
        return 0
    dx, dy = x - mind.anchor_x, y - mind.anchor_y
    if dx * dx + dy * dy < HELD_UP * HELD_UP:  # that way is blocked too
        mind.since, mind.escape, mind.escape_turn = 0, -mind.escape, 2.0 * uniform(mind) - 1.0
        return 0
    mind.held_up, mind.anchor_x, mind.anchor_y = 0, x, y
    return 1


@record
class Reflex:
    """What the reflex remembers."""

    on: int  # 0: there is none
    route: Route
    x: float  # where the robot was when it last got somewhere
    y: float
    held_up: int  # ticks since, of pushing
    waited: int  # ticks since, of standing and seeing nobody
    left: int  # ticks for which it still lets go
    tries: int  # without getting anywhere
    stick: float  # while it backs out
    turn: float


@kernel
def act_on_reflex(match: Any, seat: int, opponent: int, mind: Any, period: int) -> int:
    """1 if the reflex has set the action of the next `period` ticks. `mind` has it as `reflex`, and a generator."""
    reflex = mind.reflex
    if not reflex.on:
        return 0
    robot, action = match.robots[seat], match.actions[seat]
    update_reflex(match, robot, opponent, reflex, action, period)
    classic = not match.rules.turbo
    if reflex.held_up >= (LONG if classic else PATIENCE) or reflex.waited >= WAITING:
        reflex.left, reflex.held_up, reflex.waited = SHORTLY if classic else LETTING_GO, 0, 0
        reflex.tries += 1
        reflex.stick = -1.0 if action.linear > 0.0 else 1.0
        reflex.turn = 0.0 if classic else 2.0 * uniform(mind) - 1.0
    if reflex.left <= 0:
        return 0
    reflex.left -= period
    if reflex.tries % 2 and not classic:
        route, other = reflex.route, match.robots[opponent]
        route.wanted, route.goal_x, route.goal_y = 1, other.x, other.y
        follow(match, seat, route, period)
    else:
        set_action(action, reflex.stick, reflex.turn, 0, 0)
    return 1


@kernel
def update_reflex(match: Any, robot: Any, opponent: int, reflex: Any, action: Any, period: int) -> None:
    """Count for how long it has pushed against something that is not its opponent, or has waited for nobody."""
    dx, dy = robot.x - reflex.x, robot.y - reflex.y
    if dx * dx + dy * dy > SOMEWHERE * SOMEWHERE:
        reflex.x, reflex.y, reflex.held_up, reflex.waited, reflex.tries = robot.x, robot.y, 0, 0, 0
        return
    other = match.robots[opponent]
    dx, dy = other.x - robot.x, other.y - robot.y
    if reflex.left > 0 or dx * dx + dy * dy < TOUCH * TOUCH:
        return
    if action.linear != 0.0:
        reflex.held_up += period
    elif match.rules.turbo and not is_clear(match, robot.x, robot.y, other.x, other.y, 0.0):
        reflex.waited += period
