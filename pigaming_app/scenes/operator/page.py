"""The operator's page of an open day: quiet hours, volume cap, time limit, second screen, figures, end of all matches.

It opens from the options, and over any screen by holding F10; a match below it stands still.
"""

import logging
from collections.abc import Iterator, Sequence
from functools import partial

import pygame

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.navigation import Navigation
from pigaming_app.scenes.flow.stack import Home, Pop, Push, Scene, StackOperation
from pigaming_app.scenes.operator import pictures
from pigaming_app.scenes.operator.group_limit import InMatch
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import LABEL
from pigaming_app.ui.draw.frame_budget import Job, PrewarmQueue
from pigaming_app.ui.draw.layers import backdrop
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.focus import Focus
from pigaming_app.ui.widgets.labels import black_out, call_to_action, frame, heading
from pigaming_app.ui.widgets.setting_row import SettingValue

ROWS = ("figures", "quiet_from", "quiet_until", "volume_cap", "group_minutes", "scoreboard", "board", "end_all")
IDLE, SENTENCE_SECONDS = 90.0, 4.0  # s
END_SECONDS = 1.0  # s for which a button is held to end all matches
STEP_MINUTES = 30  # of the quiet hours
LIMITS = (0, 5, 10, 15, 20, 30, 45, 60)  # minutes of a group
PREWARM_MS = 2.0
log = logging.getLogger("pigaming")


class OperatorPage:
    """`below`: the scenes under it, if it lies over any but the options."""

    untimed = True

    def __init__(self, context: Context, below: Sequence[Scene] = ()) -> None:
        self.context, self.below = context, below
        self.clock = 0.0
        self.focus = Focus(dials.spots(ROWS))
        self.ending = HoldTimers(context.controls, END_SECONDS)
        self.prewarm = PrewarmQueue(self._prewarm_jobs())
        hints = [
            (Button.RIGHT, "options.hint_change"),
            (Button.FIRE, "options.hint_ok"),
            (Button.BACK, "options.hint_back"),
        ]
        self.navigation = Navigation(context, self.focus, hints, IDLE, SENTENCE_SECONDS)

    def on_enter(self) -> None:
        if self.below:
            self.context.hush()

    def handle(self, event: InputEvent) -> StackOperation:
        """Up and down select a row, left and right change it, FIRE changes or activates it."""
        event = self.navigation.prompts.as_button(event)
        match event.button:
            case Button.LEFT | Button.RIGHT:
                self._step(1 if event.button is Button.RIGHT else -1)
            case Button.FIRE | Button.START:
                return self._activate(event)
            case Button.CLICK:
                self.focus.handle(event)
                if self.focus.spot_at(event) is None:
                    return None
                value = self._value(self.focus.name)
                if value.kind == "deed":
                    return self._activate(event)
                hit = dials.value_at(
                    value.kind, value.options, value.chosen, (event.at or (0, 0))[0] - self.focus.spot.rect.x
                )
                if hit is not None:
                    self._set(self.focus.name, hit)
            case _:
                before, turn = self.focus.name, self.navigation.handle(event)
                if self.focus.name != before:
                    self.ending.clear()
                return turn
        return None

    def update(self, seconds: float) -> StackOperation:
        """Animate; keep a match below at rest."""
        self.clock += seconds
        for scene in self.below:
            if isinstance(scene, InMatch):
                scene.advance_paused(seconds)
        if self.ending.update(seconds):
            self.context.sounds.play("accept")
            return end_all(self.context)
        self.prewarm.work(PREWARM_MS)
        turn = self.navigation.update(seconds)
        return Pop() if turn and self.below else turn

    def draw(self, screen: pygame.Surface) -> None:
        words, focus = self.context.words, self.focus.name
        screen.blit(backdrop(), (0, 0))
        heading(words("operator.title")).draw(screen)
        black_out(screen, dials.PANEL)
        values = {name: self._value(name) for name in ROWS}
        dials.draw(screen, words, self.focus, "operator", values)
        frame(*dials.PANEL.size).draw(screen, *dials.PANEL.topleft)
        dials.describe(screen, words(f"operator.{focus}"), words(f"operator.{focus}_line"))
        pictures.drawn(focus, values[focus].chosen).draw(screen, *dials.CENTRE)
        if self.ending.share:
            dials.ring(screen, self.ending.share)
        if self.navigation.sentence:
            call_to_action(self.navigation.sentence, "", LABEL).draw(screen, 960, 926)
        self.navigation.prompts.draw(screen)

    def _prewarm_jobs(self) -> Iterator[Job]:
        """Jobs for the widgets that the next focus move needs."""
        words = self.context.words
        for name in ROWS:
            value = self._value(name)
            yield partial(dials.label, words(f"operator.{name}"), True)
            yield partial(dials.value, value.kind, value.options, value.chosen, True)
            yield partial(dials.description, words(f"operator.{name}"), words(f"operator.{name}_line"))
            yield partial(pictures.drawn, name, value.chosen)

    # ---- rows

    def _value(self, name: str) -> SettingValue:
        settings, words = self.context.settings, self.context.words
        match name:
            case "quiet_from" | "quiet_until":
                time = str(getattr(settings, name))
                if settings.quiet_from == settings.quiet_until:
                    time = f"{time}  ({words('operator.never')})"
                return SettingValue("arrows", (time,) * (_SLOTS + 2), 1 + _slot(getattr(settings, name)))
            case "volume_cap":
                return SettingValue("meter", (), settings.volume_cap)
            case "group_minutes":
                texts = [
                    words("setup.min", minutes=str(minutes)) if minutes else words("options.off") for minutes in LIMITS
                ]
                return SettingValue("arrows", tuple(texts), _nearest(settings.group_minutes))
            case "scoreboard":
                displays = self.context.canvas.displays()
                return SettingValue(
                    "arrows", (words("options.off"), *displays), min(settings.scoreboard, len(displays))
                )
            case "board":
                names = [page.name for page in self.context.board_pages] or [self.context.board_page]
                chosen = names.index(self.context.board_page) if self.context.board_page in names else 0
                return SettingValue("arrows", tuple(words(f"scoreboard.{page}") for page in names), chosen)
        return SettingValue("deed", (words("options.open" if name == "figures" else "options.clear"),))

    def _step(self, by: int) -> None:
        """Step the focused row's value; the hours go round."""
        value = self._value(self.focus.name)
        if value.kind == "deed":
            return
        limit = 10 if value.kind == "meter" else len(value.options) - 1
        self._set(self.focus.name, max(0, min(limit, value.chosen + by)))

    def _activate(self, event: InputEvent) -> StackOperation:
        """FIRE: the next value, cyclically, or the action."""
        name, value = self.focus.name, self._value(self.focus.name)
        if name == "figures":
            from pigaming_app.scenes.operator.figures_page import FiguresPage

            self.context.sounds.play("accept")
            return Push(FiguresPage(self.context))
        if name == "end_all":
            self.context.sounds.play("move")
            self.ending.begin(event)
        else:
            self._set(name, (value.chosen + 1) % (11 if value.kind == "meter" else len(value.options)))
        return None

    def _set(self, name: str, chosen: int) -> None:
        """Set a value, apply and save it."""
        context, settings = self.context, self.context.settings
        if chosen == self._value(name).chosen:
            return
        match name:
            case "quiet_from" | "quiet_until":
                minutes = (chosen - 1) % _SLOTS * STEP_MINUTES
                setattr(settings, name, f"{minutes // 60:02}:{minutes % 60:02}")
            case "volume_cap":
                settings.volume_cap = chosen
                context.sounds.volume(*settings.loudness)
            case "group_minutes":
                settings.group_minutes = LIMITS[chosen]
            case "scoreboard":
                settings.scoreboard = chosen
            case "board":
                context.board_page = context.board_pages[chosen].name
        context.sounds.play("move")
        try:
            settings.save(folders().config)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            self.navigation.show_message(context.words("app.unsaved"))


_SLOTS = 24 * 60 // STEP_MINUTES


def _slot(time: str) -> int:
    """The slot of a time of day."""
    return (int(time[:2]) * 60 + int(time[3:])) // STEP_MINUTES


def _nearest(minutes: int) -> int:
    """The place of the nearest limit; none is only near to none."""
    return min(range(len(LIMITS)), key=lambda i: (bool(minutes) != bool(LIMITS[i]), abs(LIMITS[i] - minutes)))


def end_all(context: Context) -> StackOperation:
    """Stop all robots, then end whatever is being played: back to the title."""
    context.stop_all_robots()
    return Home()
