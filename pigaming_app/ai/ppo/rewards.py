"""What a reward line may depend on in PiTanks, from what a network saw at a decision and what came of it.

The Lab's networks and the environments share it.
"""

from typing import Any

import numpy as np

from pigaming_app.ai.networks.pitanks import GUN, OTHERS
from pigaming_app.ai.pitanks.quantities import (
    BEHIND,
    DISTANCE,
    FIRED,
    HIT,
    MISS,
    QUANTITIES,
    STILL,
    TAKEN,
    TURNED,
)

RELOADED = 0.15  # of the gun's cooldown, from which on a shot counts
FAR = 800.0  # px, half of the longest distance that is seen


def quantities_of(hits: Any, taken: Any, inputs: Any, still: Any, turned: Any, fire: Any) -> Any:
    """The quantities (..., k) of decisions.

    `hits` and `taken` (...): made and taken until the next decision; `inputs` (..., inputs): seen before, units of 1;
    `still`, `turned`, `fire` (...): no linear command, an angular one, the button.
    """
    rows = np.zeros((*np.shape(hits), len(QUANTITIES)))
    fired = fire & (inputs[..., GUN] < RELOADED)
    rows[..., HIT], rows[..., TAKEN] = hits, taken
    rows[..., MISS] = fired & (inputs[..., OTHERS + 11] <= 0)
    rows[..., BEHIND] = inputs[..., OTHERS + 4] < 0
    rows[..., STILL], rows[..., TURNED], rows[..., FIRED] = still, turned, fired
    rows[..., DISTANCE] = FAR * (inputs[..., OTHERS + 2] + 1.0)
    return rows
