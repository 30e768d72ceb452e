"""The title: name, underlining robots, a tile per game, and the menu.

After a while without input, the page of a feature shows what there is to play.
"""

from collections.abc import Iterator

import pygame

from pigaming_app.scenes.features.registry import idle_page, menu
from pigaming_app.scenes.flow.auto import AutoStrengths
from pigaming_app.scenes.flow.match_words import last_goal, tagline
from pigaming_app.scenes.flow.scene import Context, Push, Quit, Scene, StackOperation
from pigaming_app.scenes.flow.used_keys import UsedKeys
from pigaming_app.scenes.title.kiosk_unlock import KioskUnlock
from pigaming_app.scenes.title.language import LanguageName
from pigaming_app.scenes.title.logo import dot_of, logo
from pigaming_app.scenes.title.parade import dot_robot, parade
from pigaming_app.scenes.views.game_tile import TileStrip, empty_tile, tile
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.storage.plugins.found import Plugin
from pigaming_app.storage.plugins.parts import undecided
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, Unfinished, budget, drop_paused, resumable
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, backdrop
from pigaming_app.ui.draw.surface_cache import cached, surfaces
from pigaming_app.ui.i18n import NAMES
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.memory import return_freed_blocks, settle
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import (
    blit_sprite,
    button_label,
    call_to_action,
    call_to_action_width,
    chip,
    chip_width,
    pulse,
    sign,
)

PROMPT_Y, FOOT_Y = 906, 990
MENU_GAP, LANGUAGES_W = 16, 240  # px: between two chips; of the language and the button that changes it
LOGO = (LEFT + 16, 84, 30)
REST = 1.0  # s on the title until memory is released: by then its own pictures are those used last


class Title:
    """The lowest scene of the stack."""

    waits = True

    def __init__(self, context: Context) -> None:
        self.context = context
        self.clock = 0.0
        self.kiosk_unlock = KioskUnlock(context)
        self.tiles = TileStrip(shown_games())
        self.complete = False  # whether all tiles have been shown
        self.game = self.tiles.names[0]  # the game whose tile was focused last
        self.menu = menu()  # of features, from left to right
        self.focus = Focus(self._spots())
        self.language = LanguageName(context)
        self.music = True  # off in the quiet hours
        self.since, self.chores = 0.0, self._do_chores()  # s since the last return; see `_rest`
        self.asked: set[str] = set()  # new plug-ins that were asked about

    def on_enter(self) -> None:
        """Release the sprites of matches and start the music; in a kiosk, offer its driving styles again."""
        surfaces.release_matches()
        self.since, self.chores = 0.0, self._do_chores()
        if self.context.kiosk:
            self.context.driving.forget_one_button()
            self.context.shared(AutoStrengths).forget()
        self.context.idle = 0.0
        self._begin_music(not self.context.quiet)
        self.focus.set_spots(self._spots())

    def handle(self, event: InputEvent) -> StackOperation:
        """Directions and the mouse move the focus; FIRE, START or a click activate; Y changes the language."""
        again = event.button is Button.Y or (event.button is Button.CLICK and self.focus.spot_at(event) == "language")
        if not again and self.language.left_by(event):
            return None
        if event.button is Button.Y:
            self.language.next()
        elif self.focus.handle(event):
            self.context.sounds.play("move")
            if self.tiles.follow(self.focus):
                self.focus.set_spots(self._spots())
        self.game = self.focus.name if self.focus.name in self.tiles.names else self.game
        chosen = self.focus.activated(event)
        return self._open(chosen, event.device) if chosen else None

    def update(self, seconds: float) -> StackOperation:
        """Animate; start attract mode when idle."""
        self.clock += seconds
        self.language.update(seconds)
        if self.spoken != self.context.words.language:
            self.focus.set_spots(self._spots())
        self.focus.update(seconds)
        self.tiles.update(seconds)
        self._keep_quiet()
        self._rest(seconds)
        if self.kiosk_unlock.unlocked(seconds):
            from pigaming_app.scenes.options.page import OptionsPage

            self.context.sounds.play("accept")
            return Push(OptionsPage(self.context, operator=True))
        if plugin := self._new_plugin():
            from pigaming_app.scenes.options.games_page import NewGame

            self.asked.add(plugin.key)
            return Push(NewGame(self.context, plugin))
        if self.context.idle > self.context.settings.attract_seconds and not self.context.preloader.busy:
            page = idle_page(self.context)
            return Push(page) if page else None
        return None

    def draw(self, screen: pygame.Surface) -> None:
        screen.blit(ground(), (0, 0))
        parade(screen, self.clock)
        blit_sprite(screen, dot_robot(self.clock, LOGO[2] / 42), *dot_of(*LOGO))
        self._draw_tiles(screen)
        self._prompt(screen)
        self._foot(screen)
        self.focus.draw(screen)
        self.language.draw(screen)

    # ---- internals

    def _draw_tiles(self, screen: pygame.Surface) -> None:
        """Draw the tiles. The first pictures do not wait for them: what is not yet built is an empty frame."""
        frame, complete = empty_tile(), True

        def tile_or_frame(game: str) -> LitImage:
            nonlocal complete
            try:
                return self._tile(game)
            except Unfinished:
                complete = False
                return frame

        with budget.until(budget.prewarm_end):
            self.tiles.draw(screen, self._tile if self.complete else tile_or_frame)
        self.complete = self.complete or complete

    def _tile(self, game: str) -> LitImage:
        words = self.context.words
        line = tagline(words, game, last_goal(self.context.settings, game))
        return tile(game, words(f"games.{game}"), line, self.focus.name == game)

    def _new_plugin(self) -> Plugin | None:
        """A plug-in that nobody has decided about yet; none in a kiosk, where the options are the place for it."""
        new = () if self.context.kiosk else undecided()
        return next((plugin for plugin in new if plugin.key not in self.asked), None)

    def _keep_quiet(self) -> None:
        """Stop the music when the quiet hours begin, and start it when they end."""
        if self.music == self.context.quiet:
            self._begin_music(not self.music)

    def _begin_music(self, on: bool) -> None:
        self.music = on
        self.context.sounds.music("title" if on else None)

    def _rest(self, seconds: float) -> None:
        """Once after each return, do the chores, one a frame."""
        self.since += seconds
        if self.since >= REST:
            next(self.chores, None)

    def _do_chores(self) -> Iterator[None]:
        """Release the memory of the pages before, which stays flat over a day."""
        surfaces.release_pages()
        drop_paused()
        yield
        return_freed_blocks()
        yield
        settle()

    def _open(self, name: str, device: Device) -> StackOperation:
        if name == "language":
            self.language.next()
            return None
        scene = self._scene(name, device)
        self.context.sounds.play("accept")
        return Push(scene) if scene else Quit()

    def _scene(self, name: str, device: Device) -> Scene | None:
        """The page of a menu item; imported late, so that the title appears at once. `device`: seated in a lobby."""
        if name in self.tiles.names:
            from pigaming_app.scenes.lobby.scene import Lobby

            self.context.shared(UsedKeys).forget(device)
            return Lobby(self.context, name, [device] if device.kind != "mouse" else [])
        if name in self.menu:
            return self.menu[name].open(self.context, self.game)
        if name == "options":
            from pigaming_app.scenes.options.page import OptionsPage

            return OptionsPage(self.context)
        return None

    def _spots(self) -> list[FocusSpot]:
        spots = self.tiles.spots()
        widths = [chip_width(self.context.words(f"title.{name}")) for name in self._items()]
        room = RIGHT - LEFT - LANGUAGES_W - MENU_GAP * len(widths)
        x, share = LEFT, min(1.0, room / sum(widths))
        for name, width in zip(self._items(), widths, strict=True):
            w = int(width * share)
            spots.append(FocusSpot(name, pygame.Rect(x, FOOT_Y - 32, w, 64)))
            x += w + MENU_GAP
        words, button = self.context.words, self.context.controls.label(None, Button.Y)
        self.spoken = words.language
        beside = kit.button_width(button) + 28 if button else 0
        self.language_word = NAMES[words.language]
        if RIGHT - chip_width(self.language_word) - beside < x:  # no room: its code
            self.language_word = words.language.upper()
        w = chip_width(self.language_word)
        return [*spots, FocusSpot("language", pygame.Rect(RIGHT - w, FOOT_Y - 32, w, 64))]

    def _items(self) -> tuple[str, ...]:
        return (*self.menu, "options") if self.context.kiosk else (*self.menu, "options", "quit")

    def _prompt(self, screen: pygame.Surface) -> None:
        """The call to action, between arrows that run towards it."""
        sentence, label = self.call_text
        call_to_action(sentence, label, kit.SUB, pulse(self.clock, 5)).draw(screen, 960, PROMPT_Y)
        reach = call_to_action_width(sentence, label, kit.SUB) / 2 + 44
        for k in range(3):
            level = (3, 5, 8)[(k + int(self.clock * 4)) % 3]
            sign("right", 24, kit.FOCUS, kit.LINE, level).draw(screen, round(960 - reach - 34 * (2 - k)), PROMPT_Y)
            sign("left", 24, kit.FOCUS, kit.LINE, level).draw(screen, round(960 + reach + 34 * (2 - k)), PROMPT_Y)

    @property
    def call_text(self) -> tuple[str, str]:
        """The call to action and the label of its button."""
        words, name = self.context.words, self.focus.name
        label = words.key_name(self.context.controls.label(None, Button.FIRE))
        if name in self.tiles.names:
            return words("title.press", button="{button}"), label
        what = words("options.language") if name == "language" else self._item_name(name)
        return words("title.choose", button="{button}", what=what), label

    def _item_name(self, name: str) -> str:
        """The word on a menu item; the language is called by its own name."""
        return self.language_word if name == "language" else self.context.words(f"title.{name}")

    def _foot(self, screen: pygame.Surface) -> None:
        for name in (*self._items(), "language"):
            box = self.focus.rect(name)
            chip(self._item_name(name), box.w, "on" if name == self.focus.name else "off").draw(screen, *box.topleft)
        label = self.context.controls.label(None, Button.Y)
        if label:
            button_label(label).draw(screen, self.focus.rect("language").left - 28 - kit.button_width(label), FOOT_Y)


@cached
@resumable
def ground() -> Steps[pygame.Surface]:
    """The static part: floor dots and the name."""
    layer = Layer(LEFT, 54, 1210, 260)
    logo(layer.glow, *LOGO)
    name = yield from layer.render_steps()
    out = backdrop().copy()
    name.draw(out)
    return out
