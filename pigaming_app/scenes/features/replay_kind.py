"""The contract of replays whose matches cannot be simulated again."""

from collections.abc import Callable
from typing import Protocol

import pygame

from pigaming_app.games.match import Match
from pigaming_app.games.replay import Replay
from pigaming_app.games.timeline import Timeline
from pigaming_app.ui.i18n import Words


class Marks(Protocol):
    """What a replay shows besides the match."""

    def draw(self, screen: pygame.Surface, tick: int) -> None:
        """Draw over the match at a tick."""

    def draw_marks(self, screen: pygame.Surface, place: Callable[[int], float], y: int) -> None:
        """Draw below the timeline at `y` (px); `place`: x (px) of a tick."""


class ReplayKind(Protocol):
    """A kind of replays whose matches cannot be simulated again."""

    def replay_of(self, match: Match) -> Replay | None:
        """The replay of a match, up to its current tick; None if it is not of this kind."""

    def pack(self, plain: bytes, replay: Replay) -> bytes | None:
        """The contents of a file; `plain`: those of the replay without what makes its kind."""

    def decode(self, raw: bytes, name: str, decode: Callable[[bytes, str], Replay]) -> Replay | None:
        """Unpack the contents of a file; `decode`: of the plain part. Raises ReplayError."""

    def prepare(self, match: Match, replay: Replay) -> None:
        """Make a match before its first tick repeat a replay of this kind."""

    def timeline(self, replay: Replay) -> Timeline | None:
        """Random access to a replay of this kind."""

    def marks(self, replay: Replay, words: Words) -> Marks | None:
        """What it shows besides the match."""
