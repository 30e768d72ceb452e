"""A match with real robots as the pages above it see it."""

from collections.abc import Callable, Collection, Sequence
from typing import Protocol

from pigaming_app.games.game import Setup
from pigaming_app.games.match import Match
from pigaming_app.hardware.control.mixed_plant import MixedPlant
from pigaming_app.hardware.session.real import Mat
from pigaming_app.scenes.calibration.corner_markers import DriftWatch
from pigaming_app.scenes.flow.stack import Scene
from pigaming_app.scenes.play.pause import PausedMatch
from pigaming_app.ui.input.events import Device

MatchOf = Callable[[Setup, Sequence[Device | None], Collection[int]], Scene]  # with which devices, which seats real


class InterruptedMatch(PausedMatch, Protocol):
    """A match with real robots that waits."""

    match: Match
    plant: MixedPlant
    mat: Mat
    watch: DriftWatch

    @property
    def real(self) -> set[int]:
        """The seats whose robots are real, or will be once they have taken their places."""

    def swap(self, seat: int, real: bool) -> None:
        """Hand a seat to its simulated or its real robot."""

    def paired(self, channels: Sequence[int], well: Collection[int]) -> None:
        """Which radio drives which robot has been found anew; the robots `well` turned as they should."""
