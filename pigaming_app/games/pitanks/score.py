"""PiTanks: what a hit counts, whatever made it."""

from typing import Any

from pigaming_app.games.pitanks.state import SHIELD
from pigaming_app.sim.kernel import kernel


@kernel
def score(match: Any, k: int, victim: int) -> int:
    """Robot k has hit robot `victim`. 1 if it counts; a shield takes it and is gone."""
    tank = match.tanks[victim]
    tank.protected = match.rules.protection
    if tank.powers[SHIELD]:
        tank.powers[SHIELD] = 0
        return 0
    match.robots[k].score += 1
    match.tanks[k].hits += 1
    match.robots[victim].score -= 1
    tank.taken += 1
    return 1
