"""Two pages that halt a match for a while: a pad was unplugged or a phone locked, or nobody responds.

A ring shows the time left.
"""

import math

import pygame

from pigaming_app.scenes.flow.scene import Home, Pop, StackOperation, Swap
from pigaming_app.scenes.play.pause import Pause, PausedMatch, player_line, sheet_title
from pigaming_app.scenes.views.sprites.effects import timer_ring
from pigaming_app.ui.draw import BODY, FOCUS, GREEN, ICE, LABEL, LINE, MIST, PLAYERS, Color, icon
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_size, word, wrap
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.dialog import HEAD, PROMPTS, W, X, Y, overlay

TIMEOUT = 15.0  # seconds
INPUT_LOCKOUT = 1.0  # seconds in which presses are ignored: other players are still pressing buttons
RING = X + 398, Y + 468
PAD = X + 184, Y + 376
TEXT_X, TEXT_W = X + 352, W - 352 - 56


class Reconnect:
    """The device of `seat` is unplugged: a free one takes over with FIRE, or the same phone when it is back, and an AI
    after the timeout.
    """

    def __init__(self, match: PausedMatch, seat: int) -> None:
        self.match, self.context, self.seat = match, match.context, seat
        self.device = match.drivers.devices[seat]
        self.phone = self.device is not None and self.device.kind == "phone"
        self.age, self.replugged = 0.0, False
        self.pictures: dict[bool, pygame.Surface] = {}
        hints = [(Button.X, "pause.hint_ai"), (Button.BACK, "pause.hint_menu")]
        self.prompts = self.context.prompts(hints, PROMPTS, W - 80, device=lambda: match.drivers.access.hint_device)

    def on_enter(self) -> None:
        """Play the error sound. A phone halts a match once."""
        self.context.hush()
        self.context.sounds.play("error")
        if self.device and self.phone:
            self.match.drivers.locked.add(self.device)

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE on a free device takes the seat; X gives it to an AI; BACK opens the menu."""
        event = self.prompts.as_button(event)
        admitted = self.match.drivers.access.admit(event)
        if event.button is Button.FOUND:
            self.replugged = True
            self.context.sounds.play("move")
        elif event.button is Button.LOST:
            self.replugged = False
        elif event.button in (Button.FIRE, Button.START) and self._may_take(event.device):
            return self._hand(event.device)
        elif admitted is None or self.age < INPUT_LOCKOUT:
            return None
        elif admitted.button is Button.X:
            return self._hand(None)
        elif admitted.button is Button.BACK:
            return Swap(Pause(self.match, admitted.device))
        return None

    def update(self, seconds: float) -> StackOperation:
        """Hand the seat to an AI after the timeout."""
        self.match.robots.advance_paused(seconds)
        self.age += seconds
        if held := self.match.drivers.access.update(seconds):
            return Swap(Pause(self.match, held.device))
        return self._hand(None) if self.age >= TIMEOUT else None

    def draw(self, screen: pygame.Surface) -> None:
        if self.replugged not in self.pictures:
            self.pictures[self.replugged] = overlay(
                self.match.runner.picture(), PLAYERS[self.seat], self._paint, self.replugged
            )
        screen.blit(self.pictures[self.replugged], (0, 0))
        if not self.phone:
            self._draw_plug(screen)
        ring(screen, TIMEOUT - self.age, TIMEOUT)
        self.prompts.draw(screen)
        self.match.robots.draw_overlay(screen)

    def _draw_plug(self, screen: pygame.Surface) -> None:
        gap = 0 if self.replugged else round(4 + 4 * math.sin(self.age * math.tau / 1.4))
        plug(MIST if not self.replugged else GREEN, self.replugged).draw(screen, PAD[0], PAD[1] - gap)
        if not self.replugged and self.age % 1.4 < 0.7:
            bolt().draw(screen, *PAD)

    def _may_take(self, device: Device) -> bool:
        """True for the phone of this seat, and for a free device; another phone does not take the seat of one."""
        other = self.phone and device.kind == "phone"
        return device == self.device or (self.match.drivers.is_free(device) and not other)

    def _hand(self, device: Device | None) -> StackOperation:
        if device:
            self.match.drivers.assign(self.seat, device)
        else:
            self.match.drivers.stand_in(self.seat)
        return Pop()

    def _paint(self, layer: Layer) -> None:
        words, ink = self.context.words, layer.glow
        sheet_title(layer, self.seat, player_line(self.match, "pause.reconnect", self.seat), ICE)
        x, y = PAD
        if self.phone:
            icon(ink, "phone", x, y + 10, 110, PLAYERS[self.seat], LINE)
        else:
            icon(ink, "pad", x, y + 34, 100, PLAYERS[self.seat], LINE)
            ink.line([(x, y - 16), (x, y - 46)], PLAYERS[self.seat], LINE)
            ink.line([(x - 16, y - 46), (x + 16, y - 46)], PLAYERS[self.seat], LINE)
        how = "pause.how_phone" if self.phone else "pause.how"
        say(layer, words("pause.found" if self.replugged else how), FOCUS if self.replugged else ICE)
        after(layer, words("pause.then_ai"))


class StillThere:
    """No input for a while: any button continues, the timeout leads to the title."""

    def __init__(self, match: PausedMatch) -> None:
        self.match, self.context = match, match.context
        self.age = 0.0
        self.picture: pygame.Surface | None = None
        self.prompts = self.context.prompts([(Button.FIRE, "pause.hint_continue")], PROMPTS, W - 80)

    def on_enter(self) -> None:
        """Play the error sound."""
        self.context.hush()
        self.context.sounds.play("error")

    def handle(self, event: InputEvent) -> StackOperation:
        """Any button continues; an idle device gets its seat back."""
        if event.button in (Button.LOST, Button.FOUND, Button.POINT):
            return None
        return Pop() if self.match.drivers.give_back(event) or self.match.drivers.access.admit(event) else None

    def update(self, seconds: float) -> StackOperation:
        """Return to the title after the timeout."""
        self.match.robots.advance_paused(seconds)
        self.age += seconds
        return Home() if self.age >= TIMEOUT else None

    def draw(self, screen: pygame.Surface) -> None:
        if self.picture is None:
            self.picture = overlay(self.match.runner.picture(), FOCUS, self._paint)
        screen.blit(self.picture, (0, 0))
        ring(screen, TIMEOUT - self.age, TIMEOUT)
        self.prompts.draw(screen)
        self.match.robots.draw_overlay(screen)

    def _paint(self, layer: Layer) -> None:
        words = self.context.words
        sheet_title(layer, None, words("pause.still"), ICE)
        icon(layer.glow, "clock", PAD[0], PAD[1], 84, MIST, LINE)
        say(layer, words("pause.still_how"), ICE)
        after(layer, words("pause.then_title"))


def say(layer: Layer, text: str, color: Color) -> None:
    """Instructions in up to three lines, right of the dialog's picture."""
    lines = wrap(text, BODY, TEXT_W)
    top = HEAD + (54 if len(lines) > 2 else 80)
    for i, line in enumerate(lines):
        layer.canvas.body(line, TEXT_X, top + 56 * i, color)


def after(layer: Layer, text: str) -> None:
    """The consequence of the timeout, beside the ring."""
    room = TEXT_W - 120
    layer.canvas.body(text, X + 472, RING[1], MIST, "l", fit_size(text, BODY, room, "body"))


def ring(screen: pygame.Surface, left: float, whole: float) -> None:
    """Draw the ring and the seconds left."""
    image, dx, dy = timer_ring(FOCUS, max(0, min(48, math.ceil(48 * left / whole))), 46, LINE)
    empty().draw(screen, *RING)
    screen.blit(image, (RING[0] + dx, RING[1] + dy), special_flags=pygame.BLEND_RGB_ADD)
    word(str(max(0, math.ceil(left))), LABEL, FOCUS, "head").draw(screen, *RING)


@cached
def empty() -> LitImage:
    """The empty ring."""
    layer = Layer(-50, -50, 100, 100)
    layer.canvas.crisp.ring(0, 0, 46, (34, 44, 64), LINE)
    return layer.render()


@cached
def plug(color: Color, joined: bool) -> LitImage:
    """A cable plug above the pad centred on (0, 0)."""
    layer = Layer(-40, -120, 80, 120)
    dy = 36 if joined else 0
    layer.glow.line([(-16, dy - 84), (16, dy - 84)], color, LINE).line([(0, dy - 84), (0, -112)], color, LINE)
    return layer.render()


@cached
def bolt() -> LitImage:
    """Two dashes between plug and pad."""
    layer = Layer(-60, -80, 120, 30)
    for side in (-1, 1):
        layer.glow.line([(26 * side, -65), (52 * side, -65)], FOCUS, LINE)
    return layer.render()
