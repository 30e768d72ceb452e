"""Reason page when a match cannot have real robots: retry, or play with simulated ones."""

from collections.abc import Collection, Sequence

import pygame

from pigaming_app.games.game import Setup
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Home, Pop, StackOperation, Swap
from pigaming_app.scenes.mat.fault_icons import sign
from pigaming_app.scenes.mat.robots.interrupted import MatchOf
from pigaming_app.scenes.play.pause import sheet_title
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.draw import ALARM, ICE, MIST
from pigaming_app.ui.draw.layers import Layer, backdrop
from pigaming_app.ui.draw.text import write_lines
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.dialog import HEAD, ICON, PROMPTS, ROOM, TEXT_X, W, overlay

UNCALIBRATED = ("none", "damaged", "changed", "version", "other_display")  # messages that require calibration
IDLE = 90.0  # s without input before the return to the title


class UnavailablePage:
    """The page. `message`: the reason; `match_of`: match factory for a set of real seats."""

    def __init__(
        self,
        context: Context,
        setup: Setup,
        devices: Sequence[Device | None],
        real: Collection[int],
        message: OperatorMessage,
        match_of: MatchOf,
    ) -> None:
        self.context, self.setup, self.devices, self.real, self.message = context, setup, devices, real, message
        self.match_of = match_of
        self.picture: pygame.Surface | None = None
        self.access = Access(context, lambda: self.devices)
        hints = [(Button.FIRE, "mat.hint_simulated"), (Button.X, "mat.hint_again"), (Button.BACK, "mat.hint_leave")]
        self.prompts = context.prompts(hints, PROMPTS, W - 80, device=lambda: self.access.hint_device)

    def on_enter(self) -> None:
        self.context.sounds.play("error")

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE plays with simulated robots, X retries, BACK leaves."""
        admitted = self.access.admit(self.prompts.as_button(event))
        if admitted is None:
            return None
        event = admitted
        if event.button in (Button.FIRE, Button.START):
            self.context.sounds.play("accept")
            return Swap(self.match_of(self.setup, self.devices, ()))
        if event.button is Button.X:
            return Swap(self.match_of(self.setup, self.devices, self.real))
        if event.button is Button.BACK:
            self.context.sounds.play("back")
            return Pop()
        return None

    def update(self, seconds: float) -> StackOperation:
        if self.access.update(seconds):
            self.context.sounds.play("back")
            return Pop()
        return Home() if self.context.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        if self.picture is None:
            self.picture = overlay(backdrop(), ALARM, self._paint)
        screen.blit(self.picture, (0, 0))
        self.prompts.draw(screen)

    def _paint(self, layer: Layer) -> None:
        words = self.context.words
        sheet_title(layer, None, words("mat.refused"), ICE)
        sign(layer.glow, "robot", *ICON, 76, ALARM)
        y = write_lines(layer, words.sentence(self.message), TEXT_X, HEAD + 56, ROOM, ICE)
        lost = self.message.key in UNCALIBRATED
        write_lines(layer, words("mat.calibrate" if lost else "mat.anyway"), TEXT_X, y + 16, ROOM, MIST)
