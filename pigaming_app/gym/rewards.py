"""Rewards: weighted changes of a seat's tallies from one decision to the next, or code over named quantities.

The quantities are the changes of the tallies; in PiTanks also those of the Lab's reward lines.

In every game `win` is 0 until the match is decided for the seat, then 1 for a win, -1 for a defeat and 0 for a tie.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from inspect import signature
from typing import Any

import numpy as np

from pigaming_app.ai.networks.pitanks_rewards import quantities_of
from pigaming_app.ai.reward_line import elementwise, points_of, program_of
from pigaming_app.ai.reward_quantities import QUANTITIES
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


def names_of(game: str) -> tuple[str, ...]:
    """What the code of a reward may use in a game."""
    tallies = TALLIES[game].names
    return (*tallies, *(name for name in QUANTITIES if name not in tallies)) if game == "pitanks" else tallies


def rows_of(game: str, gains: Any, inputs: Any, actions: Any, sticks: bool) -> Any:
    """The quantities (..., k) of decisions: `gains` (..., tallies), `inputs` seen before, `actions` and `sticks`."""
    if game != "pitanks":
        return gains
    tallies = TALLIES[game].names
    hits, taken = (gains[..., tallies.index(name)] for name in ("hits", "taken"))
    seen = quantities_of(hits, taken, inputs, actions, sticks)
    return np.concatenate([gains, seen[..., [name not in tallies for name in QUANTITIES]]], axis=-1)


def require_finite(code: Any, rewards: Any) -> None:
    """Raises ValueError, which names the code, unless all its rewards (...) are finite numbers."""
    if not (finite := np.isfinite(rewards)).all():
        wrong = np.asarray(rewards)[~finite].flat[0]
        name = getattr(code, "__name__", type(code).__name__)
        raise ValueError(f"reward {name}: a finite number is needed, not {wrong}")


@dataclass(frozen=True)
class CodedReward:
    """A reward as code: a line, or a function whose parameters are names of quantities."""

    game: str
    code: str | Callable[..., float]
    fast: bool

    def __post_init__(self) -> None:
        """Raises ValueError."""
        names = names_of(self.game)
        if isinstance(self.code, str):
            program_of(self.code or " ", names)
            return
        parameters = list(signature(self.code).parameters.values())
        for one in parameters:
            if one.kind not in (one.POSITIONAL_ONLY, one.POSITIONAL_OR_KEYWORD):
                raise ValueError(f"parameter '{one.name}' must be positional")
        unknown = [one.name for one in parameters if one.name not in names]
        if unknown or not parameters:
            found = f"parameter '{unknown[0]}'" if unknown else "function without parameters"
            raise ValueError(f"{found}; there are {', '.join(names)}")

    def __call__(self, rows: Any) -> Any:
        """The rewards (...) for the quantities of rows (..., k). Raises ValueError unless all are finite numbers."""
        with np.errstate(all="ignore"):
            found = np.asarray(self._judge(rows), float)
        require_finite(self.code, found)
        return found

    @cached_property
    def _judge(self) -> Callable[[Any], Any]:
        names = names_of(self.game)
        if isinstance(self.code, str):
            program = program_of(self.code, names)
            return lambda rows: points_of(program, rows, self.fast)
        places = [names.index(name) for name in signature(self.code).parameters]
        function = elementwise(self.code, len(places), self.fast)
        return lambda rows: function(*(rows[..., place] for place in places))
