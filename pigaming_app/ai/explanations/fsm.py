"""Explanation of `fsm`: its state, the utility of each behaviour and the direction it drives in.

All values come from the machine's memory, its last observation and its own functions; nothing is decided twice.
"""

from collections.abc import Iterator
from math import cos, pi, sin

from pigaming_app.ai.brain.kind import NoWeights
from pigaming_app.ai.brain.thoughts import BULLET, GOAL, OPPONENT, PRIZE, WAY, Percept, Thoughts, blend, clamp, towards
from pigaming_app.ai.pitanks import fsm
from pigaming_app.games.pitanks.observation import PiTanksObservation
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.world import DT, ROBOTS, Action

SOON = 1.4  # s to a hit at which a bullet is displayed; at half of that it dodges
UNTOUCHED = 9.0  # sentinel outside the stick's range
DETOUR = 320.0  # px; pickups farther away have utility 0


def explain(match: PiTanks, seat: int, mind: fsm.FsmMind, weights: NoWeights) -> Thoughts:
    """Thoughts of the machine on `seat`."""
    obs = mind.obs
    if not obs.turn_rate:
        return Thoughts("starts")
    behaviour = _behaviour(obs, mind)
    player = (seat + 1 + mind.target) % ROBOTS + 1
    utilities = {
        "cover": _cover(obs, mind),
        "attack": 1.0 - _cover(obs, mind),
        "fire": _fire(obs, mind, match.radius),
        "dodge": clamp(2.0 - 2.0 * obs.threat / SOON) if mind.dodges else 0.0,
        "free": 1.0 if mind.state == fsm.BREAK_FREE else clamp(mind.stuck_ticks / fsm.STUCK_TICKS),
    }
    if match.rules.pickups:
        utilities["collect"] = clamp(1.0 - obs.prize_distance / DETOUR) if obs.prize else 0.0
    return Thoughts(
        behaviour=behaviour,
        reason=_reason(obs, mind, behaviour),
        names={"player": player},
        facts=_facts(obs, mind),
        percepts=tuple(percepts(match, obs, mind, behaviour)),
        rose=_rose(obs, mind, behaviour),
        utilities=utilities,
        chosen=CHOSEN.get(behaviour, "cover" if mind.state == fsm.DEFEND else "attack"),
    )


CHOSEN = {"free": "free", "dodge": "dodge", "duel": "fire", "collect": "collect"}


def _behaviour(obs: PiTanksObservation, mind: fsm.FsmMind) -> str:
    """Text key of the present behaviour."""
    if mind.state == fsm.BREAK_FREE:
        return "free"
    if mind.dodges and dodges(obs):
        return "dodge"
    if mind.target < 0:
        return "idle"
    other, route = obs.others[mind.target], mind.senses.route
    waits = mind.state == fsm.DEFEND and obs.goal_distance <= fsm.ARRIVED
    if mind.seen and (other.distance < fsm.CROWD or waits if mind.state == fsm.DEFEND else other.distance < fsm.REACH):
        return "duel"
    if obs.prize and (route.goal_x, route.goal_y) == (obs.prize_x, obs.prize_y):
        return "collect"
    if mind.state == fsm.ATTACK:
        return "hunt"
    return "wait" if waits else "cover"


def dodges(obs: PiTanksObservation) -> bool:
    """True if `fsm.dodge` would override the stick."""
    action = Action()
    action.linear = UNTOUCHED
    fsm.dodge(obs, action)
    return action.linear != UNTOUCHED


def _reason(obs: PiTanksObservation, mind: fsm.FsmMind, behaviour: str) -> str:
    if behaviour in ("free", "dodge", "collect", "idle"):
        return {"free": "stuck", "dodge": "bullet", "collect": "near", "idle": ""}[behaviour]
    if behaviour == "duel":
        return "sees"
    if mind.state == fsm.DEFEND:
        return "ahead" if obs.lead > 0 else "level"
    if obs.lead < 0:
        return "behind"
    return "no_cover" if not obs.cover else "nobody" if mind.unseen > mind.patience else "level"


def _cover(obs: PiTanksObservation, mind: fsm.FsmMind) -> float:
    """Utility of cover; in a level match it falls while no opponent is in sight."""
    if not obs.cover or obs.lead < 0 or mind.target < 0:
        return 0.0
    return 1.0 if obs.lead > 0 else clamp(1.0 - mind.unseen / max(1, mind.patience))


def _fire(obs: PiTanksObservation, mind: fsm.FsmMind, radius: float) -> float:
    """Utility of firing: 1 if the gun points within the target, less the farther it is off."""
    if mind.target < 0 or not mind.seen or not obs.loaded:
        return 0.0
    other = obs.others[mind.target]
    wide = radius / (other.distance + 1.0)
    return clamp(wide / (abs(other.aim + mind.bias) + 1e-9))


def _facts(obs: PiTanksObservation, mind: fsm.FsmMind) -> dict[str, float]:
    return {
        "state": mind.state,
        "lead": obs.lead,
        "target": mind.target,
        "seen": mind.seen * DT,
        "unseen": mind.unseen * DT,
        "patience": mind.patience * DT,
        "loaded": obs.loaded,
        "threat": obs.threat,
        "aim_error": mind.bias,
    }


def percepts(match: PiTanks, obs: PiTanksObservation, mind: fsm.TankMind, behaviour: str) -> Iterator[Percept]:
    """The target, the most urgent bullet, and the route to its goal."""
    if mind.target >= 0:
        other = obs.others[mind.target]
        yield Percept(OPPONENT, other.x, other.y, bool(other.clear))
    if obs.threat < SOON:
        away, angle = obs.threat * match.rules.bullet_speed, obs.heading + obs.threat_bearing
        yield Percept(BULLET, obs.x + away * cos(angle), obs.y + away * sin(angle))
    route = mind.senses.route
    if behaviour in ("hunt", "cover", "collect") and route.active:
        if not obs.straight:
            yield Percept(WAY, obs.waypoint_x, obs.waypoint_y)
        if behaviour != "hunt":
            yield Percept(PRIZE if behaviour == "collect" else GOAL, route.goal_x, route.goal_y, bool(obs.straight))


def _rose(obs: PiTanksObservation, mind: fsm.FsmMind, behaviour: str) -> list[float]:
    """Direction in which it drives or points the gun; repulsion from a bullet."""
    if behaviour == "free":
        wanted = towards(0.0 if mind.escape > 0.0 else pi)
    elif behaviour == "duel" and obs.loaded:
        wanted = towards(obs.others[mind.target].aim + mind.bias)
    elif behaviour in ("idle", "wait"):
        wanted = towards(0.0, 0.0)
    elif behaviour == "duel":
        wanted = towards(obs.others[mind.target].bearing + fsm.SWERVE * mind.weave)
    else:
        wanted = towards(obs.waypoint_bearing)
    return blend(wanted, towards(obs.threat_bearing, -1.0 if obs.threat < SOON else 0.0))
