"""The operator's page of games that are plug-ins: each on or off from the next start on, where it is, why it failed.

Before the code of a new one first runs, a page asks whether to switch it on.
"""

import logging
from pathlib import Path

import pygame

from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.match_words import game_title
from pigaming_app.scenes.flow.scene import Context, Pop, Push, StackOperation, Swap
from pigaming_app.scenes.pages.page import Hints
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.pages.sheet import Sheet
from pigaming_app.scenes.play.pause import sheet_title
from pigaming_app.scenes.views import game_tile
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.storage.plugins.consent import is_on, switch
from pigaming_app.storage.plugins.found import Plugin, found, user_folder
from pigaming_app.storage.plugins.parts import failure, plugins
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import ALARM, BODY, FOCUS, ICE, LINE, MIST, STEEL, THIN, icon, text_width
from pigaming_app.ui.draw.layers import LEFT, RIGHT, SMALLEST, Layer, LitImage, fit_size, fit_text, text, write_lines
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.dialog import FOOT, HEAD, ICON, ROOM, TEXT_X
from pigaming_app.ui.widgets.labels import sign
from pigaming_app.ui.widgets.setting_row import SettingValue

INPUT_LOCKOUT = 0.5  # s: a press of the screen before does not answer
QUESTION, ON, OFF, UNSAVED = "question", "plays", "stays_off", "unsaved"  # states
log = logging.getLogger("pigaming")
ROWS = 6  # plug-ins on a page
MORE, NONE = "more", "none"  # names of rows
PLACE_Y, REASON_Y = dials.PANEL.bottom - 26, 922  # px: where it is, why it failed
SCALE = 0.8  # of the picture of a tile


class GamesPage(SettingsPage):
    """One page of plug-ins; the row below them leads to the next one. `first`: index of its first plug-in."""

    right = Right.SETTINGS
    table, title = "plugins", "plugins.title"

    def __init__(self, context: Context, first: int = 0) -> None:
        self.first, every = first, found()
        self.count = len(every)
        self.plugins = {str(i): plugin for i, plugin in enumerate(every[first : first + ROWS])}
        self.question: NewGame | None = None
        rows = (*self.plugins, *((MORE,) if self.count > ROWS else ())) or (NONE,)
        super().__init__(context, rows)

    @property
    def subtitle(self) -> str:
        return self.context.words("plugins.when")

    def on_enter(self) -> None:
        """First display, or return from a question."""
        self.rewarm()

    def advance(self, seconds: float) -> StackOperation:
        """Ask about a new plug-in."""
        question, self.question = self.question, None
        return Push(question) if question else None

    def paint(self, screen: pygame.Surface) -> None:
        super().paint(screen)
        if plugin := self.plugins.get(self.focus.name):
            if (reason := why(plugin)) and not self.message:
                line, size = fit_text(reason, BODY, RIGHT - LEFT, "body")
                text(line, size, ALARM, "body", "l").draw(screen, LEFT, REASON_Y)
            room = dials.PANEL.w - 80
            text(place(plugin, room), SMALLEST, MIST, "body", "l", room).draw(screen, dials.PANEL.x + 40, PLACE_Y)

    def label(self, name: str) -> str:
        return game_name(self.context.words, self.plugins[name]) if name in self.plugins else super().label(name)

    def line(self, name: str) -> str:
        """The state of a plug-in: plays, off, new, or why it failed."""
        words = self.context.words
        if name == NONE:
            return words("plugins.none_line", folder=short(user_folder()))
        if name == MORE:
            return words("plugins.more_line")
        plugin = self.plugins[name]
        if why(plugin):
            return words("plugins.failed_line")
        on = is_on(plugin)
        state = "new" if on is None else "on" if on else "off"
        return words(f"plugins.{state}_line" if bool(on) == (plugin in plugins()) else f"plugins.{state}_later")

    def value(self, name: str) -> SettingValue:
        """On or off; a new one is off."""
        if name not in self.plugins:
            return self.action("plugins.next" if name == MORE else "options.hint_back")
        return self.switch(bool(is_on(self.plugins[name])))

    def apply(self, name: str, chosen: int) -> None:
        """Switch a plug-in; a new one asks first."""
        plugin = self.plugins[name]
        if chosen and is_on(plugin) is None:
            self.question = NewGame(self.context, plugin)
            return
        self.save(lambda: switch(plugin.key, bool(chosen)))
        self.rewarm()

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """The next page, or back if there is nothing."""
        self.context.sounds.play("accept" if name == MORE else "back")
        following = self.first + ROWS if self.first + ROWS < self.count else 0
        return Swap(GamesPage(self.context, following)) if name == MORE else Pop()

    def picture(self, name: str, chosen: int) -> LitImage:
        """The picture of a game that plays, centred on (0, 0); else a sign."""
        plugin = self.plugins.get(name)
        if plugin in plugins() and plugin.name in shown_games():
            return smaller(plugin.name)
        if plugin is None:
            return sign("right" if name == MORE else "list", 90, STEEL, THIN)
        return sign("cross" if why(plugin) else "unknown", 90, ALARM if why(plugin) else STEEL, THIN)


@cached
def smaller(game: str) -> LitImage:
    """The picture of a game, 560 x 284 px, as it fits the panel, centred on (0, 0)."""
    lit = game_tile.picture(game)
    x, y = SCALE * (lit.at[0] - 280), SCALE * (lit.at[1] - 142)
    return LitImage(pygame.transform.smoothscale_by(lit.image, SCALE), (round(x), round(y)))


def why(plugin: Plugin) -> str:
    """The reason why a plug-in is left out, or nothing."""
    return plugin.fault or failure(plugin).partition(" is left out: ")[2]


class NewGame(Sheet):
    """X switches it on, FIRE leaves it off, BACK leaves it for later. Either counts from the next start on."""

    right = Right.SETTINGS
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
