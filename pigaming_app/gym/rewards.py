"""Rewards: weighted changes of a seat's tallies from one decision to the next.

In every game `win` is 0 until the match is decided for the seat, then 1 for a win, -1 for a defeat and 0 for a tie.
"""

from collections.abc import Mapping
from typing import Any

from pigaming_app.ai.tallies import Tallies, sign
from pigaming_app.games.pitanks.scoring import lead
from pigaming_app.games.registry import OURS
from pigaming_app.sim.kernel import kernel
from pigaming_app.storage.optional import optional
from pigaming_app.storage.plugins.parts import parts


@kernel
def tally_pitanks(match: Any, seat: int, senses: Any, totals: Any) -> None:
    """Hits made and taken, shots, own points, lead of the own team over the best other one, and the win."""
    tank, ahead = match.tanks[seat], lead(match, seat)
    totals[0], totals[1], totals[2] = tank.hits, tank.taken, tank.shots
    totals[3], totals[4] = match.robots[seat].score, ahead
    totals[5] = sign(ahead) if match.over else 0.0


TALLIES: Mapping[str, Tallies] = {
    "pitanks": Tallies(
        ("hits", "taken", "shots", "points", "lead", "win"),
        {"hits": 1.0, "taken": -1.0, "win": 5.0},
        tally_pitanks,
    ),
    **{game: room.TALLIES for game in OURS if (room := optional(f"gym.{game}"))},
    **parts("training", "TALLIES", Tallies),
}  # by game
