"""Options: one page leads to those of picture and sound, controls and easier use.

In a kiosk they offer only what children may change; the operator's page offers everything.
"""

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial

import pygame

from pigaming_app.scenes.features.feature import OptionRow
from pigaming_app.scenes.features.registry import features
from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.scene import Context, Push, Quit, Scene, StackOperation
from pigaming_app.scenes.options import pictures
from pigaming_app.scenes.options.games_page import GamesPage
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.views.registry import SCREENS, shown_games
from pigaming_app.scenes.views.rumble import TAKEN
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import read_large
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.i18n import LANGUAGES, NAMES
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.widgets.setting_row import CENTRE, SettingValue

FLASHES = ("off", "soft", "full")
log = logging.getLogger("pigaming")


class OptionsPage(SettingsPage):
    """The options, or one of SECTIONS; `operator`: all rows, also in a kiosk."""

    table, hold = "options", 2.0

    def __init__(self, context: Context, operator: bool = False, section: str = "") -> None:
        self.operator, self.untimed, self.cleared = operator, operator, False
        self.right = Right.SETTINGS if operator or not context.kiosk else Right.PLAY
        self.title = f"options.{section or ('operator' if operator else 'title')}"
        self.options = options_of(section)
        rows = [*self.options] if operator or not context.kiosk else offered(section)
        self.options["close"] = Option(lambda page: page.action("options.end"), lambda page: Quit())
        super().__init__(context, [*rows, "close"] if operator and context.kiosk and not section else rows)

    def value(self, name: str) -> SettingValue:
        return self.options[name].value(self)

    def apply(self, name: str, chosen: int) -> None:
        self.options[name].apply(self, chosen)
        self.rewarm()

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        """Open a page, close the arcade, or begin to clear the high scores."""
        self.context.sounds.play("move" if name == "reset" else "accept")
        if name == "reset":
            self.cleared = False
            self.holding.begin(event)
        return self.options[name].activate(self)

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        added = added_rows().get(name)
        if added:
            pictures.added(added.picture, int(self.age * 2) % 2).draw(screen, *CENTRE)
        else:
            pictures.sketch(screen, name, chosen, self.age)

    def held(self) -> StackOperation:
        """Clear the high scores, and what games keep besides."""
        self.context.scores.reset()
        self.cleared = True
        self.context.sounds.play("accept")
        self.save(lambda: self.context.scores.save(folders().data))
        for game in shown_games():
            try:
                SCREENS[game].forget(folders().data)
            except OSError as trouble:
                log.warning("%s", trouble)
        return None


@dataclass(frozen=True)
class Option:
    """A row: its value, what its action does, or what becomes of a value that was chosen.

    `for_children`: they may change it in a kiosk.
    """

    value: Callable[[OptionsPage], SettingValue]
    activate: Callable[[OptionsPage], StackOperation] = lambda page: None
    apply: Callable[[OptionsPage, int], object] = lambda page, chosen: None
    for_children: bool = False


def opens(scene: Callable[[OptionsPage], Scene], for_children: bool = False) -> Option:
    """A row that opens a page."""
    return Option(lambda page: page.action("options.open"), lambda page: Push(scene(page)), for_children=for_children)


def chosen_from(
    name: str,
    values: Sequence[object],
    shown: Callable[[OptionsPage, int], SettingValue],
    then: Callable[[OptionsPage], object] = lambda page: None,
    for_children: bool = False,
) -> Option:
    """A row for a setting with these values. `shown`: its content while the i-th is chosen; `then`: what follows."""

    def value(page: OptionsPage) -> SettingValue:
        return shown(page, values.index(getattr(page.context.settings, name)))

    def apply(page: OptionsPage, chosen: int) -> None:
        page.context.settings.choose(name, values[chosen])
        then(page)

    return Option(value, apply=apply, for_children=for_children)


def switch(name: str, then: Callable[[OptionsPage], object] = lambda page: None) -> Option:
    """A row for a setting that is on or off."""
    return chosen_from(name, (False, True), lambda page, on: page.switch(bool(on)), then, for_children=True)


def meter(name: str) -> Option:
    """A row for a volume."""
    return chosen_from(name, range(11), lambda page, now: SettingValue("meter", (), now), _set_volume)


def _flashes(page: OptionsPage, chosen: int) -> SettingValue:
    return SettingValue("toggle", tuple(page.context.words(f"options.{code}") for code in FLASHES), chosen)


def _languages(page: OptionsPage, chosen: int) -> SettingValue:
    now = LANGUAGES.index(page.context.words.language)  # which may be another than that of the settings
    return SettingValue("arrows", tuple(NAMES[code] for code in LANGUAGES), now)


def _speak(page: OptionsPage) -> None:
    settings = page.context.settings
    if page.operator or not page.context.kiosk:
        settings.settle("language")
    page.context.words.switch(settings.language)


def _set_volume(page: OptionsPage) -> None:
    page.context.sounds.volume(*page.context.settings.loudness)


def _rumble(page: OptionsPage) -> None:
    """Show what it feels like."""
    if page.context.settings.rumble:
        page.context.controls.rumble(page.context.controls.last, *TAKEN)


def _resize_texts(page: OptionsPage) -> None:
    read_large(page.context.settings.large_text)
    surfaces.clear()


def _show_on(page: OptionsPage, display: int | None = None, fullscreen: bool | None = None) -> None:
    canvas, settings = page.context.canvas, page.context.settings
    canvas.show(canvas.display if display is None else display, canvas.fullscreen if fullscreen is None else fullscreen)
    settings.display, settings.fullscreen = canvas.display, canvas.fullscreen


def _displays(page: OptionsPage) -> SettingValue:
    return SettingValue("arrows", tuple(page.context.canvas.displays()), page.context.canvas.display)


def _section(name: str) -> Option:
    return opens(lambda page: OptionsPage(page.context, page.operator, name))


SECTIONS: dict[str, dict[str, Option]] = {
    "picture": {
        "music": meter("music"),
        "sounds": meter("sounds"),
        "display": Option(_displays, apply=lambda page, chosen: _show_on(page, display=chosen)),
        "fullscreen": Option(
            lambda page: page.switch(page.context.canvas.fullscreen),
            apply=lambda page, chosen: _show_on(page, fullscreen=bool(chosen)),
        ),
    },
    "controls": {"rumble": switch("rumble", _rumble)},
    "ease": {
        "calm": switch("calm"),
        "flashes": chosen_from("flashes", FLASHES, _flashes, for_children=True),
        "shake": switch("shake"),
        "large": switch("large_text", _resize_texts),
    },
    "games": {
        "added": opens(lambda page: GamesPage(page.context)),
        "reset": Option(lambda page: page.action("options.cleared" if page.cleared else "options.clear")),
    },
}
FIRST: dict[str, Option] = {
    "language": chosen_from("language", LANGUAGES, _languages, _speak, for_children=True),
    **{name: _section(name) for name in SECTIONS},
}


@cache
def added_rows() -> Mapping[str, OptionRow]:
    """The rows of features."""
    return {name: row for feature in features() for name, row in feature.options.items()}


def options_of(section: str) -> dict[str, Option]:
    """The rows of a section with those of features; empty: of the first page."""
    found = [*SECTIONS.get(section, FIRST).items()]
    for name, row in added_rows().items():
        if row.section == section:
            known = [name for name, _ in found]
            place = known.index(row.after) + 1 if row.after in known else len(found)
            found.insert(place, (name, opens(partial(_page_of, row), row.for_children)))
    return dict(found)


def _page_of(row: OptionRow, page: OptionsPage) -> Scene:
    return row.page(page.context)


def offered(section: str) -> list[str]:
    """Those of the rows of a section that children may change, and those that lead to such rows."""
    options = options_of(section)
    return [name for name in options if options[name].for_children or (name in SECTIONS and offered(name))]
