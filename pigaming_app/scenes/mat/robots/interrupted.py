"""Interface of a match with real robots for the pages above it."""

from collections.abc import Collection, Sequence
from typing import Protocol

from pigaming_app.games.game import Setup
from pigaming_app.games.match import Match
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.flow.stack import Scene
from pigaming_app.scenes.mat.things.moved_page import MatchAmongThings
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.ui.input.events import Device


class MatchOf(Protocol):
    """Match factory; `real`: seats with real robots, `rounds`: see `MatchScene`, `things`: see `match_of`."""

    def __call__(
        self,
        setup: Setup,
        devices: Sequence[Device | None],
        real: Collection[int],
        *,
        rounds: Rounds | None = None,
        things: Sequence[ThingSpec] | None = None,
    ) -> Scene: ...


class InterruptedMatch(MatchAmongThings, Protocol):
    """A paused match with real robots."""

    match: Match

    @property
    def preparing(self) -> bool:
        """True while robots drive to their start positions, and while the countdown runs."""

    @property
    def real(self) -> set[int]:
        """Seats with real robots, including those still driving to their start positions."""

    def set_real(self, seat: int, real: bool) -> None:
        """Hand a seat over to its simulated or its real robot."""
