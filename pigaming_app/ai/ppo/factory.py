"""Robot Factory as PPO learns it; all numbers, matches and opponents are in assets/brains/factory.task.toml.

Steps of the team's pallets count, and the end of the match; so does, as a potential, the way to the next target.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from pigaming_app.ai.networks.encoding import UNIT, Inputs
from pigaming_app.ai.networks.factory import ENCODING, WAY
from pigaming_app.ai.networks.factory_progress import progress_of_pallets, success
from pigaming_app.ai.ppo.task import Task
from pigaming_app.games.factory.state import Factory
from pigaming_app.sim.kernel import kernel

PROGRESS, ERRAND, BUMPS, SUCCESS = range(4)  # gauges
FAR = 1600.0  # px, the longest way among the inputs


@kernel
def gauge(match: Factory, seat: int, inputs: Inputs, gauges: list[float]) -> None:
    """Steps of the team's pallets, the way to the first target, people driven over, and the end."""
    team = match.robots[seat].team
    gauges[PROGRESS] = progress_of_pallets(match, team)
    gauges[ERRAND] = -FAR * inputs[WAY + 4] / UNIT / 1000.0
    gauges[BUMPS] = match.loads[seat].hits
    if match.over:
        gauges[SUCCESS] = success(match, team)


@dataclass(frozen=True)
class FactoryRewards:
    """Rewards of the decisions; costs are positive."""

    step: float  # for a step of a pallet of the team
    errand: float  # for 1000 px nearer to the first target
    bump: float  # cost of a person driven over
    success: float  # for a win, which is 1; see `success`

    def __call__(self, gains: np.ndarray, inputs: np.ndarray, choices: np.ndarray, share: float) -> Any:
        """Rewards (T, S)."""
        return gains @ np.array([self.step, self.errand, -self.bump, self.success], np.float32)


TASK = Task(
    encoding=ENCODING,
    gauges=("progress", "errand", "bumps", "success"),
    gauge=gauge,
    reward=FactoryRewards,
)
