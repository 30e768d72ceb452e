"""The spaces of one learner."""

from typing import Any

import numpy as np
from gymnasium.spaces import Box, MultiDiscrete

from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.gym.options import EnvironmentTask


def observation_space(task: EnvironmentTask) -> Box:
    """The inputs of the game's networks, in units of 1."""
    return Box(-1.0, 1.0, (ENCODINGS[task.game].size,), np.float32)


def action_space(task: EnvironmentTask) -> Any:
    """A choice for each of the game's heads; or, continuous, linear and angular stick, fire and turbo."""
    if task.continuous:
        return Box(np.array([-1.0, -1.0, 0.0, 0.0]), np.ones(4), dtype=np.float64)
    return MultiDiscrete([choices for _, choices in ENCODINGS[task.game].heads])
