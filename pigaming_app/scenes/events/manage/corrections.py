"""The results of an event, newest first, and the correction of one of them with a note.

In a kiosk the button is held until a correction opens: visitors can read the results.
"""

import logging
from dataclasses import dataclass

import pygame

from pigaming_app.events.event import Event
from pigaming_app.events.match_setup import setup_of
from pigaming_app.events.spec import WALKOVER, Fixture, Result
from pigaming_app.scenes.events.names import places_line, places_of, shortened
from pigaming_app.scenes.events.overview import worth
from pigaming_app.scenes.events.running import RunningEvent, decided_by, round_name
from pigaming_app.scenes.flow.access import HOLD, HOLD_WITHOUT_PIN, Right, Roles
from pigaming_app.scenes.flow.scene import Context, Pop, Push, StackOperation, Swap
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, STEEL, THIN, cut_box, icon, text_width
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, fit_text, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets import setting_row
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out, heading
from pigaming_app.ui.widgets.setting_row import SettingValue

ROWS, TOP, HIGH, PITCH = 7, 212, 88, 104  # px
RESULT_ROOM = RIGHT - LEFT - 570  # px
NOTES = ("note_referee", "note_robot", "note_agreed", "note_seats")
LABEL_ROOM = 430  # px, of a name in a row
MAX_NOTE = 40  # characters
NOTE, SAVE = " note", " save"  # rows below the entrants, whose names begin with no space

log = logging.getLogger("pigaming")


class ResultsList(Page):
    """The matches that have been played, on pages of ROWS."""

    title = "events.results"
    idle, when_idle, stay = 60.0, Pop(), HOLD_WITHOUT_PIN
    hints = (
        (Button.FIRE, "events.hint_correct"),
        (Button.Y, "events.hint_again"),
        (Button.RIGHT, "events.hint_page"),
        (Button.BACK, "events.hint_back"),
    )

    def __init__(self, context: Context, running: RunningEvent) -> None:
        super().__init__(context, Focus([FocusSpot("0", row_box(0))]))
        self.running, self.page = running, 0
        self.roles = context.shared(Roles)
        self.holding = HoldTimers(context.controls, HOLD_WITHOUT_PIN)
        self._show()

    def prewarm(self, milliseconds: float) -> bool:
        """Nothing to do: its rows are rendered as they are drawn."""
        return True

    def on_enter(self) -> None:
        """First display, or return from a correction or a match."""
        self.context.sounds.music("title")
        self._show()

    def press(self, event: InputEvent) -> StackOperation:
        """UP and DOWN select a result, LEFT and RIGHT turn the page, FIRE corrects it."""
        if event.button in (Button.LEFT, Button.RIGHT):
            self.page = max(0, min(self.pages - 1, self.page + (1 if event.button is Button.RIGHT else -1)))
            self._show()
            self.context.sounds.play("move")
            return None
        if event.button is Button.Y and self.shown:
            return self._watch(self.shown[int(self.focus.name)])
        before = self.focus.name
        turn = super().press(event)
        if self.focus.name != before:
            self.holding.clear()
        return turn

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        """Correct a result; in a kiosk without a PIN the button is held."""
        if not self.shown:
            return None
        if self.roles.hold == HOLD or not self.roles.may(event.device, Right.EVENTS):
            return self._correct(name)
        self.context.sounds.play("move")
        self.show_message(self.context.words("events.hold"))
        self.holding.clear()
        self.holding.begin(event)
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Open a correction once the button has been held long enough."""
        return self._correct(self.focus.name) if self.holding.update(seconds) else None

    @property
    def subtitle(self) -> str:
        return self.context.words("events.page", page=self.page + 1, of=self.pages) if self.pages > 1 else ""

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the results of this page."""
        words, event = self.context.words, self.running.event
        if not self.shown:
            text(words("events.no_results"), LABEL, MIST, "head").draw(screen, 960, 540)
        black_out(screen, *(row_box(i) for i in range(len(self.shown))))
        for i, fixture in enumerate(self.shown):
            outcome = result_of(event, fixture)
            where = round_name(words, event, fixture)
            how = decided_by(words, event, fixture.number)
            room = RESULT_ROOM - text_width(how, BODY) - 40
            tried = event.progress.kind.single
            line = tries_line(words, outcome) if tried else f"{places_line(outcome, room)}   {how}"
            noted = bool(outcome.note)
            result_row(where, line, noted, self.focus.name == str(i)).draw(screen, *row_box(i).topleft)
        if self.shown:
            self.focus.draw(screen)

    # ---- inside

    def _correct(self, chosen: str) -> StackOperation:
        self.context.sounds.play("accept")
        return Push(Correction(self.context, self.running, self.shown[int(chosen)]))

    def _watch(self, fixture: Fixture) -> StackOperation:
        """Play a match of AIs again: it goes as before, and does not count."""
        event = self.running.event
        try:
            setup = setup_of(event, fixture) if self.running.without_people(fixture) else None
        except ValueError as reason:
            log.warning("%s", reason)
            setup = None
        if setup is None or not self.context.preloader.ready(setup.game, setup.arena):
            self.context.sounds.play("refused")
            return None
        self.context.sounds.play("accept")
        return Swap(MatchScene(self.context, setup, after=ShownAgain(self.running, fixture.entrants)))

    @property
    def pages(self) -> int:
        """Pages of results."""
        return max(1, -(-len(self.played) // ROWS))

    @property
    def played(self) -> list[Fixture]:
        """The matches with a result that can be corrected, newest first."""
        event = self.running.event
        by_number = {fixture.number: fixture for fixture in event.fixtures}
        return [by_number[number] for number in reversed([*event.played])]

    def _show(self) -> None:
        self.holding.clear()
        self.shown = self.played[self.page * ROWS : (self.page + 1) * ROWS]
        self.focus.set_spots([FocusSpot(str(i), row_box(i)) for i in range(max(1, len(self.shown)))])


@dataclass(frozen=True)
class ShownAgain:
    """A match that was watched again. Called after it, it returns the results; `names`: see `MatchScene`."""

    event: RunningEvent
    names: tuple[str, ...]

    def __call__(self, scene: MatchScene) -> ResultsList:
        return ResultsList(scene.context, self.event)


class Correction(SettingsPage):
    """The places of one match, or which tries count, and the reason why they change."""

    right, table, saves = Right.EVENTS, "events", False
    idle, when_idle, stay = 60.0, Pop(), 5.0
    hints = (
        (Button.RIGHT, "options.hint_change"),
        (Button.X, "events.hint_words"),
        (Button.START, "events.hint_save"),
        (Button.BACK, "options.hint_back"),
    )

    def __init__(self, context: Context, running: RunningEvent, fixture: Fixture) -> None:
        self.running, self.fixture = running, fixture
        before = result_of(running.event, fixture)
        self.scores = before.scores
        self.places = {name: place for place, names in places_of(before) for name in names}
        self.names = sorted(fixture.entrants, key=lambda name: (self.places[name], name))
        self.tried = running.event.progress.kind.single
        self.void: set[str] = set()  # whose try does not count
        self.note, self.own = 0, ""  # the reason: one of those offered, or in own words
        super().__init__(context, (*self.names, NOTE, SAVE))

    def press(self, event: InputEvent) -> StackOperation:
        """LEFT and RIGHT change a place or the reason, X writes it; START and the last row save."""
        if event.button is Button.X:
            self.context.sounds.play("accept")
            title = self.context.words("events.note")
            return Push(TextPage(self.context, title, self.own, MAX_NOTE, self._write))
        return self.activate(SAVE, event) if event.button is Button.START else super().press(event)

    @property
    def heading(self) -> LitImage:
        words = self.context.words
        return heading(words("events.correct"), round_name(words, self.running.event, self.fixture))

    def label(self, name: str) -> str:
        return shortened(name, LABEL_ROOM, BODY, "body") if name in self.names else super().label(name.strip())

    def description(self, name: str) -> tuple[str, str]:
        """That of the page, whichever row is focused."""
        return super().description("correct")

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        """Draw the places, or what has been reached."""
        panel = setting_row.PANEL
        if self.tried:
            line = tries_line(self.context.words, self.outcome)
            text(line, BODY, ICE, "head", "l", panel.w - 80).draw(screen, panel.x + 40, panel.y + 80)
            return
        for i, (place, names) in enumerate(places_of(self.outcome)):
            room = (panel.w - 130) // len(names) - 40
            line = f"{place}.  {' = '.join(shortened(name, room, BODY) for name in names)}"
            lit = text(line, BODY, FOCUS if place == 1 else ICE, "head", "l", panel.w - 80)
            lit.draw(screen, panel.x + 40, panel.y + 80 + 76 * i)

    draw_foot = Page.draw_foot

    @property
    def outcome(self) -> Result:
        """The result as it would be saved."""
        ranks = sorted(set(self.places.values()))
        places = tuple(tuple(name for name in self.names if self.places[name] == rank) for rank in ranks)
        scores = {name: score for name, score in self.scores.items() if name not in self.void}
        return Result(self.fixture.number, places, scores, self._reasons[self.note])

    # ---- inside

    def value(self, name: str) -> SettingValue:
        if name == SAVE:
            return self.action("events.hint_save")
        if name == NOTE:
            return SettingValue("arrows", self._reasons, self.note, endless=True)
        if self.tried:
            choices = worth(self.context.words, self.scores.get(name, 0.0)), self.context.words("events.void")
            return SettingValue("toggle", choices, int(name in self.void), endless=True)
        count = len(self.names)
        places = tuple(str(i + 1) for i in range(count))
        return SettingValue("toggle", places, min(self.places[name], count) - 1, endless=True)

    def apply(self, name: str, chosen: int) -> None:
        if name == NOTE:
            self.note = chosen
        elif self.tried:
            self.void = self.void | {name} if chosen else self.void - {name}
        else:
            self.places[name] = chosen + 1

    @property
    def _reasons(self) -> tuple[str, ...]:
        """The reasons that are offered, and the one in own words."""
        return (*(self.context.words(f"events.{note}") for note in NOTES), *([self.own] if self.own else []))

    def _write(self, reason: str) -> str:
        """Take a reason; returns the sentence why not, or an empty one."""
        if not reason or reason == WALKOVER:
            return self.context.words("events.no_reason")
        self.own = reason
        self.note = len(NOTES)
        return ""

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Save the correction."""
        try:
            saved = self.running.change(lambda event: event.correct(self.outcome))
        except ValueError as reason:
            log.warning("%s", reason)
            return self._refuse("events.uncorrectable", "refused")
        if not saved:
            return self._refuse("app.unsaved", "error")
        self.context.sounds.play("ready")
        return Pop()

    def _refuse(self, key: str, sound: str) -> StackOperation:
        self.show_message(self.context.words(key), wrong=True)
        self.context.sounds.play(sound)
        return None


def result_of(event: Event, fixture: Fixture) -> Result:
    """The result of a match; while its extra matches are open, that of the match itself."""
    return event.outcomes.get(fixture.number) or event.played[fixture.number][0]


def tries_line(words: Words, outcome: Result) -> str:
    """Who has tried, and what they have reached."""
    names = [name for place in outcome.places for name in place]
    reached = {name: worth(words, score) for name, score in outcome.scores.items()}
    return "   ".join(f"{shortened(name)}  {reached.get(name, '–')}" for name in names)


def row_box(i: int) -> pygame.Rect:
    """Rectangle of the i-th row."""
    return pygame.Rect(LEFT, TOP + PITCH * i, RIGHT - LEFT, HIGH)


@cached
def result_row(where: str, line: str, noted: bool, hot: bool) -> LitImage:
    """A result; top left at (0, 0). `noted`: it has been corrected."""
    w = RIGHT - LEFT
    layer = Layer(0, 0, w, HIGH)
    layer.glow.line(cut_box(0, 0, w, HIGH, 16), FOCUS if hot else STEEL, THIN, True)
    layer.canvas.body(where, 32, HIGH / 2, MIST, "l", fit_size(where, BODY, 400, "body"))
    line, size = fit_text(line, LABEL, RESULT_ROOM)
    layer.canvas.text(line, size, 470, HIGH / 2, FOCUS if hot else ICE, "head")
    if noted:
        icon(layer.glow, "pencil", w - 56, HIGH / 2, 22, FOCUS, 4)
    return layer.render()
