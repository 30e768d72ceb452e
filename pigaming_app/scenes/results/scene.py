"""Results scene: the ceremony, the numbers on a second view, and one button for a rematch.

The rows are revealed from last to first, then the winner's name. Input is ignored until then, so that players who are
still firing do not skip it; B, the turbo button, is accepted even later and has to be held. Every player votes with
FIRE; START begins at once; a free device holds FIRE to replace an AI.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Protocol

import pygame

from pigaming_app.games.game import Outcome, Setup
from pigaming_app.games.replay import Replay
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.flow.access import TAKE_SECONDS, Access
from pigaming_app.scenes.flow.scene import Context, Home, Push, Scene, StackOperation, Swap
from pigaming_app.scenes.recordings import store
from pigaming_app.scenes.recordings.store import StoreError
from pigaming_app.scenes.results.awards.ceremony import Ceremony
from pigaming_app.scenes.results.awards.feats import Feats
from pigaming_app.scenes.results.headline import EndedMatch
from pigaming_app.scenes.results.high_scores import HighScores, contest
from pigaming_app.scenes.results.initials import Initials, qualifying
from pigaming_app.scenes.results.podium_page import PodiumPage
from pigaming_app.scenes.results.rematch_vote import RematchVote
from pigaming_app.scenes.results.view import ResultsPage
from pigaming_app.storage.scores import Score
from pigaming_app.ui.draw import ALARM, FOCUS
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets.button_prompts import ButtonPrompts
from pigaming_app.ui.widgets.caption import Caption, caption

INPUT_LOCKOUT = 2.5  # s during which input is ignored
LATE, LEAVE = 5.0, 0.5  # s during which BACK is ignored; s it must be held afterwards
MESSAGE_SECONDS = 3.0  # s, display time of a message
CLAIMS = 2.6  # s before the initials entry
PREWARM_MS = 4.0  # of the second view, per frame
IDLE = 60.0  # s without input before the return to the title

SceneFactory = Callable[
    [Context, Setup, Sequence[Device | None]], Scene
]  # scene that follows a match, for these devices


class ResultsView(Protocol):
    """A view of the results, without the votes."""

    ready_at: float  # s, when it is complete

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm for at most this many milliseconds; True when complete."""

    def sounds(self) -> list[tuple[float, str, int | None]]:
        """Sounds of the reveal: (seconds, name, player)."""

    def draw(self, screen: pygame.Surface, age: float) -> None:
        """Draw the page `age` seconds after it was opened."""


class Results:
    """Results of a match. `devices`: driver of each seat; `finished`: played to its end.

    `rematch`: factory of the rematch; `game_choice`: factory of the game selection, if offered. `ai_assisted`: seats
    that changed drivers during the match; their scores do not count as records. `recording`: the replay, if it can be
    saved. `rounds`: those that led to this outcome; their records count even if the match was ended between them.
    `feats`: of each seat, for the awards; `names`: see `EndedMatch`.
    """

    def __init__(
        self,
        context: Context,
        outcome: Outcome,
        setup: Setup,
        devices: Sequence[Device | None],
        rematch: SceneFactory,
        finished: bool = True,
        ai_assisted: Collection[int] = (),
        game_choice: SceneFactory | None = None,
        recording: Replay | None = None,
        rounds: Rounds | None = None,
        feats: Mapping[int, Feats] | None = None,
        names: Sequence[str] = (),
    ) -> None:
        self.context, self.setup, self.rematch, self.game_choice = context, setup, rematch, game_choice
        self.recording = recording
        seats = [row.seat for row in sorted(outcome.rows, key=lambda row: row.seat)]
        self.ended = EndedMatch(setup, outcome, tuple(devices), names)
        self.ballot = RematchVote(context, seats, self.ended.humans, devices)
        self.ceremony = Ceremony(context, self.ended, finished, feats or {}, rounds)
        self.numbers: ResultsView = (
            PodiumPage(context, self.ended, finished, rounds) if rounds else ResultsPage(context, self.ended, finished)
        )
        self.page: ResultsView = self.ceremony
        own = [None if seat in ai_assisted else device for seat, device in enumerate(devices)]
        self.claims = qualifying(context, outcome, setup, own) if finished or rounds else []
        self.initials = Initials(context, self.claims, self._tables)
        self.sounds = self.ceremony.sounds()
        self.age = self.idle = self.message_left = 0.0
        self.message: Caption | None = None
        self.access = Access(context, lambda: self.ballot.devices)
        self.leaving, self.joining = HoldTimers(context.controls, LEAVE), HoldTimers(context.controls, TAKE_SECONDS)

    @property
    def prompts(self) -> ButtonPrompts:
        """The current button prompts; five at most, to be large: two of them on one view only."""
        awards = self.page is self.ceremony
        hints = [
            (Button.FIRE, "results.again"),
            *([(Button.X, "results.change")] if self.game_choice and awards else []),
            *([] if awards else [(Button.Y, "results.scores")]),
            (Button.RIGHT, "results.numbers" if awards else "results.awards"),
            *([(Button.UP, "results.save")] if self.recording else []),
            (Button.BACK, "results.menu"),
        ]
        return self.context.prompts(hints, device=lambda: self.access.hint_device)

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm the page for at most this many milliseconds; True when complete."""
        return self.ceremony.prewarm(milliseconds)

    def on_enter(self) -> None:
        """First display, or return from initials or tables."""
        self.context.sounds.music("title")
        self.idle = 0.0

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE votes, START begins, X changes the game, Y shows tables, LEFT or RIGHT the other view, UP saves the
        replay, BACK, held, returns to the title.
        """
        event = self.prompts.as_button(event)
        admitted = self.access.admit(event)
        if admitted is None and event.button is not Button.FIRE:
            return None
        self.idle = 0.0
        if self.age < INPUT_LOCKOUT or self.claims:
            return None
        if admitted is None or (event.button is Button.FIRE and event.device.kind != "mouse"):
            self._fire(event)
            return None
        match admitted.button:
            case Button.START | Button.FIRE:
                return self._rematch(everyone=True)
            case Button.X if self.game_choice:
                self.context.sounds.play("accept")
                return Push(self.game_choice(self.context, self.setup, self.ballot.devices))
            case Button.UP if self.recording and not event.repeat:
                self._save(self.recording)
            case Button.LEFT | Button.RIGHT if not admitted.repeat:
                self.page = self.ceremony if self.page is self.numbers else self.numbers
                self.context.sounds.play("move")
            case Button.Y:
                return Push(HighScores(self.context, contest(self.setup)))
            case Button.BACK if admitted.device.kind == "mouse":
                return self._leave()
            case Button.BACK if self.age >= LATE:
                self.leaving.begin(admitted)
        return None

    def update(self, seconds: float) -> StackOperation:
        """Reveal the page, ask for initials, count the votes, leave when idle."""
        self.age += seconds
        self.idle += seconds
        self.message_left -= seconds
        while self.sounds and self.sounds[0][0] <= self.age:
            _, name, player = self.sounds.pop(0)
            self.context.sounds.play(name, player)
        if self.age >= self.ceremony.ready_at:
            self.numbers.prewarm(PREWARM_MS)
        if self.claims:
            self.initials.prewarm()
            if self.age >= CLAIMS:
                self.claims = []
                return Push(self.initials)
        if self.leaving.update(seconds) or self.access.update(seconds):
            return self._leave()
        for event in self.joining.update(seconds):
            if self.ballot.take(event.device):
                self.context.sounds.play("join", self.ballot.devices.index(event.device))
        if self.ballot.update(seconds):
            return self._rematch(everyone=False)
        return Home() if self.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        self.page.draw(screen, self.age + (self.numbers.ready_at if self.page is self.numbers else 0.0))
        if self.age >= self.ceremony.ready_at:
            self.ballot.draw(screen, self.joining.shares.values())
            if self.message and self.message_left > 0.0:
                self.message.draw(screen, 960, self.prompts.y)
            else:
                self.prompts.draw(screen)
            if self.leaving.share:
                hold_bar(screen, self.leaving.share)

    def _fire(self, event: InputEvent) -> None:
        """Count a vote; a free device takes a seat, after holding FIRE if it is an AI's."""
        if self.ballot.vote(event.device):
            self.context.sounds.play("ready", None)
        elif event.device not in self.ballot.devices and self.ballot.takeable:
            self.joining.begin(event)
            self._say(caption(self.context.words("match.hold"), sign="ai"))

    def _tables(self, fresh: Sequence[Score]) -> Scene | None:
        """The tables with new rows, if there are any."""
        return HighScores(self.context, contest(self.setup, self.initials.claims[0].seat), fresh) if fresh else None

    def _save(self, recording: Replay) -> None:
        """Save the replay, once; after a failure again on request."""
        try:
            store.save(recording)
        except StoreError as error:
            self._say(caption(self.context.words(str(error)), ALARM))
            self.context.sounds.play("error")
            return
        self.recording = None
        self._say(caption(self.context.words("results.saved"), sign="check"))
        self.context.sounds.play("accept")

    def _say(self, message: Caption) -> None:
        self.message, self.message_left = message, MESSAGE_SECONDS

    def _leave(self) -> StackOperation:
        self.context.sounds.play("back")
        return Home()

    def _rematch(self, everyone: bool) -> StackOperation:
        self.context.sounds.play("accept")
        return Swap(self.rematch(self.context, self.setup, self.ballot.drivers(everyone)))


def hold_bar(screen: pygame.Surface, share: float) -> None:
    """Draw the hold progress of BACK, `share` 0..1, as a line at the bottom of the page."""
    pygame.draw.line(screen, FOCUS, (960 - 400 * share, 1034), (960 + 400 * share, 1034), 6)
