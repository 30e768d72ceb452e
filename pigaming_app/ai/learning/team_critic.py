"""A team's critic: a central value function for policies that see their own inputs alone.

C. Yu et al., "The surprising effectiveness of PPO in cooperative multi-agent games", arXiv:2103.01955. In play there is
no critic, so a network that learned with one is like any other.
"""

from typing import Any

import numpy as np

from pigaming_app.sim.world import ROBOTS


def mates_of(families: np.ndarray, teams: np.ndarray, streams: np.ndarray) -> Any:
    """For each stream, those of the same learner in the same team (S, 3); -1 for those that there are not.

    `families`, `teams`, `streams` (-1: no learner): by match and seat (n, 4).
    """
    same = (families[:, :, None] == families[:, None]) & (teams[:, :, None] == teams[:, None])
    same &= (streams >= 0)[:, :, None] & ~np.eye(ROBOTS, dtype=bool)
    others = np.where(same, streams[:, None], -1)  # (n, 4, 4)
    return -np.sort(-others, axis=2)[streams >= 0, : ROBOTS - 1]


def team_views(inputs: np.ndarray, mates: np.ndarray) -> Any:
    """Inputs of a team's critic (T, S, 2 n + 2): the own n, the mean of the mates' n and 1, or zeros without mates; 1.

    `inputs`: (T, S, n + 1); `mates`: see Experience.
    """
    total = np.zeros_like(inputs)
    for others in mates.T:
        total += inputs[:, others] * (others >= 0)[:, None]
    total /= np.maximum((mates >= 0).sum(1), 1)[:, None].astype(inputs.dtype)
    return np.concatenate([inputs[..., :-1], total, inputs[..., -1:]], axis=-1)
