"""Explanation of `hand1` to `hand3`: what each does now, why, and the utility of each behaviour.

All values come from the machine's memory, its last observation and its own functions; nothing is decided twice.
"""

from math import pi

from pigaming_app.ai.brain.kind import NoWeights
from pigaming_app.ai.brain.thoughts import Thoughts, blend, clamp, towards
from pigaming_app.ai.explanations.fsm import SOON, dodges, percepts
from pigaming_app.ai.pitanks import fsm, gunner
from pigaming_app.ai.pitanks.gunner import GunnerMind
from pigaming_app.games.pitanks.observation import PiTanksObservation
from pigaming_app.games.pitanks.scoring import lead
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.world import DT, ROBOTS

PARTS = {gunner.WATCH: "watch", gunner.SWING_ASIDE: "swing", gunner.AIM: "duel"}
CHOSEN = {"hunt": "attack", "duel": "fire", "watch": "wait", "out": "", "idle": ""}  # others: named as the behaviour


def explain(match: PiTanks, seat: int, mind: GunnerMind, weights: NoWeights) -> Thoughts:
    """Thoughts of the machine on `seat`."""
    obs = mind.obs
    if not obs.turn_rate:
        return Thoughts("starts")
    behaviour = _behaviour(obs, mind)
    return Thoughts(
        behaviour=behaviour,
        reason=_reason(obs, mind, behaviour),
        names={"player": (seat + 1 + mind.target) % ROBOTS + 1},
        facts=_facts(match, seat, mind),
        percepts=tuple(percepts(match, obs, mind, behaviour)),
        rose=_rose(obs, mind, behaviour),
        utilities=_utilities(match, obs, mind),
        chosen=CHOSEN.get(behaviour, behaviour),
    )


def _behaviour(obs: PiTanksObservation, mind: GunnerMind) -> str:
    """Text key of the present behaviour."""
    if obs.knocked_out:
        return "out"
    if mind.state == fsm.BREAK_FREE:
        return "free"
    if obs.threat > obs.protected * DT and dodges(obs):
        return "dodge"
    if mind.target < 0:
        return "idle"
    if mind.state == gunner.COLLECT and obs.prize:
        return "collect"
    if mind.state == gunner.FIGHT:
        return PARTS[gunner.rhythm(obs, mind, obs.others[mind.target])]
    return "hunt"


def _reason(obs: PiTanksObservation, mind: GunnerMind, behaviour: str) -> str:
    """Text key of the reason."""
    fixed = {"out": "hit", "free": "stuck", "dodge": "bullet", "collect": "near", "watch": "wonders", "idle": ""}
    if behaviour in fixed:
        return fixed[behaviour]
    other = obs.others[mind.target]
    if behaviour == "swing":
        return "immune" if other.protected > gunner.INVULNERABLE else "reloads"
    if obs.overtime:
        return "overtime"
    if other.bounty:
        return "bounty"
    if other.lit:
        return "lit"
    if obs.finale:
        return "finale"
    return "sees" if behaviour == "duel" else "nearest"


def _utilities(match: PiTanks, obs: PiTanksObservation, mind: GunnerMind) -> dict[str, float]:
    """Utility of each behaviour; `wait` only for a strength that watches its shots."""
    attack = fire = swing = wait = 0.0
    if mind.target >= 0:
        other = obs.others[mind.target]
        attack = 1.0 if not gunner.in_fight(obs, mind) else clamp(other.distance / gunner.REACH)
        if gunner.can_hit(obs, mind):
            fire = clamp(match.radius / (other.distance + 1.0) / (abs(gunner.aim(mind, other)) + 1e-9))
        part = gunner.rhythm(obs, mind, other)
        wait, swing = float(part == gunner.WATCH), float(part == gunner.SWING_ASIDE)
    utilities = {
        "attack": attack,
        "fire": fire,
        "swing": swing,
        "dodge": clamp(2.0 - 2.0 * obs.threat / SOON),
        "free": 1.0 if mind.state == fsm.BREAK_FREE else clamp(mind.stuck_ticks / fsm.STUCK_TICKS),
    }
    if mind.watch:
        utilities["wait"] = wait
    if match.rules.pickups:
        utilities["collect"] = clamp(1.0 - obs.prize_distance / gunner.DETOUR) if obs.prize else 0.0
    return utilities


def _facts(match: PiTanks, seat: int, mind: GunnerMind) -> dict[str, float]:
    obs = mind.obs
    return {
        "state": mind.state,
        "lead": lead(match, seat),
        "target": mind.target,
        "seen": mind.seen * DT,
        "unseen": mind.unseen * DT,
        "since_shot": mind.shot * DT,
        "loaded": obs.loaded,
        "threat": obs.threat,
        "aim_error": mind.bias,
    }


def _rose(obs: PiTanksObservation, mind: GunnerMind, behaviour: str) -> list[float]:
    """Direction in which it drives or points the gun; repulsion from a bullet."""
    if behaviour == "free":
        wanted = towards(0.0 if mind.escape > 0.0 else pi)
    elif behaviour in ("idle", "out", "watch"):
        wanted = towards(0.0, 0.0)
    elif behaviour == "duel":
        wanted = towards(gunner.aim(mind, obs.others[mind.target]))
    elif behaviour == "swing":
        other = obs.others[mind.target]
        wanted = towards(other.bearing + gunner.swing_angle(other) * mind.weave)
    else:
        wanted = towards(obs.waypoint_bearing)
    return blend(wanted, towards(obs.threat_bearing, -1.0 if obs.threat < SOON else 0.0))
