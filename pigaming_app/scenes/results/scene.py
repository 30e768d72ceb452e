"""The results: rows and plot, and one button for a rematch.

The rows come in from the last to the first, then the winner's name. Nothing is heard until that is over, so that nobody
who is still firing leaves it unseen; B, the turbo, counts even later and has to be held. Everyone who played votes with
FIRE; START begins at once; a free device holds FIRE to play instead of an AI.
"""

from collections.abc import Callable, Collection, Sequence

import pygame

from pigaming_app.games.game import Outcome, Setup
from pigaming_app.scenes.flow.access import TAKE, Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Home, Push, Scene, Swap, Turn
from pigaming_app.scenes.results.high_score_tables import contest
from pigaming_app.scenes.results.high_scores import HighScores
from pigaming_app.scenes.results.initials import Initials, claims
from pigaming_app.scenes.results.rematch_vote import RematchVote
from pigaming_app.scenes.results.view import ResultsPage
from pigaming_app.ui.draw import FOCUS
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets.caption import caption

DEAF = 2.5  # seconds in which presses are ignored
LATE, LEAVE = 5.0, 0.5  # seconds in which BACK is ignored, and for which it then has to be held
SAID = 3.0  # seconds for which a sentence stays
CLAIMS = 2.6  # seconds before initials are asked for
IDLE = 60.0  # seconds without a press until the title

After = Callable[[Context, Setup, Sequence[Device | None]], Scene]  # what follows a match, driven with these devices


class Results:
    """How a match ended. `devices`: who drove each seat; `finished`: it was played to its end.

    `again`: makes the rematch; `game_choice`: makes the page that offers another game, if any.
    `helped`: the seats that were not driven by the same person all the time; what they scored is no record.
    """

    def __init__(
        self,
        context: Context,
        outcome: Outcome,
        setup: Setup,
        devices: Sequence[Device | None],
        again: After,
        finished: bool = True,
        helped: Collection[int] = (),
        game_choice: After | None = None,
    ) -> None:
        self.context, self.setup, self.again, self.game_choice = context, setup, again, game_choice
        seats = [row.seat for row in sorted(outcome.rows, key=lambda row: row.seat)]
        humans = [seat for seat in seats if setup.seats[seat].brain == "human" or devices[seat]]
        self.ballot = RematchVote(context, seats, humans, devices)
        absent = [seat for seat in humans if devices[seat] is None]
        self.page = ResultsPage(context, outcome, setup, finished, absent)
        own = [None if seat in helped else device for seat, device in enumerate(devices)]
        self.claims = claims(context, outcome, setup, own) if finished else []
        self.initials = Initials(context, setup, self.claims)
        self.sounds = self.page.sounds(humans)
        self.age = self.idle = self.told = 0.0
        self.access = Access(context, lambda: self.ballot.devices)
        self.leaving, self.joining = HoldTimers(context.controls, LEAVE), HoldTimers(context.controls, TAKE)
        hints = [
            (Button.FIRE, "results.again"),
            *([(Button.X, "results.change")] if game_choice else []),
            (Button.Y, "results.scores"),
            (Button.BACK, "results.menu"),
        ]
        self.prompts = context.prompts(hints, voice=lambda: self.access.voice)

    def warm(self, milliseconds: float) -> bool:
        """Make the page for so long; true when all of it is there."""
        return self.page.warm(milliseconds)

    def entered(self) -> None:
        """Shown, or shown again after initials or tables."""
        self.idle = 0.0

    def on(self, event: InputEvent) -> Turn:
        """FIRE votes, START begins, X leads to another game, BACK, held, to the title."""
        event = self.prompts.as_button(event)
        admitted = self.access.admit(event)
        if admitted is None and event.button is not Button.FIRE:
            return None
        self.idle = 0.0
        if self.age < DEAF or self.claims:
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
            case Button.Y:
                return Push(HighScores(self.context, contest(self.setup)))
            case Button.BACK if admitted.device.kind == "mouse":
                return self._leave()
            case Button.BACK if self.age >= LATE:
                self.leaving.begin(admitted)
            case _:
                pass
        return None

    def update(self, seconds: float) -> Turn:
        """Let the page come, ask for initials, count the votes, leave when nobody is there."""
        self.age += seconds
        self.idle += seconds
        self.told -= seconds
        self.page.update(seconds, self.age)
        while self.sounds and self.sounds[0][0] <= self.age:
            _, name, player = self.sounds.pop(0)
            self.context.sounds.play(name, player)
        if self.claims:
            self.initials.warm()
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
        """Paint the page, the votes and what the buttons do."""
        self.page.draw(screen, self.age)
        if self.age >= self.page.ready_at:
            self.ballot.draw(screen, self.joining.shares.values())
            if self.told > 0.0:
                caption(self.context.words("match.hold"), sign="ai").draw(screen, 960, self.prompts.y)
            else:
                self.prompts.draw(screen)
            if self.leaving.share:
                filled(screen, self.leaving.share)

    def _fire(self, event: InputEvent) -> None:
        """A vote; of a free device a seat, for which FIRE is held where it is an AI's."""
        if self.ballot.vote(event.device):
            self.context.sounds.play("ready", None)
        elif event.device not in self.ballot.devices and self.ballot.takeable:
            self.joining.begin(event)
            self.told = SAID

    def _leave(self) -> Turn:
        self.context.sounds.play("back")
        return Home()

    def _rematch(self, everyone: bool) -> Turn:
        self.context.sounds.play("accept")
        return Swap(self.again(self.context, self.setup, self.ballot.drivers(everyone)))


def filled(screen: pygame.Surface, share: float) -> None:
    """A line at the foot of a page that fills while BACK is held, `share` 0..1."""
    pygame.draw.line(screen, FOCUS, (960 - 400 * share, 1034), (960 + 400 * share, 1034), 6)
