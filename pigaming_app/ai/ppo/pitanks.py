"""PiTanks as PPO learns it; all numbers, matches and opponents are in assets/brains/pitanks.task.toml.

Hits count as points; hits taken count little at first, so that the network learns to fight before it learns to hide.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from pigaming_app.ai.networks.encoding import UNIT, Inputs
from pigaming_app.ai.networks.pitanks import ENCODING, GUN, HABITS, OTHER, OTHERS, WAY
from pigaming_app.ai.ppo.task import Task
from pigaming_app.games.pitanks.scoring import lead
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.kernel import kernel

POINTS, TAKEN, SHOTS, POTENTIAL, WON, TIED, LOST = range(7)  # gauges
FAR = 10.0  # by which 1600 px more on the way to an opponent out of sight lower the potential, twice


@kernel
def gauge(match: PiTanks, seat: int, inputs: Inputs, gauges: list[float]) -> None:
    """Points made, hits taken, shots, how well the first of the others can be fought, and the end of the match."""
    tank = match.tanks[seat]
    gauges[POINTS] = match.robots[seat].score + match.rules.penalty * tank.taken
    gauges[TAKEN], gauges[SHOTS] = tank.taken, tank.shots
    if inputs[OTHERS + 11] > 0.0:
        gauges[POTENTIAL] = 0.5 * inputs[OTHERS + 4] / UNIT + 0.3
    else:
        gauges[POTENTIAL] = -0.5 * FAR * (inputs[WAY + 7] / UNIT + 1.0)
    if match.over:
        ahead = lead(match, seat)
        gauges[WON if ahead > 0 else LOST if ahead < 0 else TIED] = 1.0


@dataclass(frozen=True)
class PiTanksRewards:
    """Rewards of the decisions; costs are positive."""

    win: float
    tie: float
    defeat: float
    first_care: float  # cost of a hit taken, at the begin and from half of the training on
    care: float
    first_shaping: float  # weight of the potential, at the begin and at the end of the training
    shaping: float
    shot: float  # cost of a shot: who fires at a protected opponent is not loaded when the protection ends
    blind: float  # cost of a shot with nobody in the line of fire
    bored: float  # cost of a decision with nobody in the line of fire: who waits loses
    crowd: float  # cost of a decision within `close` px of an opponent: blows at arm's length end level
    close: float

    def __call__(self, gains: np.ndarray, inputs: np.ndarray, choices: np.ndarray, share: float) -> Any:
        """Rewards (T, S)."""
        care = min(self.care, self.first_care + (self.care - self.first_care) * share / 0.5)
        shaping = self.first_shaping + (self.shaping - self.first_shaping) * share
        blind, crowded = np.ones(gains.shape[:2], bool), np.zeros(gains.shape[:2], bool)
        for k in range(OTHERS, OTHERS + 3 * OTHER, OTHER):
            opponent = (inputs[..., k] > 0) & (inputs[..., k + 1] <= 0)
            blind &= ~(opponent & (inputs[..., k + 11] > 0))
            crowded |= opponent & (inputs[..., k + 2] < self.close / 800.0 - 1.0)
        fired = (choices[..., 2] == 1) & (inputs[..., GUN] < 0.15)
        rewards = (
            gains[..., POINTS]
            - care * gains[..., TAKEN]
            + shaping * gains[..., POTENTIAL]
            - (self.shot + inputs[..., HABITS]) * gains[..., SHOTS]
            - self.blind * (fired & blind)
            - self.bored * blind
            - self.crowd * crowded
        ).astype(np.float32)
        return rewards + (self.win * gains[..., WON] + self.tie * gains[..., TIED] + self.defeat * gains[..., LOST])


@dataclass(frozen=True)
class PiTanksHabits:
    """How sparing of shots a network is in a match, and how late it sees others."""

    thrifty: float  # share of matches in which a shot has a cost, and the highest, in points
    most_thrift: float
    late: float  # share of matches in which others are seen late, and the longest delay, s
    latest: float

    def __call__(self, random: np.random.Generator) -> dict[str, float]:
        """Fields of a network's senses."""
        thrift = random.random() * self.most_thrift if random.random() < self.thrifty else 0.0
        delay = random.random() * self.latest if random.random() < self.late else 0.0
        return {"thrift": thrift, "delay": delay}


TASK = Task(
    encoding=ENCODING,
    gauges=("points", "taken", "shots", "potential", "won", "tied", "lost"),
    gauge=gauge,
    reward=PiTanksRewards,
    habits=PiTanksHabits,
)
