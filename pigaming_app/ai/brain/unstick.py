"""Stuck detection and recovery, and a recovery reflex for learned brains, which have neither.

The reflex overrides a learned policy for a second when the robot pushes without moving. It is not part of the policy
and is off during training and evaluation. It first drives towards the opponent round the walls; if that fails, it
backs out with a random turn. A robot that stands still without seeing its opponent for long is sent off as well. By the
`classic` rules (those without turbo) robots must play as they were measured: there the reflex only backs off the wall
for ten ticks after 2.5 s, and never moves a waiting robot.
"""

from typing import Protocol

from pigaming_app.ai.brain.steering import follow
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.action import set_action
from pigaming_app.sim.flow_field import Route
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import Rng, uniform
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import HZ, Action, Robot

PROGRESS = 20.0  # px of displacement that reset the reflex
PUSHING = round(1.5 * HZ)  # ticks of pushing in place until the reflex acts
WAITING = 5 * HZ  # ticks of standing without sight of the opponent until the reflex acts
OVERRIDE = HZ  # ticks for which the reflex drives
CLASSIC_PUSHING, CLASSIC_OVERRIDE = round(2.5 * HZ), 10  # PUSHING and OVERRIDE by the classic rules
TOUCH = 6.0  # px between robots that push each other
STUCK_DISTANCE = 20.0  # px; a smaller displacement counts as stuck
FREEING = 20  # ticks of one attempt to back out


class Anchored(Protocol):
    """A mind that `ticks_stuck` uses: the position at the last progress, px, and the ticks since then."""

    anchor_x: float
    anchor_y: float
    stuck_ticks: int


class Escaping(Rng, Protocol):
    """A mind that `choose_escape` uses: forward and turn stick while backing out."""

    escape: float
    escape_turn: float


class Stuck(Anchored, Escaping, Protocol):
    """A mind that `escape` uses: in addition the ticks since its attempt began."""

    since: int


@kernel
def ticks_stuck(mind: Anchored, x: float, y: float, idle: bool, near: float, period: int) -> int:
    """Ticks since a robot, now at (x, y), was last idle or moved more than `near` px; call every `period` ticks."""
    dx, dy = x - mind.anchor_x, y - mind.anchor_y
    if idle or dx * dx + dy * dy > near * near:
        mind.stuck_ticks, mind.anchor_x, mind.anchor_y = 0, x, y
    else:
        mind.stuck_ticks += period
    return int(mind.stuck_ticks)


@kernel
def choose_escape(mind: Escaping, back: float, odds: float) -> None:
    """Choose the stick for backing out: `back` with probability `odds`, else `-back`, and a random turn."""
    mind.escape = back if uniform(mind) < odds else -back
    mind.escape_turn = 2.0 * uniform(mind) - 1.0


@kernel
def escape(mind: Stuck, x: float, y: float, action: Action) -> int:
    """Back out with a turn, and reverse direction if still stuck after FREEING ticks. Returns 1 once free."""
    set_action(action, mind.escape, mind.escape_turn, 0, 0)
    if mind.since < FREEING:
        return 0
    dx, dy = x - mind.anchor_x, y - mind.anchor_y
    if dx * dx + dy * dy < STUCK_DISTANCE * STUCK_DISTANCE:  # that way is blocked too
        mind.since, mind.escape, mind.escape_turn = 0, -mind.escape, 2.0 * uniform(mind) - 1.0
        return 0
    mind.stuck_ticks, mind.anchor_x, mind.anchor_y = 0, x, y
    return 1


@record
class Reflex:
    """State of the reflex."""

    on: int  # 0: disabled
    route: Route
    x: float  # position at the last progress, px
    y: float
    stuck_ticks: int  # ticks of pushing since then
    waited: int  # ticks of standing without sight of the opponent since then
    left: int  # ticks left of overriding
    tries: int  # overrides since the last progress
    stick: float  # forward stick while backing out
    turn: float


class WithReflex(Rng, Protocol):
    """A mind with a reflex."""

    reflex: Reflex


@kernel
def act_on_reflex(match: PiTanks, seat: int, opponent: int, mind: WithReflex, period: int) -> int:
    """Let the reflex set the action of the next `period` ticks if it has to; 1 if it did."""
    reflex = mind.reflex
    if not reflex.on:
        return 0
    robot, action = match.robots[seat], match.actions[seat]
    update_reflex(match, robot, opponent, reflex, action, period)
    classic = not match.rules.turbo
    if reflex.stuck_ticks >= (CLASSIC_PUSHING if classic else PUSHING) or reflex.waited >= WAITING:
        reflex.left, reflex.stuck_ticks, reflex.waited = CLASSIC_OVERRIDE if classic else OVERRIDE, 0, 0
        reflex.tries += 1
        reflex.stick = -1.0 if action.linear > 0.0 else 1.0
        reflex.turn = 0.0 if classic else 2.0 * uniform(mind) - 1.0
    if reflex.left <= 0:
        return 0
    reflex.left -= period
    if reflex.tries % 2 and not classic:
        route, other = reflex.route, match.robots[opponent]
        route.active, route.goal_x, route.goal_y = 1, other.x, other.y
        follow(match, seat, route, period)
    else:
        set_action(action, reflex.stick, reflex.turn, 0, 0)
    return 1


@kernel
def update_reflex(match: PiTanks, robot: Robot, opponent: int, reflex: Reflex, action: Action, period: int) -> None:
    """Count the ticks of pushing against anything but the opponent, and of waiting without sight of the opponent."""
    dx, dy = robot.x - reflex.x, robot.y - reflex.y
    if dx * dx + dy * dy > PROGRESS * PROGRESS:
        reflex.x, reflex.y, reflex.stuck_ticks, reflex.waited, reflex.tries = robot.x, robot.y, 0, 0, 0
        return
    other, touch = match.robots[opponent], 2.0 * match.radius + TOUCH
    dx, dy = other.x - robot.x, other.y - robot.y
    if reflex.left > 0 or dx * dx + dy * dy < touch * touch:
        return
    if action.linear != 0.0:
        reflex.stuck_ticks += period
    elif match.rules.turbo and not is_clear(match, robot.x, robot.y, other.x, other.y, 0.0):
        reflex.waited += period
