"""Who plays next, in a format on call: a challenge, or a try.

Everybody stands here by the table. FIRE on a name calls them: to a try at once, or together with others if a match has
room for more; on a ladder FIRE chooses who challenges, then whom. The match follows on its own page.
"""

import logging

import pygame

from pigaming_app.events.formats import challenge
from pigaming_app.events.formats.field import OnCall
from pigaming_app.events.spec import Entrant, Format, Standing
from pigaming_app.scenes.events.next_page import NextMatch
from pigaming_app.scenes.events.overview import figure_of
from pigaming_app.scenes.events.podium_page import EventPodiumPage
from pigaming_app.scenes.events.running import RunningEvent, progress_line
from pigaming_app.scenes.events.setup.entrants_page import cell, spots_of
from pigaming_app.scenes.events.setup.letters_page import LettersPage
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation, Swap
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.ui.draw import FOCUS, LINE, cut_box
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out, heading

NAME_ROOM = 560  # px, of a name in the heading

log = logging.getLogger("pigaming")


class ArrangePage(Page):
    """The page of a running event. `called`: who has been chosen so far."""

    idle = 300.0

    def __init__(self, context: Context, running: RunningEvent) -> None:
        self.running = running
        self.called: list[str] = []
        self.resume = True  # an open match comes first
        super().__init__(context, Focus(self._spots()))

    def on_enter(self) -> None:
        """First display, or return from a match."""
        self.context.sounds.music("title")
        self.running.refresh()
        self.called = []
        self.focus.set_spots(self._spots())

    # ---- input

    @property
    def hints(self) -> Hints:
        begins = self.called and not self._ladder
        return [
            (Button.FIRE, "events.hint_choose"),
            *([(Button.START, "events.hint_play")] if begins or self.running.event.open else []),
            (Button.X, "events.hint_table"),
            *([(Button.Y, "events.hint_late")] if self.running.accepts_late else []),
            (Button.BACK, "events.hint_back"),
        ]

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE calls somebody, START begins, Y enters somebody, X shows the table."""
        match event.button:
            case Button.X:
                self.context.sounds.play("accept")
                return Push(TablePage(self.context, self.running))
            case Button.Y if self.running.accepts_late:
                self.context.sounds.play("accept")
                names = [entrant.name for entrant in self.running.event.entrants]
                return Push(LettersPage(self.context, self._add, lambda: names))
            case Button.START:
                return self._start()
        return super().press(event)

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        """Call somebody, or take the call back."""
        who = self.rows[int(name)].entrant
        if who in self.called:
            self.called.remove(who)
            self.context.sounds.play("back")
            return None
        if not self._can(who):
            self._refuse(who)
            return None
        self.called.append(who)
        self.context.sounds.play("accept")
        if self._ladder and len(self.called) == 1:
            nearest = challenge.in_reach(self.running.event.progress.as_field(), who)[0]
            self.focus.move_to(str([row.entrant for row in self.rows].index(nearest)))
        return self._start() if len(self.called) == self._room else None

    def leave(self) -> StackOperation:
        """Take the calls back, or go back."""
        if self.called:
            self.called = []
            self.context.sounds.play("back")
            return None
        return super().leave()

    def advance(self, seconds: float) -> StackOperation:
        """An open match comes first; after the last period the podium."""
        if self.running.event.over:
            return Swap(EventPodiumPage(self.context, self.running))
        if self.resume and self.running.event.open:
            self.resume = False
            return Push(NextMatch(self.context, self.running))
        self.resume = False
        return None

    # ---- drawing

    @property
    def heading(self) -> LitImage:
        words = self.context.words
        if not self._ladder:
            title = words("events.who_tries")
        elif self.called:
            title = words("events.challenged", name=fit_text(self.called[0], 96, NAME_ROOM, "hero", 96)[0])
        else:
            title = words("events.challenger")
        return heading(title, progress_line(words, self.running.event))

    def paint(self, screen: pygame.Surface) -> None:
        """Draw everybody with their place, or their best try."""
        words, event = self.context.words, self.running.event
        black_out(screen, *(spot.rect for spot in self.focus.spots))
        brains = {entrant.name: entrant.brain for entrant in event.entrants}
        for spot, row in zip(self.focus.spots, self.rows, strict=True):
            hot, note = spot.name == self.focus.name, str(row.place)
            if not self._ladder:
                note = figure_of(words, row, "best")
            can = row.entrant in self.called or self._can(row.entrant)
            cell(row.entrant, note, bool(brains[row.entrant]), spot.rect.size, hot, can).draw(
                screen, *spot.rect.topleft
            )
            if row.entrant in self.called:
                ring(spot.rect.size).draw(screen, *spot.rect.topleft)
        self.focus.draw(screen)

    # ---- inside

    @property
    def rows(self) -> list[Standing]:
        """Everybody who is there, best first."""
        event = self.running.event
        return [row for row in event.standings if row.entrant not in event.withdrawn]

    @property
    def _on_call(self) -> OnCall:
        on_call = self.running.event.progress.kind.on_call
        assert on_call
        return on_call

    @property
    def _ladder(self) -> bool:
        return self.running.event.spec.format is Format.CHALLENGE

    @property
    def _room(self) -> int:
        """How many are called to a match."""
        return self.running.event.spec.seats

    def _can(self, who: str) -> bool:
        """True if somebody can be called besides those who are."""
        field = self.running.event.progress.as_field()
        if self._ladder:
            return (
                who in challenge.in_reach(field, self.called[0])
                if self.called
                else bool(challenge.in_reach(field, who))
            )
        try:
            self._on_call.check(field, (*self.called, who))
        except ValueError:
            return False
        return True

    def _start(self) -> StackOperation:
        """The match of those who are called; without any, the one that is open."""
        if not self.called or (self._ladder and len(self.called) < 2):
            if self.running.event.open and not self.called:
                self.context.sounds.play("accept")
                return Push(NextMatch(self.context, self.running))
            self.context.sounds.play("refused")
            return None
        names, self.called = tuple(self.called), []
        try:
            saved = self.running.change(lambda event: event.arrange(*names))
        except ValueError as reason:
            log.warning("%s", reason)
            self._refuse(names[-1])
            return None
        if not saved:
            self.show_message(self.context.words("app.unsaved"), wrong=True)
        self.context.sounds.play("ready")
        return Push(NextMatch(self.context, self.running))

    def _refuse(self, who: str) -> None:
        self.show_message(self.context.words("events.no_call", name=who))
        self.context.sounds.play("refused")

    def _add(self, name: str) -> str:
        """Enter somebody; returns the sentence why not, or an empty one."""
        words = self.context.words
        if any(entrant.name == name for entrant in self.running.event.entrants):
            return words("events.taken", name=name)
        try:
            return "" if self.running.change(lambda event: event.add(Entrant(name))) else words("app.unsaved")
        except ValueError as reason:
            log.warning("%s", reason)
            return words("events.too_late")

    def _spots(self) -> list[FocusSpot]:
        return spots_of(len(self.rows))


@cached
def ring(size: tuple[int, int]) -> LitImage:
    """Round a name that is called; top left at (0, 0)."""
    layer = Layer(0, 0, *size)
    layer.glow.line(cut_box(5, 5, size[0] - 10, size[1] - 10, 10), FOCUS, LINE, True)
    return layer.render()
