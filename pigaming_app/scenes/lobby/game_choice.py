"""Game selection after a match: one tile per game. Players keep their seats and devices."""

from collections.abc import Callable, Sequence

import pygame

from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_words import last_goal, tagline
from pigaming_app.scenes.flow.stack import Home, Pop, Scene, StackOperation
from pigaming_app.scenes.views.game_tile import TILE_H, tile, tile_rect
from pigaming_app.ui.draw.layers import backdrop
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out, heading

IDLE = 60.0  # s without input before the return to the title
DOWN = (1080 - TILE_H) // 2 - tile_rect(0).y + 20  # px, offset of the tiles below their position on the title screen

LobbyOf = Callable[[Context, str, Sequence[Device | str | None]], Scene]  # lobby factory: context, game, drivers


class GameChoice:
    """Selection page after a match of `setup`, whose seats were driven by `devices`. Initial focus: the next game."""

    def __init__(self, context: Context, setup: Setup, devices: Sequence[Device | None], lobby: LobbyOf) -> None:
        self.context, self.setup, self.devices, self.lobby = context, setup, list(devices), lobby
        self.access = Access(context, lambda: self.devices)
        names = list(games())
        after = names[(names.index(setup.game) + 1) % len(names)]
        self.focus = Focus([FocusSpot(game, tile_rect(i).move(0, DOWN)) for i, game in enumerate(names)], after)
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
        game = self.focus.activated(admitted)
        return self._open(game) if game else None

    def update(self, seconds: float) -> StackOperation:
        """Animate the focus; leave when idle or abandoned."""
        self.focus.update(seconds)
        if self.access.update(seconds):
            self.context.sounds.play("back")
            return Pop()
        return Home() if self.context.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        words = self.context.words
        screen.blit(backdrop(), (0, 0))
        heading(words("choice.title")).draw(screen)
        black_out(screen, *(spot.rect for spot in self.focus.spots))
        for spot in self.focus.spots:
            game = spot.name
            line = tagline(words, game, last_goal(self.context.settings, game))
            lit = tile(game, words(f"games.{game}"), line, game == self.focus.name)
            lit.draw(screen, *spot.rect.topleft)
        self.focus.draw(screen)
        self.prompts.draw(screen)

    def _open(self, game: str) -> StackOperation:
        """Open the lobby of a game with the connected devices and the AIs already seated."""
        self.context.sounds.play("accept")
        drivers: list[Device | str | None] = []
        for device, seat in zip(self.devices, self.setup.seats, strict=True):
            here = device if device and self.context.controls.connected(device) else None
            drivers.append(here or (None if seat.brain in ("human", "off") else seat.brain))
        return Home(self.lobby(self.context, game, drivers))
