"""Pieces of a race card: place, lap, gap, turbo and warnings.

A card is baked into the background from these pieces when its content changes.
"""

import math
from dataclasses import dataclass

import pygame

from pigaming_app.scenes.views.background import HUD_HEIGHT, Bit
from pigaming_app.scenes.views.hud.ai_sign import driver_tab
from pigaming_app.scenes.views.hud.parts import CLOCK, PANEL_W, H, Y, number_bits
from pigaming_app.scenes.views.race.lines import draw_sign, flag
from pigaming_app.ui.draw import (
    ALARM,
    BODY,
    FOCUS,
    ICE,
    LABEL,
    LINE,
    MIST,
    PLAYERS,
    SUB,
    THIN,
    WHITE,
    Color,
    GlowCanvas,
    badge,
    cut_box,
    dim,
    icon,
    mix,
    regular_polygon,
)
from pigaming_app.ui.draw.sprites import Sprite, faded
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size, number_width

W, EDGE = PANEL_W, 24  # px: width of the cards, margin around their sprites
GAIN, LOSS = (96, 255, 150), (255, 128, 118)  # colours of a gain and a loss of time; the sign shows it too
CELLS, CELL = 16, 17.75  # cells of the turbo bar, px between them
PLACE, FIGURE, OF, ENDING = SUB, 58, BODY, 30  # font sizes: digits of 58 are 41 px high
ROW = 49  # px, vertical centre of the digits
LEFT, LAP, RIGHT = 16, 103, W - 14  # px: left edge of place and lap, right edge of the gap
GAP = 122  # px, maximum width of a gap
FOOT = W - 40  # px, length of the lap bar
SIGNS = W - 132  # px, centre of the warnings
ITEM = W - 68  # px, EDGE left of the centre of the item slot
ITEM_SIZE, ITEM_UP = 28, 5  # px, radius, and its centre above the card


@dataclass(frozen=True)
class RaceCard:
    """Content of a card. `sign`: "", "wrong" or "missed"; `moved`: 1 gained a place, -1 lost one, else 0."""

    seat: int
    brain: str
    place: int
    ending: str  # ordinal suffix of the place: st, nd
    lap: int  # current lap, of `laps`
    gap: str  # to the leader, s; empty for the leader
    turbo: int  # remaining, 0..64
    way: int  # px of the lap bar that are lit
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
    corner = (x - EDGE, Y - EDGE)
    bits: list[Bit] = [
        (frame(card.seat, card.brain, card.name, bool(card.sign), card.done, card.item != "none"), corner, None)
    ]
    number = FOCUS if card.done and card.place == 1 else WHITE
    text = str(card.place)
    bits += number_bits(text, PLACE, x + LEFT, Y + ROW, number)
    after = x + LEFT + round(number_width(text, PLACE)) + 1
    bits.append((word(card.ending, number, ENDING), (after - EDGE, Y + ROW - 15 - EDGE), None))
    if card.moved:
        bits.append((mover(card.moved > 0), (after + 15 - EDGE, Y + ROW + 16 - EDGE), None))
    if card.item != "none":
        bits.append((item_slot(card.item), (x + ITEM - EDGE, Y - 2 * EDGE - ITEM_UP), None))
    full, empty = turbo(card.seat, True, card.slip), turbo(card.seat, False, False)
    bits += _part_lit(full, empty, (x + 17, Y + 80), card.turbo * CELLS * CELL / 64)
    bits += _part_lit(
        foot(card.seat, card.laps, True), foot(card.seat, card.laps, False), (x + 20, Y + H - 3), card.way
    )
    if card.sign == "missed":
        bits.append((missed_mark(card.missed), (x + SIGNS - EDGE, Y - EDGE), None))
    elif card.sign:
        bits.append((wrong_mark(), (x + SIGNS - EDGE, Y - EDGE), None))
    else:
        bits += _figures(card, x)
    return bits


def _figures(card: RaceCard, x: int) -> list[Bit]:
    """Lap and gap; the leader has a crown instead, and a flag at the end."""
    lap = str(card.lap)
    bits = number_bits(lap, FIGURE, x + LAP, Y + ROW, ICE)
    low = Y + ROW + 0.35 * (FIGURE - OF)  # common baseline
    bits += number_bits(f"/{card.laps}", OF, x + LAP + number_width(lap, FIGURE), low, MIST)
    if card.gap:
        size = FIGURE if number_width(card.gap, FIGURE) < GAP else OF  # a gap of minutes
        return bits + number_bits(card.gap, size, x + RIGHT - number_width(card.gap, size), Y + ROW, ICE)
    return [*bits, (leader(card.done), (x + RIGHT - 60 - EDGE, Y - EDGE), None)]


def _part_lit(full: pygame.Surface, empty: pygame.Surface, at: tuple[int, int], way: float) -> list[Bit]:
    """Bar lit up to `way` px."""
    x, y, split, (w, h) = at[0] - EDGE, at[1] - EDGE, EDGE + round(way), full.get_size()
    return [(full, (x, y), (0, 0, split, h)), (empty, (x + split, y), (split, 0, w - split, h))]


# ---- cached pieces


@cached
def frame(seat: int, brain: str, name: str, alarm: bool, done: bool, slot: bool) -> pygame.Surface:
    """Outline and badge of a card, and who drives; red during a warning, bold after the finish. `slot`: with a gap for
    an item.
    """
    ink, color = GlowCanvas(W + 2 * EDGE, H + 2 * EDGE).set_transform(EDGE, EDGE), PLAYERS[seat]
    outline, edge = cut_box(0, 0, W, H), ALARM if alarm else color
    if alarm or done:
        ink.fill(outline, dim(edge, 0.16))
    ink.line(outline, edge if alarm or done else dim(edge, 0.8), LINE if alarm or done else THIN, True)
    if slot:
        ink.fill(regular_polygon(6, ITEM_SIZE + 9, 0.0, ITEM + EDGE, -ITEM_UP), (0, 0, 0))
    ink.fill([(18, H - 8), (W - 18, H - 8), (W - 18, H + 8), (18, H + 8)], (0, 0, 0))
    ink.solid(cut_box(14, -20, 56, 36, 4))
    badge(ink, seat, 42, -2, 20)
    driver_tab(ink, brain, name, 76, -2, (ITEM + EDGE - ITEM_SIZE - 12 if slot else W - 16) - 76, color)
    return ink.lit(0.7)


@cached
def pulse(seat: int) -> tuple[Sprite, ...]:
    """Fade-out of a card flash, relative to its top left."""
    ink = GlowCanvas(W + 2 * EDGE, H + 2 * EDGE).set_transform(EDGE, EDGE)
    whole = Sprite(ink.fill(cut_box(0, 0, W, H), dim(PLAYERS[seat], 0.3)).lit(0.8), -EDGE, -EDGE)
    return whole, *(faded(whole, share) for share in (0.8, 0.6, 0.4, 0.25, 0.1))


@cached
def word(text: str, color: Color, size: int = BODY) -> pygame.Surface:
    """Short word, EDGE px from the left, vertical centre EDGE px from the top."""
    width = max(1, round(number_width(text, size)))
    ink = GlowCanvas(width + 2 * EDGE, size + 2 * EDGE)
    return ink.text(text, size, EDGE, EDGE, color, "head").lit(0.5)


@cached
def turbo(seat: int, full: bool, slip: bool) -> pygame.Surface:
    """Cells of a turbo bar, all lit or all dark; white in a slipstream, which refills it."""
    ink = GlowCanvas(round(CELLS * CELL) + 2 * EDGE, 9 + 2 * EDGE).set_transform(EDGE, EDGE)
    color = WHITE if slip else PLAYERS[seat]
    for i in range(CELLS):
        x = i * CELL
        ink.fill([(x + 3, -4), (x + 15, -4), (x + 13, 3), (x, 3)], color if full else dim(color, 0.2))
    return ink.lit(1.0 if slip else 0.5) if full else ink.plain()


@cached
def item_slot(name: str) -> pygame.Surface:
    """Hexagon on the upper edge of a card with the icon of the item, or empty."""
    ink = GlowCanvas(4 * EDGE, 4 * EDGE, 3).set_transform(2 * EDGE, 2 * EDGE)
    frame = regular_polygon(6, ITEM_SIZE)
    if not name:
        return ink.dashes(frame, dim(MIST, 0.5), 3, 10, 7).plain()
    ink.fill(frame, dim(FOCUS, 0.14)).line(frame, FOCUS, THIN, True)
    return icon(ink, name, 0, 0, 19, mix(FOCUS, WHITE, 0.5), 5).lit(0.7)


@cached
def banner(lines: tuple[str, ...], color: Color) -> pygame.Surface:
    """Words in place of the clock, in one or two lines."""
    ink = GlowCanvas(CLOCK.w, HUD_HEIGHT)
    for i, line in enumerate(lines):
        size = fit_size(line, LABEL, CLOCK.w - 16)
        ink.text(line, size, CLOCK.w / 2, Y + H / 2 + 54 * (i - (len(lines) - 1) / 2), color, "head", "c")
    return ink.lit(0.8)


@cached
def foot(seat: int, laps: int, full: bool) -> pygame.Surface:
    """Lap bar along the bottom of a card, one segment per lap, all lit or all dark."""
    ink, color = GlowCanvas(FOOT + 2 * EDGE, 6 + 2 * EDGE).set_transform(EDGE, EDGE), PLAYERS[seat]
    piece = FOOT / laps
    for i in range(laps):
        corners = [(i * piece, 0), ((i + 1) * piece - 5, 0), ((i + 1) * piece - 5, 6), (i * piece, 6)]
        ink.fill(corners, mix(color, WHITE, 0.25) if full else dim(color, 0.28))
    return ink.lit(0.6) if full else ink.plain()


@cached
def mover(up: bool) -> pygame.Surface:
    """Arrowhead for a gained or lost place."""
    side = -1 if up else 1
    ink = GlowCanvas(2 * EDGE + 2, 2 * EDGE + 2).set_transform(EDGE, EDGE)
    return ink.fill([(-13, -side * 9), (13, -side * 9), (0, side * 11)], GAIN if up else LOSS).lit(0.9)


@cached
def leader(done: bool) -> pygame.Surface:
    """Crown of the leader or, at the end, a flag."""
    ink = GlowCanvas(60 + 2 * EDGE, H + 2 * EDGE).set_transform(EDGE, EDGE)
    if done:
        flag(ink, 30, ROW, 21, FOCUS)
    else:
        icon(ink, "crown", 30, ROW, 24, FOCUS, LINE)
    return ink.lit(0.7)


@cached
def missed_mark(sign: int) -> pygame.Surface:
    """Warning: sign of the missed line."""
    ink = GlowCanvas(W // 2 + 2 * EDGE, H + 2 * EDGE).set_transform(EDGE, EDGE)
    draw_sign(ink, sign, 36, 44, 30)
    ink.line([(92, 22), (92, 50)], WHITE, 12)
    return ink.disc(92, 69, 8, WHITE).lit(0.7)


@cached
def wrong_mark() -> pygame.Surface:
    """Warning: wrong way."""
    ink = GlowCanvas(W // 2 + 2 * EDGE, H + 2 * EDGE).set_transform(EDGE, EDGE)
    return u_turn(ink, 56, 46, 0.85).lit(0.7)


def u_turn(ink: GlowCanvas, x: float, y: float, k: float) -> GlowCanvas:
    """U-turn arrow, 72 px high at scale 1."""
    arc = [(18 * math.cos(t / 8), -8 - 18 * math.sin(t / 8)) for t in range(26)]
    way = [(18.0, 30.0), (18.0, -8.0), *arc, (-18.0, 6.0)]
    ink.line([(x + k * a, y + k * b) for a, b in way], WHITE, 11 * k)
    return ink.fill([(x + k * a, y + k * b) for a, b in ((-39, 4), (3, 4), (-18, 32))], WHITE)
