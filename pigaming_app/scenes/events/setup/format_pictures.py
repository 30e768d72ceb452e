"""Pictures beside the rows: each format has its own, as have length, rounds, seats, AIs and names."""

import math
from collections.abc import Callable

from pigaming_app.events.spec import Format
from pigaming_app.ui.draw import (
    FOCUS,
    ICE,
    LABEL,
    LINE,
    MIST,
    PLAYERS,
    STEEL,
    SUB,
    THIN,
    TITLE,
    GlowCanvas,
    badge,
    cut_box,
    dim,
    icon,
)
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import cached

HALF = 190  # px, half the size of a picture


@cached
def picture(form: Format) -> LitImage:
    """The picture of a format, centred on (0, 0)."""
    ink = GlowCanvas(2 * HALF, 2 * HALF).set_transform(HALF, HALF)
    DRAWINGS[form](ink)
    return LitImage(ink.lit(0.8), (-HALF, -HALF))


def _bracket(ink: GlowCanvas) -> None:
    """Two sides: the unbeaten above, those with one life left below in dashes, and the final of both."""
    upper, lower = (-172, -84, 4), (-84, 4)  # px, left edges of the rounds of either side
    rounds = [(x, [(-136, -90, -44, 2), (-113, -21), (-67,)][i], False) for i, x in enumerate(upper)]
    rounds += [(x, [(74, 120), (97,)][i], True) for i, x in enumerate(lower)]
    for k, (x, ys, beaten) in enumerate(rounds):
        following = rounds[k + 1] if k + 1 < len(rounds) and len(ys) > 1 else (108, (15,), False)
        for i, y in enumerate(ys):
            box = cut_box(x, y - 16, 62, 32, 7)
            color = PLAYERS[(i + k) % 4]
            ink.dashes(box, dim(color, 0.7), THIN, 9, 6) if beaten else ink.line(box, color, THIN, True)
            there = following[1][i // 2]
            ink.line([(x + 64, y), (following[0] - 13, y), (following[0] - 13, there), (following[0], there)], STEEL, 3)
    ink.line(cut_box(108, -9, 70, 48, 8), FOCUS, LINE, True)


def _cross_table(ink: GlowCanvas) -> None:
    for row in range(4):
        for column in range(4):
            box = cut_box(-128 + 66 * column, -128 + 66 * row, 56, 56, 8)
            if row == column:
                ink.fill(box, dim(STEEL, 0.6))
            else:
                ink.line(box, PLAYERS[row] if (row + column) % 3 else MIST, THIN, True)


def _swiss(ink: GlowCanvas) -> None:
    for column in range(3):
        for row in range(4):
            color = PLAYERS[row] if column == 2 else dim(PLAYERS[(row * (3 if column == 0 else 1) + column) % 4], 0.7)
            ink.line(
                cut_box(-156 + 120 * column, -120 + 64 * row, 72, 48, 8), color, LINE if column == 2 else THIN, True
            )
        if column < 2:
            for one, other in ((0, 1), (1, 0), (2, 3), (3, 2)):
                ink.line([(-78 + 120 * column, -96 + 64 * one), (-42 + 120 * column, -96 + 64 * other)], STEEL, THIN)


def _podium(ink: GlowCanvas) -> None:
    for x, high, color in ((-120, 130, ICE), (-40, 190, FOCUS), (40, 90, MIST)):
        ink.line(cut_box(x, 120 - high, 76, high, 10), color, LINE if color == FOCUS else THIN, True)
    for i in range(3):
        ink.disc(-82 + 80 * i, -128, 14, PLAYERS[i])


def _groups(ink: GlowCanvas) -> None:
    """Two groups, of whose four the first two cross over to the final."""
    for group, y in enumerate((-150, 20)):
        for row in range(4):
            box, color = cut_box(-170, y + 34 * row, 108, 26, 6), PLAYERS[(row + group) % 4]
            ink.line(box, color if row < 2 else dim(color, 0.45), LINE if row < 2 else THIN, True)
    pairs = ((-137, 67), (33, -103))  # first of one group, second of the other: middles of their boxes
    for (one, other), there in zip(pairs, (-62, 62), strict=True):
        for y in (one, other):
            ink.line([(-58, y), (-20, there), (-4, there)], STEEL, 3)
        ink.line(cut_box(0, there - 22, 62, 44, 8), MIST, THIN, True)
        ink.line([(66, there), (88, there), (88, 0), (104, 0)], STEEL, 3)
    ink.line(cut_box(108, -26, 70, 52, 8), FOCUS, LINE, True)


def _ladder(ink: GlowCanvas) -> None:
    """Rungs with places; the one at the foot challenges two places up."""
    for x in (-96, 56):
        ink.line([(x, -160), (x, 160)], STEEL, LINE)
    for i, y in enumerate((-126, -42, 42, 126)):
        color = PLAYERS[(3, 1, 2, 0)[i]]
        ink.line(cut_box(-78, y - 33, 116, 66, 8), FOCUS if i == 3 else color, LINE if i in (1, 3) else THIN, True)
        ink.text(str(i + 1), LABEL, -20, y, FOCUS if i == 3 else ICE, "hero", "c")
    ink.line([(66, 126), (128, 126), (128, -42), (76, -42)], FOCUS, LINE)
    ink.line([(98, -64), (72, -42), (98, -20)], FOCUS, LINE)


def _stopwatch(ink: GlowCanvas) -> None:
    """A stopwatch, and a course with one robot on it."""
    ink.ring(0, 22, 118, MIST, LINE).arc(0, 22, 88, -math.pi / 2, math.pi * 0.75, FOCUS, 22)
    ink.line([(0, -96), (0, -136)], MIST, LINE)
    ink.line([(-34, -144), (34, -144)], ICE, LINE)
    ink.line([(92, -76), (114, -98)], MIST, LINE)
    ink.line([(0, 22), (58, 58)], ICE, LINE)
    ink.disc(0, 22, 9, ICE)


def _high_score(ink: GlowCanvas) -> None:
    """Tries as bars, the best of which has the crown."""
    for i, high in enumerate((90, 150, 60, 230, 120)):
        best = high == 230
        box = cut_box(-160 + 66 * i, 150 - high, 50, high, 8)
        ink.line(box, FOCUS if best else dim(PLAYERS[i % 4], 0.8), LINE if best else THIN, True)
    icon(ink, "crown", 63, -126, 40, FOCUS, LINE)


@cached
def row_picture(row: str, chosen: int) -> LitImage:
    """The picture of the row "length", "rounds", "seats", "fill" or "entrants" with its value, centred on (0, 0)."""
    ink = GlowCanvas(2 * HALF, 2 * HALF).set_transform(HALF, HALF)
    ROW_DRAWINGS[row](ink, chosen)
    return LitImage(ink.lit(0.8), (-HALF, -HALF))


def _length(ink: GlowCanvas, chosen: int) -> None:
    """A clock face: a third of it, two thirds or all of it is lit."""
    ink.ring(0, 0, 120, MIST, LINE).arc(0, 0, 92, -math.pi / 2, -math.pi / 2 + math.tau * (chosen + 1) / 3, FOCUS, 24)
    ink.line([(0, -52), (0, 0), (34, 20)], ICE, LINE)


def _rounds(ink: GlowCanvas, rounds: int) -> None:
    """So many rounds, in an arrow that goes round."""
    ink.arc(0, 0, 120, -math.pi / 2 + 0.5, 1.5 * math.pi - 0.1, FOCUS, LINE)
    ink.line([(-30, -148), (-2, -120), (-30, -92)], FOCUS, LINE)
    ink.text(str(rounds) if rounds else "∞", TITLE, 0, 0, ICE, "hero", "c")


def _seats(ink: GlowCanvas, seats: int) -> None:
    """So many robots, face to face."""
    places = {2: ((-80, 0), (80, 0)), 3: ((-90, 70), (0, -80), (90, 70))}
    for seat, (x, y) in enumerate(places.get(seats, ((-84, -84), (84, -84), (-84, 84), (84, 84)))):
        badge(ink, seat, x, y, 56)


def _fill(ink: GlowCanvas, on: int) -> None:
    """Two players, and a place that an AI takes, or that stays empty."""
    for seat, x in enumerate((-130, 0)):
        badge(ink, seat, x, 0, 48)
    ink.dashes(cut_box(74, -56, 112, 112, 14), FOCUS if on else STEEL, THIN, 16, 12)
    if on:
        icon(ink, "ai", 130, 0, 40, FOCUS, THIN)


def _names(ink: GlowCanvas, chosen: int) -> None:
    """Three letters, and an AI."""
    for i, letter in enumerate("ABC"):
        ink.line(cut_box(-168 + 116 * i, -120, 100, 124, 14), FOCUS if i == 0 else MIST, LINE, True)
        ink.text(letter, SUB, -118 + 116 * i, -58, FOCUS if i == 0 else ICE, "hero", "c")
    icon(ink, "ai", 0, 88, 50, ICE, THIN)


ROW_DRAWINGS: dict[str, Callable[[GlowCanvas, int], None]] = {
    "length": _length,
    "rounds": _rounds,
    "seats": _seats,
    "fill": _fill,
    "entrants": _names,
}
DRAWINGS: dict[Format, Callable[[GlowCanvas], None]] = {
    Format.KNOCKOUT: _bracket,
    Format.ROUND_ROBIN: _cross_table,
    Format.SWISS: _swiss,
    Format.GRAND_PRIX: _podium,
    Format.GROUPS: _groups,
    Format.CHALLENGE: _ladder,
    Format.TIME_TRIAL: _stopwatch,
    Format.HIGH_SCORE: _high_score,
}
