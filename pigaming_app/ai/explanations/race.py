"""Explanations of Robot Race. Of the brain: its line, the robots in the way and its speed.

All values come from the brain's memory, its last observation and its own functions; nothing is decided twice. Of
networks: topics of their inputs, and the places of perceived things.
"""

from collections.abc import Iterator, Sequence
from math import atan2, pi

from pigaming_app.ai.brain.kind import NoWeights
from pigaming_app.ai.brain.thoughts import GOAL, OPPONENT, WAY, Percept, Thoughts, blend, clamp, towards
from pigaming_app.ai.networks import race as network
from pigaming_app.ai.networks.subject import Sight, Subject
from pigaming_app.ai.race import overtaking, racer
from pigaming_app.ai.race.overtaking import CLEAR, EDGE, FAR, lane_cost, leader_speed
from pigaming_app.ai.race.racer import RacerMind
from pigaming_app.games.race.observation import OTHERS, CourseFeature, RaceObservation
from pigaming_app.games.race.state import Race
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.world import ROBOTS, Action

CHANGED = 25.0  # px off its own line beyond which it is overtaking
SLOW = 0.93  # share of full speed below which it is braking
TROUBLE = 150.0  # cost of a lane with utility 0, px
NEAR = 200.0  # px within which other robots repel

CHOSEN = {
    "free": "free", "return": "back", "done": "brake", "follow": "brake", "bend": "brake", "boost": "turbo",
    "mud": "line", "race": "line", "wide": "line", "spin": "line", "item": "line", "tow": "line", "recall": "back",
}  # fmt: skip
REASONS = {
    "free": "stuck", "return": "missed", "done": "finish", "pass_left": "in_way", "pass_right": "in_way",
    "follow": "no_room", "bend": "bend", "boost": "straight", "mud": "mud", "wide": "late", "spin": "oil",
    "item": "pays", "recall": "lost", "avoid_oil": "oil_ahead", "to_pad": "pad", "to_box": "box", "tow": "slipstream",
}  # fmt: skip


def explain(match: Race, seat: int, mind: RacerMind, weights: NoWeights) -> Thoughts:
    """Thoughts of the driver on `seat`."""
    obs = mind.obs
    if not obs.turn_rate:
        return Thoughts("starts")
    x, y = _goal(obs, mind)
    behaviour, first = _behaviour(obs, mind, match.actions[seat]), _ahead(obs)
    line = "line" if mind.line > 0.5 else "middle"
    return Thoughts(
        behaviour=behaviour,
        reason=REASONS.get(behaviour, line),
        names={"player": (seat + 1 + first) % ROBOTS + 1},
        facts=_facts(obs, mind),
        percepts=tuple(_percepts(obs, first, x, y)),
        rose=_rose(obs, mind, x, y),
        utilities=_utilities(obs, mind),
        chosen=CHOSEN.get(behaviour, "left" if mind.lane < mind.line * obs.ahead.ideal else "right"),
    )


def _behaviour(obs: RaceObservation, mind: RacerMind, action: Action) -> str:
    """Text key of the present behaviour."""
    if obs.finished:  # its actions no longer move the robot
        return "done"
    if obs.spin:
        return "spin"
    if action.fire:
        return "recall" if obs.lost else "item"
    if mind.state == racer.BREAK_FREE:
        return "free"
    if mind.state == racer.GO_BACK or obs.past > racer.SLACK:
        return "return"
    if mind.blunder > 0:
        return "wide"
    if abs(mind.lane - mind.line * obs.ahead.ideal) > CHANGED:
        return _lane_change(obs, mind)
    if leader_speed(obs, mind) < 1.0:
        return "follow"
    if not obs.on:
        return "mud"
    if obs.boosting:
        return "boost"
    if obs.slip:
        return "tow"
    return "bend" if obs.pace < SLOW else "race"


def _lane_change(obs: RaceObservation, mind: RacerMind) -> str:
    """Text key of the reason to leave its own line: oil on it, a pad or a box beside it, else a robot."""
    own = mind.line * obs.ahead.ideal
    if not obs.shield and any(_near(oil, own, mind, overtaking.SLICK_HALF) for oil in obs.oils):
        return "avoid_oil"
    if _near(obs.pad, mind.lane, mind, overtaking.PAD_HALF):
        return "to_pad"
    if not obs.item and _near(obs.box, mind.lane, mind, overtaking.BOX_HALF):
        return "to_box"
    return "pass_left" if mind.lane < own else "pass_right"


def _near(feature: CourseFeature, lane: float, mind: RacerMind, half: float) -> bool:
    """True if a feature on this lane is near enough to be considered."""
    return bool(feature.present and feature.ahead < mind.foresight and abs(feature.aside - lane) < half)


def _utilities(obs: RaceObservation, mind: RacerMind) -> dict[str, float]:
    """Utilities of lanes (of another lane, higher the more its own is blocked) and of speed changes."""
    mark = obs.ahead
    room, own = mark.half - EDGE, mind.line * mark.ideal
    costs = lane_cost(obs, mind, own)
    sides = [lane_cost(obs, mind, min(room, max(-room, own + side * CLEAR))) for side in (-1.0, 1.0)]
    left, right = (clamp(costs / TROUBLE) * clamp(1.0 - side / TROUBLE) for side in sides)
    may = obs.on and obs.pace >= 1.0
    return {
        "left": left,
        "line": clamp(1.0 - costs / TROUBLE),
        "right": right,
        "brake": clamp(1.0 - min(obs.pace, leader_speed(obs, mind), 1.0)),
        "turbo": 1.0 if obs.boosting else clamp(obs.turbo / max(0.1, mind.boost)) if may else 0.0,
        "back": 1.0 if mind.state == racer.GO_BACK else clamp(obs.past / racer.SLACK),
        "free": 1.0 if mind.state == racer.BREAK_FREE else clamp(mind.stuck_ticks / racer.STUCK_TICKS),
    }


def _goal(obs: RaceObservation, mind: RacerMind) -> tuple[float, float]:
    """The point it steers to, arena px."""
    if mind.state == racer.GO_BACK or obs.past > racer.SLACK:
        return obs.return_x, obs.return_y
    mark = obs.ahead
    room = mark.half - EDGE
    lane = min(room, max(-room, racer.aimed_lane(mind)))
    aside = (min(mark.high, max(mark.low, lane)) if mark.narrow else lane) - mark.ideal
    return mark.x + aside * mark.right_x, mark.y + aside * mark.right_y


def _ahead(obs: RaceObservation) -> int:
    """Index of the nearest robot ahead, else alongside; -1 if none is near."""
    near = [i for i in range(OTHERS) if obs.others[i].present and -CLEAR < obs.others[i].ahead < FAR]
    return min(near, key=lambda i: (obs.others[i].ahead <= 0.0, obs.others[i].distance), default=-1)


def _facts(obs: RaceObservation, mind: RacerMind) -> dict[str, float]:
    return {
        "state": mind.state,
        "place": obs.rank,
        "past_line": obs.past,
        "lane": mind.lane,
        "error": mind.stray,
        "pace": obs.pace,
        "held_to": leader_speed(obs, mind),
        "turbo": obs.turbo,
        "on_course": obs.on,
        "mistake": mind.blunder,
        "item": obs.item,
    }


def _percepts(obs: RaceObservation, first: int, x: float, y: float) -> Iterator[Percept]:
    if first >= 0:
        yield Percept(OPPONENT, obs.others[first].x, obs.others[first].y)
    yield Percept(GOAL, x, y)


def _rose(obs: RaceObservation, mind: RacerMind, x: float, y: float) -> list[float]:
    """Attraction to the goal, repulsion from close robots."""
    if mind.state == racer.BREAK_FREE:
        return towards(0.0 if mind.escape > 0.0 else pi)
    wanted = towards(turn_to(atan2(y - obs.y, x - obs.x) - obs.heading))
    close = [other for other in obs.others if other.present and other.distance < NEAR]
    return blend(wanted, *(towards(other.bearing, -clamp(1.5 - 1.5 * other.distance / NEAR)) for other in close))


BY_THINK = {racer.think: explain}


def in_race(match: MatchState, inputs: Sequence[float]) -> Iterator[Sight]:
    """Robots, and the point of the fastest line some way ahead."""
    for k in range(network.OTHERS, network.OILS, network.OTHER):
        if any(inputs[k : k + network.OTHER]) and abs(inputs[k + 2]) < 1.0:
            place = (1.0, network.NEAR * inputs[k + 1], 200.0 * inputs[k + 2])
            yield Sight("near" if k == network.OTHERS else "others", OPPONENT, *place)
    for i in (3, 5):
        k = network.COURSE + 6 * i
        if abs(inputs[k]) < 1.0 and abs(inputs[k + 1]) < 1.0:
            place = (1.0, 450.0 * inputs[k], (1.2 * network.AHEAD[i] + 40.0) * inputs[k + 1])
            yield Sight("course", WAY, *place)


SUBJECT = Subject(
    {
        "course": ("place", "way", "course"),
        "near": ("first",),
        "others": ("second", "third"),
        "oil": ("oil",),
        "pads": ("pad", "box"),
        "self": ("motion", "powers"),
        "score": ("race",),
    },
    network.DRIVES,
    network.TURNS,
    "item",
    in_race,
)
