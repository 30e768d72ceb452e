"""People by name, for every game whose AIs say what a person wants: `beginner`, `player`, `expert`, and `masher`.

`masher` presses keys at random, with steering help where a game has it. The others are a brain of the game, which sees
and wants, and hands between its wish and the robot.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from math import exp
from typing import Any

from pigaming_app.ai.brain.driving import SteeringHelp
from pigaming_app.ai.brain.kind import BrainKind, NoWeights, Traits
from pigaming_app.ai.game_ai import POINT, TURN, GameAI
from pigaming_app.ai.people.hands import Hands, move
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import bell, seeded, uniform
from pigaming_app.sim.world import HZ, Action

BEGINNER = Traits(  # a child of 8 on a keyboard
    reaction=0.6, spread=0.3, decisions=2.5, timing=0.11, aim=0.26, prediction=0.0, lapses=6.0, lapse=1.5,
    stick=0.0, tactics=0.1, turbo=False,
)  # fmt: skip
PLAYER = Traits(  # a teenager who knows the game, on a pad
    reaction=0.42, spread=0.25, decisions=3.5, timing=0.07, aim=0.2, prediction=0.3, lapses=3.0, lapse=0.7,
    stick=0.2, tactics=0.4, turbo=True,
)  # fmt: skip
EXPERT = Traits(  # an adult who plays often, on a pad
    reaction=0.34, spread=0.15, decisions=4.0, timing=0.055, aim=0.17, prediction=0.6, lapses=1.5, lapse=0.5,
    stick=0.17, tactics=0.7, turbo=True,
)  # fmt: skip
PRESSES = 3.5  # per second
HELD = 0.8  # s, mean time for which a key is down
KEYS = 5  # ahead, back, left, right, FIRE


@dataclass(frozen=True)
class PersonModel:
    """Traits, and the driving style of their device."""

    traits: Traits
    driving: str


PEOPLE: Mapping[str, PersonModel] = {
    "beginner": PersonModel(BEGINNER, TURN),
    "player": PersonModel(PLAYER, POINT),
    "expert": PersonModel(EXPERT, POINT),
}


def people(ai: GameAI) -> dict[str, BrainKind]:
    """The people of a game by name; `masher` alone if its AIs do not say what a person wants."""
    found = {MASHER.name: helped_masher(ai.help) if ai.help else MASHER}
    if ai.person:
        found |= {name: person_brain(name, ai.person, person) for name, person in PEOPLE.items()}
    return found


def person_brain(name: str, wishes: Callable[[Traits], BrainKind], person: PersonModel) -> BrainKind:
    """The brain of a person in a game whose wishes are a brain by traits."""
    inner = wishes(person.traits)

    def reset(mind: Any, seed: int) -> None:
        hands = mind.hands
        hands.random = seeded(seed + 1)
        traits = person.traits.slower(exp(2.0 * person.traits.spread * bell(hands)))
        wishes(traits).begin(mind.inner, seed)
        hands.stick, hands.point = traits.stick, int(person.driving == POINT)
        hands.period, hands.timing = HZ / traits.decisions, HZ * traits.timing
        hands.odds, hands.lapse = traits.lapses / (60.0 * HZ), HZ * traits.lapse
        hands.turbo = int(traits.turbo)

    return BrainKind(name, _mind_record(inner.mind), _make_think(inner.think), reset, inner.weights)


def wisher(wishes: Callable[[Traits], BrainKind], traits: Traits) -> BrainKind:
    """What a person with these traits would do, in `mind.wish`; the seat's action stays as it is."""
    inner = wishes(traits)

    def reset(mind: Any, seed: int) -> None:
        inner.begin(mind.inner, seed)

    return BrainKind("wisher", _wisher_record(inner.mind), _make_wish(inner.think), reset, inner.weights)


@cache
def _mind_record(inner: type) -> type:
    """The record of the mind of a person whose wishes have the record `inner`."""
    hints = {"hands": Hands, "inner": inner}
    return record(type("PersonMind", (), {"__annotations__": hints, "__module__": __name__}))


@cache
def _wisher_record(inner: type) -> type:
    """The record of the mind of a wisher."""
    hints = {"wish": Action, "inner": inner}
    return record(type("WisherMind", (), {"__annotations__": hints, "__module__": __name__}))


@cache
def _make_think(wish: Callable[[Any, int, Any, Any], None]) -> Callable[[Any, int, Any, Any], None]:
    """The decision function of people with these wishes."""

    def think(match: MatchState, seat: int, mind: Any, weights: Any) -> None:
        action, wished = match.actions[seat], mind.hands.wish
        copy_action(wished, action)
        wish(match, seat, mind.inner, weights)
        copy_action(action, wished)
        move(match, seat, mind.hands)

    return kernel(think)


@cache
def _make_wish(wish: Callable[[Any, int, Any, Any], None]) -> Callable[[Any, int, Any, Any], None]:
    """The decision function of a wisher: the brain that wishes finds its last wish in place of the seat's action."""

    def think(match: MatchState, seat: int, mind: Any, weights: Any) -> None:
        action, wished = match.actions[seat], mind.wish
        linear, angular, fire, turbo, aim = action.linear, action.angular, action.fire, action.turbo, action.aim
        copy_action(wished, action)
        wish(match, seat, mind.inner, weights)
        copy_action(action, wished)
        action.linear, action.angular, action.fire, action.turbo, action.aim = linear, angular, fire, turbo, aim

    return kernel(think)


@kernel
def copy_action(source: Action, target: Action) -> None:
    """Make an action equal to another."""
    target.linear, target.angular = source.linear, source.angular
    target.fire, target.turbo, target.aim = source.fire, source.turbo, source.aim


@record
class MasherMind:
    """Ticks for which each key is still down."""

    random: int
    ahead: int
    back: int
    left: int
    right: int
    fire: int


@kernel
def think(match: MatchState, seat: int, mind: MasherMind, weights: NoWeights) -> None:
    """Press a key at random now and then, and hold what is down."""
    if uniform(mind) < PRESSES / HZ:
        key, ticks = int(KEYS * uniform(mind)), 1 + int(2.0 * HELD * HZ * uniform(mind))
        if key == 0:
            mind.ahead = ticks
        elif key == 1:
            mind.back = ticks
        elif key == 2:
            mind.left = ticks
        elif key == 3:
            mind.right = ticks
        else:
            mind.fire = ticks
    mind.ahead, mind.back = max(0, mind.ahead - 1), max(0, mind.back - 1)
    mind.left, mind.right = max(0, mind.left - 1), max(0, mind.right - 1)
    mind.fire = max(0, mind.fire - 1)
    linear = (1.0 if mind.ahead else 0.0) - (1.0 if mind.back else 0.0)
    angular = (1.0 if mind.right else 0.0) - (1.0 if mind.left else 0.0)
    set_action(match.actions[seat], linear, angular, mind.fire, 0)


MASHER = BrainKind("masher", MasherMind, think)


def helped_masher(steering: SteeringHelp) -> BrainKind:
    """Keys at random with steering help."""

    def reset(mind: Any, seed: int) -> None:
        MASHER.begin(mind.inner, seed)

    return BrainKind(MASHER.name, _helped_record(steering.memory), _make_helped(steering.steer), reset)


@cache
def _helped_record(memory: type) -> type:
    hints = {"inner": MasherMind, "memory": memory}
    return record(type("HelpedMind", (), {"__annotations__": hints, "__module__": __name__}))


@cache
def _make_helped(steer: Callable[[Any, int, float, float, Any], tuple[float, float]]) -> Any:
    """The decision function of keys at random with this help."""

    def press_with_help(match: MatchState, seat: int, mind: Any, weights: NoWeights) -> None:
        think(match, seat, mind.inner, weights)
        action = match.actions[seat]
        linear, angular = steer(match, seat, action.linear, action.angular, mind.memory)
        set_action(action, linear, angular, action.fire, action.turbo)

    return kernel(press_with_help)
