"""Explanations of Robot Factory. Of the brains: the utility of each kind of job, and the route to the chosen slot.

All values come from the brain's memory, its last observation and its own cost functions, without the noise and before
the allocation between mates. Of networks: topics of their inputs, and the places of perceived things.
"""

from collections.abc import Iterator, Sequence
from math import pi, tau

from pigaming_app.ai.brain.kind import NoWeights
from pigaming_app.ai.brain.thoughts import (
    GOAL,
    MATE,
    OPPONENT,
    PERSON,
    PETALS,
    WAY,
    Percept,
    Thoughts,
    blend,
    clamp,
    towards,
)
from pigaming_app.ai.factory.driving import LOOK, ROBOT_ROOM, free_distance
from pigaming_app.ai.factory.foreman import think as foreman_think
from pigaming_app.ai.factory.mind import STUCK_TICKS
from pigaming_app.ai.factory.planner import think as planner_think
from pigaming_app.ai.factory.task_allocation import NO, QUEUE, ForemanMind, cheapest_place, cost_of, distance_to
from pigaming_app.ai.networks import factory as network
from pigaming_app.ai.networks.subject import Sight, Subject, distance_of
from pigaming_app.games.factory.observation import FactoryObservation, SlotView
from pigaming_app.games.factory.state import DAMAGED, DONE, EXIT, HALF, INPUT, OUTPUT, RAW, B, Factory
from pigaming_app.games.simple import MatchState

DEAR = 2600.0  # cost of a job with utility 0, px
FAR = 1600.0  # distance at which the utility of putting down falls to its minimum of 0.2, px
JOBS = {"raw": RAW, "half": HALF, "done": DONE}
LOADS = {RAW: "raw", HALF: "half", DONE: "done", DAMAGED: "damaged"}


def explain(match: Factory, seat: int, mind: ForemanMind, weights: NoWeights) -> Thoughts:
    """Thoughts of the factory brain on `seat`."""
    obs = mind.obs
    if not obs.turn_rate or mind.target < 0:
        return Thoughts("starts")
    slot = obs.slots[mind.target]
    behaviour, reason = _behaviour(obs, mind, slot)
    return Thoughts(
        behaviour=behaviour,
        reason=reason,
        names={"machine": "B" if slot.makes == B else "A"},
        facts=_facts(obs, mind),
        percepts=tuple(_percepts(obs, mind, behaviour)),
        rose=_rose(obs, mind, behaviour),
        utilities=_utilities(obs, mind),
        chosen=_chosen(obs, mind, slot, behaviour),
    )


def _behaviour(obs: FactoryObservation, mind: ForemanMind, slot: SlotView) -> tuple[str, str]:
    """Text keys of the present behaviour and its reason."""
    if obs.frozen:
        return "frozen", "bumped"
    if mind.resting > 0:
        return "ponder", "next"
    if mind.freeing > 0:
        return "free", "stuck"
    if mind.near:
        return "queue", "full" if obs.carries else "nothing"
    if mind.detour > 0:
        return "detour", "lost"
    if not obs.carries:
        if slot.theirs and slot.lift:
            return "take", "anybody"
        if slot.kind == OUTPUT and not slot.ours:
            return "clear", "blocked"
        return "fetch", "rush" if slot.rush else LOADS.get(slot.holds - 1, "next")
    bring = "bring" if slot.kind == INPUT else "deliver" if slot.kind == EXIT else "shelve"
    return bring, "rush" if obs.rush else "fast" if slot.fast else LOADS[obs.carries - 1]


def _chosen(obs: FactoryObservation, mind: ForemanMind, slot: SlotView, behaviour: str) -> str:
    if behaviour == "free":
        return "free"
    if mind.near or behaviour in ("frozen", "ponder"):
        return "wait"
    return "put" if obs.carries else LOADS.get(slot.holds - 1, "wait")


def _utilities(obs: FactoryObservation, mind: ForemanMind) -> dict[str, float]:
    """Utilities: for each state of a pallet that of its best job; for putting down, higher the nearer the place."""
    utilities = dict.fromkeys(JOBS, 0.0)
    for s in range(obs.slot_count):
        name = LOADS.get(obs.slots[s].holds - 1, "")
        if name in JOBS and not obs.carries:
            cost = cost_of(obs, s, QUEUE)
            if cost < NO / 2.0:
                utilities[name] = max(utilities[name], clamp(1.0 - (distance_to(obs, s) + cost) / DEAR))
    place = cheapest_place(obs, mind) if obs.carries else -1
    utilities["put"] = clamp(1.0 - 0.8 * distance_to(obs, place) / FAR) if place >= 0 else 0.0
    utilities["wait"] = 1.0 if mind.near or obs.frozen or mind.resting > 0 else 0.0
    utilities["free"] = 1.0 if mind.freeing > 0 else clamp(mind.stuck_ticks / STUCK_TICKS)
    return utilities


def _facts(obs: FactoryObservation, mind: ForemanMind) -> dict[str, float]:
    return {
        "target": mind.target,
        "carries": obs.carries,
        "near": mind.near,
        "resting": mind.resting,
        "frozen": obs.frozen,
        "lead": obs.lead,
        "rush": obs.rush,
        "goal_distance": obs.goal_distance,
        "stuck_ticks": mind.stuck_ticks,
    }


def _percepts(obs: FactoryObservation, mind: ForemanMind, behaviour: str) -> Iterator[Percept]:
    """Nearby people and robots, and the route to the slot."""
    for person in obs.people:
        if person.distance < 2.0 * LOOK:
            yield Percept(PERSON, person.x, person.y)
    for other in obs.others:
        if other.present and other.distance < LOOK:
            yield Percept(OPPONENT, other.x, other.y)
    if behaviour not in ("frozen", "ponder", "free"):
        if not obs.straight:
            yield Percept(WAY, obs.waypoint_x, obs.waypoint_y)
        yield Percept(GOAL, obs.slots[mind.target].x, obs.slots[mind.target].y)


def _rose(obs: FactoryObservation, mind: ForemanMind, behaviour: str) -> list[float]:
    """Attraction along the route, repulsion from blocked directions."""
    blocked = [clamp(free_distance(obs, tau * k / PETALS, ROBOT_ROOM) / LOOK) - 1.0 for k in range(PETALS)]
    if behaviour in ("frozen", "ponder"):
        return blocked
    if behaviour == "free":
        return blend(towards(0.0 if mind.escape > 0.0 else pi), blocked)
    return blend(towards(obs.waypoint_bearing), blocked)


BY_THINK = dict.fromkeys((foreman_think, planner_think), explain)


def in_factory(match: MatchState, inputs: Sequence[float]) -> Iterator[Sight]:
    """The first target and the way to it, robots and people."""
    k = network.TARGETS
    if inputs[k]:
        way = network.WAY
        if not inputs[way + 2]:
            yield Sight("target", WAY, 400.0 * inputs[way + 3], inputs[way], inputs[way + 1])
        yield Sight("target", GOAL, distance_of(inputs[k + 2], network.NEAR), inputs[k + 3], inputs[k + 4])
    for k in range(network.OTHERS, network.PEOPLE, network.OTHER):
        if inputs[k]:
            place = (distance_of(inputs[k + 1], network.NEAR), inputs[k + 2], inputs[k + 3])
            yield Sight("others", MATE if inputs[k] > 0.0 else OPPONENT, *place)
    for k in range(network.PEOPLE, network.ROOM, network.PERSON):
        yield Sight("people", PERSON, distance_of(inputs[k], 150.0), inputs[k + 1], inputs[k + 2])


SUBJECT = Subject(
    {
        "target": ("target", "way"),
        "choices": ("second", "third"),
        "machines": ("machines",),
        "others": ("others",),
        "people": ("people",),
        "walls": ("place", "room"),
        "load": ("motion", "load"),
        "score": ("score", "rules"),
    },
    (-1.0, 0.0, 1.0),
    network.TURNS,
    "fork",
    in_factory,
    network.PLACE,
)
