"""Robot Race as PPO learns it; all numbers, races and opponents are in assets/brains/race.task.toml.

Progress counts, and a lead over the best of the others; so do finishing and the place at the finish.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from pigaming_app.ai.networks.encoding import Inputs
from pigaming_app.ai.networks.race import ENCODING
from pigaming_app.ai.ppo.task import Task
from pigaming_app.games.race.state import Race
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import ROBOTS

PROGRESS, LEAD, PLACES, WON = range(4)  # gauges


@kernel
def gauge(match: Race, seat: int, inputs: Inputs, gauges: list[float]) -> None:
    """Progress, lead over the best of the others, and, once at the finish, the places up to the last, and a win."""
    racer, best, others = match.racers[seat], 0.0, 0
    for j in range(ROBOTS):
        if j != seat and match.robots[j].present:
            if not others or match.racers[j].progress > best:
                best = match.racers[j].progress
            others = 1
    gauges[PROGRESS] = racer.progress
    gauges[LEAD] = racer.progress - best if others else 0.0
    if racer.finished:
        gauges[PLACES] = 1 + ROBOTS - racer.rank
        gauges[WON] = racer.rank == 1


@dataclass(frozen=True)
class RaceRewards:
    """Rewards of the decisions."""

    stride: float  # px of progress that count 1: 260 px are about 0.8 s at full speed
    lead: float  # for a stride by which the lead grows
    longest: float  # px: more in a decision is a jump, such as the way back to a missed line
    place: float  # for each place up to the last, at the finish
    win: float

    def __call__(self, gains: np.ndarray, inputs: np.ndarray, choices: np.ndarray, share: float) -> Any:
        """Rewards (T, S)."""
        ahead = np.clip(gains[..., :PLACES], -self.longest, self.longest) / np.float32(self.stride)
        ends = gains[..., PLACES:].astype(float)
        finish = np.maximum(self.place * ends[..., 0] + self.win * ends[..., 1], 0.0).astype(np.float32)
        return (ahead[..., PROGRESS] + self.lead * ahead[..., LEAD] + finish).astype(np.float32)


TASK = Task(
    encoding=ENCODING,
    gauges=("progress", "lead", "places", "won"),
    gauge=gauge,
    reward=RaceRewards,
)
