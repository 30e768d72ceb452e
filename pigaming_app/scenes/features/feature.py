"""The contract of a feature: screens and services that the core offers when they are there, and runs without.

A feature declares itself as `FEATURE` in `scenes/NAME/feature.py`, or without screens in `jobs/NAME/feature.py`, and
has its page beside it, README.md. The former is imported before the title appears, so it imports its own screens late;
`registry.py` lists its name. Jobs of a feature are declared in `jobs/NAME/__init__.py`.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, Protocol

import pygame

from pigaming_app.games.match import Match
from pigaming_app.games.replay import Replay
from pigaming_app.games.timeline import Timeline
from pigaming_app.scenes.features.board_page import BoardPage
from pigaming_app.scenes.flow.scene import Context, RobotMat, Scene, Stack, StackOperation
from pigaming_app.scenes.launch import Options
from pigaming_app.ui.draw import GlowCanvas
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Device, InputEvent
from pigaming_app.ui.window import Pin

if TYPE_CHECKING:  # the title does not wait for these
    from pigaming_app.games.match import Match
    from pigaming_app.scenes.views.view import MatchView


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


class MenuItem(NamedTuple):
    """An item of the title's menu; its word is the text `title.NAME`. `open` gets the game that was focused last."""

    place: int  # from the left
    open: Callable[[Context, str], Scene]


class OptionRow(NamedTuple):
    """A row of the options that opens a page; its words are the texts `options.NAME` and `options.NAME_line`."""

    section: str  # of the options; empty: the first page
    after: str  # the row that it follows; if that is missing, it comes last
    page: Callable[[Context], Scene]
    picture: Callable[[GlowCanvas, int], object]  # draws round (0, 0); `beat`: 0 or 1, twice a second
    for_children: bool = False  # they may open it in a kiosk


class Show(NamedTuple):
    """A page of attract mode. `paint` draws it without what only a visitor needs."""

    page: Scene
    paint: Callable[[pygame.Surface], None]


class Service:
    """Part of the running arcade, called by its main loop. Each method does nothing unless a service has its own."""

    @property
    def has_window(self) -> bool:
        """True while it has a window of its own."""
        return False

    def first_page(self) -> Scene | None:
        """The page to show on top of the title at the start and after a failure, if any."""
        return None

    def preloaded(self) -> None:
        """Everything that the title has loaded in the background is there. Called by another thread."""

    def filter(self, events: Sequence[pygame.Event], scenes: Sequence[Scene]) -> list[pygame.Event]:
        """Those of the events of a frame that go on to the arcade."""
        return list(events)

    def update(self, seconds: float, stack: Stack) -> None:
        """Advance by `seconds`, after the scene on top, if any is left."""

    def draw(self, screen: pygame.Surface) -> None:
        """Draw over the scene on top."""

    def show(self, seconds: float, left: float, scenes: Sequence[Scene]) -> None:
        """Work after the picture is shown. `left`: s of this frame that nobody else needs."""

    def close_if_requested(self, event: pygame.Event) -> bool:
        """Close the own window if an event requests it; true if so."""
        return False

    def close(self) -> None:
        """The arcade ends."""


class JoinOffer(Protocol):
    """Another way to take a seat than by the devices at hand."""

    @property
    def on(self) -> bool:
        """True if it is switched on."""

    @property
    def open(self) -> bool:
        """True if people can join now."""

    def draw_code(self, screen: pygame.Surface, box: pygame.Rect) -> None:
        """Draw the code to scan in the middle of a box."""

    def page(
        self,
        devices: Callable[[], Sequence[Device | None]],
        lobby: Callable[[InputEvent], StackOperation] | None = None,
        ready: Callable[[], bool] = lambda: False,
    ) -> Scene:
        """The page with the code. `devices`: of the seats. `lobby`: handles presses of those who join; None over a
        paused match. `ready`: true when the lobby goes on.
        """


class MatchOverlay(Protocol):
    """Drawn over a match for one of its AIs at a time."""

    seat: int | None  # of the AI that is shown

    @property
    def seats(self) -> Sequence[int]:
        """The seats of AIs that can be shown."""

    def next(self) -> None:
        """Show the first AI, then the next; after the last, none."""

    def draw(self, screen: pygame.Surface, blend: float, seconds: float) -> None:
        """Draw it, if one is shown, `seconds` after the previous picture; `blend`: between the last two ticks."""


@dataclass(frozen=True)
class Feature:
    """What a feature consists of, and what it offers the arcade; all of the latter is optional."""

    name: str
    rooms: Sequence[str]  # its packages and modules in `pigaming_app`; it is offered with all of them only
    needs: Sequence[str] = ()  # rooms of other features without which it is not offered
    menu: MenuItem | None = None
    options: Mapping[str, OptionRow] = field(default_factory=dict)
    idle: Callable[[Context], Scene] | None = None  # over the title while nobody plays
    show: Callable[[Context, str], Show | None] | None = None  # of a game, for attract mode
    service: Callable[[Context, Options], Service | None] | None = None
    join: Callable[[Context], JoinOffer] | None = None
    draw_arena: Callable[[Context, str], Callable[[], Scene] | None] | None = None  # opens the drawn arenas of a game
    overlay: Callable[["Match", "MatchView", Words], MatchOverlay] | None = None
    board_pages: Callable[[Context], Sequence[BoardPage]] | None = None  # of the second screen
    next_line: Callable[[Context, Sequence[Scene]], str] | None = None  # what comes next, for the second screen
    without_limit: Callable[[Sequence[Scene]], bool] | None = None  # the time limit of a group does not apply
    saved_brains: Callable[[], Sequence[Path]] | None = None  # files of PiTanks robots that visitors have trained
    mat: Callable[[Context, Options], RobotMat] | None = None
    corner_pin: Callable[[Sequence[float]], Pin] | None = None  # warps to eight numbers, px; raises OperatorError
    replays: Callable[[], ReplayKind] | None = None  # a kind of its own
    preload: Sequence[str] = ()  # modules, loaded in the background in this order
