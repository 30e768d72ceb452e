"""Options: one page leads to those of picture and sound, controls and easier use.

In a kiosk they offer only what children may change; the operator's page offers everything.
"""

import logging
from functools import cache

import pygame

from pigaming_app.scenes.features.feature import OptionRow
from pigaming_app.scenes.features.registry import features
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.settings_page import SettingsPage
from pigaming_app.scenes.flow.stack import Push, Quit, Scene, StackOperation
from pigaming_app.scenes.options import pictures
from pigaming_app.scenes.views.race.ghost_files import delete_ghosts
from pigaming_app.scenes.views.rumble import TAKEN
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import read_large
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.i18n import LANGUAGES, NAMES
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.widgets.setting_row import CENTRE, SettingValue

CLEAR = 2.0  # seconds for which a button is held to clear the high scores
FLASHES = ("off", "soft", "full")
ROWS = ("language", "picture", "controls", "ease", "games")
SECTIONS: dict[str, tuple[str, ...]] = {
    "picture": ("music", "sounds", "display", "fullscreen"),
    "controls": ("rumble", "padtest", "remap"),
    "ease": ("calm", "flashes", "shake", "large"),
    "games": ("added", "reset"),
}
FOR_CHILDREN = {"language", "rumble", "padtest", *SECTIONS["ease"]}
OPENING = ("padtest", "added", "remap", *SECTIONS)  # rows that open a page, besides those of features
log = logging.getLogger("pigaming")


@cache
def added_rows() -> dict[str, OptionRow]:
    """The rows of features."""
    return {name: row for feature in features() for name, row in feature.options.items()}


def rows_of(section: str) -> tuple[str, ...]:
    """The rows of a section with those of features; empty: of the first page."""
    found = list(SECTIONS.get(section, ROWS))
    for name, row in added_rows().items():
        if row.section == section:
            found.insert(found.index(row.after) + 1, name)
    return tuple(found)


def offered(rows: tuple[str, ...]) -> tuple[str, ...]:
    """Those of the rows that children may change, and those that lead to such rows."""
    return tuple(name for name in rows if name in FOR_CHILDREN or (name in SECTIONS and offered(rows_of(name))))


class OptionsPage(SettingsPage):
    """The options, or one of SECTIONS; `operator`: all rows, also in a kiosk."""

    def __init__(self, context: Context, operator: bool = False, section: str = "") -> None:
        self.operator, self.untimed, self.cleared = operator, operator, False
        self.added = added_rows()
        rows = rows_of(section)
        if context.kiosk:
            rows = rows if operator and section else (*rows, "close") if operator else offered(rows)
        title = section or ("operator" if operator else "title")
        super().__init__(context, "options", f"options.{title}", rows, CLEAR)

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        if name in self.added:
            pictures.added(self.added[name].picture, int(self.clock * 2) % 2).draw(screen, *CENTRE)
        else:
            pictures.sketch(screen, name, chosen, self.clock)

    def render_picture(self, name: str, chosen: int) -> object:
        return pictures.added(self.added[name].picture, 0) if name in self.added else pictures.drawn(name, chosen)

    def value(self, name: str) -> SettingValue:
        """The value of a row."""
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
        opens = name in OPENING or name in self.added
        return SettingValue("deed", (words("options.open" if opens else "options.end"),))

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Open a page, close the arcade, or begin to clear the high scores."""
        self.context.sounds.play("move" if name == "reset" else "accept")
        if name == "close":
            return Quit()
        if name == "reset":
            self.cleared = False
            self.holding.begin(event)
            return None
        return Push(self._page(name))

    def _page(self, name: str) -> Scene:
        """The page that a row opens."""
        if name == "padtest":
            from pigaming_app.scenes.options.controls_test import ControlsTest

            return ControlsTest(self.context)
        if name == "remap":
            from pigaming_app.scenes.options.remap_page import RemapPage

            return RemapPage(self.context)
        if name == "added":
            from pigaming_app.scenes.options.games_page import GamesPage

            return GamesPage(self.context)
        if name in self.added:
            return self.added[name].page(self.context)
        return OptionsPage(self.context, self.operator, name)

    def apply(self, name: str, chosen: int) -> None:
        """Apply a changed value."""
        context, settings, canvas = self.context, self.context.settings, self.context.canvas
        match name:
            case "language":
                settings.language = LANGUAGES[chosen]
                if self.operator or not context.kiosk:
                    settings.settle("language")
                context.words.switch(settings.language)
                self.rewarm()
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
                self.rewarm()
            case "display" | "fullscreen":
                canvas.show(*((chosen, canvas.fullscreen) if name == "display" else (canvas.display, bool(chosen))))
                settings.display, settings.fullscreen = canvas.display, canvas.fullscreen

    def held(self) -> StackOperation:
        """Clear the high scores and ghosts."""
        self.context.scores.reset()
        self.cleared = True
        self.context.sounds.play("accept")
        self.save(lambda: self.context.scores.save(folders().data))
        try:
            delete_ghosts(folders().data)
        except OSError as trouble:
            log.warning("%s", trouble)
        return None
