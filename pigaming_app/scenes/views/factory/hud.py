"""HUD of Robot Factory: each team's deliveries, robots and pallet states.

Panels are baked into the background when their content changes.
"""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import pygame

from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.factory.state import DELIVERED, MAX_PALLETS, TEAMS
from pigaming_app.scenes.views.background import Background, Bit
from pigaming_app.scenes.views.hud_parts import HudParts, number_bits
from pigaming_app.scenes.views.sprites.factory import TEAMS as COLORS
from pigaming_app.scenes.views.sprites.factory import draw_crate, emblem
from pigaming_app.ui.draw import ICE, LABEL, LINE, MIST, PLAYERS, SUB, GlowCanvas, badge, cut_box, dim, icon
from pigaming_app.ui.draw.sprites import Sprite, faded
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import glyph, number_width

Y, H, W, EDGE = 26, 104, 652, 24  # px: top, height and width of a panel, margin around its sprites
X = (160, 1108)
EMBLEM, NUMBER, ROBOT, CRATES = 58, 106, 268, 330  # px from a panel's outer edge


class FactoryHud:
    """Keeps the HUD up to date. `players`: driver of each seat; names in BRAINS are marked as AI."""

    def __init__(self, background: Background, players: list[str]) -> None:
        self.background, self.players = background, players
        self.parts = HudParts(background)
        self.delivered = [0] * TEAMS

    def show(self, state: Any) -> list[int]:
        """Bake changed panels; returns the teams with new deliveries."""
        new = [team for team in range(TEAMS) if state.delivered[team] > self.delivered[team]]
        self.delivered = list(state.delivered)
        for team in range(TEAMS):
            mates = tuple(
                (i, self.players[i] in BRAINS["factory"], round(16 * robot.turbo))
                for i, robot in enumerate(state.robots)
                if robot.present and robot.team == team
            )
            first = team * MAX_PALLETS
            states = tuple(
                sorted(
                    (pallet.state for pallet in state.pallets[first : first + MAX_PALLETS] if pallet.exists), key=order
                )
            )
            content = state.delivered[team], state.rules.pallets, mates, states
            self.parts.show(team, content, X[team] - 8, W + 16, partial(panel_bits, team, *content))
        self.parts.countdown(state, 82)
        return new

    def jobs(self) -> Iterator[Callable[[], object]]:
        """Prewarm jobs for the pieces of the panels."""
        for team in range(TEAMS):
            yield partial(frame, team)
            yield partial(pulse, team)
            for char in "0123456789":
                yield partial(glyph, char, SUB, ICE)
            for state in range(DELIVERED + 1):
                yield partial(small_crate, team, state, 52)


def order(state: int) -> int:
    """Sort key of a pallet: delivered first, then by remaining steps, damaged last."""
    return (3, 2, 1, 4, 0)[state]


def panel_bits(
    team: int, delivered: int, whole: int, mates: tuple[tuple[int, bool, int], ...], states: tuple[int, ...]
) -> Iterator[Bit]:
    """Pieces of a panel; the second team's is mirrored."""
    x = X[team]
    yield frame(team), (x - EDGE, Y - EDGE), None

    def at(px: float, width: float) -> float:
        return x + px if team == 0 else x + W - px - width

    text, of = str(delivered), f"/{whole}"
    number_w, rest = number_width(text, SUB), number_width(of, LABEL)
    begin = at(NUMBER, number_w + rest + 4)
    yield from number_bits(text, SUB, begin, Y + H / 2, ICE)
    yield from number_bits(of, LABEL, begin + number_w + 4, Y + H / 2 + 7, MIST)
    for i, (seat, ai, turbo) in enumerate(mates):
        image = robot_sign(seat, ai, turbo)
        y = Y + H / 2 + (0 if len(mates) == 1 else -25 + 50 * i)
        yield image, (round(at(ROBOT, 0)) - image.get_width() // 2, round(y) - image.get_height() // 2), None
    room = W - CRATES - 16
    size, pitch = (52, 66) if len(states) <= 4 else (40, 42) if len(states) <= 7 else (36, 38)
    pitch = min(pitch, room // max(1, len(states)))
    for i, state in enumerate(states):
        image = small_crate(team, state, size)
        px = CRATES + pitch * i + pitch / 2
        yield image, (round(at(px, 0)) - image.get_width() // 2, round(Y + H / 2) - image.get_height() // 2), None


@cached
def frame(team: int) -> pygame.Surface:
    """Outline and emblem of a panel."""
    ink = GlowCanvas(W + 2 * EDGE, H + 2 * EDGE).set_transform(EDGE, EDGE)
    ink.fill(cut_box(0, 0, W, H), dim(COLORS[team], 0.05)).line(cut_box(0, 0, W, H), COLORS[team], LINE, True)
    emblem(ink, team, EMBLEM if team == 0 else W - EMBLEM, H / 2, 34)
    return ink.lit(0.6)


@cached
def small_crate(team: int, state: int, size: int) -> pygame.Surface:
    """Crate in a panel."""
    ink = GlowCanvas(size + 28, size + 28, 3)
    draw_crate(ink, team, state, size / 2 + 14, size / 2 + 14, size)
    return ink.lit(0.5)


@cached
def robot_sign(seat: int, ai: bool, turbo: int) -> pygame.Surface:
    """Robot in a panel: badge, AI mark, and turbo in sixteenths."""
    ink = GlowCanvas(120, 52, 3)
    badge(ink, seat, 34, 22, 18)
    if ai:
        icon(ink, "ai", 80, 20, 13, MIST, 3)
    ink.line([(14, 46), (104, 46)], dim(PLAYERS[seat], 0.2), 4)
    if turbo:
        ink.line([(14, 46), (14 + 90 * turbo / 16, 46)], PLAYERS[seat], 4)
    return ink.lit(0.4)


@cached
def pulse(team: int) -> tuple[Sprite, ...]:
    """Fade-out of a panel flash after a delivery, relative to its top left."""
    ink = (
        GlowCanvas(W + 2 * EDGE, H + 2 * EDGE)
        .set_transform(EDGE, EDGE)
        .fill(cut_box(0, 0, W, H), dim(COLORS[team], 0.24))
    )
    whole = Sprite(ink.lit(0.8), -EDGE, -EDGE)
    return whole, *(faded(whole, share) for share in (0.8, 0.6, 0.4, 0.25, 0.1))
