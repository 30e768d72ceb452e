"""Explanation of `classic`: its state, the opponent in sight and the hiding place."""

from collections.abc import Iterator
from math import atan2, pi

from pigaming_app.ai.brain.kind import NoWeights
from pigaming_app.ai.brain.steering import bearing
from pigaming_app.ai.brain.thoughts import GOAL, OPPONENT, WAY, Percept, Thoughts, clamp, towards
from pigaming_app.ai.pitanks import classic
from pigaming_app.ai.pitanks.classic import ClassicMind
from pigaming_app.ai.qlearning.features import nearest_opponent
from pigaming_app.games.pitanks.scoring import lead
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import Robot


def explain(match: PiTanks, seat: int, mind: ClassicMind, weights: NoWeights) -> Thoughts:
    """Thoughts of the machine on `seat`."""
    opponent = nearest_opponent(match, seat)
    if not mind.route.active or opponent < 0:
        return Thoughts("starts")
    robot, other = match.robots[seat], match.robots[opponent]
    aim = abs(bearing(robot, other.x, other.y))
    away = max(1.0, _away(robot, other.x, other.y))
    shows = bool(classic.shows(match, robot, other, mind))
    ahead, hides = lead(match, seat), mind.state == classic.DEFEND
    behaviour, reason, chosen = _behaviour(robot, mind, shows, ahead)
    return Thoughts(
        behaviour=behaviour,
        reason=reason,
        names={"player": opponent + 1},
        facts={"state": mind.state, "lead": ahead, "distance": away, "shows": shows, "stuck_ticks": mind.stuck_ticks},
        percepts=tuple(_percepts(match, robot, other, mind, behaviour)),
        rose=_rose(robot, other, mind, behaviour),
        utilities={
            "cover": float(hides),
            "attack": float(mind.state == classic.ATTACK),
            "fire": clamp(match.radius / away / (aim + 1e-9)) if shows else 0.0,
            "free": 1.0 if mind.state == classic.BREAK_FREE else clamp(mind.stuck_ticks / classic.STUCK_TICKS),
        },
        chosen=chosen,
    )


def _behaviour(robot: Robot, mind: ClassicMind, shows: bool, ahead: int) -> tuple[str, str, str]:
    """Text keys of the present behaviour and its reason, and the chosen wish."""
    if mind.state == classic.BREAK_FREE:
        return "free", "stuck", "free"
    if shows:
        return "duel", "sees", "fire"
    if mind.state == classic.ATTACK:
        return "hunt", "behind" if ahead < 0 else "no_cover", "attack"
    there = _away(robot, mind.route.goal_x, mind.route.goal_y) <= mind.numbers.arrived
    return "wait" if there else "cover", "ahead" if ahead > 0 else "level", "cover"


def _away(robot: Robot, x: float, y: float) -> float:
    dx, dy = x - robot.x, y - robot.y
    return float((dx * dx + dy * dy) ** 0.5)


def _percepts(match: PiTanks, robot: Robot, other: Robot, mind: ClassicMind, behaviour: str) -> Iterator[Percept]:
    seen = bool(is_clear(match, robot.x, robot.y, other.x, other.y, match.rules.bullet_radius))
    yield Percept(OPPONENT, other.x, other.y, seen)
    route = mind.route
    if behaviour in ("hunt", "cover"):
        if not route.straight:
            yield Percept(WAY, route.waypoint_x, route.waypoint_y)
        if behaviour == "cover":
            yield Percept(GOAL, route.goal_x, route.goal_y)


def _rose(robot: Robot, other: Robot, mind: ClassicMind, behaviour: str) -> list[float]:
    """Direction in which it drives, or points the gun."""
    if behaviour == "free":
        return towards(0.0 if mind.escape > 0.0 else pi)
    if behaviour in ("duel", "wait"):
        return towards(bearing(robot, other.x, other.y))
    route = mind.route
    return towards(atan2(route.waypoint_y - robot.y, route.waypoint_x - robot.x) - robot.heading)
