"""The hand-written opponent of PiTanks in three strengths: it hunts, whatever the score.

It drives round the walls to the most rewarding opponent, fights in sight of it, and fetches pick-ups on the way. In a
fight it points the gun ahead of the target, fires, swings aside while the gun reloads, and turns back in time for the
next shot. It never waits behind a wall.

The strengths differ in reaction time, aiming error, patience and tactics, never in speed. `hand1` errs as a novice
does: it aims at where the target is and not where it will be, slows down to aim, stops to watch each of its shots, and
dodges nothing.
"""

from math import cos, nan, sin, sqrt
from typing import Any

from pigaming_app.ai.brain.kind import BrainKind, NoWeights, Traits
from pigaming_app.ai.brain.steering import approach, turn_stick
from pigaming_app.ai.brain.unstick import escape
from pigaming_app.ai.pitanks.fsm import BREAK_FREE, TankMind, detect_stuck, dodge, draw_error, go_to
from pigaming_app.games.pitanks.observation import (
    OTHERS,
    PiTanksObservation,
    PiTanksOther,
    aim_at_other,
    locate_other,
    observe_self,
    observe_surroundings,
)
from pigaming_app.games.pitanks.state import PiTanks, Tank
from pigaming_app.sim.action import set_action
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import seeded, uniform
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import DT, HEIGHT, HZ, ROBOTS, WIDTH, Action

PERIOD = 5  # ticks between decisions: 10 Hz, one seat after the other
NEAR, FAR = 300.0, 480.0  # px; in a fight it opens the distance within NEAR and closes in beyond FAR
REACH = 700.0  # px; within this range it fights an opponent in sight
LOST = 20  # ticks out of sight after which a fight ends
SWING = 1.3  # rad off the target's bearing at which it swings aside between NEAR and FAR
OPEN_UP, CLOSE_IN = 2.2, 0.6  # rad; the same within NEAR and beyond FAR
STEADY, BACK = 0.4, -0.7  # forward stick while it aims, beyond NEAR and within it
FULL, LOW = 0.6, 0.1  # charge of the meter from which it starts turbo, and below which it stops
ROOM = 150.0  # px that must be clear on the side to which it swings
DETOUR = 340.0  # px; it fetches pick-ups nearer than this
SNATCH = 150.0  # px; it fetches these even in a fight, and in the finale
INVULNERABLE = 20  # ticks of protection left above which a shot is wasted
HIDDEN = 400.0  # px by which an opponent out of sight counts as farther away than it is
WAITING = 4.0  # px for each tick for which it cannot be hit
ROUNDING = 1e-6  # px
EXPOSED = 300.0  # px by which a lit opponent counts as nearer, and for each point of bounty

WATCH, SWING_ASIDE, AIM = range(3)  # parts of a fight
HUNT, FIGHT, COLLECT = 0, 1, 3  # states, with BREAK_FREE of `fsm`, which is 2


@record
class GunnerMind(TankMind):
    """Parameters of a strength, and memory."""

    lead: float  # share of the target's movement that the aim allows for
    watch: int  # ticks for which it watches a shot before it aims again
    swing: int  # ticks for which it swings aside after a shot
    loyalty: float  # px by which its target counts as nearer than other opponents
    mines: int  # 1: lays them
    wait: int  # ticks until the next decision; at random at first, so that no seat is always ahead of another
    shot: int  # ticks since the last shot


@kernel
def think(match: PiTanks, seat: int, mind: GunnerMind, weights: NoWeights) -> None:
    """Observe and decide every PERIOD ticks; the action holds in between."""
    mind.wait -= 1
    if mind.wait > 0:
        return
    mind.wait, mind.radius = PERIOD, match.radius
    observe_self(match, seat, mind.obs)
    choose_target(match, seat, mind)
    observe_surroundings(match, seat, mind.senses, mind.obs)
    act(match, mind.obs, mind, match.actions[seat])


@kernel
def act(match: PiTanks, obs: PiTanksObservation, mind: GunnerMind, action: Action) -> None:
    """One step of the machine: update memory, run the state, change state if it returns another one."""
    mind.since += PERIOD
    mind.shot += PERIOD
    draw_error(mind)
    if obs.knocked_out:
        set_action(action, 0.0, 0.0, 0, 0)
        return
    detect_stuck(obs, mind, action)
    state = mind.state
    if state == HUNT:
        after = hunt(obs, mind, action)
    elif state == FIGHT:
        after = fight(match, obs, mind, action)
    elif state == COLLECT:
        after = collect(obs, mind, action)
    else:
        after = break_free(obs, mind, action)
    if after != state:
        mind.state, mind.since = after, 0
    if after != BREAK_FREE and obs.threat > obs.protected * DT:
        dodge(obs, action)


# ------------------------------------------------------------------------------------------------------------- states


@kernel
def hunt(obs: PiTanksObservation, mind: GunnerMind, action: Action) -> int:
    """Drive to the target round the walls."""
    if mind.target < 0:
        set_action(action, 0.0, 0.0, 0, 0)
        return HUNT
    other = obs.others[mind.target]
    go_to(mind, other.x, other.y)
    follow(obs, mind, action)
    if wants_prize(obs, mind):
        return COLLECT
    return FIGHT if in_fight(obs, mind) else HUNT


@kernel
def collect(obs: PiTanksObservation, mind: GunnerMind, action: Action) -> int:
    """Drive to the nearest pick-up."""
    if mind.target < 0 or not wants_prize(obs, mind):
        return hunt(obs, mind, action)
    go_to(mind, obs.prize_x, obs.prize_y)
    follow(obs, mind, action)
    return COLLECT


@kernel
def fight(match: PiTanks, obs: PiTanksObservation, mind: GunnerMind, action: Action) -> int:
    """Aim and fire; swing aside while the gun reloads."""
    if mind.target < 0 or mind.unseen > LOST or obs.others[mind.target].distance > REACH:
        return hunt(obs, mind, action)
    other = obs.others[mind.target]
    mind.senses.route.active = 0
    phase = rhythm(obs, mind, other)
    if phase == WATCH:
        set_action(action, STEADY, 0.0, 0, 0)
    elif phase == SWING_ASIDE:
        choose_side(match, obs, mind, other)
        aside = turn_to(other.bearing + swing_angle(other) * mind.weave)
        dash = 1 if other.distance < NEAR and charged(obs, action) else 0
        set_action(action, 1.0, turn_stick(aside, obs.angular, obs.turn_rate, PERIOD), 0, dash)
    else:
        speed = STEADY if other.distance > NEAR else BACK
        turn = turn_stick(aim(mind, other), obs.angular, obs.turn_rate, PERIOD)
        set_action(action, speed, turn, pull_trigger(obs, mind), 0)
    return COLLECT if wants_prize(obs, mind) else FIGHT


@kernel
def break_free(obs: PiTanksObservation, mind: GunnerMind, action: Action) -> int:
    """Back out with a turn until the robot is free."""
    return HUNT if escape(mind, obs.x, obs.y, action) else BREAK_FREE


# ------------------------------------------------------------------------------------------------------------- helpers


@kernel
def choose_target(match: PiTanks, seat: int, mind: GunnerMind) -> None:
    """Choose the most rewarding opponent, observe it, and count for how long it has been in sight.

    The present target comes first, since it mostly stays the best: of the others no more is observed than it takes to
    show that they are not better.
    """
    robot, delay = match.robots[seat], mind.senses.delay
    best, least, vx, vy = -1, 1e9, 0.0, 0.0
    for n in range(OTHERS):
        i = (mind.target + n) % OTHERS
        j, other = (seat + 1 + i) % ROBOTS, mind.obs.others[i]
        seen = match.robots[j]
        if not seen.present or seen.team == robot.team:
            continue
        dx, dy, tank = seen.x - robot.x, seen.y - robot.y, match.tanks[j]
        nearest = sqrt(dx * dx + dy * dy) - delay * abs(seen.linear) - ROUNDING  # at most the distance observed
        if i != mind.target and price(nearest, tank) > least:
            continue
        other_vx, other_vy = locate_other(robot, seen, delay, other)
        cost, bonus = price(other.distance, tank), mind.loyalty if i == mind.target else 0.0
        if not is_better(cost - bonus, i, least, best):
            continue
        other.clear = is_clear(match, robot.x, robot.y, seen.x, seen.y, match.rules.bullet_radius)
        if not other.clear:
            cost += HIDDEN
        if is_better(cost - bonus, i, least, best):
            best, least, vx, vy = i, cost - bonus, other_vx, other_vy
    if best != mind.target:
        mind.target, mind.seen = best, 0
    if best < 0:
        mind.seen = 0
        mind.unseen += PERIOD
        return
    other, tank = mind.obs.others[best], match.tanks[(seat + 1 + best) % ROBOTS]
    other.protected, other.lit, other.bounty = tank.protected, tank.lit, tank.bounty
    if other.clear or mind.state == FIGHT:  # else nothing points at it
        aim_at_other(match, robot, vx, vy, delay, other)
    if other.clear:
        mind.seen += PERIOD
        if mind.seen * DT >= delay:  # noticed
            mind.unseen = 0
    else:
        mind.seen = 0
        mind.unseen += PERIOD


@kernel
def is_better(cost: float, i: int, least: float, best: int) -> bool:
    """True if opponent `i` costs less than the best so far; of equal ones the first is better."""
    return cost < least or (cost == least and i < best)


@kernel
def price(distance: float, tank: Tank) -> float:
    """Cost of an opponent in sight as a target: its distance in px, less what makes it rewarding."""
    return distance + WAITING * tank.protected - EXPOSED * (tank.lit + tank.bounty)


@kernel
def in_fight(obs: PiTanksObservation, mind: GunnerMind) -> int:
    """1 if the target has been noticed within REACH."""
    if mind.unseen or obs.others[mind.target].distance > REACH:
        return 0
    return 1


@kernel
def wants_prize(obs: PiTanksObservation, mind: GunnerMind) -> int:
    """1 if the nearest pick-up is worth the way; in the finale only if it is very near."""
    if not obs.prize or obs.prize_distance > DETOUR:
        return 0
    if obs.prize_distance < SNATCH:
        return 1
    return 0 if obs.finale or in_fight(obs, mind) or obs.prize_distance > obs.others[mind.target].distance else 1


@kernel
def follow(obs: PiTanksObservation, mind: GunnerMind, action: Action) -> None:
    """Follow the route; fire if the gun happens to point at the target."""
    bearing, speed = approach(obs.waypoint_bearing, obs.waypoint_distance)
    dash = 1 if obs.goal_distance > 300.0 and abs(bearing) < 0.3 and charged(obs, action) else 0
    set_action(action, speed, turn_stick(bearing, obs.angular, obs.turn_rate, PERIOD), pull_trigger(obs, mind), dash)


@kernel
def charged(obs: PiTanksObservation, action: Action) -> int:
    """1 if the meter is full enough to start turbo, or to keep it on."""
    return 1 if obs.turbo > (LOW if action.turbo else FULL) else 0


@kernel
def aim(mind: GunnerMind, other: PiTanksOther) -> float:
    """Bearing to point the gun at: between the target and where a bullet would meet it, with the present error."""
    return float(other.bearing + mind.lead * turn_to(other.aim - other.bearing) + mind.bias)


@kernel
def pull_trigger(obs: PiTanksObservation, mind: GunnerMind) -> int:
    """1 if the gun points at a target that can be hit, or if a mine can be laid at a distance."""
    other = obs.others[mind.target]
    if obs.mine and mind.mines and other.distance > 150.0:
        return 1
    if not can_hit(obs, mind) or abs(aim(mind, other)) > 0.7 * mind.radius / (other.distance + 1.0) + 0.02:
        return 0
    mind.shot = 0
    mind.weave = 1.0 if uniform(mind) < 0.5 else -1.0
    return 1


@kernel
def rhythm(obs: PiTanksObservation, mind: GunnerMind, other: PiTanksOther) -> int:
    """Part of a fight: it watches its last shot, swings aside, aims. In the finale it takes half the time for it."""
    pace = 2 if obs.finale or obs.overtime else 1
    if pace * mind.shot < mind.watch:
        return WATCH
    return SWING_ASIDE if pace * mind.shot < mind.watch + mind.swing or other.protected > INVULNERABLE else AIM


@kernel
def swing_angle(other: PiTanksOther) -> float:
    """Angle off the target's bearing at which it swings aside, rad."""
    if other.distance < NEAR:
        return OPEN_UP
    return CLOSE_IN if other.distance > FAR else SWING


@kernel
def can_hit(obs: PiTanksObservation, mind: GunnerMind) -> int:
    """1 if the gun is loaded and the target noticed, in sight and not protected."""
    other = obs.others[mind.target]
    if not obs.loaded or not other.clear or other.protected > INVULNERABLE:
        return 0
    return 1 if mind.seen * DT >= mind.senses.delay else 0


@kernel
def choose_side(match: PiTanks, obs: PiTanksObservation, mind: GunnerMind, other: PiTanksOther) -> None:
    """Swing to the other side if a wall is in the way and there is room on that one."""
    angle = obs.heading + other.bearing
    turn = swing_angle(other) * mind.weave
    if not has_room(match, obs, angle + turn) and has_room(match, obs, angle - turn):
        mind.weave = -mind.weave


@kernel
def has_room(match: PiTanks, obs: PiTanksObservation, direction: float) -> int:
    """1 if the robot can drive ROOM px in a direction."""
    x, y = obs.x + ROOM * cos(direction), obs.y + ROOM * sin(direction)
    if not (match.radius < x < WIDTH - match.radius and match.radius < y < HEIGHT - match.radius):
        return 0
    return is_clear(match, obs.x, obs.y, x, y, match.radius)


def make_reset(
    delay: float, spread: float, lead: float, watch: float, swing: float, loyalty: float, mines: int = 1
) -> Any:
    """A `reset` for a strength: times in s, the rest as in the mind."""

    def fill(mind: GunnerMind, seed: int) -> None:
        mind.senses.delay, mind.spread, mind.lead, mind.loyalty = delay, spread, lead, loyalty
        mind.mines = mines
        mind.senses.cover = 0
        mind.watch, mind.swing = round(watch * HZ), round(swing * HZ)
        mind.random, mind.target, mind.shot, mind.weave = seeded(seed), -1, 10 * HZ, 1.0
        mind.wait = 1 + int(uniform(mind) * PERIOD)

    return fill


def person(traits: Traits) -> BrainKind:
    """What a person sees and wants: who knows the game watches its shots less and changes the target sooner."""
    novice = 1.0 - traits.tactics
    reset = make_reset(
        delay=traits.reaction,
        spread=traits.aim,
        lead=traits.prediction,
        watch=0.8 * novice,
        swing=1.2,
        loyalty=100.0 + 250.0 * novice,
        mines=int(traits.turbo),
    )
    return BrainKind("person", GunnerMind, think, reset)


@kernel
def recall(mind: GunnerMind, since: int) -> None:
    """Take the last shot for `since` ticks ago."""
    mind.shot = since


@kernel
def sight(mind: GunnerMind) -> tuple[float, float]:
    """Directions to the target and to where a bullet would meet it, rad; NaN without a target in sight."""
    if mind.target < 0 or not mind.obs.others[mind.target].clear:
        return nan, nan
    other = mind.obs.others[mind.target]
    return float(mind.obs.heading + other.bearing), float(mind.obs.heading + other.aim)


HAND1 = BrainKind("hand1", GunnerMind, think, make_reset(0.40, 0.14, 0.2, 0.8, 1.1, 350.0))
HAND2 = BrainKind("hand2", GunnerMind, think, make_reset(0.27, 0.13, 0.8, 0.0, 1.5, 150.0))
HAND3 = BrainKind("hand3", GunnerMind, think, make_reset(0.10, 0.05, 1.0, 0.0, 1.2, 100.0))
