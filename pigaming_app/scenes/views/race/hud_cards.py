"""Pieces of a race card: place, lap, gap, turbo and warnings.

A card is baked into the background from these pieces when its content changes.
"""

import math
from dataclasses import dataclass

import pygame

from pigaming_app.scenes.views.background import Bit
from pigaming_app.scenes.views.hud import parts
from pigaming_app.scenes.views.hud.ai_sign import driver_tab
from pigaming_app.scenes.views.race.lines import draw_sign, flag
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import number_width
from pigaming_app.ui.draw.surface_cache import cached

W = parts.PANEL_W  # px, width of the cards
GAIN, LOSS = (96, 255, 150), (255, 128, 118)  # colours of a gain and a loss of time; the sign shows it too
CELLS = 16  # of the turbo bar
PLACE, FIGURE, OF = kit.SUB, 58, kit.BODY  # font sizes: digits of 58 are 41 px high
ROW, METER = 48, 79  # px: vertical centre of the digits, top of the turbo bar
LEFT, AIR, RIGHT = 18, 24, W - 18  # px: left edge of the place, space from there to the lap, right edge of the gap
GAP = 122  # px, maximum width of a gap
LARGE_PLACE, LARGE_ROW = 82, 47  # px, of larger texts
SIGNS = W - 132  # px, centre of the warnings
ITEM = W - 68  # px, EDGE left of the centre of the item slot
FLASH = 0.3  # brightness of the flash of a card
ITEM_SIZE, ITEM_UP = 28, 5  # px, radius, and its centre above the card


@dataclass(frozen=True)
class RaceCard:
    """Content of a card. `sign`: "", "wrong" or "missed"; `moved`: 1 gained a place, -1 lost one, else 0."""

    seat: int
    brain: str
    place: int
    lap: int  # current lap, of `laps`
    gap: str  # to the leader, s; empty for the leader
    turbo: int  # remaining, 0..64
    laps: int
    sign: str
    missed: int
    moved: int
    done: bool
    item: str = "none"  # that it holds: "", or the name of its icon; "none": there are no items
    slip: bool = False  # in a slipstream
    name: str = ""  # of an entrant, in an event


def card_bits(card: RaceCard, x: int) -> list[Bit]:
    """Pieces of a card with its left edge at `x`."""
    corner = (x - parts.EDGE, parts.Y - parts.EDGE)
    bits: list[Bit] = [
        (frame(card.seat, card.brain, card.name, bool(card.sign), card.done, card.item != "none"), corner, None)
    ]
    number = kit.FOCUS if card.done and card.place == 1 else kit.WHITE
    bits += parts.number_bits(str(card.place), place_size(), x + LEFT, parts.Y + row(), number)
    if card.moved:
        at = x + lap_x() - AIR // 2 - parts.EDGE, parts.Y + row() - parts.EDGE
        bits.append((mover(card.moved > 0), at, None))
    if card.item != "none":
        bits.append((item_slot(card.item), (x + ITEM - parts.EDGE, parts.Y - 2 * parts.EDGE - ITEM_UP), None))
    color, wide = kit.PLAYERS[card.seat], round(CELLS * parts.CELL)
    full = parts.turbo_cells(kit.WHITE, wide, 7, True, 1.0) if card.slip else parts.turbo_cells(color, wide, 7, True)
    lit = card.turbo * CELLS * parts.CELL / 64
    bits += parts.bar_bits(full, parts.turbo_cells(color, wide, 7, False), (x + 17, parts.Y + METER), lit)
    if card.sign == "missed":
        bits.append((missed_mark(card.missed), (x + SIGNS - parts.EDGE, parts.Y - parts.EDGE), None))
    elif card.sign:
        bits.append((wrong_mark(), (x + SIGNS - parts.EDGE, parts.Y - parts.EDGE), None))
    else:
        bits += _figures(card, x)
    return bits


def _figures(card: RaceCard, x: int) -> list[Bit]:
    """Lap and gap, as in 2/5 +0.5; the leader has a crown instead, and a flag at the end."""
    lap, size, at, middle = str(card.lap), kit.readable(FIGURE), x + lap_x(), parts.Y + row()
    bits = parts.number_bits(lap, size, at, middle, kit.ICE)
    low = middle + 0.35 * (size - OF)  # common baseline
    bits += parts.number_bits(f"/{card.laps}", OF, at + number_width(lap, size), low, kit.MIST)
    if card.gap:
        size = parts.number_size(card.gap, GAP, FIGURE, OF)  # OF: a gap of minutes
        return bits + parts.number_bits(card.gap, size, x + RIGHT - number_width(card.gap, size), middle, kit.ICE)
    return [*bits, (leader(card.done), (x + RIGHT - 60 - parts.EDGE, parts.Y - parts.EDGE), None)]


def lap_x() -> int:
    """Left edge of the lap, px from that of the card."""
    return LEFT + round(number_width("4", place_size())) + AIR


def place_size() -> int:
    """Type size of the place, px."""
    return LARGE_PLACE if kit.reads_large() else PLACE


def row() -> int:
    """Vertical centre of the digits, px."""
    return LARGE_ROW if kit.reads_large() else ROW


# ---- cached pieces


@cached
def frame(seat: int, brain: str, name: str, alarm: bool, done: bool, slot: bool) -> pygame.Surface:
    """Outline and badge of a card, and who drives; red during a warning, bold after the finish. `slot`: with a gap for
    an item.
    """
    ink, color = parts.plate(W, parts.H), kit.PLAYERS[seat]
    outline, edge = kit.cut_box(0, 0, W, parts.H), kit.ALARM if alarm else color
    if alarm or done:
        ink.fill(outline, kit.dim(edge, 0.16))
    ink.line(outline, edge if alarm or done else kit.dim(edge, 0.8), kit.LINE if alarm or done else kit.THIN, True)
    if slot:
        ink.fill(kit.regular_polygon(6, ITEM_SIZE + 9, 0.0, ITEM + parts.EDGE, -ITEM_UP), (0, 0, 0))
    ink.solid(kit.cut_box(14, -20, 56, 36, 4))
    kit.badge(ink, seat, 42, -2, 20)
    driver_tab(ink, brain, name, 76, -2, (ITEM + parts.EDGE - ITEM_SIZE - 12 if slot else W - 16) - 76, color)
    return ink.lit(0.7)


@cached
def item_slot(name: str) -> pygame.Surface:
    """Hexagon on the upper edge of a card with the icon of the item, or empty."""
    ink = kit.GlowCanvas(4 * parts.EDGE, 4 * parts.EDGE, 3).set_transform(2 * parts.EDGE, 2 * parts.EDGE)
    frame = kit.regular_polygon(6, ITEM_SIZE)
    if not name:
        return ink.dashes(frame, kit.dim(kit.MIST, 0.5), 3, 10, 7).plain()
    ink.fill(frame, kit.dim(kit.FOCUS, 0.14)).line(frame, kit.FOCUS, kit.THIN, True)
    return kit.icon(ink, name, 0, 0, 19, kit.mix(kit.FOCUS, kit.WHITE, 0.5), 5).lit(0.7)


@cached
def mover(up: bool) -> pygame.Surface:
    """Arrowhead for a gained or lost place."""
    side = -1 if up else 1
    ink = parts.plate(2, 2)
    return ink.fill([(-9, -side * 7), (9, -side * 7), (0, side * 9)], GAIN if up else LOSS).lit(0.9)


@cached
def leader(done: bool) -> pygame.Surface:
    """Crown of the leader or, at the end, a flag."""
    ink = parts.plate(60, parts.H)
    if done:
        flag(ink, 30, ROW, 21, kit.FOCUS)
    else:
        kit.icon(ink, "crown", 30, ROW, 24, kit.FOCUS, kit.LINE)
    return ink.lit(0.7)


@cached
def missed_mark(sign: int) -> pygame.Surface:
    """Warning: sign of the missed line."""
    ink = parts.plate(W // 2, parts.H)
    draw_sign(ink, sign, 36, 44, 30)
    ink.line([(92, 22), (92, 50)], kit.WHITE, 12)
    return ink.disc(92, 69, 8, kit.WHITE).lit(0.7)


@cached
def wrong_mark() -> pygame.Surface:
    """Warning: wrong way."""
    ink = parts.plate(W // 2, parts.H)
    return u_turn(ink, 56, 46, 0.85).lit(0.7)


def u_turn(ink: kit.GlowCanvas, x: float, y: float, k: float) -> kit.GlowCanvas:
    """U-turn arrow, 72 px high at scale 1."""
    arc = [(18 * math.cos(t / 8), -8 - 18 * math.sin(t / 8)) for t in range(26)]
    way = [(18.0, 30.0), (18.0, -8.0), *arc, (-18.0, 6.0)]
    ink.line([(x + k * a, y + k * b) for a, b in way], kit.WHITE, 11 * k)
    return ink.fill([(x + k * a, y + k * b) for a, b in ((-39, 4), (3, 4), (-18, 32))], kit.WHITE)
