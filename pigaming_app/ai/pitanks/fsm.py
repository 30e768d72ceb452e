"""The hand-written opponent of PiTanks, a finite state machine after the original's.

Winning or level it defends: it takes cover behind the nearest inner wall, waits, and fires when an opponent shows.
Losing it attacks: it closes in round the walls, aims, fires. Two things the original lacked: it backs out when it gets
nowhere, and when it has waited for long in a level match it goes out and looks (else two of them would wait for ever).

The three strengths differ in how late they see others and how badly they aim, never in speed.
"""

from math import pi
from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.brain.steering import approach, turn_stick
from pigaming_app.ai.brain.unstick import HELD_UP, choose_escape, escape, held_up
from pigaming_app.games.pitanks.observation import OTHERS, Observation, Senses, observe
from pigaming_app.sim.action import set_action
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import bell, seeded, uniform
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.world import DT, HZ

PERIOD = 5  # ticks between decisions: 10 Hz, one seat after the other
ENGAGE = 420.0  # px at which an attacker no longer closes in
CROWD = 230.0  # px at which it backs off
REACH = 760.0  # px from which an attacker fires
SWERVE = 0.9  # rad to the side of the other while it reloads
ARRIVED = 26.0  # px from the goal that count as there
HELD_UP_TICKS = 30
NEW_AIM = 25  # ticks after which the error of the aim is drawn anew

DEFEND, ATTACK, BREAK_FREE = range(3)


@record
class FsmMind:
    """What the machine remembers."""

    senses: Senses
    obs: Observation
    spread: float  # rad, standard deviation of the aim
    patience: int  # ticks of seeing nobody in a level match after which it goes out
    dodges: int  # 1: it drives out of the way of bullets
    random: int
    state: int
    since: int  # ticks in this state
    unseen: int  # ticks since an opponent was last in sight
    seen: int  # ticks for which one has been in sight
    target: int  # which of the others; -1: none
    on_target: int  # ticks for which the gun has pointed at the target
    bias: float  # rad, the present error of the aim
    bias_left: int
    anchor_x: float  # where it was when it last got anywhere
    anchor_y: float
    held_up: int  # ticks since
    escape: float  # the stick while it breaks free
    escape_turn: float
    weave: float  # ahead or back while it duels


@kernel
def think(match: Any, seat: int, mind: Any, weights: Any) -> None:
    """Look and decide every PERIOD ticks; in between the stick stays as it is."""
    if (match.tick + seat) % PERIOD:
        return
    observe(match, seat, mind.senses, mind.obs)
    act(mind.obs, mind, match.actions[seat])


@kernel
def act(obs: Any, mind: Any, action: Any) -> None:
    """The machine: remember, choose the state, let the state act."""
    mind.since += PERIOD
    pick_target(obs, mind)
    draw_error(mind)
    detect_stuck(obs, mind, action)
    state = mind.state
    if state == DEFEND:
        after = defend(obs, mind, action)
    elif state == ATTACK:
        after = attack(obs, mind, action)
    else:
        after = break_free(obs, mind, action)
    if after != state:
        mind.state, mind.since = after, 0
    if mind.dodges and after != BREAK_FREE:
        dodge(obs, action)


# ------------------------------------------------------------------------------------------------------------- states


@kernel
def defend(obs: Any, mind: Any, action: Any) -> int:
    """Go behind the nearest wall and wait there; fire at whoever shows."""
    bored = obs.lead == 0 and mind.unseen > mind.patience
    if obs.lead < 0 or bored or not obs.cover or mind.target < 0:
        return ATTACK
    if obs.prize and obs.prize_distance < 260.0:
        go_to(mind, obs.prize_x, obs.prize_y)
    else:
        go_to(mind, obs.cover_x, obs.cover_y)
    other = obs.others[mind.target]
    if mind.seen and (other.distance < CROWD or obs.goal_distance <= ARRIVED):
        duel(obs, mind, action, other)
    elif obs.goal_distance > ARRIVED:
        follow(obs, mind, action)
    else:
        shoot(obs, mind, action, 0.0)
    return DEFEND


@kernel
def attack(obs: Any, mind: Any, action: Any) -> int:
    """Close in on the target round the walls, aim, fire."""
    if mind.target < 0:
        set_action(action, 0.0, 0.0, 0, 0)
        return ATTACK
    if obs.cover and (obs.lead > 0 or (obs.lead == 0 and mind.unseen == 0 and mind.since > 4 * HZ)):
        return DEFEND
    other = obs.others[mind.target]
    if obs.prize and obs.prize_distance < 320.0 and obs.prize_distance < other.distance:
        go_to(mind, obs.prize_x, obs.prize_y)
    else:
        go_to(mind, other.x, other.y)
    if mind.seen and other.distance < REACH:
        duel(obs, mind, action, other)
    else:
        follow(obs, mind, action)
    return ATTACK


@kernel
def break_free(obs: Any, mind: Any, action: Any) -> int:
    """Back out the way it came, with a turn, else the other way, until it has got somewhere."""
    if not escape(mind, obs.x, obs.y, action):
        return BREAK_FREE
    return DEFEND if obs.lead >= 0 else ATTACK


# ------------------------------------------------------------------------------------------------------- what they use


@kernel
def pick_target(obs: Any, mind: Any) -> None:
    """The nearest opponent; one in sight counts as much nearer, and so does the one already chosen."""
    best, least = -1, 1e9
    for i in range(OTHERS):
        other = obs.others[i]
        if not other.present or other.mate:
            continue
        cost = other.distance
        if not other.clear:
            cost += 500.0
        if other.protected:
            cost += 150.0
        if i == mind.target:
            cost -= 120.0
        if cost < least:
            best, least = i, cost
    mind.target = best
    if best >= 0 and obs.others[best].clear:
        mind.seen += PERIOD
        if mind.seen * DT < mind.senses.delay:  # not noticed yet
            return
        mind.unseen = 0
    else:
        mind.seen = 0
        mind.unseen += PERIOD


@kernel
def draw_error(mind: Any) -> None:
    """Draw the error of the aim anew now and then."""
    mind.bias_left -= PERIOD
    if mind.bias_left <= 0:
        mind.bias_left = NEW_AIM
        mind.bias = 2.0 * mind.spread * bell(mind)
        mind.weave = 1.0 if uniform(mind) < 0.5 else -1.0


@kernel
def detect_stuck(obs: Any, mind: Any, action: Any) -> None:
    """Notice that it wants to move and gets nowhere."""
    if mind.state == BREAK_FREE:
        return
    idle = action.linear == 0.0
    if held_up(mind, obs.x, obs.y, idle, HELD_UP, PERIOD) > HELD_UP_TICKS:
        mind.state, mind.since = BREAK_FREE, 0
        choose_escape(mind, -1.0 if action.linear > 0.0 else 1.0, 0.75)


@kernel
def go_to(mind: Any, x: float, y: float) -> None:
    """Set the goal of the route; the way there comes with the next observation."""
    route = mind.senses.route
    route.wanted, route.goal_x, route.goal_y = 1, x, y


@kernel
def follow(obs: Any, mind: Any, action: Any) -> None:
    """Drive on along the way."""
    bearing, speed = approach(obs.way_bearing, obs.way_distance)
    near = obs.goal_distance / 70.0
    if obs.straight and near < 1.0:
        speed *= 0.3 + 0.7 * near
    dash = 1 if obs.goal_distance > 300.0 and obs.turbo > 0.5 and abs(bearing) < 0.3 else 0
    set_action(action, speed, turn_stick(bearing, obs.angular, obs.turn_rate, PERIOD), snap_shot(obs, mind), dash)


@kernel
def shoot(obs: Any, mind: Any, action: Any, speed: float) -> None:
    """Turn to the target's aim, and fire when it is on it."""
    aim = obs.others[mind.target].aim + mind.bias
    set_action(action, speed, turn_stick(aim, obs.angular, obs.turn_rate, PERIOD), snap_shot(obs, mind), 0)


@kernel
def snap_shot(obs: Any, mind: Any) -> int:
    """1 if the gun happens to point at what it wants to hit (or a mine can be laid in flight)."""
    if mind.target < 0:
        return 0
    other = obs.others[mind.target]
    if obs.mine and other.distance > 150.0:
        return 1
    if not mind.seen or mind.seen * DT < mind.senses.delay or not obs.loaded or other.protected > 20:
        return 0
    if abs(other.aim + mind.bias) > 0.7 * RADIUS / (other.distance + 1.0) + 0.02:
        mind.on_target = 0
        return 0
    mind.on_target += PERIOD
    if mind.on_target * DT < mind.senses.delay:  # the finger is as late as the eyes
        return 0
    mind.on_target = 0
    return 1


@kernel
def duel(obs: Any, mind: Any, action: Any, other: Any) -> None:
    """Aim and fire while the gun is loaded; swerve across the other's sights while it is not."""
    ahead = 1.0
    if other.distance < CROWD:
        ahead = -1.0
    elif other.distance < ENGAGE:
        ahead = mind.weave
    if obs.loaded:
        shoot(obs, mind, action, ahead)
    else:
        aside = other.bearing + SWERVE * mind.weave
        set_action(action, ahead, turn_stick(aside, obs.angular, obs.turn_rate, PERIOD), 0, 0)


@kernel
def dodge(obs: Any, action: Any) -> None:
    """Drive out of a bullet's path if that is possible in time: across it, to the nearer side."""
    if obs.threat > 0.7:
        return
    across = turn_to(
        obs.threat_bearing + 0.5 * pi
    )  # the bullet comes from threat_bearing; its right hand is across - pi
    ahead = 1.0 if abs(across) < 0.5 * pi else -1.0
    lean = abs(abs(across) - 0.5 * pi)  # pi/2: the robot stands across the path; 0: along it
    if lean < 0.5:
        return
    side = 1.0 if obs.threat_side >= 0.0 else -1.0
    action.linear = -side * ahead


def make_reset(delay: float, spread: float, patience: float) -> Any:
    """A function that fills a fresh mind: seeing `delay` s late, aiming `spread` rad wide, patient for so many s."""

    def fill(mind: FsmMind, seed: int) -> None:
        mind.senses.delay, mind.spread, mind.patience = delay, spread, round(patience * HZ)
        mind.random, mind.target, mind.weave, mind.dodges = seeded(seed), -1, 1.0, 1

    return fill


EASY = BrainKind("easy", FsmMind, think, make_reset(delay=0.42, spread=0.14, patience=4.0))
NORMAL = BrainKind("normal", FsmMind, think, make_reset(delay=0.24, spread=0.09, patience=2.5))
HARD = BrainKind("hard", FsmMind, think, make_reset(delay=0.12, spread=0.045, patience=1.5))
FSM = BrainKind("fsm", FsmMind, think, make_reset(delay=0.24, spread=0.09, patience=2.5))
