"""What the hand-written driver of Robot Race has on its mind: its line, whoever is in the way, and how fast it dares.

Nothing is thought twice: numbers come from its memory and its last observation, reckonings from the driver itself.
"""

from collections.abc import Iterator
from math import atan2, pi
from typing import Any

from pigaming_app.ai.brain.thoughts import GOAL, OPPONENT, Percept, Thoughts, blend, clamp, towards
from pigaming_app.ai.race import racer
from pigaming_app.ai.race.overtaking import CLEAR, EDGE, FAR, blocked, held_to
from pigaming_app.games.race.observation import OTHERS
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.world import ROBOTS

CHANGED = 25.0  # px off its own line from which on it is on another lane
SLOW = 0.93  # of full speed: below that it brakes
TROUBLE = 150.0  # px that a lane costs which nobody wants any more
NEAR = 200.0  # px from which on another robot is on its mind

CHOSEN = {
    "free": "free", "return": "back", "done": "brake", "follow": "brake", "bend": "brake", "boost": "turbo",
    "mud": "line", "race": "line",
}  # fmt: skip
BECAUSE = {
    "free": "stuck", "return": "missed", "done": "finish", "pass_left": "in_way", "pass_right": "in_way",
    "follow": "no_room", "bend": "bend", "boost": "straight", "mud": "mud",
}  # fmt: skip


def explain(match: Any, seat: int, mind: Any, weights: Any) -> Thoughts:
    """The thoughts of the driver on `seat`."""
    obs = mind.obs
    if not obs.turn_rate:
        return Thoughts("starts")
    x, y = _goal(obs, mind)
    doing, first = _doing(obs, mind), _ahead(obs)
    line = "line" if mind.line > 0.5 else "middle"
    return Thoughts(
        doing=doing,
        because=BECAUSE.get(doing, line),
        names={"player": (seat + 1 + first) % ROBOTS + 1},
        facts=_facts(obs, mind),
        sights=tuple(_sights(obs, first, x, y)),
        rose=_rose(obs, mind, x, y),
        wishes=_wishes(obs, mind),
        chosen=CHOSEN.get(doing, doing.removeprefix("pass_")),
    )


def _doing(obs: Any, mind: Any) -> str:
    """What it is about, as a key of the texts."""
    aside = mind.lane - mind.line * obs.ahead.ideal
    if obs.finished:  # what it still does no longer moves it
        return "done"
    if mind.state == racer.BREAK_FREE:
        return "free"
    if mind.state == racer.GO_BACK or obs.past > racer.SLACK:
        return "return"
    if abs(aside) > CHANGED:
        return "pass_left" if aside < 0.0 else "pass_right"
    if held_to(obs, mind) < 1.0:
        return "follow"
    if not obs.on:
        return "mud"
    if obs.boosting:
        return "boost"
    return "bend" if obs.pace < SLOW else "race"


def _wishes(obs: Any, mind: Any) -> dict[str, float]:
    """Lanes: another one the more, the more its own is in others' way. Speed: what the bend and others leave of it."""
    mark = obs.ahead
    room, own = mark.half - EDGE, mind.line * mark.ideal
    costs = blocked(obs, mind, own)
    sides = [blocked(obs, mind, min(room, max(-room, own + side * CLEAR))) for side in (-1.0, 1.0)]
    left, right = (clamp(costs / TROUBLE) * clamp(1.0 - side / TROUBLE) for side in sides)
    may = obs.on and obs.pace >= 1.0
    return {
        "left": left,
        "line": clamp(1.0 - costs / TROUBLE),
        "right": right,
        "brake": clamp(1.0 - min(obs.pace, held_to(obs, mind), 1.0)),
        "turbo": 1.0 if obs.boosting else clamp(obs.turbo / max(0.1, mind.boost)) if may else 0.0,
        "back": 1.0 if mind.state == racer.GO_BACK else clamp(obs.past / racer.SLACK),
        "free": 1.0 if mind.state == racer.BREAK_FREE else clamp(mind.held_up / racer.HELD_UP_TICKS),
    }


def _goal(obs: Any, mind: Any) -> tuple[float, float]:
    """The point that it drives for, arena px."""
    if mind.state == racer.GO_BACK or obs.past > racer.SLACK:
        return obs.return_x, obs.return_y
    mark = obs.ahead
    room = mark.half - EDGE
    aside = min(room, max(-room, mind.lane + mind.stray)) - mark.ideal
    return mark.x + aside * mark.right_x, mark.y + aside * mark.right_y


def _ahead(obs: Any) -> int:
    """The nearest robot before it, else beside it, that matters; -1: none."""
    near = [i for i in range(OTHERS) if obs.others[i].present and -CLEAR < obs.others[i].ahead < FAR]
    return min(near, key=lambda i: (obs.others[i].ahead <= 0.0, obs.others[i].distance), default=-1)


def _facts(obs: Any, mind: Any) -> dict[str, float]:
    return {
        "state": mind.state,
        "place": obs.rank,
        "past_line": obs.past,
        "lane": mind.lane,
        "error": mind.stray,
        "pace": obs.pace,
        "held_to": held_to(obs, mind),
        "turbo": obs.turbo,
        "on_course": obs.on,
    }


def _sights(obs: Any, first: int, x: float, y: float) -> Iterator[Percept]:
    if first >= 0:
        yield Percept(OPPONENT, obs.others[first].x, obs.others[first].y)
    yield Percept(GOAL, x, y)


def _rose(obs: Any, mind: Any, x: float, y: float) -> list[float]:
    """To where it drives; away from those who are close."""
    if mind.state == racer.BREAK_FREE:
        return towards(0.0 if mind.escape > 0.0 else pi)
    wanted = towards(turn_to(atan2(y - obs.y, x - obs.x) - obs.heading))
    close = [one for one in obs.others if one.present and one.distance < NEAR]
    return blend(wanted, *(towards(one.bearing, -clamp(1.5 - 1.5 * one.distance / NEAR)) for one in close))
