"""Captions: a line of text on a black plate with cut corners, shown over a running match. Cached."""

import math
from dataclasses import dataclass

import pygame

from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.surface_cache import cached

MARGIN = 24  # px of glow round a plate
ROOM = 1500  # px of a larger text


@dataclass(frozen=True)
class Caption:
    """A premultiplied, opaque sprite, and its size without the glow, px."""

    image: pygame.Surface
    width: int
    height: int

    def box(self, at: tuple[int, int]) -> pygame.Rect:
        """Its box without the glow, centred at a position."""
        box = pygame.Rect(0, 0, self.width, self.height)
        box.center = at
        return box

    def draw(self, screen: pygame.Surface, x: float, y: float) -> None:
        """Draw it centred at (x, y)."""
        corner = round(x - self.image.get_width() / 2), round(y - self.image.get_height() / 2)
        screen.blit(self.image, corner, special_flags=pygame.BLEND_PREMULTIPLIED)


class Notice:
    """A caption shown for a while, centred at `at` on the canvas."""

    def __init__(self, at: tuple[int, int]) -> None:
        self.at, self.left = at, 0.0  # s
        self._caption: Caption | None = None

    @property
    def box(self) -> pygame.Rect | None:
        """The box of what is shown."""
        return self._caption.box(self.at) if self._caption and self.left > 0.0 else None

    def show(self, caption: Caption, seconds: float = 3.0) -> None:
        """Show another one from now on."""
        self._caption, self.left = caption, seconds

    def update(self, seconds: float) -> None:
        self.left -= seconds

    def draw(self, screen: pygame.Surface) -> None:
        if self._caption and self.left > 0.0:
            self._caption.draw(screen, *self.at)


RING_STEPS = 12  # images of a ring that fills


@cached
def hold_ring(player: int, step: int) -> Caption:
    """A player's badge in a ring filled to `step` of RING_STEPS: progress of a held button."""
    r = 46
    ink = kit.GlowCanvas(2 * r + 2 * MARGIN, 2 * r + 2 * MARGIN).set_transform(r + MARGIN, r + MARGIN)
    ink.solid([(1.2 * r * math.cos(i * math.tau / 32), 1.2 * r * math.sin(i * math.tau / 32)) for i in range(32)])
    ink.ring(0, 0, r - 2, kit.STEEL, kit.THIN)
    if step:
        ink.arc(0, 0, r - 2, math.tau * 0.75, math.tau * (0.75 + step / RING_STEPS), kit.FOCUS, kit.LINE)
    kit.badge(ink, player, 0, 0, 24)
    return Caption(ink.sprite(0.6), 2 * r, 2 * r)


@cached
def caption(
    text: str,
    color: kit.Color = kit.STEEL,
    ink_color: kit.Color = kit.ICE,
    size: int = 0,
    player: int | None = None,
    sign: str | None = None,
    face: str = "body",
) -> Caption:
    """A plate outlined in `color`, with a player's badge and an icon before the text if given. `size`: of the type, px;
    0: of readable texts.
    """
    size = size or (kit.readable(kit.BODY) if kit.text_width(text, kit.readable(kit.BODY), face) <= ROOM else kit.BODY)
    high = round(size * 1.7)
    lead = (0 if player is None else round(size * 1.35)) + (0 if sign is None else round(size * 1.35))
    wide = round(kit.text_width(text, size, face)) + lead + 2 * round(size * 0.6)
    ink = kit.GlowCanvas(wide + 2 * MARGIN, high + 2 * MARGIN).set_transform(MARGIN, MARGIN)
    outline = kit.cut_box(0, 0, wide, high, 14)
    ink.solid(outline).line(outline, color, kit.THIN, True)
    x, y = round(size * 0.6), high / 2
    if player is not None:
        kit.badge(ink, player, x + size * 0.4, y, size * 0.5)
        x += round(size * 1.35)
    if sign is not None:
        kit.icon(ink, sign, x + size * 0.4, y, size * 0.48, ink_color, kit.THIN)
        x += round(size * 1.35)
    ink.text(text, size, x, y, ink_color, face)
    return Caption(ink.sprite(0.6), wide, high)
