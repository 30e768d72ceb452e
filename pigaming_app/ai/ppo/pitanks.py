"""PiTanks as PPO learns it: duels, free-for-alls and pairs under every rule set, on five arenas.

Hits count as points; hits taken count little at first, so that the network learns to fight before it learns to hide.
"""

from typing import Any

import numpy as np

from pigaming_app.ai.networks.encoding import UNIT, Inputs
from pigaming_app.ai.networks.pitanks import ENCODING, GUN, HABITS, OTHER, OTHERS, WAY
from pigaming_app.ai.ppo.learner import Hyper
from pigaming_app.ai.ppo.task import EXPLOITER, LEARNER, OFF, POOL, LineUp, Task
from pigaming_app.games.pitanks.scoring import lead
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.kernel import kernel

POINTS, TAKEN, SHOTS, POTENTIAL = range(4)  # gauges
CARE, FULL_CARE = 0.3, 1.0  # cost of a hit taken, at the begin and from half of the training on
SHAPING, SHAPED = 0.5, 0.3  # weight of the potential, at the begin and at the end of the training
FAR = 10.0  # by which 1600 px more on the way to an opponent out of sight lower the potential
SHOT = 0.08  # cost of a shot: who fires at a protected opponent is not loaded when the protection ends
BLIND = 0.1  # cost of a shot with nobody in the line of fire
CROWD, CLOSE = 0.03, 160.0  # cost of a decision within so many px of an opponent: blows at arm's length end level
BORED = 0.02  # cost of a decision with nobody in the line of fire: who waits loses
THRIFTY, MOST_THRIFT = 0.4, 0.9  # share of matches in which a shot has a cost, and the highest
LATE, LATEST = 0.3, 0.4  # share of matches in which others are seen late, and the longest delay, s
WIN = 2.0  # reward of a win; a tie costs half of it
PAIRS = (0, 1, 0, 1)
OWN = ("classic", "courtyard", "islands", "labyrinth", "trenches")  # arenas that ship with the game
MADE = tuple(f"surprise-{seed}" for seed in range(1, 61))  # others, so that it learns no arena by heart
PURE = ("classic",)  # variants by which the tables learned: with neither turbo nor protection, a stray burst decides
WALLED = ("labyrinth", "trenches")  # arenas in which somebody who waits must be looked for


@kernel
def gauge(match: PiTanks, seat: int, inputs: Inputs, gauges: list[float]) -> None:
    """Points made, hits taken, shots, and how well the first of the others can be fought."""
    tank = match.tanks[seat]
    gauges[POINTS] = match.robots[seat].score + match.rules.penalty * tank.taken
    gauges[TAKEN], gauges[SHOTS] = tank.taken, tank.shots
    if inputs[OTHERS + 11] > 0.0:
        gauges[POTENTIAL] = 0.5 * inputs[OTHERS + 4] / UNIT + 0.3
    else:
        gauges[POTENTIAL] = -0.5 * FAR * (inputs[WAY + 7] / UNIT + 1.0)


@kernel
def result(match: PiTanks, seat: int) -> float:
    """Reward of the end of a match."""
    ahead = lead(match, seat)
    return WIN if ahead > 0 else -WIN if ahead < 0 else -0.5 * WIN


def reward(gains: np.ndarray, inputs: np.ndarray, choices: np.ndarray, share: float) -> Any:
    """Rewards (T, S) of the decisions."""
    care = min(FULL_CARE, CARE + (FULL_CARE - CARE) * share / 0.5)
    shaping = SHAPING + (SHAPED - SHAPING) * share
    blind, crowded = np.ones(gains.shape[:2], bool), np.zeros(gains.shape[:2], bool)
    for k in range(OTHERS, OTHERS + 3 * OTHER, OTHER):
        opponent = (inputs[..., k] > 0) & (inputs[..., k + 1] <= 0)
        blind &= ~(opponent & (inputs[..., k + 11] > 0))
        crowded |= opponent & (inputs[..., k + 2] < CLOSE / 800.0 - 1.0)
    fired = (choices[..., 2] == 1) & (inputs[..., GUN] < 0.15)
    return (
        gains[..., POINTS]
        - care * gains[..., TAKEN]
        + shaping * gains[..., POTENTIAL]
        - (SHOT + inputs[..., HABITS]) * gains[..., SHOTS]
        - BLIND * (fired & blind)
        - BORED * blind
        - CROWD * crowded
    ).astype(np.float32)


def habits(random: np.random.Generator) -> dict[str, float]:
    """How sparing of shots a network is in a match, and how late it sees others."""
    thrift = random.random() * MOST_THRIFT if random.random() < THRIFTY else 0.0
    delay = random.random() * LATEST if random.random() < LATE else 0.0
    return {"thrift": thrift, "delay": delay}


def duel(share: int, rival: str, arenas: tuple[str, ...] = (), variants: tuple[str, ...] = ()) -> LineUp:
    """The learner against one rival."""
    return LineUp(share, (LEARNER, rival, OFF, OFF), variants=variants, arenas=arenas)


TASK = Task(
    encoding=ENCODING,
    arenas=OWN * 12 + MADE,
    variants=("pickups", "pickups", "party", "party", "party", "plain", "classic", "original"),
    minutes=(2.0,),
    line_ups=(
        duel(3, "hand3"),
        duel(1, "hand2"),
        duel(2, "classic"),
        duel(2, "classic", WALLED),
        duel(1, "idle"),
        duel(1, "idle", WALLED),
        duel(3, "q1"),
        duel(2, "q2"),
        duel(2, "q2", WALLED),
        duel(5, "q1", variants=PURE),
        duel(2, "q2", variants=PURE),
        duel(3, LEARNER),
        duel(16, EXPLOITER),
        duel(8, POOL),
        LineUp(2, (LEARNER, "hand3", "hand3", "hand3")),
        LineUp(1, (LEARNER, LEARNER, POOL, "hand3")),
        LineUp(2, (LEARNER, "hand3", LEARNER, "hand3"), PAIRS),
    ),
    gauges=("points", "taken", "shots", "potential"),
    gauge=gauge,
    result=result,
    reward=reward,
    habits=habits,
    rivals=("hand3", "q2", "classic"),
    hyper=Hyper(discount=0.995),
)
