"""The example of TorchRL learns: in a race without opponents, where progress leads.

TorchRL comes with PyTorch, a gigabyte in which no job of the arcade has a part; it is tried where it is installed.
"""

import runpy
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "torchrl_ppo.py"


@pytest.mark.skipif(not find_spec("torchrl"), reason="TorchRL is not installed")
@pytest.mark.long
@pytest.mark.again  # `.ci/run` has no PyTorch
def test_the_example_learns():
    train = runpy.run_path(str(EXAMPLE))["train"]
    means = train("RobotRace-v0", [], minutes=1.0, num_envs=64, seed=1)
    assert np.mean(means[-3:]) > 2.0 * np.mean(means[:3])
