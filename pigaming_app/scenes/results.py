"""The results: rows and plot, and one button for a rematch.

The rows come in from the last to the first, then the winner's name. Nothing is heard until that is over, so that nobody
who is still firing leaves it unseen. Everyone who played votes with FIRE; START begins at once.
"""

from collections.abc import Callable, Sequence

import pygame

from pigaming_app.games.game import Outcome, Setup
from pigaming_app.scenes.ballot import Ballot
from pigaming_app.scenes.best import Best
from pigaming_app.scenes.feats import contest
from pigaming_app.scenes.house import House
from pigaming_app.scenes.initials import Initials, claims
from pigaming_app.scenes.press import Act, Device, Press
from pigaming_app.scenes.prompts import Prompts
from pigaming_app.scenes.results_page import ResultsPage
from pigaming_app.scenes.stack import Home, Pop, Push, Scene, Swap, Turn

DEAF = 1.2  # seconds in which presses are ignored
CLAIMS = 2.6  # seconds before initials are asked for
IDLE = 60.0  # seconds without a press until the title

Again = Callable[[House, Setup, Sequence[Device | None]], Scene]


class Results:
    """How a match ended. `devices`: who drove each seat; `finished`: it was played to its end."""

    def __init__(
        self,
        house: House,
        outcome: Outcome,
        setup: Setup,
        devices: Sequence[Device | None],
        again: Again,
        finished: bool = True,
    ) -> None:
        self.house, self.setup, self.again = house, setup, again
        seats = [row.seat for row in sorted(outcome.rows, key=lambda row: row.seat)]
        humans = [seat for seat in seats if setup.seats[seat].brain == "human"]
        self.ballot = Ballot(house, seats, humans, devices)
        absent = [seat for seat in humans if devices[seat] is None]
        self.page = ResultsPage(house, outcome, setup, finished, absent)
        self.claims = claims(house, outcome, setup, devices) if finished else []
        self.sounds = self.page.sounds(humans)
        self.age = self.idle = 0.0
        self.prompts = Prompts(
            house,
            [
                (Act.FIRE, "results.again"),
                (Act.EXTRA, "results.change"),
                (Act.ALT, "results.scores"),
                (Act.BACK, "results.menu"),
            ],
        )

    def warm(self, milliseconds: float) -> bool:
        """Make the page for so long; true when all of it is there."""
        return self.page.warm(milliseconds)

    def entered(self) -> None:
        """Shown, or shown again after initials or tables."""
        self.idle = 0.0

    def on(self, press: Press) -> Turn:
        """FIRE votes, START begins, EXTRA goes back to the choice of the match, BACK to the title."""
        self.idle = 0.0
        press = self.prompts.meant(press)
        if self.age < DEAF or self.claims:
            return None
        match press.act:
            case Act.FIRE if press.device.kind != "mouse":
                if self.ballot.vote(press.device):
                    self.house.sounds.play("ready", None)
            case Act.START | Act.FIRE:
                return self._rematch(everyone=True)
            case Act.EXTRA:
                self.house.sounds.play("accept")
                return Pop()
            case Act.ALT:
                return Push(Best(self.house, contest(self.setup)))
            case Act.BACK:
                self.house.sounds.play("back")
                return Home()
            case _:
                pass
        return None

    def update(self, seconds: float) -> Turn:
        """Let the page come, ask for initials, count the votes, leave when nobody is there."""
        self.age += seconds
        self.idle += seconds
        self.page.update(seconds, self.age)
        while self.sounds and self.sounds[0][0] <= self.age:
            _, name, player = self.sounds.pop(0)
            self.house.sounds.play(name, player)
        if self.claims and self.age >= CLAIMS:
            claims, self.claims = self.claims, []
            return Push(Initials(self.house, self.setup, claims))
        if self.ballot.update(seconds):
            return self._rematch(everyone=False)
        return Home() if self.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        """Paint the page, the votes and what the buttons do."""
        self.page.draw(screen, self.age)
        if self.age >= self.page.ready_at:
            self.ballot.draw(screen)
            self.prompts.draw(screen)

    def _rematch(self, everyone: bool) -> Turn:
        self.house.sounds.play("accept")
        return Swap(self.again(self.house, self.setup, self.ballot.drivers(everyone)))
