"""The first minute of a seat: the keys that its player has not used yet, one after the other, in the margin beside the
arena.

Each is shown until it was used once since the device took its seat; a rematch shows none of them again.
"""

from collections.abc import Sequence

import pygame

from pigaming_app.ai.game_ai import ONE_BUTTON
from pigaming_app.ai.registry import AIS
from pigaming_app.games.match import Match
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.flow.used_keys import FIRE, STEER, TURBO, UsedKeys
from pigaming_app.scenes.play.side_hints import ROOM, X, draw_key, key_size
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import FOCUS, PLAYERS, Color, badge, icon, text_width
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_size, wrap_balanced
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.widgets.key_caps import CAP, PITCH, PLACES, RADIUS, draw_steering_key, draw_stick, steering_signs

PRAISE = 0.8  # s for which a key stays, lit, after its first use
HIGH, BADGE, TYPE = 166, 17, 34  # px: height of a sign, radius of the badge in its corner, size of its words
WIDER = 1.15  # times ROOM: words of this width are in two lines
STICK = (12.0, RADIUS + 4.0)  # px
ARROW_PLACES = {"up": (0, -29), "left": (-29, 0), "down": (0, 29), "right": (29, 0)}
EAST = round(X)
CORNERS = ((1920 - EAST, TOP - 6), (EAST, TOP - 6), (1920 - EAST, 1074 - HIGH), (EAST, 1074 - HIGH))  # px, top middle
BELOW_ROUNDS = (1920 - EAST, 1060 - 2 * HIGH)  # px, in place of the first: there are the rounds won


class FirstKeys:
    """The signs of a match. `devices`: of each seat, as they are now; `rounds`: the left margin shows rounds."""

    def __init__(self, context: Context, match: Match, devices: Sequence[Device | None], rounds: bool) -> None:
        self.context, self.match, self.devices = context, match, devices
        self.used = context.shared(UsedKeys)
        self.corners = corners([(LEFT + robot.x, TOP + robot.y) for robot in match.state.robots], rounds)
        self.shown: dict[Device, str] = {}  # the key shown to each device
        self.praised: dict[Device, float] = {}  # s for which it stays, lit

    def update(self, seconds: float) -> None:
        """Show the next key a moment after one was used."""
        self.praised = {device: left - seconds for device, left in self.praised.items()}
        for device in filter(None, self.devices):
            key, now = self.used.next_of(device, self._keys(device)), self.shown.get(device, "")
            if now and key != now and device not in self.praised:
                self.praised[device] = PRAISE
            elif self.praised.get(device, 0.0) <= 0.0:
                self.praised.pop(device, None)
                self.shown[device] = key

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the sign of each seat that has one."""
        for seat, device in enumerate(self.devices):
            if device and (key := self.shown.get(device, "")):
                controls = self.context.controls
                label = self.context.words.key_name(controls.label(device, _button(device, key)))
                moves = controls.moves(device) if key == STEER else ""
                word, lit = self._word(key), device in self.praised
                sign(seat, "" if key == STEER else label, moves, word, lit).draw(screen, *self.corners[seat])

    def _keys(self, device: Device) -> Sequence[str]:
        """The keys that a device needs in this game, in the order in which they are learned."""
        game = self.match.setup.game
        keys = [key for key in SCREENS[game].first_keys if key != FIRE or SCREENS[game].fire]
        if self.context.driving.of(device, game) == ONE_BUTTON:
            return [FIRE] if AIS[game].boosts or FIRE in keys else []
        return keys

    def _word(self, key: str) -> str:
        """What a key does; the one button of a race is the turbo."""
        screens = SCREENS[self.match.setup.game]
        if key == FIRE:
            return self.context.words(f"howto.{screens.fire if FIRE in screens.first_keys else 'hint_turbo'}")
        return self.context.words(f"howto.hint_{key}")


def _button(device: Device, key: str) -> Button:
    if key == TURBO:
        return Button.LEAVE_SEAT if device.kind == "keys" else Button.BACK
    return Button.FIRE


def corners(robots: Sequence[tuple[float, float]], rounds: bool) -> list[tuple[int, int]]:
    """The corner of each robot, all different: the nearest that is free. Positions on the canvas, px."""
    free = [BELOW_ROUNDS if rounds else CORNERS[0], *CORNERS[1:]]
    chosen = []
    for x, y in robots:
        right, low = x > LEFT + WIDTH / 2, y > TOP + HEIGHT / 2
        nearest = min(free, key=lambda at: 2 * ((at[0] > 960) != right) + ((at[1] > 540) != low))
        free.remove(nearest)
        chosen.append(nearest)
    return chosen


@cached
def sign(seat: int, label: str, moves: str, word: str, lit: bool) -> LitImage:
    """A key, or without a label what steers, with the badge of its player and what it does; top middle at (0, 0)."""
    color = FOCUS if lit else PLAYERS[seat]
    layer = Layer(-ROOM / 2, 0, ROOM, HIGH)
    badge(layer.glow, seat, BADGE - ROOM / 2, BADGE + 2, BADGE)
    lines = wrap_balanced(word, 2, TYPE) if text_width(word, TYPE, "body") > WIDER * ROOM else [word]
    foot = _draw_cap(layer, label, color, len(lines)) if label else _draw_steering(layer, moves, color)
    pitch = min(TYPE + 2, (HIGH - foot) / len(lines))
    size = min(round(0.95 * pitch), *(fit_size(line, TYPE, ROOM, "body") for line in lines))
    for i, line in enumerate(lines):
        layer.canvas.body(line, 0, foot + pitch * (i + 0.5), color, "c", size)
    return layer.render()


def _draw_steering(layer: Layer, moves: str, color: Color) -> float:
    """Draw the four keys, or a stick; returns where the words begin, px."""
    if not moves:
        x, y = STICK
        draw_stick(layer, x, y, color)
        layer.glow.disc(x, y, 15, color)
        for name, (dx, dy) in ARROW_PLACES.items():
            icon(layer.canvas.crisp, name, x + dx, y + dy, 7, color, 4)
        return y + RADIUS + 8
    pitch = (ROOM - CAP) / 2
    for symbol, (column, row) in zip(steering_signs(moves), PLACES, strict=True):
        draw_steering_key(layer, symbol, pitch * column, CAP / 2 + 2 + PITCH * row, color)
    return CAP + PITCH + 14


def _draw_cap(layer: Layer, label: str, color: Color, lines: int) -> float:
    """Draw a key beside the badge, or below it if it is wide, with room for lines of text; returns where they begin."""
    wide, high = key_size(label)
    beside = wide < ROOM - 4 * BADGE
    y = 10 if beside else 2 * BADGE + 6
    k = min(1.0 if beside else 0.8, ROOM / wide, (HIGH - y - 4 - 30 * lines) / high)
    for ink in (layer.canvas.glow, layer.canvas.soft, layer.canvas.crisp):
        ink.set_transform(-layer.at[0], y - layer.at[1], 0.0, k)
    draw_key(layer, label, color)
    for ink in (layer.canvas.glow, layer.canvas.soft, layer.canvas.crisp):
        ink.set_transform(-layer.at[0], -layer.at[1])
    return y + k * high + 4
