"""What the hand-written driver of Robot Race has on its mind: its line, whoever is in the way, and how fast it dares.

Nothing is thought twice: numbers come from its memory and its last view, reckonings from the driver itself.
"""

from collections.abc import Iterator
from math import atan2, pi
from typing import Any

from pigaming_app.ai.brain.thoughts import GOAL, OPPONENT, Sight, Thoughts, blend, clamp, towards
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


def explain(match: Any, seat: int, mind: Any, known: Any) -> Thoughts:
    """The thoughts of the driver on `seat`."""
    view = mind.sight
    if not view.turn_rate:
        return Thoughts("starts")
    x, y = _goal(view, mind)
    doing, first = _doing(view, mind), _ahead(view)
    line = "line" if mind.line > 0.5 else "middle"
    return Thoughts(
        doing=doing,
        because=BECAUSE.get(doing, line),
        names={"player": (seat + 1 + first) % ROBOTS + 1},
        facts=_facts(view, mind),
        sights=tuple(_sights(view, first, x, y)),
        rose=_rose(view, mind, x, y),
        wishes=_wishes(view, mind),
        chosen=CHOSEN.get(doing, doing.removeprefix("pass_")),
    )


def _doing(view: Any, mind: Any) -> str:
    """What it is about, as a key of the texts."""
    aside = mind.lane - mind.line * view.ahead.ideal
    if view.finished:  # what it still does no longer moves it
        return "done"
    if mind.state == racer.BREAK_FREE:
        return "free"
    if mind.state == racer.GO_BACK or view.past > racer.SLACK:
        return "return"
    if abs(aside) > CHANGED:
        return "pass_left" if aside < 0.0 else "pass_right"
    if held_to(view, mind) < 1.0:
        return "follow"
    if not view.on:
        return "mud"
    if view.boosting:
        return "boost"
    return "bend" if view.pace < SLOW else "race"


def _wishes(view: Any, mind: Any) -> dict[str, float]:
    """Lanes: another one the more, the more its own is in others' way. Speed: what the bend and others leave of it."""
    mark = view.ahead
    room, own = mark.half - EDGE, mind.line * mark.ideal
    costs = blocked(view, mind, own)
    sides = [blocked(view, mind, min(room, max(-room, own + side * CLEAR))) for side in (-1.0, 1.0)]
    left, right = (clamp(costs / TROUBLE) * clamp(1.0 - side / TROUBLE) for side in sides)
    may = view.on and view.pace >= 1.0
    return {
        "left": left,
        "line": clamp(1.0 - costs / TROUBLE),
        "right": right,
        "brake": clamp(1.0 - min(view.pace, held_to(view, mind), 1.0)),
        "turbo": 1.0 if view.boosting else clamp(view.turbo / max(0.1, mind.boost)) if may else 0.0,
        "back": 1.0 if mind.state == racer.GO_BACK else clamp(view.past / racer.SLACK),
        "free": 1.0 if mind.state == racer.BREAK_FREE else clamp(mind.held_up / racer.HELD_UP_TICKS),
    }


def _goal(view: Any, mind: Any) -> tuple[float, float]:
    """The point that it drives for, arena px."""
    if mind.state == racer.GO_BACK or view.past > racer.SLACK:
        return view.return_x, view.return_y
    mark = view.ahead
    room = mark.half - EDGE
    aside = min(room, max(-room, mind.lane + mind.stray)) - mark.ideal
    return mark.x + aside * mark.right_x, mark.y + aside * mark.right_y


def _ahead(view: Any) -> int:
    """The nearest robot before it, else beside it, that matters; -1: none."""
    near = [i for i in range(OTHERS) if view.others[i].present and -CLEAR < view.others[i].ahead < FAR]
    return min(near, key=lambda i: (view.others[i].ahead <= 0.0, view.others[i].distance), default=-1)


def _facts(view: Any, mind: Any) -> dict[str, float]:
    return {
        "state": mind.state,
        "place": view.rank,
        "past_line": view.past,
        "lane": mind.lane,
        "error": mind.stray,
        "pace": view.pace,
        "held_to": held_to(view, mind),
        "turbo": view.turbo,
        "on_course": view.on,
    }


def _sights(view: Any, first: int, x: float, y: float) -> Iterator[Sight]:
    if first >= 0:
        yield Sight(OPPONENT, view.others[first].x, view.others[first].y)
    yield Sight(GOAL, x, y)


def _rose(view: Any, mind: Any, x: float, y: float) -> list[float]:
    """To where it drives; away from those who are close."""
    if mind.state == racer.BREAK_FREE:
        return towards(0.0 if mind.escape > 0.0 else pi)
    wanted = towards(turn_to(atan2(y - view.y, x - view.x) - view.heading))
    close = [one for one in view.others if one.present and one.distance < NEAR]
    return blend(wanted, *(towards(one.bearing, -clamp(1.5 - 1.5 * one.distance / NEAR)) for one in close))
