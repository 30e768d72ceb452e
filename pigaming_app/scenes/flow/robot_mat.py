"""What the core asks of a mat with real robots; without one, all robots are simulated."""

from collections.abc import Callable, Collection, Sequence
from typing import Any, Protocol

from pigaming_app.games.game import Setup
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.flow.stack import Scene
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.input.events import Device, StickState


class RobotMat(Protocol):
    """The real robots of a running arcade."""

    @property
    def available(self) -> bool:
        """True if seats can be given to real robots."""

    @property
    def problem(self) -> OperatorMessage | None:
        """Why the settings forbid matches with real robots, or None."""

    @property
    def scans(self) -> bool:
        """True if our own camera finds things on the mat."""

    @property
    def things(self) -> tuple[ThingSpec, ...]:
        """The things on the mat, as they were scanned last; none if blocks mark them."""

    def has_room(self, game: str, arena: str, robots: Collection[int]) -> bool:
        """True if these real robots are narrow enough on their surface for an arena."""

    def stick(self, seat: int, first: bool) -> StickState | None:
        """The joystick of a seat in a network of robots; None without one. `first`: it is the first person's."""

    def arena_page(self, devices: Callable[[], Sequence[Device | None]]) -> Scene:
        """The page on which an arena is built of real things."""

    def match(
        self,
        setup: Setup,
        devices: Sequence[Device | None],
        real: Collection[int],
        game_choice: Callable[..., Scene] | None = None,
        rounds: Rounds | None = None,
        things: Sequence[ThingSpec] | None = None,
        after: Callable[..., Any] | None = None,
    ) -> Scene:
        """The match with real robots on the seats `real`, or the page with the reason why not. `things`: on the mat;
        None: as they were scanned last, unless they are blocks. The rest: see `MatchScene`.
        """

    def stop(self) -> None:
        """Stop all robots; a match may follow."""

    def end(self) -> None:
        """Close for good."""
