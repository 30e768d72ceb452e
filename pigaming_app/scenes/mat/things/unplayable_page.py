"""Page before a match whose arena cannot be played with the things on the mat: build again, or play without them."""

from collections.abc import Callable, Sequence

import pygame

from pigaming_app.games.game import Setup
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_choice import arena_title, load_cached
from pigaming_app.scenes.flow.stack import Home, Pop, Push, Scene, StackOperation, Swap
from pigaming_app.scenes.mat.things.arena_page import ArenaPage
from pigaming_app.scenes.mat.things.outlines import boxes
from pigaming_app.scenes.play.pause import sheet_title
from pigaming_app.ui.draw import ALARM, ICE, MIST
from pigaming_app.ui.draw.layers import Layer, backdrop
from pigaming_app.ui.draw.text import write_lines
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.dialog import HEAD, ICON, PROMPTS, ROOM, TEXT_X, W, overlay

IDLE = 90.0  # s without input before the return to the title


class UnplayablePage:
    """The page. `again` and `without` make the match with the things, as they are then, and without."""

    def __init__(
        self,
        context: Context,
        setup: Setup,
        devices: Sequence[Device | None],
        again: Callable[[], Scene],
        without: Callable[[], Scene],
    ) -> None:
        self.context, self.setup, self.devices, self.again, self.without = context, setup, devices, again, without
        self.picture: pygame.Surface | None = None
        self.building = False
        self.access = Access(context, lambda: self.devices)
        hints = [(Button.FIRE, "things.hint_build"), (Button.X, "things.hint_without"), (Button.BACK, "mat.hint_leave")]
        self.prompts = context.prompts(hints, PROMPTS, W - 80, device=lambda: self.access.hint_device)

    def on_enter(self) -> None:
        if not self.building:
            self.context.sounds.play("error")

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE builds again, X plays without the things, BACK leaves."""
        admitted = self.access.admit(self.prompts.as_button(event))
        if admitted is None:
            return None
        match admitted.button:
            case Button.FIRE | Button.START:
                self.building = True
                self.context.sounds.play("accept")
                return Push(ArenaPage(self.context, lambda: self.devices))
            case Button.X:
                self.context.sounds.play("accept")
                return Swap(self.without())
            case Button.BACK:
                self.context.sounds.play("back")
                return Pop()
        return None

    def update(self, seconds: float) -> StackOperation:
        """Try again after the arena was built."""
        if self.building:
            return Swap(self.again())
        if self.access.update(seconds):
            self.context.sounds.play("back")
            return Pop()
        return Home() if self.context.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        if self.picture is None:
            self.picture = overlay(backdrop(), ALARM, self._paint, (self.setup.game, self.setup.arena))
        screen.blit(self.picture, (0, 0))
        self.prompts.draw(screen)

    def _paint(self, layer: Layer) -> None:
        words = self.context.words
        title = arena_title(load_cached(self.setup.game, self.setup.arena), words.language)
        sheet_title(layer, None, words("things.in_the_way"), ICE)
        boxes(layer.glow, *ICON, ALARM)
        y = write_lines(layer, words("things.unplayable", arena=title), TEXT_X, HEAD + 56, ROOM, ICE)
        write_lines(layer, words("things.move_them"), TEXT_X, y + 16, ROOM, MIST)
