"""Options page: changes apply and are saved immediately.

In a kiosk the page offers only what children may change; the operator's page offers everything.
"""

import logging
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import pygame

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.navigation import Navigation
from pigaming_app.scenes.flow.stack import Push, Quit, StackOperation
from pigaming_app.scenes.options import pictures
from pigaming_app.scenes.views.race.ghost_files import delete_ghosts
from pigaming_app.scenes.views.rumble import TAKEN
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import LABEL, read_large
from pigaming_app.ui.draw.frame_budget import PrewarmQueue
from pigaming_app.ui.draw.layers import backdrop, span
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.i18n import LANGUAGES, NAMES
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out, call_to_action, frame, heading
from pigaming_app.ui.widgets.setting_row import SettingValue

IDLE = 90.0  # seconds without input until the title
SENTENCE_SECONDS = 3.0  # seconds for which a sentence is shown
CLEAR = 2.0  # seconds for which a button is held to clear the high scores
PREWARM_MS = 2.0  # ms per frame for prewarming
FLASHES = ("off", "soft", "full")
ROWS = (
    "language",
    "music",
    "sounds",
    "rumble",
    "ease",
    "display",
    "fullscreen",
    "padtest",
    "phones",
    "robots",
    "day",
    "reset",
)
FOR_CHILDREN = ("language", "rumble", "ease", "padtest")
EASE_FOR_CHILDREN = ("calm", "flashes", "shake", "large")
EASE = (*EASE_FOR_CHILDREN, "remap")
OPENING = ("padtest", "phones", "robots", "day", "ease", "remap")  # rows that open a page
TOP, BOTTOM, HIGH = 226, 930, 64
log = logging.getLogger("pigaming")


class OptionsPage:
    """The options; `operator`: all rows, also in a kiosk. `ease`: those that make seeing and playing easier."""

    def __init__(self, context: Context, operator: bool = False, ease: bool = False) -> None:
        self.context, self.operator, self.untimed = context, operator, operator
        self.title = "options.ease" if ease else "options.operator" if operator else "options.title"
        self.rows: Sequence[str] = EASE if ease else ROWS
        if context.kiosk and not operator:
            self.rows = EASE_FOR_CHILDREN if ease else FOR_CHILDREN
        elif context.kiosk and not ease:
            self.rows = (*ROWS, "close")
        self.clock = 0.0
        self.cleared = False
        self.clearing = HoldTimers(context.controls, CLEAR)
        self.focus = Focus([FocusSpot(name, self._box(i)) for i, name in enumerate(self.rows)])
        self.prewarm = PrewarmQueue(self._prewarm_jobs())
        hints = [
            (Button.RIGHT, "options.hint_change"),
            (Button.FIRE, "options.hint_ok"),
            (Button.BACK, "options.hint_back"),
        ]
        self.navigation = Navigation(context, self.focus, hints, IDLE, SENTENCE_SECONDS)

    def on_enter(self) -> None:
        pass

    def handle(self, event: InputEvent) -> StackOperation:
        """Up and down select a row, left and right change it, FIRE changes or activates it."""
        event = self.navigation.prompts.as_button(event)
        match event.button:
            case Button.LEFT | Button.RIGHT:
                self._change(self.focus.name, 1 if event.button is Button.RIGHT else -1)
            case Button.FIRE | Button.START:
                return self._do(self.focus.name, event)
            case Button.CLICK:
                self.focus.handle(event)
                return self._click(event)
            case _:
                before, turn = self.focus.name, self.navigation.handle(event)
                if self.focus.name != before:
                    self.clearing.clear()
                return turn
        return None

    def update(self, seconds: float) -> StackOperation:
        self.clock += seconds
        if self.clearing.update(seconds):
            self._clear()
        self.prewarm.work(PREWARM_MS)
        return self.navigation.update(seconds)

    def draw(self, screen: pygame.Surface) -> None:
        words, focus = self.context.words, self.focus.name
        screen.blit(backdrop(), (0, 0))
        heading(words(self.title)).draw(screen)
        black_out(screen, dials.PANEL)
        values = {name: self._value(name) for name in self.rows}
        dials.draw(screen, words, self.focus, "options", values)
        frame(*dials.PANEL.size).draw(screen, *dials.PANEL.topleft)
        dials.describe(screen, words(f"options.{focus}"), words(f"options.{focus}_line"))
        pictures.sketch(screen, focus, values[focus].chosen, self.clock)
        if self.clearing.share:
            dials.ring(screen, self.clearing.share)
        if self.navigation.sentence:
            call_to_action(self.navigation.sentence, "", LABEL).draw(screen, 960, 926)
        self.navigation.prompts.draw(screen)

    # ---- drawing

    def _box(self, i: int) -> pygame.Rect:
        """The rectangle of row `i`."""
        x, w = span(0, 8)
        pitch = min(96.0, (BOTTOM - TOP - HIGH) / max(1, len(self.rows) - 1))
        high = min(HIGH, int(pitch))  # overlapping rows would be ambiguous for the focus
        return pygame.Rect(x, round(TOP + pitch * i) - high // 2, w, high)

    def _prewarm_jobs(self) -> Iterator[Callable[[], object]]:
        """Jobs for the widgets that the next focus move needs, so that it need not wait for them."""
        words = self.context.words
        for name in self.rows:
            yield partial(dials.label, words(f"options.{name}"), True)
            yield partial(self._focused_value, name)
            yield partial(dials.description, words(f"options.{name}"), words(f"options.{name}_line"))
            yield partial(pictures.drawn, name, self._value(name).chosen)

    def _focused_value(self, name: str) -> object:
        value = self._value(name)
        return dials.value(value.kind, value.options, value.chosen, True)

    # ---- rows

    def _value(self, name: str) -> SettingValue:
        settings, words, canvas = self.context.settings, self.context.words, self.context.canvas
        off_on = (words("options.off"), words("options.on"))
        match name:
            case "language":
                return SettingValue("arrows", tuple(NAMES[code] for code in LANGUAGES), LANGUAGES.index(words.language))
            case "music" | "sounds":
                return SettingValue("meter", (), settings.music if name == "music" else settings.sounds)
            case "flashes":
                flashes = tuple(words(f"options.{code}") for code in FLASHES)
                return SettingValue("toggle", flashes, FLASHES.index(settings.flashes))
            case "shake":
                return SettingValue("toggle", off_on, int(settings.shake))
            case "rumble":
                return SettingValue("toggle", off_on, int(settings.rumble))
            case "calm" | "large":
                return SettingValue("toggle", off_on, int(settings.calm if name == "calm" else settings.large_text))
            case "fullscreen":
                return SettingValue("toggle", off_on, int(canvas.fullscreen))
            case "display":
                return SettingValue("arrows", tuple(canvas.displays()), canvas.display)
            case "reset":
                key = "cleared" if self.cleared else "clear"
                return SettingValue("deed", (words(f"options.{key}"),))
        return SettingValue("deed", (words("options.open" if name in OPENING else "options.end"),))

    def _change(self, name: str, by: int) -> None:
        """Step a row's value."""
        value = self._value(name)
        limit = {"meter": 10, "deed": 0}.get(value.kind, len(value.options) - 1)
        self._set(name, max(0, min(limit, value.chosen + by)))

    def _do(self, name: str, event: InputEvent) -> StackOperation:
        """FIRE: the next value, cyclically, or the action."""
        value = self._value(name)
        if value.kind != "deed":
            count = 11 if value.kind == "meter" else len(value.options)
            self._set(name, (value.chosen + 1) % count)
            return None
        self.context.sounds.play("move" if name == "reset" else "accept")
        if name == "close":
            return Quit()
        if name == "padtest":
            from pigaming_app.scenes.options.controls_test import ControlsTest

            return Push(ControlsTest(self.context))
        if name == "phones":
            from pigaming_app.scenes.phones.settings_page import PhonesPage

            return Push(PhonesPage(self.context))
        if name == "ease":
            return Push(OptionsPage(self.context, self.operator, ease=True))
        if name == "remap":
            from pigaming_app.scenes.options.remap_page import RemapPage

            return Push(RemapPage(self.context))
        if name == "robots":
            from pigaming_app.scenes.robots.menu import RobotsMenu

            return Push(RobotsMenu(self.context))
        if name == "day":
            from pigaming_app.scenes.operator.page import OperatorPage

            return Push(OperatorPage(self.context))
        self.cleared = False
        self.clearing.begin(event)
        return None

    def _click(self, event: InputEvent) -> StackOperation:
        name = self.focus.spot_at(event)
        if name is None or event.at is None:
            return None
        value = self._value(name)
        if value.kind == "deed":
            return self._do(name, event)
        hit = dials.value_at(value.kind, value.options, value.chosen, event.at[0] - self.focus.rect(name).x)
        if hit is not None:
            self._set(name, hit)
        return None

    def _set(self, name: str, chosen: int) -> None:
        """Set a value and apply it."""
        if chosen == self._value(name).chosen:
            return
        context, settings, canvas = self.context, self.context.settings, self.context.canvas
        match name:
            case "language":
                settings.language = LANGUAGES[chosen]
                context.words.switch(settings.language)
                self.prewarm = PrewarmQueue(self._prewarm_jobs())
            case "music" | "sounds":
                setattr(settings, name, chosen)
                context.sounds.volume(*settings.loudness)
            case "flashes":
                settings.flashes = FLASHES[chosen]
            case "shake":
                settings.shake = bool(chosen)
            case "rumble":
                settings.rumble = bool(chosen)
                if settings.rumble:
                    context.controls.rumble(context.controls.last, *TAKEN)
            case "calm":
                settings.calm = bool(chosen)
            case "large":
                settings.large_text = bool(chosen)
                read_large(settings.large_text)
                surfaces.clear()
                self.prewarm = PrewarmQueue(self._prewarm_jobs())
            case "display" | "fullscreen":
                canvas.show(*((chosen, canvas.fullscreen) if name == "display" else (canvas.display, bool(chosen))))
                settings.display, settings.fullscreen = canvas.display, canvas.fullscreen
        context.sounds.play("hit" if name == "sounds" else "move")
        self._save()

    def _clear(self) -> None:
        """Clear the high scores and ghosts."""
        self.context.scores.reset()
        self.cleared = True
        self.context.sounds.play("accept")
        self._save(scores=True)
        try:
            delete_ghosts(folders().data)
        except OSError as trouble:
            log.warning("%s", trouble)

    def _save(self, scores: bool = False) -> None:
        """Save settings or scores; on failure, show a sentence."""
        try:
            if scores:
                self.context.scores.save(folders().data)
            else:
                self.context.settings.save(folders().config)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            self.navigation.show_message(self.context.words("app.unsaved"))
