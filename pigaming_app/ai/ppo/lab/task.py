"""PiTanks as the network in the Lab learns it: duels in one arena, and rewards that a visitor may change meanwhile.

The rewards have the names of the Q-learner's in the Lab. The network beats the strongest hand-written brain after some
15,000 decisions of 60 robots that play at the same time: 25 seconds of their lives.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from pigaming_app.ai.networks.encoding import UNIT, Inputs
from pigaming_app.ai.networks.pitanks import ENCODING, OTHERS, WAY
from pigaming_app.ai.networks.pitanks_rewards import quantities_of
from pigaming_app.ai.ppo.learner import Hyper
from pigaming_app.ai.ppo.task import LEARNER, OFF, LineUp, Task
from pigaming_app.ai.reward_line import points_of, program_of
from pigaming_app.ai.reward_quantities import QUANTITIES, WEIGHTED
from pigaming_app.games.pitanks.scoring import lead
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.kernel import can_compile, kernel

ARENA, VARIANT, MINUTES, RIVAL = "classic", "classic", 2.0, "hand3"
POINTS, TAKEN, POTENTIAL = range(3)  # gauges
POINT = 0.1  # reward per point of the recipe
WIN = 2.0  # reward of a win; a tie costs half of it
SHAPING = 0.5  # weight of the potential

HYPER = Hyper(
    matches=48, decisions=5, epochs=3, minibatch=300, rate=1e-3, last_rate=1e-3, entropy=0.01, last_entropy=0.01
)


@dataclass(frozen=True)
class NetworkRecipe:
    """Rewards of the network in points."""

    hit: float = 10.0  # a hit
    miss: float = -0.5  # fires with a wall between it and the opponent
    behind: float = -0.3  # the opponent is behind, at every decision
    still: float = 0.0  # no linear command, at every decision
    rest: str = "-3*taken"  # of the reward: see reward_line.py


@kernel
def gauge(match: PiTanks, seat: int, inputs: Inputs, gauges: list[float]) -> None:
    """Points made, hits taken, and how well the opponent can be fought."""
    tank = match.tanks[seat]
    gauges[POINTS], gauges[TAKEN] = match.robots[seat].score + match.rules.penalty * tank.taken, tank.taken
    clear, towards, length = inputs[OTHERS + 11] / UNIT, inputs[OTHERS + 4] / UNIT, inputs[WAY + 7] / UNIT
    gauges[POTENTIAL] = clear * (0.5 * towards + 0.3) - 0.8 * length


@kernel
def result(match: PiTanks, seat: int) -> float:
    """Reward of the end of a match."""
    ahead = lead(match, seat)
    return WIN if ahead > 0 else -WIN if ahead < 0 else -0.5 * WIN


def reward_of(recipe: NetworkRecipe) -> Callable[[Any, Any, Any, float], Any]:
    """The reward of a task."""

    weights, rest = [getattr(recipe, name) for name in WEIGHTED], program_of(recipe.rest, QUANTITIES)

    def reward(gains: np.ndarray, inputs: np.ndarray, choices: np.ndarray, share: float) -> Any:
        rows = quantities_of(gains[..., POINTS], gains[..., TAKEN], inputs, choices)
        worths = rows[..., : len(weights)] @ weights + points_of(rest, rows, can_compile())
        return (POINT * worths + SHAPING * gains[..., POTENTIAL]).astype(np.float32)

    return reward


def no_habits(random: np.random.Generator) -> dict[str, float]:
    """Shots cost nothing, and others are seen without delay."""
    return {"thrift": 0.0, "delay": 0.0}


TASK = Task(
    encoding=ENCODING,
    arenas=(ARENA,),
    variants=(VARIANT,),
    minutes=(MINUTES,),
    line_ups=(LineUp(3, (LEARNER, RIVAL, OFF, OFF)), LineUp(1, (LEARNER, LEARNER, OFF, OFF))),
    gauges=("points", "taken", "potential"),
    gauge=gauge,
    result=result,
    reward=reward_of(NetworkRecipe()),
    rivals=(RIVAL,),
    habits=no_habits,
)
