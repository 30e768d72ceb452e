"""What models of people would wish in the situations of a recorded match.

The recorded actions determine the state of each tick, so the match is played again, and in each tick several models
are asked what they would do on a person's seat. They differ in one trait each and err in nothing. What they remember of
shots are those of the person.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pigaming_app.ai.brain.kind import BrainKind, Traits
from pigaming_app.ai.game_ai import Gun
from pigaming_app.ai.people.models import wisher
from pigaming_app.ai.registry import AIS
from pigaming_app.games.registry import games
from pigaming_app.sim.contact import drive
from pigaming_app.sim.kernel import can_compile, compiled
from pigaming_app.sim.record import packed, unpack
from pigaming_app.sim.world import HZ, ROBOTS

Array = NDArray[Any]

MIDDLE = Traits(
    reaction=0.4, spread=0.0, decisions=3.0, timing=0.0, aim=0.0, prediction=0.3, lapses=0.0, lapse=0.0,
    stick=0.0, tactics=0.4, turbo=True,
)  # fmt: skip
ASKED = (
    *(replace(MIDDLE, reaction=reaction) for reaction in (0.15, 0.4, 0.65, 0.9)),
    replace(MIDDLE, prediction=0.0),
    replace(MIDDLE, prediction=1.0),
    replace(MIDDLE, tactics=0.0),
    replace(MIDDLE, tactics=1.0),
    *(replace(MIDDLE, reaction=reaction) for reaction in (0.3, 0.5, 0.6, 0.8)),
)
"""The models that are asked; the second is the middle one. The last ones are for finer reactions."""
NEVER = 10 * HZ  # ticks since a shot, before the first
FIELDS = ("linear", "angular", "fire", "turbo", "aim")  # of a recorded action


@dataclass(frozen=True)
class Watched:
    """A person's seat, tick by tick."""

    actions: Array  # (ticks, 5): FIELDS
    poses: Array  # (ticks, 2): heading, rad, and turn rate, rad/s
    wishes: Array  # (ticks, models, 3): linear, angular, fire
    sights: Array  # (ticks, models, 2): directions to the target and to where a shot would meet it, rad; NaN: to none
    turn_rate: float  # rad/s, the highest
    end: Any  # state after the last tick


def watch(game: str, start: Any, recorded: Array, seat: int, fast: bool | None = None) -> Watched:
    """Play a match again. `start`: the state before its first tick; `recorded`: the actions, (ticks, 4 seats, 5)."""
    wishes = AIS[game].person
    assert wishes is not None
    kinds, judge, gun = [wisher(wishes, traits) for traits in ASKED], games()[game].judge, AIS[game].gun
    minds = [_mind(kind, 4 * number) for number, kind in enumerate(kinds)]
    seen = np.zeros((len(recorded), 2 + 5 * len(kinds)))
    if can_compile() if fast is None else fast:
        states = packed([start])
        _compiled_loop(game, kinds[0].think)(states, recorded, seat, packed(minds), kinds[0].weights(True)[0], seen)
        start = unpack(games()[game].state, states[0])
    else:
        _loop(judge, kinds[0].think, gun)([start], recorded, seat, minds, kinds[0].weights(False)[0], seen)
    asked = seen[:, 2:].reshape(len(seen), len(kinds), 5)
    turn_rate = float(start.rules.turn_rate)
    return Watched(recorded[:, seat], seen[:, :2], asked[:, :, :3], asked[:, :, 3:], turn_rate, start)


def _mind(kind: BrainKind, seed: int) -> Any:
    mind = kind.mind()
    kind.begin(mind, seed)
    return mind


@cache
def _compiled_loop(game: str, ask: Callable[..., None]) -> Callable[..., None]:
    return compiled(_loop(games()[game].judge, ask, AIS[game].gun))


def _loop(judge: Callable[[Any], None], ask: Callable[..., None], gun: Gun) -> Callable[..., None]:
    """A loop over the ticks of a match, plain or to be compiled."""
    recall, sight = gun.recall, gun.sight

    def loop(matches: Any, recorded: Any, seat: int, minds: Any, weights: Any, seen: Any) -> None:
        match = matches[0]
        since, held = NEVER, 0
        for tick in range(len(recorded)):
            if match.over:
                break
            robot = match.robots[seat]
            seen[tick, 0], seen[tick, 1] = robot.heading, robot.angular
            for model in range(len(minds)):
                mind = minds[model]
                recall(mind.inner, since)
                ask(match, seat, mind, weights)
                wish = mind.wish
                seen[tick, 2 + 5 * model] = wish.linear
                seen[tick, 3 + 5 * model] = wish.angular
                seen[tick, 4 + 5 * model] = wish.fire
                seen[tick, 5 + 5 * model], seen[tick, 6 + 5 * model] = sight(mind.inner)
            pressed = int(recorded[tick, seat, 2])
            since = 0 if pressed and not held else since + 1
            held = pressed
            for i in range(ROBOTS):
                action = match.actions[i]
                action.linear, action.angular = recorded[tick, i, 0], recorded[tick, i, 1]
                action.fire, action.turbo = int(recorded[tick, i, 2]), int(recorded[tick, i, 3])
                action.aim = int(recorded[tick, i, 4])
            judge(match)
            drive(match)

    return loop
