"""Set-up of a new event: format, game, arena, length, seats and rounds; then its entrants."""

import pygame

from pigaming_app.events.spec import Format
from pigaming_app.scenes.events.setup.arenas_page import ArenasPage
from pigaming_app.scenes.events.setup.draft import BY_TURNS, Draft, variant_of
from pigaming_app.scenes.events.setup.entrants_page import Begin, EntrantsPage
from pigaming_app.scenes.events.setup.format_pictures import picture, row_picture
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_choice import arena_title
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.pages.settings_page import SettingsPage
from pigaming_app.scenes.views import game_tile
from pigaming_app.ui.draw import BODY, readable, text_width
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets import setting_row
from pigaming_app.ui.widgets.setting_row import SettingValue

ARENA, NEXT = "arena", "entrants"  # rows that open a page


class SetupPage(SettingsPage):
    """The page of a draft. `begin`: makes the event of it, and returns the sentence why not, or what follows."""

    untimed = True  # for the limit of a group: the draft would be lost
    table, title, saves = "events", "events.new", False
    idle = 120.0
    hints = (*SettingsPage.hints[:2], (Button.START, "events.hint_entrants"), SettingsPage.hints[2])

    def __init__(self, context: Context, draft: Draft, begin: Begin) -> None:
        self.draft, self.begin = draft, begin
        super().__init__(context, self._rows)

    def on_enter(self) -> None:
        self.context.sounds.music("title")

    def press(self, event: InputEvent) -> StackOperation:
        """START goes on to the entrants, as does the last row."""
        return self.activate(NEXT, event) if event.button is Button.START else super().press(event)

    def activate(self, name: str, event: InputEvent) -> StackOperation:
        self.context.sounds.play("accept")
        if name == ARENA:
            return Push(ArenasPage(self.context, self.draft))
        return Push(EntrantsPage(self.context, self.draft, self.begin))

    def description(self, name: str) -> tuple[str, str]:
        """That of a row; of the formats that of the chosen one."""
        return super().description(self.draft.format.value if name == "format" else self._row_name(name))

    def label(self, name: str) -> str:
        """The name of a row; rounds are called weeks or tries where they are."""
        return super().label(self._row_name(name))

    def _row_name(self, name: str) -> str:
        kind = self.draft.kind
        if name != "rounds" or not kind.on_call:
            return name
        return "tries" if kind.single else "weeks"

    def draw_picture(self, screen: pygame.Surface, name: str, chosen: int) -> None:
        """Draw the picture of a row: of its value, else of the game or the format."""
        draft, panel = self.draft, setting_row.PANEL
        if name in ("game", "order", "arena"):
            game_tile.picture(draft.games[0]).draw(screen, panel.x, panel.y + 48)
        elif name == "format":
            picture(draft.format).draw(screen, *setting_row.CENTRE)
        else:
            number = {"rounds": draft.rounds, "seats": draft.seats}.get(name, chosen)
            row_picture(name, number).draw(screen, *setting_row.CENTRE)

    # ---- inside

    @property
    def _rows(self) -> list[str]:
        """The rows of the draft, with the arenas below the games."""
        rows = [*self.draft.rows, NEXT]
        rows.insert(1 + max(i for i, row in enumerate(rows) if row in ("format", "game", "order")), ARENA)
        return rows

    def value(self, name: str) -> SettingValue:
        if name == NEXT:
            return self.action("events.go_on")
        if name == ARENA:
            return SettingValue("action", (self._arenas(),))
        options = self.draft.options(name)
        names = tuple(self._name(name, option) for option in options)
        short = name in ("seats", "rounds", "fill")
        return SettingValue("toggle" if short else "arrows", names, options.index(getattr(self.draft, name)))

    def apply(self, name: str, chosen: int) -> None:
        self.draft.choose(name, self.draft.options(name)[chosen])
        self.show_rows(self._rows)

    def _name(self, row: str, option: object) -> str:
        """The name of an option."""
        words = self.context.words
        if isinstance(option, Format):
            return words(f"events.{option.value}")
        if row == "game":
            return words("events.turns" if option == BY_TURNS else f"games.{option}")
        if row == "order" and isinstance(option, tuple):
            names = [words(f"events.short_{game}") for game in option]
            whole = "  ·  ".join(names)
            fits = text_width(whole, readable(BODY), "body") <= setting_row.VALUE_ROOM
            return whole if fits else words("events.first_game", game=names[0])
        if row == "length":
            return self._length(str(option))
        if row == "fill":
            return words("options.on" if option else "options.off")
        return str(option) if option else words("events.unlimited")

    def line(self, name: str) -> str:
        """The description of a row; of the games their order, for which the row may have no room."""
        if name == "order":
            return ", ".join(self.context.words(f"events.short_{game}") for game in self.draft.order)
        return super().line(name)

    def _arenas(self) -> str:
        """All arenas by name, or how many there are, if the names have no room."""
        words, draft = self.context.words, self.draft
        found = [(game, arena) for game in draft.games for arena in draft.arenas(game)]
        names = "  ·  ".join(arena_title(load_cached(*one), words.language) for one in found)
        return names if text_width(names, BODY) < setting_row.ROOM - 60 else words("events.by_turns", count=len(found))

    def _length(self, length: str) -> str:
        """A length in words; of a single game in minutes."""
        words, played = self.context.words, [game for game in self.draft.games if len(variant_of(game).minutes) > 1]
        if len(self.draft.games) == 1 and played:
            variant = variant_of(played[0])
            minutes = {"short": variant.minutes[0], "normal": variant.default_minutes, "long": variant.minutes[-1]}
            return words("setup.min", minutes=minutes[length])
        return words(f"events.{length}")
