"""Set-up of a new event: format, game, arena, length, seats and rounds; then its entrants."""

import pygame

from pigaming_app.events.spec import Format
from pigaming_app.scenes.events.setup.arenas_page import ArenasPage
from pigaming_app.scenes.events.setup.draft import BY_TURNS, Draft, variant_of
from pigaming_app.scenes.events.setup.entrants_page import Begin, EntrantsPage
from pigaming_app.scenes.events.setup.format_pictures import picture, row_picture
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_choice import arena_title, load_cached
from pigaming_app.scenes.flow.navigation import Navigation
from pigaming_app.scenes.flow.stack import Push, StackOperation
from pigaming_app.scenes.views import game_tile
from pigaming_app.ui.draw import BODY, readable, text_width
from pigaming_app.ui.draw.layers import backdrop
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets import setting_row
from pigaming_app.ui.widgets.focus import Focus
from pigaming_app.ui.widgets.labels import black_out, frame, heading
from pigaming_app.ui.widgets.setting_row import SettingValue

IDLE = 120.0  # s without input before the return to the title
ARENA, NEXT = "arena", "entrants"  # rows that open a page


class SetupPage:
    """The page of a draft. `begin`: makes the event of it, and returns the sentence why not, or what follows."""

    untimed = True  # for the limit of a group: the draft would be lost

    def __init__(self, context: Context, draft: Draft, begin: Begin) -> None:
        self.context, self.draft, self.begin = context, draft, begin
        hints = [
            (Button.RIGHT, "options.hint_change"),
            (Button.FIRE, "options.hint_ok"),
            (Button.START, "events.hint_entrants"),
            (Button.BACK, "options.hint_back"),
        ]
        self.focus = Focus(setting_row.spots(self._rows))
        self.navigation = Navigation(context, self.focus, hints, IDLE)

    def on_enter(self) -> None:
        self.context.sounds.music(True)

    def handle(self, event: InputEvent) -> StackOperation:
        """LEFT and RIGHT change a row, FIRE too; START and the last row go on to the entrants."""
        event = self.navigation.prompts.as_button(event)
        row = self.focus.name
        if event.button in (Button.FIRE, Button.START):
            if event.button is Button.START or row in (ARENA, NEXT):
                return self._open(NEXT if event.button is Button.START else row)
            self._step(row, 1, True)
            return None
        if event.button is Button.CLICK:
            self.focus.handle(event)
            row = self.focus.spot_at(event) or ""
            if row in (ARENA, NEXT):
                return self._open(row)
        if row not in ("", ARENA, NEXT) and (by := setting_row.step_of(event, self.focus, self._value(row))):
            self._step(row, by, event.button is Button.CLICK)
            return None
        return None if event.button in (Button.LEFT, Button.RIGHT) else self.navigation.handle(event)

    def update(self, seconds: float) -> StackOperation:
        return self.navigation.update(seconds)

    def draw(self, screen: pygame.Surface) -> None:
        words, focus = self.context.words, self.focus.name
        screen.blit(backdrop(), (0, 0))
        heading(words("events.new")).draw(screen)
        black_out(screen, setting_row.PANEL)
        values = {spot.name: self._value(spot.name) for spot in self.focus.spots}
        setting_row.draw(screen, words, self.focus, "events", values)
        frame(*setting_row.PANEL.size).draw(screen, *setting_row.PANEL.topleft)
        self._draw_picture(screen, focus, values[focus].chosen)
        if focus == "format":
            name = self.draft.format.value
            setting_row.describe(screen, words(f"events.{name}"), words(f"events.{name}_line"))
        else:
            setting_row.describe(screen, words(f"events.{focus}"), self._line(focus))
        self.navigation.prompts.draw(screen)

    # ---- inside

    @property
    def _rows(self) -> list[str]:
        """The rows of the draft, with the arenas below the games."""
        rows = [*self.draft.rows, NEXT]
        rows.insert(1 + max(i for i, row in enumerate(rows) if row in ("game", "order")), ARENA)
        return rows

    def _open(self, row: str) -> StackOperation:
        self.context.sounds.play("accept")
        if row == ARENA:
            return Push(ArenasPage(self.context, self.draft))
        return Push(EntrantsPage(self.context, self.draft, self.begin))

    def _draw_picture(self, screen: pygame.Surface, row: str, chosen: int) -> None:
        """Draw the picture of a row: of its value, else of the game or the format."""
        draft, panel = self.draft, setting_row.PANEL
        if row in ("game", "order", "arena"):
            game_tile.picture(draft.games[0]).draw(screen, panel.x, panel.y + 48)
        elif row == "format":
            picture(draft.format).draw(screen, *setting_row.CENTRE)
        else:
            number = {"rounds": draft.rounds, "seats": draft.seats}.get(row, chosen)
            row_picture(row, number).draw(screen, *setting_row.CENTRE)

    def _step(self, row: str, by: int, cyclic: bool) -> None:
        """Step the value of a row; `cyclic`: after the last one comes the first."""
        options = self.draft.options(row)
        now = options.index(getattr(self.draft, row)) + by
        now = now % len(options) if cyclic else max(0, min(len(options) - 1, now))
        if options[now] != getattr(self.draft, row):
            self.draft.choose(row, options[now])
            self.focus.set_spots(setting_row.spots(self._rows))
            self.context.sounds.play("move")

    def _value(self, row: str) -> SettingValue:
        words, draft = self.context.words, self.draft
        if row == NEXT:
            return SettingValue("deed", (words("events.go_on"),))
        if row == ARENA:
            return SettingValue("deed", (self._arenas(),))
        options = draft.options(row)
        names = tuple(self._name(row, option) for option in options)
        short = row in ("seats", "rounds", "fill")
        return SettingValue("toggle" if short else "arrows", names, options.index(getattr(draft, row)))

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
        return str(option)

    def _line(self, row: str) -> str:
        """The description of a row; of the games their order, for which the row may have no room."""
        if row == "order":
            return ", ".join(self.context.words(f"events.short_{game}") for game in self.draft.order)
        return self.context.words(f"events.{row}_line")

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
