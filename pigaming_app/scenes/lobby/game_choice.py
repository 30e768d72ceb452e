"""Game selection after a match: one tile per game. Players keep their seats and devices."""

from collections.abc import Callable, Sequence

import pygame

from pigaming_app.games.game import Setup
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.match_words import last_goal, tagline
from pigaming_app.scenes.flow.scene import Context, Home, Scene, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.views.game_tile import TILE_H, TileStrip, tile
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.focus import Focus

TILES_Y = (1080 - TILE_H) // 2 + 20  # px

LobbyOf = Callable[[Context, str, Sequence[Device | str | None]], Scene]  # lobby factory: context, game, drivers


class GameChoice(Page):
    """Selection page after a match of `setup`, whose seats were driven by `devices`. Initial focus: the next game."""

    title, idle = "choice.title", 60.0
    hints = ((Button.FIRE, "choice.hint_ok"), (Button.BACK, "choice.hint_back"))

    def __init__(self, context: Context, setup: Setup, devices: Sequence[Device | None], lobby: LobbyOf) -> None:
        self.setup, self.devices, self.lobby = setup, list(devices), lobby
        self.access = Access(context, lambda: self.devices)
        names = shown_games()
        self.tiles = TileStrip(names, TILES_Y)
        focus = Focus(self.tiles.spots(), names[(names.index(setup.game) + 1) % len(names)])
        super().__init__(context, focus, self.access)
        self._follow()

    def press(self, event: InputEvent) -> StackOperation:
        turn = super().press(event)
        self._follow()
        return turn

    def advance(self, seconds: float) -> StackOperation:
        self.tiles.update(seconds)
        return None

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the tiles."""
        self.tiles.draw(screen, self._tile)
        self.focus.draw(screen)

    def _tile(self, game: str) -> LitImage:
        words = self.context.words
        line = tagline(words, game, last_goal(self.context.settings, game))
        return tile(game, words(f"games.{game}"), line, game == self.focus.name)

    def _follow(self) -> None:
        """Keep the focused tile in the picture."""
        if self.tiles.follow(self.focus):
            self.focus.set_spots(self.tiles.spots())

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        """Open the lobby of a game with the connected devices and the AIs already seated."""
        self.context.sounds.play("accept")
        drivers: list[Device | str | None] = []
        for device, seat in zip(self.devices, self.setup.seats, strict=True):
            here = device if device and self.context.controls.connected(device) else None
            drivers.append(here or (None if seat.brain in ("human", "off") else seat.brain))
        return Home(self.lobby(self.context, name, drivers))
