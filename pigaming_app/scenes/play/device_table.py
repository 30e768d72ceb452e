"""The device table of a pause: for each seat its device, driving style, and the keys for steering, fire and turbo."""

from collections.abc import Callable, Sequence
from itertools import chain

import pygame

from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.driving import PICTURES
from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, budget
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, backdrop, fit_size
from pigaming_app.ui.input.events import Button, Device, InputEvent

TOP, PITCH, HIGH = 236, 164, 140
NAMES, MOVES, FIRES, TURBO = LEFT + 150, LEFT + 500, LEFT + 1040, LEFT + 1390


class DeviceTable:
    """One row per seat driven by a device; None: an AI or nobody. `access`: which devices may act; `style_of`: the
    driving style of a device.
    """

    def __init__(
        self, context: Context, devices: Sequence[Device | None], access: Access, style_of: Callable[[Device], str]
    ) -> None:
        self.context, self.access, self.style_of = context, access, style_of
        self.rows = [(seat, device) for seat, device in enumerate(devices) if device]
        self.lit: list[LitImage] = []
        self.making = self._make()
        self.prompts = context.prompts([(Button.BACK, "pause.hint_back")], device=lambda: access.hint_device)

    def on_enter(self) -> None:
        pass

    def handle(self, event: InputEvent) -> StackOperation:
        """Any button leads back."""
        admitted = self.access.admit(self.prompts.as_button(event))
        if admitted and admitted.button in (Button.FIRE, Button.START, Button.BACK):
            self.context.sounds.play("back")
            return Pop()
        return None

    def update(self, seconds: float) -> StackOperation:
        self.access.update(seconds)
        return None

    def draw(self, screen: pygame.Surface) -> None:
        for _ in self.making:
            budget.pause()
        screen.blit(backdrop(), (0, 0))
        for lit in self.lit:
            lit.draw(screen)
        self.prompts.draw(screen)

    def _make(self) -> Steps[None]:
        """Build the page layer by layer."""
        panes = (self._row(i, *row) for i, row in enumerate(self.rows))
        for layer in chain([self._heading()], panes):
            yield
            lit = yield from layer.render_steps()
            self.lit.append(lit)

    def _heading(self) -> Layer:
        layer = Layer(LEFT, 54, RIGHT - LEFT, 130)
        text = self.context.words("pause.drives")
        layer.canvas.text(text, fit_size(text, kit.TITLE, RIGHT - LEFT), LEFT, 112)
        layer.glow.line([(LEFT, 176), (RIGHT, 176)], kit.STEEL, kit.THIN).line(
            [(LEFT, 176), (LEFT + 218, 176)], kit.ICE, kit.LINE
        )
        return layer

    def _row(self, i: int, seat: int, device: Device) -> Layer:
        words, controls = self.context.words, self.context.controls
        y = TOP + PITCH * i + HIGH // 2
        layer = Layer(LEFT, y - HIGH // 2, RIGHT - LEFT, HIGH)
        kit.panel(layer.glow, LEFT, y - HIGH // 2, RIGHT - LEFT, HIGH, kit.PLAYERS[seat], kit.THIN)
        kit.badge(layer.glow, seat, LEFT + 84, y, 40)
        kit.icon(layer.glow, controls.sign(device), NAMES + 40, y, 34, kit.MIST, kit.THIN)
        name = words(f"devices.{controls.name(device)}")
        layer.canvas.body(name, NAMES + 96, y, kit.ICE, "l", fit_size(name, kit.BODY, MOVES - NAMES - 112, "body"))
        self._moves(layer, device, y)
        for x, function, name in ((FIRES, Button.FIRE, "pause.fires"), (TURBO, Button.LEAVE_SEAT, "pause.turbo")):
            label, what = words.key_name(controls.label(device, function)), words(name)
            size = kit.prompt_size([(label, what)], TURBO - FIRES - 24)
            wide = kit.button(layer.canvas, x, y, label, size=size)
            layer.canvas.body(what, x + wide + 18, y, kit.MIST, size=size)
        return layer

    def _moves(self, layer: Layer, device: Device, y: float) -> None:
        x = MOVES
        if device.has_stick:
            layer.glow.ring(x + 30, y, 30, kit.ICE, kit.THIN).ring(x + 30, y, 13, kit.ICE, kit.THIN)
            x += 78
        controls = self.context.controls
        keypad = controls.name(device) == "Keypad"
        for mark in [kit.KEYPAD] if keypad else controls.moves(device).replace(" ", ""):
            kit.button(layer.canvas, x, y, mark)
            x += 66
        style = self.style_of(device)
        kit.icon(layer.glow, PICTURES[style], x + 36, y, 24, kit.ICE, kit.THIN)
        name = self.context.words(f"lobby.drive_{style}")
        layer.canvas.body(name, x + 72, y, kit.MIST, "l", fit_size(name, kit.BODY, FIRES - x - 84, "body"))
