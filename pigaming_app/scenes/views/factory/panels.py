"""Pieces of the HUD panels of Robot Factory: frames, crates, robots, banners."""

from collections.abc import Iterator

import pygame

from pigaming_app.games.factory.state import ICE as FIRST_TEAM
from pigaming_app.scenes.views.background import Bit
from pigaming_app.scenes.views.factory.background import draw_lorry
from pigaming_app.scenes.views.hud.ai_sign import driver_tab, level_mark
from pigaming_app.scenes.views.hud.parts import EDGE, number_bits, plate
from pigaming_app.scenes.views.sprites.factory import draw_crate
from pigaming_app.scenes.views.sprites.teams import TEAMS as COLORS
from pigaming_app.scenes.views.sprites.teams import emblem
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import fit_size, number_width
from pigaming_app.ui.draw.surface_cache import cached

Y, H, W = 26, 104, 652  # px: top, height and width of a panel
X = (160, 1108)
EMBLEM, NUMBER = 58, 106  # px from a panel's outer edge
MIDDLE = Y + H / 2
NAMES = -9  # px, of the middle of the names below the upper line
Mate = tuple[int, str, str, int]  # seat, its AI and name or empty, turbo in sixteenths


@cached
def frame(team: int, lorry: bool = False, mates: tuple[Mate, ...] = ()) -> pygame.Surface:
    """Outline and emblem of a panel; with a lorry for its emblem if there is only one team. `mates`: whose names stand
    on its upper line.
    """
    ink = plate(W, H)
    _outline(ink, team)
    for i, (seat, brain, name, _) in enumerate(mates):
        x, room = 24 + (W - 48) / len(mates) * i, (W - 48) / len(mates)
        ink.solid(kit.cut_box(x, NAMES - 18, 38, 34, 4))
        kit.badge(ink, seat, x + 18, NAMES, 14)
        driver_tab(ink, brain, name, x + 34, NAMES, room - 50, kit.PLAYERS[seat])
    if lorry:
        ink.set_transform(EDGE + EMBLEM, EDGE + H / 2, 0.0, 0.8)
        draw_lorry(ink, 0, 0, COLORS[team], 1)
    else:
        emblem(ink, team, EMBLEM if team == FIRST_TEAM else W - EMBLEM, H / 2, 34)
    return ink.lit(0.6)


@cached
def plain_frame(team: int) -> pygame.Surface:
    """Outline of a panel without an emblem."""
    ink = plate(W, H)
    _outline(ink, team)
    return ink.lit(0.6)


def _outline(ink: kit.GlowCanvas, team: int) -> None:
    ink.fill(kit.cut_box(0, 0, W, H), kit.dim(COLORS[team], 0.05)).line(
        kit.cut_box(0, 0, W, H), COLORS[team], kit.LINE, True
    )


@cached
def banner(text: str, color: kit.Color) -> pygame.Surface:
    """A whole panel with a call instead of its content."""
    ink = plate(W, H)
    ink.fill(kit.cut_box(0, 0, W, H), kit.dim(color, 0.2)).line(kit.cut_box(0, 0, W, H), color, kit.LINE + 4, True)
    ink.text(text, fit_size(text, kit.readable(kit.SUB), W - 80, "hero"), W / 2, H / 2, color, "hero", "c")
    return ink.lit(0.7)


@cached
def small_crate(team: int, state: int, size: int) -> pygame.Surface:
    """Crate in a panel."""
    ink = kit.GlowCanvas(size + 28, size + 28, 3)
    draw_crate(ink, team, state, size / 2 + 14, size / 2 + 14, size)
    return ink.lit(0.5)


@cached
def robot_sign(seat: int, brain: str, turbo: int) -> pygame.Surface:
    """Robot in a panel: badge, AI sign, and turbo in sixteenths."""
    ink = kit.GlowCanvas(120, 52, 3)
    kit.badge(ink, seat, 34, 22, 18)
    if text := level_mark(brain):
        ink.text(text, kit.readable(30), 61, 22, kit.ICE, "head")
    elif brain:
        kit.icon(ink, "ai", 80, 20, 13, kit.MIST, 3)
    ink.line([(14, 46), (104, 46)], kit.dim(kit.PLAYERS[seat], 0.2), 4)
    if turbo:
        ink.line([(14, 46), (14 + 90 * turbo / 16, 46)], kit.PLAYERS[seat], 4)
    return ink.lit(0.4)


def centred(image: pygame.Surface, x: float, y: float) -> Bit:
    """An image centred at (x, y)."""
    return image, (round(x) - image.get_width() // 2, round(y) - image.get_height() // 2), None


def count_width(number: str, rest: str) -> float:
    """Width of a large number and what follows it in smaller type, px."""
    return number_width(number, kit.readable(kit.SUB)) + 4 + number_width(rest, kit.readable(kit.LABEL))


def count_bits(number: str, rest: str, x: float, color: kit.Color) -> Iterator[Bit]:
    """A large number from `x`, and what follows it in smaller type."""
    size, smaller = kit.readable(kit.SUB), kit.readable(kit.LABEL)
    yield from number_bits(number, size, x, MIDDLE, color)
    yield from number_bits(
        rest, smaller, x + number_width(number, size) + 4, MIDDLE + 0.35 * (size - smaller), kit.MIST
    )


def robot_bits(mates: tuple[Mate, ...], xs: tuple[float, ...]) -> Iterator[Bit]:
    """Robots in columns centred at `xs`, at most two in each."""
    columns = [mates[2 * i : 2 * i + 2] for i in range(len(xs))]
    for x, column in zip(xs, columns, strict=True):
        for i, (seat, brain, _, turbo) in enumerate(column):
            yield centred(robot_sign(seat, brain, turbo), x, MIDDLE + (0 if len(column) == 1 else -25 + 50 * i))
