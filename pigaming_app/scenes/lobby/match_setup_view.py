"""Rows in which something is chosen, and the small things round them, for the page before a match."""

from pigaming_app.ui.draw import (
    BODY,
    FOCUS,
    ICE,
    LABEL,
    LINE,
    MIST,
    STEEL,
    SUB,
    THIN,
    badge,
    cut,
    dim,
    icon,
    text_width,
)
from pigaming_app.ui.draw.layers import Lit, Pane, span
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fitted, shrunk_lines

W = span(8, 4)[1]
PAD = 32  # px between a row's edge and what is in it
CHIP, APART, CLOSE = 112, 16, 8  # px: a chip at most, between a few chips, between many
FEW = 4  # chips that have all the room they want


@cached
def row(name: str, value: str, aside: str = "", line: str = "") -> Lit:
    """What is chosen, a fact beside it, the value between arrows, and a sentence about it; upper left at (0, 0)."""
    high = 236 if line else 140
    pane = _named(name, high)
    pane.page.body(aside, W - PAD, 38, MIST, "r")
    size = fitted(value, LABEL, W - 2 * PAD - 100)
    pane.page.text(value, size, W / 2, 94, ICE, "head", "c")
    for sign, x in (("left", PAD + 14), ("right", W - PAD - 14)):
        icon(pane.hot, sign, x, 94, 20, MIST, LINE)
    room = W - 2 * PAD
    size, parts = shrunk_lines(line, room, 2)
    for i, part in enumerate(parts):
        pane.page.body(part, PAD, 156 + 48 * i, MIST, "l", size)
    return pane.done()


@cached
def chips(name: str, values: tuple[str, ...], value: str) -> Lit:
    """All values side by side, the chosen one lit; upper left at (0, 0)."""
    pane = _named(name, 140)
    wide, pitch = chip_size(len(values))
    for i, said in enumerate(values):
        x, on = PAD + i * pitch, said == value
        pane.hot.line(cut(x, 66, wide, 60, 12 if wide == CHIP else 10), ICE if on else STEEL, THIN, True)
        pane.page.cold.text(said, BODY, x + wide / 2, 96, ICE if on else MIST, "head", "c")
    return pane.done()


def chip_size(count: int) -> tuple[int, int]:
    """How wide each of so many chips is, and how far it is from one to the next, px."""
    apart = APART if count <= FEW else CLOSE
    wide = min(CHIP, (W - 2 * PAD + apart) // count - apart)
    return wide, wide + apart


def chip_at(count: int, x: float) -> int | None:
    """Which of so many chips lies x px from the left edge of its row."""
    wide, pitch = chip_size(count)
    i, rest = divmod(x - PAD, pitch)
    return int(i) if 0 <= i < count and rest < wide else None


@cached
def records(lines: tuple[tuple[str, str, str], ...]) -> Lit:
    """The best so far: what, how much and whose, a line for each; upper left at (0, 0)."""
    pane = Pane(0, 0, W, records_high(len(lines)))
    for i, (name, value, initials) in enumerate(lines):
        y = 38 + 56 * i
        icon(pane.hot, "crown", PAD + 18, y - 2, 16, FOCUS, 3)
        pane.page.body(name, PAD + 52, y, MIST, "l", fitted(name, BODY, W - 2 * PAD - 364, "body"))
        pane.page.text(value, BODY, W - PAD - 110, y, ICE, "head", "r")
        pane.page.text(initials, BODY, W - PAD, y, FOCUS, "head", "r")
    return pane.done()


def records_high(lines: int) -> int:
    """How much room they take, px."""
    return 20 + 56 * lines


@cached
def begin(said: str) -> Lit:
    """The button that begins; upper left at (0, 0)."""
    pane = Pane(0, 0, W, 96)
    pane.hot.line(cut(0, 0, W, 96, 18), dim(FOCUS, 0.55), THIN, True)
    size = fitted(said, SUB, W - 200)
    x = W / 2 - text_width(said, size) / 2
    icon(pane.hot, "right", x - 30, 48, 24, FOCUS, LINE)
    pane.page.text(said, size, W / 2 + 16, 48, FOCUS, "head", "c")
    return pane.done()


@cached
def lineup(seats: tuple[tuple[int, str], ...]) -> Lit:
    """Who plays: badges and the icons of what drives them, ending at x = 0."""
    pitch = 168
    pane = Pane(-pitch * len(seats), -40, pitch * len(seats), 80)
    for k, (seat, sign) in enumerate(seats):
        x = -pitch * (len(seats) - k)
        badge(pane.hot, seat, x + 50, 0, 30)
        icon(pane.hot, sign, x + 124, 0, 30, MIST, THIN)
    return pane.done()


@cached
def mark(seat: int) -> Lit:
    """Who begins here; round (0, 0)."""
    pane = Pane(-24, -24, 48, 48)
    badge(pane.hot, seat, 0, 0, 17)
    return pane.done()


@cached
def meant(high: int) -> Lit:
    """What a row in focus gets on top of its outline; upper left at (0, 0)."""
    pane = Pane(0, 0, W, high)
    pane.hot.line(cut(0, 0, W, high, 16), dim(FOCUS, 0.55), THIN, True)
    return pane.done()


def _named(name: str, high: int) -> Pane:
    pane = Pane(0, 0, W, high)
    pane.hot.line(cut(0, 0, W, high, 16), STEEL, THIN, True)
    pane.page.body(name, PAD, 38, MIST)
    return pane
