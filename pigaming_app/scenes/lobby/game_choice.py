"""Game selection after a match: one tile per game. Players keep their seats and devices."""

from collections.abc import Callable, Sequence

import pygame

from pigaming_app.games.game import Setup
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_words import last_goal, tagline
from pigaming_app.scenes.flow.stack import Home, Pop, Scene, StackOperation
from pigaming_app.scenes.views.game_tile import TILE_H, TileStrip, tile
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.ui.draw.layers import LitImage, backdrop
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.focus import Focus
from pigaming_app.ui.widgets.labels import heading

IDLE = 60.0  # s without input before the return to the title
TILES_Y = (1080 - TILE_H) // 2 + 20  # px

LobbyOf = Callable[[Context, str, Sequence[Device | str | None]], Scene]  # lobby factory: context, game, drivers


class GameChoice:
    """Selection page after a match of `setup`, whose seats were driven by `devices`. Initial focus: the next game."""

    def __init__(self, context: Context, setup: Setup, devices: Sequence[Device | None], lobby: LobbyOf) -> None:
        self.context, self.setup, self.devices, self.lobby = context, setup, list(devices), lobby
        self.access = Access(context, lambda: self.devices)
        names = shown_games()
        self.tiles = TileStrip(names, TILES_Y)
        self.focus = Focus(self.tiles.spots(), names[(names.index(setup.game) + 1) % len(names)])
        self._follow()
        hints = [(Button.FIRE, "choice.hint_ok"), (Button.BACK, "choice.hint_back")]
        self.prompts = context.prompts(hints, device=lambda: self.access.hint_device)

    def on_enter(self) -> None:
        """Nothing to do."""

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE selects a game, BACK returns to the results."""
        admitted = self.access.admit(self.prompts.as_button(event))
        if admitted is None:
            return None
        if admitted.button is Button.BACK:
            self.context.sounds.play("back")
            return Pop()
        if self.focus.handle(admitted):
            self.context.sounds.play("move")
            self._follow()
        game = self.focus.activated(admitted)
        return self._open(game) if game else None

    def update(self, seconds: float) -> StackOperation:
        """Animate the focus; leave when idle or abandoned."""
        self.focus.update(seconds)
        self.tiles.update(seconds)
        if self.access.update(seconds):
            self.context.sounds.play("back")
            return Pop()
        return Home() if self.context.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        words = self.context.words
        screen.blit(backdrop(), (0, 0))
        heading(words("choice.title")).draw(screen)
        self.tiles.draw(screen, self._tile)
        self.focus.draw(screen)
        self.prompts.draw(screen)

    def _tile(self, game: str) -> LitImage:
        words = self.context.words
        line = tagline(words, game, last_goal(self.context.settings, game))
        return tile(game, words(f"games.{game}"), line, game == self.focus.name)

    def _follow(self) -> None:
        """Keep the focused tile in the picture."""
        if self.tiles.follow(self.focus):
            self.focus.set_spots(self.tiles.spots())

    def _open(self, game: str) -> StackOperation:
        """Open the lobby of a game with the connected devices and the AIs already seated."""
        self.context.sounds.play("accept")
        drivers: list[Device | str | None] = []
        for device, seat in zip(self.devices, self.setup.seats, strict=True):
            here = device if device and self.context.controls.connected(device) else None
            drivers.append(here or (None if seat.brain in ("human", "off") else seat.brain))
        return Home(self.lobby(self.context, game, drivers))
