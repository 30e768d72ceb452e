"""The options: what an operator or a player may change. Everything acts at once and is kept.

Up and down go from row to row, left and right change, FIRE changes or opens. On the right it says what a row is for.
"""

import logging
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import pygame

from pigaming_app.keeping import NotSaved
from pigaming_app.scenes.focus import Focus, Spot
from pigaming_app.scenes.house import House
from pigaming_app.scenes.ink import BODY, FOCUS, ICE, LABEL, LINE, MIST, STEEL, THIN, cut, dim, icon, panel, text_width
from pigaming_app.scenes.page import glow_bar, heading
from pigaming_app.scenes.pane import Lit, Pane, backdrop, fitted, lines_of, span
from pigaming_app.scenes.press import Act, Press
from pigaming_app.scenes.prompts import Prompts
from pigaming_app.scenes.stack import Pop, Push, Quit, Turn
from pigaming_app.settings import folders

X, W = span(0, 8)
HELP_X, HELP_W = span(8, 4)
TOP, STEP, HIGH = 212, 74, 66
VALUE = X + 520  # where the values begin
METER = 10  # cells of a volume
log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class Row:
    """One thing that can be changed: what it shows, and what becomes of a step to either side."""

    name: str
    shown: Callable[[], tuple[tuple[str, ...], int]]  # choices and which is chosen; no choices: a volume
    change: Callable[[int], Turn]


class OptionsPage:
    """The page. `operator`: it was opened in a kiosk by whoever knows how, so it can close the arcade."""

    def __init__(self, house: House, operator: bool = False) -> None:
        self.house, self.operator = house, operator
        self.said, self.sure = "", False
        self.rows = self._rows()
        boxes = [Spot(row.name, pygame.Rect(X, TOP + STEP * i, W, HIGH)) for i, row in enumerate(self.rows)]
        self.focus = Focus(boxes)
        self.prompts = Prompts(
            house,
            [(Act.RIGHT, "options.hint_change"), (Act.FIRE, "options.hint_ok"), (Act.BACK, "options.hint_back")],
            1010,
        )

    def entered(self) -> None:
        """Shown, or come back to from the page that tests the controls."""

    def on(self, press: Press) -> Turn:
        """Move, change, or go back."""
        press = self.prompts.meant(press)
        if press.act is Act.BACK:
            self.house.sounds.play("back")
            return Pop()
        if press.act in (Act.LEFT, Act.RIGHT):
            return self._change(1 if press.act is Act.RIGHT else -1)
        if self.focus.on(press):
            self.said, self.sure = "", False
            self.house.sounds.play("move")
        if self.focus.chosen(press) is not None:
            left = press.act is Act.CLICK and press.at is not None and press.at[0] < VALUE + 60
            return self._change(-1 if left else 1)
        return None

    def update(self, seconds: float) -> Turn:
        """Let the focus glide."""
        self.focus.update(seconds)
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """Paint the page."""
        words, lit = self.house.words, self.focus.name
        screen.blit(backdrop(), (0, 0))
        heading(words("options.operator" if self.operator else "options.title")).draw(screen)
        box = self.focus.rect(lit)
        glow_bar(screen, box)
        for row in self.rows:
            choices, chosen = row.shown()
            line = painted(words(f"options.{row.name}"), choices, chosen, row.name == lit)
            line.draw(screen, 0, self.focus.rect(row.name).y)
        advice(words(f"options.{lit}"), self.said or words(f"options.{lit}_line")).draw(screen)
        self.focus.draw(screen)
        self.prompts.draw(screen)

    # ---- inside

    def _change(self, by: int) -> Turn:
        row = next(row for row in self.rows if row.name == self.focus.name)
        turn = row.change(by)
        self.house.sounds.play("accept")
        self._keep()
        return turn

    def _keep(self) -> None:
        try:
            self.house.settings.save(folders().config)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            self.said = self.house.words("app.unsaved")

    def _rows(self) -> list[Row]:
        settings, words = self.house.settings, self.house.words

        def switch(name: str) -> tuple[tuple[str, ...], int]:
            return (words("options.off"), words("options.on")), int(getattr(settings, name))

        def levels() -> tuple[tuple[str, ...], int]:
            names = ("off", "soft", "full")
            return tuple(words(f"options.{name}") for name in names), names.index(settings.flashes)

        rows = [
            Row("language", lambda: (("English", "Português"), int(words.language == "pt")), self._language),
            Row("music", lambda: ((), settings.music), lambda by: self._volume("music", by)),
            Row("sounds", lambda: ((), settings.sounds), lambda by: self._volume("sounds", by)),
            Row("flashes", levels, self._flashes),
            Row("shake", lambda: switch("shake"), self._shake),
            Row("display", self._displays, self._display),
            Row("fullscreen", lambda: switch("fullscreen"), self._fullscreen),
            Row("padtest", lambda: ((words("options.open"),), 0), self._padtest),
            Row("reset", lambda: ((words("options.sure" if self.sure else "options.open"),), 0), self._reset),
        ]
        if self.operator:
            rows.append(Row("close", lambda: ((words("options.open"),), 0), lambda by: Quit()))
        return rows

    def _language(self, by: int) -> Turn:
        self.house.words.switch(self.house.words.other)
        self.house.settings.language = self.house.words.language
        return None

    def _volume(self, name: str, by: int) -> Turn:
        settings = self.house.settings
        setattr(settings, name, max(0, min(METER, getattr(settings, name) + by)))
        self.house.sounds.volume(settings.music, settings.sounds)
        return None

    def _flashes(self, by: int) -> Turn:
        names = ("off", "soft", "full")
        self.house.settings.flashes = names[(names.index(self.house.settings.flashes) + by) % len(names)]
        return None

    def _shake(self, by: int) -> Turn:
        self.house.settings.shake = not self.house.settings.shake
        return None

    def _displays(self) -> tuple[tuple[str, ...], int]:
        there = self.house.canvas.displays()
        return (there[min(self.house.canvas.display, len(there) - 1)],), 0

    def _display(self, by: int) -> Turn:
        canvas = self.house.canvas
        self.house.settings.display = (canvas.display + by) % len(canvas.displays())
        canvas.show(self.house.settings.display, canvas.fullscreen)
        return None

    def _fullscreen(self, by: int) -> Turn:
        self.house.settings.fullscreen = self.house.canvas.toggle_fullscreen()
        return None

    def _padtest(self, by: int) -> Turn:
        from pigaming_app.scenes.padtest import PadTest

        return Push(PadTest(self.house))

    def _reset(self, by: int) -> Turn:
        """Asked twice, the tables are emptied."""
        if not self.sure:
            self.sure = True
            return None
        self.sure = False
        self.house.scores.reset()
        self.said = self.house.words("options.cleared")
        try:
            self.house.scores.save(folders().data)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            self.said = self.house.words("app.unsaved")
        return None


@lru_cache(maxsize=96)
def painted(name: str, choices: tuple[str, ...], chosen: int, hot: bool) -> Lit:
    """One row with its upper edge at y = 0."""
    pane = Pane(X, 0, W, HIGH)
    y = HIGH / 2
    pane.page.body(name, X + 40, y, ICE if hot else MIST, size=fitted(name, BODY, VALUE - X - 60, "body"))
    if not choices:
        for i in range(METER):
            cell = cut(VALUE + 40 * i, y - 22, 30, 44, 6)
            if i < chosen:
                pane.hot.fill(cell, FOCUS if hot else MIST)
            else:
                pane.hot.line(cell, STEEL, 3, True)
        pane.page.cold.text(str(chosen), BODY, X + W - 40, y, ICE if hot else MIST, "head", "r")
        return pane.done()
    x: float = VALUE
    for i, choice in enumerate(choices):
        w, on = text_width(choice, BODY) + 48, i == chosen
        pane.hot.line(cut(x, y - 29, w, 58, 12), (FOCUS if hot else ICE) if on else STEEL, THIN, True)
        pane.page.cold.text(choice, BODY, x + w / 2, y, ICE if on else MIST, "head", "c")
        x += w + 12
    return pane.done()


@lru_cache(maxsize=32)
def advice(name: str, line: str) -> Lit:
    """What the row in focus is for."""
    pane = Pane(HELP_X, TOP, HELP_W, 560)
    panel(pane.hot, HELP_X, TOP, HELP_W, 560, STEEL)
    icon(pane.hot, "right", HELP_X + 60, TOP + 76, 24, FOCUS, LINE)
    pane.hot.line([(HELP_X + 40, TOP + 140), (HELP_X + HELP_W - 40, TOP + 140)], dim(FOCUS, 0.5), THIN)
    pane.page.text(name, fitted(name, LABEL, HELP_W - 150), HELP_X + 104, TOP + 76, FOCUS)
    for i, part in enumerate(lines_of(line, BODY, HELP_W - 80)):
        pane.page.body(part, HELP_X + 40, TOP + 200 + 58 * i, ICE)
    return pane.done()
