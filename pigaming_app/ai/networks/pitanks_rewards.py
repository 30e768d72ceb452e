"""What a reward line may depend on in PiTanks, from what a network saw at a decision and what came of it.

The Lab's networks and the environments share it.
"""

from typing import Any

import numpy as np

from pigaming_app.ai.networks.pitanks import GUN, OTHERS, TURNS
from pigaming_app.ai.reward_quantities import (
    BEHIND,
    DISTANCE,
    FARTHEST,
    FIRED,
    HIT,
    MISS,
    QUANTITIES,
    STILL,
    TAKEN,
    TURNED,
)

STAND = 1  # choice of the first head: neither forwards nor backwards
AHEAD = len(TURNS) // 2  # choice of the second head: no turn
RELOADED = 0.15  # of the gun's cooldown, from which on a shot counts


def quantities_of(hits: Any, taken: Any, inputs: Any, actions: Any, sticks: bool = False) -> Any:
    """The quantities (..., k) of decisions.

    `hits` and `taken` (...): made and taken until the next decision; `inputs` (..., inputs): seen before, units of 1;
    `actions` (..., 4): choices, or `sticks`.
    """
    rows = np.zeros((*np.shape(hits), len(QUANTITIES)))
    drive, turn, fire = actions[..., 0], actions[..., 1], actions[..., 2] > 0.5
    still, turned = drive == (0.0 if sticks else STAND), turn != (0.0 if sticks else AHEAD)
    fired = fire & (inputs[..., GUN] < RELOADED)
    rows[..., HIT], rows[..., TAKEN] = hits, taken
    rows[..., MISS] = fired & (inputs[..., OTHERS + 11] <= 0)
    rows[..., BEHIND] = inputs[..., OTHERS + 4] < 0
    rows[..., STILL], rows[..., TURNED], rows[..., FIRED] = still, turned, fired
    rows[..., DISTANCE] = 0.5 * FARTHEST * (inputs[..., OTHERS + 2] + 1.0)
    return rows
