"""The events: a new one, and those that were begun, each where it stopped."""

import logging
import secrets
from datetime import date
from pathlib import Path

import pygame

from pigaming_app.ai.registry import find_brain
from pigaming_app.events import event_files
from pigaming_app.events.event import Event
from pigaming_app.events.match_setup import check_playable
from pigaming_app.scenes.events.arrange_page import ArrangePage
from pigaming_app.scenes.events.manage.event_page import EventPage
from pigaming_app.scenes.events.next_page import NextMatch
from pigaming_app.scenes.events.podium_page import EventPodiumPage
from pigaming_app.scenes.events.running import RunningEvent, progress_line
from pigaming_app.scenes.events.setup.draft import Draft
from pigaming_app.scenes.events.setup.page import SetupPage
from pigaming_app.scenes.flow.scene import Context, Home, Pop, Push, Scene, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, STEEL, THIN, cut_box, icon
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, fit_text, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out

ROWS, TOP, HIGH, PITCH = 7, 212, 88, 104  # px; the first row begins a new event
NEW = "new"
SEEDS = 10_000  # an event's fixtures derive theirs from this one

log = logging.getLogger("pigaming")


class EventsPage(Page):
    """The list of events, the one played last first."""

    title, idle = "events.title", 60.0
    hints = ((Button.FIRE, "events.hint_choose"), (Button.Y, "events.hint_manage"), (Button.BACK, "events.hint_back"))

    def __init__(self, context: Context) -> None:
        super().__init__(context, Focus([FocusSpot(NEW, row_box(0))]))
        self.saved: list[event_files.Listed] = []

    def on_enter(self) -> None:
        """Read the list of events."""
        self.context.sounds.music("title")
        self.saved = event_files.saved_events(folders().data / event_files.FOLDER, ROWS - 1)
        self.focus.set_spots(
            [FocusSpot(name, row_box(i)) for i, name in enumerate((NEW, *map(str, range(len(self.saved)))))]
        )

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE opens an event, or begins a new one; Y manages an event."""
        if event.button is Button.Y and self.focus.name != NEW:
            self.context.sounds.play("accept")
            listed = self.saved[int(self.focus.name)]
            running = RunningEvent(listed.path, listed.event) if listed.event else None
            return Push(EventPage(self.context, listed.path, running, Pop()))
        return super().press(event)

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        if name == NEW:
            self.context.sounds.play("accept")
            return Push(SetupPage(self.context, Draft(), self.begin))
        listed = self.saved[int(name)]
        if listed.event is None:
            self.context.sounds.play("refused")
            return None
        self.context.sounds.play("accept")
        return Push(page_of(self.context, RunningEvent(listed.path, listed.event)))

    @property
    def subtitle(self) -> str:
        return self.context.words("events.invitation")

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the rows."""
        words = self.context.words
        black_out(screen, *(spot.rect for spot in self.focus.spots))
        for i, spot in enumerate(self.focus.spots):
            hot = spot.name == self.focus.name
            if i == 0:
                row("plus", words("events.new"), "", "", hot).draw(screen, *spot.rect.topleft)
            else:
                self._row(self.saved[i - 1], hot).draw(screen, *spot.rect.topleft)
        if not self.saved:
            text(words("events.none"), LABEL, MIST, "head").draw(screen, 960, 560)
        self.focus.draw(screen)

    def begin(self, draft: Draft) -> StackOperation | str:
        """Make and save a new event; returns the page of its first match, or the sentence why there is none."""
        words, folder = self.context.words, folders().data / event_files.FOLDER
        title = f"{words(f'events.{draft.format.value}')} {words.day_of_year(date.today())}"
        event = Event(draft.spec(title, secrets.randbelow(SEEDS) + 1))
        try:
            _ = event.progress
            check_playable(event.spec, find_brain)
            folder.mkdir(parents=True, exist_ok=True)
            running = RunningEvent(Path(event_files.path_of(title, folder)), event)
            event_files.save(running.path, event)
        except ValueError as reason:
            log.warning("%s", reason)
            return words("events.impossible")
        except (NotSaved, OSError) as reason:
            log.warning("%s", reason)
            return words("app.unsaved")
        return Home(page_of(self.context, running))

    def _row(self, listed: event_files.Listed, hot: bool) -> LitImage:
        words, event = self.context.words, listed.event
        if event is None:
            return row("cross", words("events.damaged", name=listed.path.name), "", "", hot)
        count = words("events.count", count=len(event.entrants))
        state = words("events.over") if event.over else progress_line(words, event)
        return row("crown" if event.over else "play", event.spec.title, count, state, hot)


def page_of(context: Context, running: RunningEvent) -> Scene:
    """The page with which an event goes on; one of AIs alone does so by itself."""
    if running.event.over:
        return EventPodiumPage(context, running)
    alone = all(entrant.brain for entrant in running.event.entrants)
    if running.event.progress.kind.on_call and not alone:
        return ArrangePage(context, running)
    return NextMatch(context, running, show=alone)


def row_box(i: int) -> pygame.Rect:
    """Rectangle of the i-th row."""
    return pygame.Rect(LEFT, TOP + PITCH * i, RIGHT - LEFT, HIGH)


@cached
@resumable
def row(sign: str, title: str, count: str, state: str, hot: bool) -> Steps[LitImage]:
    """A row; top left at (0, 0)."""
    w = RIGHT - LEFT
    layer = Layer(0, 0, w, HIGH)
    layer.glow.line(cut_box(0, 0, w, HIGH, 16), FOCUS if hot else STEEL, THIN, True)
    icon(layer.glow, sign, 58, HIGH / 2, 22, FOCUS if hot or sign == "crown" else MIST, 4)
    title, size = fit_text(title, LABEL, 690 if count else w - 160, "head", BODY)
    layer.canvas.text(title, size, 116, HIGH / 2, FOCUS if hot else ICE, "head")
    yield
    layer.canvas.body(count, 830, HIGH / 2, MIST, "l", fit_size(count, BODY, 300, "body"))
    layer.canvas.body(state, w - 40, HIGH / 2, ICE if hot else MIST, "r", fit_size(state, BODY, 540, "body"))
    yield
    return (yield from layer.render_steps())
