"""The pieces of a card over a race: who is where, in which lap, how fast, and what is wrong.

A card is baked into the ground from these pieces whenever what it says changes.
"""

import math
from dataclasses import dataclass

import pygame

from pigaming_app.scenes.ink import (
    ALARM,
    BODY,
    FOCUS,
    ICE,
    LINE,
    MIST,
    PLAYERS,
    THIN,
    TITLE,
    WHITE,
    Color,
    Ink,
    Point,
    badge,
    cut,
    dim,
    icon,
    mix,
    regular,
)
from pigaming_app.scenes.sprites import Sprite, faded
from pigaming_app.scenes.surface_cache import cached
from pigaming_app.scenes.things import number_width
from pigaming_app.scenes.views.ground import Bit
from pigaming_app.scenes.views.hud import number_bits

Y, W, H, EDGE = 18, 352, 110, 24  # px: top and size of the cards, margin round their sprites
GAIN, LOSS = (96, 255, 150), (255, 128, 118)  # of a time that is better, or worse; a sign says it too
CELLS, CELL = 8, 17.75  # of the turbo bar, and px from one to the next
MIDDLE, TIMES, RIGHT = 154, 206, W - 18  # px: of badge and laps, of the signs before times, where times end
ROWS = (23, 54, 85)  # px: middles of the three times
FOOT = W - 40  # px: length of the bar of laps


@dataclass(frozen=True)
class Card:
    """What a card says. `sign`: "", "wrong" or "missed"; `moved`: 1 went ahead, -1 fell back, 0."""

    seat: int
    ai: bool
    place: int
    ending: str  # of the place's number: st, nd
    lap: str
    first: tuple[str, Color]  # the time that runs, or a difference
    last: str
    best: str
    turbo: int  # left, of 64
    way: int  # px of the bar of laps
    laps: int
    sign: str
    missed: int
    moved: int
    done: bool


def card_bits(card: Card, x: int) -> list[Bit]:
    """The pieces of a card whose left edge is at x."""
    corner = (x - EDGE, Y - EDGE)
    bits: list[Bit] = [(frame(card.seat, card.ai, bool(card.sign), card.done), corner, None)]
    number = FOCUS if card.done and card.place == 1 else WHITE
    text = str(card.place)
    bits += number_bits(text, TITLE, x + 43 - number_width(text, TITLE) / 2, Y + 42, number)
    bits.append((word(card.ending, number), (x + 75 - EDGE, Y + 25 - EDGE), None))
    bits += number_bits(card.lap, BODY, x + MIDDLE - number_width(card.lap, BODY) / 2, Y + 67, ICE)
    if card.moved:
        bits.append((mover(card.moved > 0), (x + 97 - EDGE, Y + 62 - EDGE), None))
    bits += _part_lit(turbo(card.seat, True), turbo(card.seat, False), (x + 20, Y + 94), card.turbo * CELLS * CELL / 64)
    bits += _part_lit(
        foot(card.seat, card.laps, True), foot(card.seat, card.laps, False), (x + 20, Y + H - 3), card.way
    )
    if card.sign == "missed":
        bits.append((missed_mark(card.missed), (x + 190 - EDGE, Y - EDGE), None))
    elif card.sign:
        bits.append((wrong_mark(), (x + 190 - EDGE, Y - EDGE), None))
    else:
        bits += _times(card, x)
    return bits


def _times(card: Card, x: int) -> list[Bit]:
    """The time that runs, the last and the best; each after its sign."""
    bits: list[Bit] = [(signs(card.done), (x + TIMES - EDGE, Y - EDGE), None)]
    text, color = card.first
    rows = ((text, color), (card.last, MIST), (card.best, FOCUS))
    for (said, tone), y in zip(rows, ROWS, strict=True):
        bits += number_bits(said, BODY, x + RIGHT - number_width(said, BODY), Y + y, tone)
    return bits


def _part_lit(full: pygame.Surface, empty: pygame.Surface, at: tuple[int, int], way: float) -> list[Bit]:
    """A bar that is lit up to `way` px."""
    x, y, split, (w, h) = at[0] - EDGE, at[1] - EDGE, EDGE + round(way), full.get_size()
    return [(full, (x, y), (0, 0, split, h)), (empty, (x + split, y), (split, 0, w - split, h))]


# ---- pieces, each made once


@cached
def frame(seat: int, ai: bool, alarm: bool, done: bool) -> pygame.Surface:
    """Outline and badge of a card; it is red while something is wrong and bold when the race is done."""
    ink, color = Ink(W + 2 * EDGE, H + 2 * EDGE).to(EDGE, EDGE), PLAYERS[seat]
    outline, edge = cut(0, 0, W, H), ALARM if alarm else color
    if alarm or done:
        ink.fill(outline, dim(edge, 0.16))
    ink.line(outline, edge if alarm or done else dim(edge, 0.8), LINE if alarm or done else THIN, True)
    ink.fill([(18, H - 8), (W - 18, H - 8), (W - 18, H + 8), (18, H + 8)], (0, 0, 0))
    badge(ink, seat, MIDDLE, 29, 20)
    if ai:
        ink.solid(cut(78, -16, 40, 26, 4))
        icon(ink, "ai", 98, -2, 14, mix(color, WHITE, 0.5), 3)
    return ink.lit(0.7)


@cached
def pulse(seat: int) -> tuple[Sprite, ...]:
    """A card that lights up, and how that fades; from its upper left corner."""
    ink = Ink(W + 2 * EDGE, H + 2 * EDGE).to(EDGE, EDGE)
    whole = Sprite(ink.fill(cut(0, 0, W, H), dim(PLAYERS[seat], 0.3)).lit(0.8), -EDGE, -EDGE)
    return whole, *(faded(whole, share) for share in (0.8, 0.6, 0.4, 0.25, 0.1))


@cached
def word(text: str, color: Color, size: int = BODY) -> pygame.Surface:
    """A short word, EDGE px in from the left and with its middle EDGE px down."""
    wide = max(1, round(number_width(text, size)))
    ink = Ink(wide + 2 * EDGE, size + 2 * EDGE)
    return ink.text(text, size, EDGE, EDGE, color, "head").lit(0.5)


@cached
def turbo(seat: int, full: bool) -> pygame.Surface:
    """The cells of a turbo meter, all lit or all dark."""
    ink, color = Ink(round(CELLS * CELL) + 2 * EDGE, 9 + 2 * EDGE).to(EDGE, EDGE), PLAYERS[seat]
    for i in range(CELLS):
        x = i * CELL
        ink.fill([(x + 3, -5), (x + 15, -5), (x + 12, 4), (x, 4)], color if full else dim(color, 0.2))
    return ink.lit(0.5) if full else ink.plain()


@cached
def foot(seat: int, laps: int, full: bool) -> pygame.Surface:
    """The bar along a card's foot, a piece for each lap, all lit or all dark."""
    ink, color = Ink(FOOT + 2 * EDGE, 6 + 2 * EDGE).to(EDGE, EDGE), PLAYERS[seat]
    piece = FOOT / laps
    for i in range(laps):
        corners = [(i * piece, 0), ((i + 1) * piece - 5, 0), ((i + 1) * piece - 5, 6), (i * piece, 6)]
        ink.fill(corners, mix(color, WHITE, 0.25) if full else dim(color, 0.28))
    return ink.lit(0.6) if full else ink.plain()


@cached
def mover(up: bool) -> pygame.Surface:
    """An arrowhead: went ahead, or fell back."""
    side = -1 if up else 1
    ink = Ink(2 * EDGE + 2, 2 * EDGE + 2).to(EDGE, EDGE)
    return ink.fill([(-13, -side * 9), (13, -side * 9), (0, side * 11)], GAIN if up else LOSS).lit(0.9)


@cached
def signs(done: bool) -> pygame.Surface:
    """What stands before the times: a stopwatch or, in the end, a flag; a lap gone round; a star for the best."""
    ink = Ink(W // 2, H + 2 * EDGE).to(EDGE, EDGE)
    if done:
        flag(ink, 2, ROWS[0], 13, ICE)
    else:
        ink.ring(0, ROWS[0] + 1, 11, ICE, THIN).line([(0, ROWS[0] - 14), (0, ROWS[0] - 13)], ICE, 6)
        ink.line([(0, ROWS[0] - 5), (0, ROWS[0] + 1), (4, ROWS[0] + 1)], ICE, 3)
    ink.arc(0, ROWS[1], 9, -1.0, 4.0, MIST, THIN)
    ink.fill([(1, ROWS[1] - 13), (13, ROWS[1] - 9), (3, ROWS[1] - 1)], MIST)
    return ink.fill(star(0, ROWS[2], 12), FOCUS).lit(0.5)


@cached
def missed_mark(line: int) -> pygame.Surface:
    """On a card: the badge of the line that was missed."""
    ink = Ink(W // 2 + 2 * EDGE, H + 2 * EDGE).to(EDGE, EDGE)
    badge(ink, line, 50, 52, 34)
    ink.line([(114, 26), (114, 58)], WHITE, 12)
    return ink.disc(114, 80, 8, WHITE).lit(0.7)


@cached
def wrong_mark() -> pygame.Surface:
    """On a card: turn round."""
    ink = Ink(W // 2 + 2 * EDGE, H + 2 * EDGE).to(EDGE, EDGE)
    return u_turn(ink, 76, 52, 0.95).lit(0.7)


def u_turn(ink: Ink, x: float, y: float, k: float) -> Ink:
    """An arrow that turns back, 72 px high at scale 1."""
    bow = [(18 * math.cos(t / 8), -8 - 18 * math.sin(t / 8)) for t in range(26)]
    way = [(18.0, 30.0), (18.0, -8.0), *bow, (-18.0, 6.0)]
    ink.line([(x + k * a, y + k * b) for a, b in way], WHITE, 11 * k)
    return ink.fill([(x + k * a, y + k * b) for a, b in ((-39, 4), (3, 4), (-18, 32))], WHITE)


def star(x: float, y: float, r: float) -> list[Point]:
    """Five points."""
    outer, inner = regular(5, r, -math.pi / 2, x, y), regular(5, r * 0.45, -math.pi / 2 + math.pi / 5, x, y)
    return [point for pair in zip(outer, inner, strict=True) for point in pair]


def flag(ink: Ink, x: float, y: float, r: float, color: Color) -> None:
    """A chequered flag on its pole, `r` px to each side."""
    size = 2 * r / 4
    ink.line([(x - r, y - r), (x - r, y + r)], color, max(3, r * 0.2))
    for row in range(3):
        for column in range(4):
            if (row + column) % 2 == 0:
                a, b = x - r + column * size, y - r + row * size
                ink.fill([(a, b), (a + size, b), (a + size, b + size), (a, b + size)], color)
