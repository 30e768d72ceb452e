"""`fsm`, the cautious robot of the lobby: a state machine for PiTanks after the idea of the thesis.

Winning or level it defends: it takes cover behind the nearest inner wall, waits, and fires at opponents in sight.
Losing it attacks: it closes in round the walls, aims and fires. Two additions to the original: it backs out when stuck,
and it leaves cover after a long wait in a level match, since two of them would otherwise wait for ever.
"""

from math import pi
from typing import Any

from pigaming_app.ai.brain.kind import BrainKind, NoWeights
from pigaming_app.ai.brain.steering import approach, turn_stick
from pigaming_app.ai.brain.unstick import STUCK_DISTANCE, choose_escape, escape, ticks_stuck
from pigaming_app.games.pitanks.observation import OTHERS, PiTanksObservation, PiTanksOther, PiTanksSenses, observe
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.action import set_action
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import bell, seeded, uniform
from pigaming_app.sim.world import DT, HZ, RADIUS, Action

PERIOD = 5  # ticks between decisions: 10 Hz, one seat after the other
ENGAGE = 420.0  # px; within this range an attacker stops closing in
CROWD = 230.0  # px; within this range it backs off
REACH = 760.0  # px; within this range an attacker fires
SWERVE = 0.9  # rad off the opponent's bearing while reloading
ARRIVED = 26.0  # px from the goal that count as arrived
STUCK_TICKS = 30  # ticks of driving without moving that count as stuck
NEW_AIM = 25  # ticks between draws of the aiming error

DEFEND, ATTACK, BREAK_FREE = range(3)


@record
class TankMind:
    """What both tank brains remember."""

    senses: PiTanksSenses
    obs: PiTanksObservation
    spread: float  # standard deviation of the aiming error, rad
    random: int
    state: int
    since: int  # ticks in this state
    unseen: int  # ticks since the target was last in sight
    seen: int  # ticks for which the target has been in sight
    target: int  # index into `obs.others`; -1: none
    bias: float  # present aiming error, rad
    bias_left: int  # ticks until the next draw
    weave: float  # in a duel: forward stick, or side to which it swings; 1 or -1
    anchor_x: float  # position at the last progress, px
    anchor_y: float
    stuck_ticks: int  # ticks since then
    escape: float  # forward stick while backing out
    escape_turn: float
    radius: float = RADIUS  # px, of robots


@record
class FsmMind(TankMind):
    """Memory of the machine."""

    patience: int  # ticks without sight of an opponent in a level match after which it leaves cover
    dodges: int  # 1: it dodges bullets
    on_target: int  # ticks for which the gun has pointed at the target


@kernel
def think(match: PiTanks, seat: int, mind: FsmMind, weights: NoWeights) -> None:
    """Observe and decide every PERIOD ticks; the action holds in between."""
    if (match.tick + seat) % PERIOD:
        return
    mind.radius = match.radius
    observe(match, seat, mind.senses, mind.obs)
    act(mind.obs, mind, match.actions[seat])


@kernel
def act(obs: PiTanksObservation, mind: FsmMind, action: Action) -> None:
    """One step of the machine: update memory, run the state, change state if it returns another one."""
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
def defend(obs: PiTanksObservation, mind: FsmMind, action: Action) -> int:
    """Take cover and wait; fire at an opponent in sight."""
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
def attack(obs: PiTanksObservation, mind: FsmMind, action: Action) -> int:
    """Close in on the target round the walls, aim and fire."""
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
def break_free(obs: PiTanksObservation, mind: FsmMind, action: Action) -> int:
    """Back out with a turn until the robot is free."""
    if not escape(mind, obs.x, obs.y, action):
        return BREAK_FREE
    return DEFEND if obs.lead >= 0 else ATTACK


# ------------------------------------------------------------------------------------------------------------- helpers


@kernel
def pick_target(obs: PiTanksObservation, mind: FsmMind) -> None:
    """Target the nearest opponent, with bonuses for one in sight and for the present target."""
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
def draw_error(mind: TankMind) -> None:
    """Draw a new aiming error and weave every NEW_AIM ticks."""
    mind.bias_left -= PERIOD
    if mind.bias_left <= 0:
        mind.bias_left = NEW_AIM
        mind.bias = 2.0 * mind.spread * bell(mind)
        mind.weave = 1.0 if uniform(mind) < 0.5 else -1.0


@kernel
def detect_stuck(obs: PiTanksObservation, mind: TankMind, action: Action) -> None:
    """Enter BREAK_FREE if the robot drives without moving for STUCK_TICKS."""
    if mind.state == BREAK_FREE:
        return
    idle = action.linear == 0.0
    if ticks_stuck(mind, obs.x, obs.y, idle, STUCK_DISTANCE, PERIOD) > STUCK_TICKS:
        mind.state, mind.since = BREAK_FREE, 0
        choose_escape(mind, -1.0 if action.linear > 0.0 else 1.0, 0.75)


@kernel
def go_to(mind: TankMind, x: float, y: float) -> None:
    """Set the goal of the route; the next observation brings the route itself."""
    route = mind.senses.route
    route.active, route.goal_x, route.goal_y = 1, x, y


@kernel
def follow(obs: PiTanksObservation, mind: FsmMind, action: Action) -> None:
    """Follow the route; fire if the gun happens to point at the target."""
    bearing, speed = approach(obs.waypoint_bearing, obs.waypoint_distance)
    near = obs.goal_distance / 70.0
    if obs.straight and near < 1.0:
        speed *= 0.3 + 0.7 * near
    dash = 1 if obs.goal_distance > 300.0 and obs.turbo > 0.5 and abs(bearing) < 0.3 else 0
    set_action(action, speed, turn_stick(bearing, obs.angular, obs.turn_rate, PERIOD), snap_shot(obs, mind), dash)


@kernel
def shoot(obs: PiTanksObservation, mind: FsmMind, action: Action, speed: float) -> None:
    """Turn the gun to the target's lead angle, driving at `speed`, and fire once it is on target."""
    aim = obs.others[mind.target].aim + mind.bias
    set_action(action, speed, turn_stick(aim, obs.angular, obs.turn_rate, PERIOD), snap_shot(obs, mind), 0)


@kernel
def snap_shot(obs: PiTanksObservation, mind: FsmMind) -> int:
    """1 if the gun points at the target and the reaction time is over, or if a mine can be laid at a distance."""
    if mind.target < 0:
        return 0
    other = obs.others[mind.target]
    if obs.mine and other.distance > 150.0:
        return 1
    if not mind.seen or mind.seen * DT < mind.senses.delay or not obs.loaded or other.protected > 20:
        return 0
    if abs(other.aim + mind.bias) > 0.7 * mind.radius / (other.distance + 1.0) + 0.02:
        mind.on_target = 0
        return 0
    mind.on_target += PERIOD
    if mind.on_target * DT < mind.senses.delay:  # firing takes the reaction time as well
        return 0
    mind.on_target = 0
    return 1


@kernel
def duel(obs: PiTanksObservation, mind: FsmMind, action: Action, other: PiTanksOther) -> None:
    """Aim and fire while the gun is loaded; swerve while it reloads."""
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
def dodge(obs: PiTanksObservation, action: Action) -> None:
    """Drive across the path of a bullet, to the nearer side, if that can still succeed."""
    if obs.threat > 0.7:
        return
    across = turn_to(obs.threat_bearing + 0.5 * pi)  # perpendicular to the path; the bullet's right is across - pi
    ahead = 1.0 if abs(across) < 0.5 * pi else -1.0
    lean = abs(abs(across) - 0.5 * pi)  # pi/2: the robot is perpendicular to the path; 0: along it
    if lean < 0.5:
        return
    side = 1.0 if obs.threat_side >= 0.0 else -1.0
    action.linear = -side * ahead


def make_reset(delay: float, spread: float, patience: float) -> Any:
    """A `reset` for a strength: reaction time `delay` (s), aiming error `spread` (rad, s.d.), `patience` (s)."""

    def fill(mind: FsmMind, seed: int) -> None:
        mind.senses.delay, mind.spread, mind.patience = delay, spread, round(patience * HZ)
        mind.random, mind.target, mind.weave, mind.dodges = seeded(seed), -1, 1.0, 1

    return fill


HAND1 = BrainKind("hand1", FsmMind, think, make_reset(delay=0.42, spread=0.14, patience=4.0))
HAND2 = BrainKind("hand2", FsmMind, think, make_reset(delay=0.24, spread=0.09, patience=2.5))
HAND3 = BrainKind("hand3", FsmMind, think, make_reset(delay=0.12, spread=0.045, patience=1.5))
FSM = BrainKind("fsm", FsmMind, think, make_reset(delay=0.24, spread=0.09, patience=2.5))
