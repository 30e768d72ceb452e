"""The question about a new plug-in, before its code first runs: where it is, and whether to switch it on."""

import logging
from pathlib import Path

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_words import game_title
from pigaming_app.scenes.flow.stack import StackOperation
from pigaming_app.scenes.pages.page import Hints
from pigaming_app.scenes.pages.sheet import Sheet
from pigaming_app.scenes.play.pause import sheet_title
from pigaming_app.storage.plugins.consent import switch
from pigaming_app.storage.plugins.found import Plugin
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import ALARM, BODY, FOCUS, ICE, LINE, MIST, icon, text_width
from pigaming_app.ui.draw.layers import Layer
from pigaming_app.ui.draw.text import SMALLEST, fit_size, write_lines
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.dialog import FOOT, HEAD, ICON, ROOM, TEXT_X

INPUT_LOCKOUT = 0.5  # s: a press of the screen before does not answer
QUESTION, ON, OFF, UNSAVED = "question", "plays", "stays_off", "unsaved"  # states
log = logging.getLogger("pigaming")


class NewGame(Sheet):
    """X switches it on, FIRE leaves it off, BACK leaves it for later. Either counts from the next start on."""

    color = FOCUS

    def __init__(self, context: Context, plugin: Plugin) -> None:
        super().__init__(context)
        self.plugin, self.state = plugin, QUESTION

    def on_enter(self) -> None:
        self.context.sounds.play("error")

    def press(self, event: InputEvent) -> StackOperation:
        """Answer, or leave."""
        if self.state != QUESTION and event.button in (Button.FIRE, Button.START):
            return self.leave()
        if self.state == QUESTION and self.age >= INPUT_LOCKOUT and event.button in (Button.X, Button.FIRE):
            self._answer(event.button is Button.X)
        return None

    @property
    def look(self) -> str:
        return self.state

    @property
    def hints(self) -> Hints:
        hints = [(Button.X, "plugins.hint_on"), (Button.FIRE, "plugins.hint_off"), (Button.BACK, "plugins.hint_later")]
        return hints if self.state == QUESTION else [(Button.FIRE, "options.hint_ok")]

    def _answer(self, on: bool) -> None:
        self.state = ON if on else OFF
        try:
            switch(self.plugin.key, on)
            self.context.sounds.play("accept")
        except NotSaved as trouble:
            log.warning("%s", trouble)
            self.state = UNSAVED
            self.context.sounds.play("error")

    def paint_sheet(self, layer: Layer) -> None:
        words, name = self.context.words, game_name(self.context.words, self.plugin)
        sheet_title(layer, None, words("plugins.new_game", game=name), ICE)
        icon(layer.glow, "unknown", *ICON, 76, FOCUS if self.state == QUESTION else MIST, LINE)
        if self.state == QUESTION:
            y = write_lines(layer, words("plugins.code"), TEXT_X, HEAD + 56, ROOM, ICE)
            write_lines(layer, words("plugins.trust"), TEXT_X, y + 16, ROOM, MIST)
            line = place(self.plugin, ROOM)
            layer.canvas.body(line, TEXT_X, FOOT - 40, MIST, "l", fit_size(line, BODY, ROOM, "body"))
            return
        unsaved = self.state == UNSAVED
        sentence = words("app.unsaved") if unsaved else words(f"plugins.{self.state}", game=name)
        write_lines(layer, sentence, TEXT_X, HEAD + 56, ROOM, ALARM if unsaved else ICE)


def game_name(words: Words, plugin: Plugin) -> str:
    """The name of a plug-in's game: as its texts have it if they are loaded."""
    return plugin.name.replace("_", " ").title() if plugin.fault else game_title(words, plugin.name)


def short(path: Path) -> str:
    """A path, with ~ for the home folder."""
    return f"~/{path.relative_to(Path.home())}" if path.is_relative_to(Path.home()) else str(path)


def place(plugin: Plugin, room: float) -> str:
    """Where a plug-in is: its distribution, or the end of its path that fits `room` px at the smallest size."""
    where = plugin.origin or short(plugin.folder.resolve())
    kept = where
    while text_width(kept, SMALLEST, "body") > room:
        kept = f"…{kept[2:]}"
    return kept
