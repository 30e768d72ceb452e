"""Robot Race as PPO learns it: alone, among drivers by hand and among copies of itself, on every track.

Progress counts, and a lead over the best of the others; so do finishing and the place at the finish.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from pigaming_app.ai.networks.encoding import Inputs
from pigaming_app.ai.networks.race import ENCODING
from pigaming_app.ai.ppo.learner import Hyper
from pigaming_app.ai.ppo.task import LEARNER, OFF, POOL, LineUp, Task
from pigaming_app.games.race.state import Race
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import ROBOTS

PROGRESS, LEAD, PLACE = range(3)  # gauges
STRIDE = 260.0  # px that count 1: about 0.8 s at full speed
LEADING = 0.3  # weight of the lead
LONGEST = 80.0  # px: more in a decision is a jump, such as the way back to a missed line
FINISH, WIN = 0.1, 0.5  # reward for each place up to the last at the finish, and for a win


@kernel
def gauge(match: Race, seat: int, inputs: Inputs, gauges: list[float]) -> None:
    """Progress, lead over the best of the others, and, once at the finish, the worth of the place."""
    racer, best, others = match.racers[seat], 0.0, 0
    for j in range(ROBOTS):
        if j != seat and match.robots[j].present:
            if not others or match.racers[j].progress > best:
                best = match.racers[j].progress
            others = 1
    gauges[PROGRESS] = racer.progress
    gauges[LEAD] = racer.progress - best if others else 0.0
    if racer.finished:
        gauges[PLACE] = FINISH * (1 + ROBOTS - racer.rank) + (WIN if racer.rank == 1 else 0.0)


@kernel
def result(match: Race, seat: int) -> float:
    """No reward at the end of a match: places count at the finish."""
    return 0.0


def reward(gains: np.ndarray, inputs: np.ndarray, choices: np.ndarray, share: float) -> Any:
    """Rewards (T, S) of the decisions."""
    ahead = np.clip(gains[..., :PLACE], -LONGEST, LONGEST) / np.float32(STRIDE)
    return (ahead[..., PROGRESS] + LEADING * ahead[..., LEAD] + np.maximum(gains[..., PLACE], 0.0)).astype(np.float32)


def habits(random: np.random.Generator) -> Mapping[str, float]:
    """None."""
    return {}


def field(share: int, *others: str) -> LineUp:
    """The learner and others."""
    return LineUp(share, (LEARNER, *others, *[OFF] * (ROBOTS - 1 - len(others))))


TASK = Task(
    encoding=ENCODING,
    arenas=("classic", "hairpin", "kidney", "technical"),
    variants=("standard", "party"),
    minutes=(10.0,),
    line_ups=(
        field(4),
        field(2, "hand3"),
        field(4, "hand3", "hand3", "hand3"),
        field(2, LEARNER, "hand3", "hand3"),
        field(1, "hand3", "hand2", "hand1"),
        field(2, LEARNER, LEARNER, LEARNER),
        field(2, POOL, POOL, POOL),
    ),
    gauges=("progress", "lead", "place"),
    gauge=gauge,
    result=result,
    reward=reward,
    rivals=("hand3",),
    habits=habits,
    cut=0.03,
    hyper=Hyper(matches=160, minibatch=4096, last_entropy=0.001, discount=0.975, trace=0.9, held=100),
    sharpness=4.0,
)
