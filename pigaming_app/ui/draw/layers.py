"""Layers: parts of a page, rendered once and then blitted additively every frame.

A whole page takes 250 ms to render, so an animated scene is composed of cached layers. Lines of text are layers too:
the sizes at which they fit, line breaks, paragraphs.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import pygame

from pigaming_app.ui.draw import BODY, ICE, Color, GlowCanvas, LayeredCanvas, font, readable, text_width
from pigaming_app.ui.draw.frame_budget import Steps, run_to_end
from pigaming_app.ui.draw.sprites import Sprite, trim
from pigaming_app.ui.draw.surface_cache import cached

ADD = pygame.BLEND_RGB_ADD
MARGIN = 48  # px of glow round a layer
LEFT, RIGHT, TOP, BOTTOM = 96, 1824, 54, 1026  # the safe area
SMALLEST = 28  # px
LINE_PITCH = 1.35  # em, from line to line of a paragraph


@dataclass(frozen=True)
class LitImage:
    """A rendered layer and the canvas position of its upper left corner."""

    image: pygame.Surface
    at: tuple[int, int]

    def draw(
        self, screen: pygame.Surface, dx: float = 0.0, dy: float = 0.0, share: float = 1.0, begin: float = 0.0
    ) -> None:
        """Add it to the screen, moved by (dx, dy) px; `begin` and `share` (0..1 of its width) clip it."""
        w, h = self.image.get_size()
        left, right = round(w * max(0.0, begin)), round(w * min(1.0, share))
        if right > left:
            place = self.at[0] + dx + left, self.at[1] + dy
            screen.blit(self.image, place, (left, 0, right - left, h), special_flags=ADD)


class Layer:
    """A canvas for the area x, y, w, h (px), drawn on in screen coordinates."""

    def __init__(self, x: float, y: float, w: float, h: float) -> None:
        self.at = round(x) - MARGIN, round(y) - MARGIN
        self.canvas = LayeredCanvas(round(w) + 2 * MARGIN, round(h) + 2 * MARGIN)
        for canvas in (self.canvas.glow, self.canvas.soft, self.canvas.crisp):
            canvas.set_transform(-self.at[0], -self.at[1])

    @property
    def glow(self) -> GlowCanvas:
        """The glowing sub-canvas."""
        return self.canvas.glow

    def render_steps(self) -> Steps[LitImage]:
        """Render the layer: about 0.1 µs per pixel, too slow for a steady frame."""
        image = yield from self.canvas.render_steps()
        return LitImage(image, self.at)

    def render(self) -> LitImage:
        """Like `render_steps`, uninterrupted."""
        return run_to_end(self.render_steps())


def span(first: int, columns: int) -> tuple[int, int]:
    """x and width, px, of `columns` of the twelve page columns, starting at column `first` (0..11)."""
    return LEFT + first * 146, columns * 146 - 24


@cached
def backdrop() -> pygame.Surface:
    """The dotted arena floor, full screen."""
    tile = GlowCanvas(48, 48).disc(24, 12, 1.5, (22, 31, 46)).plain()
    out = pygame.Surface((1920, 1080))
    out.fblits([(tile, (x, y)) for x in range(0, 1920, 48) for y in range(0, 1080, 48)])
    return out


def fit_size(text: str, size: int, width: float, face: str = "head") -> int:
    """The largest font size up to `size` at which a line is at most `width` px wide."""
    wide = text_width(text, size, face)
    return size if wide <= width else int(size * width / wide)


def fit_text(text: str, size: int, width: float, face: str = "head", smallest: int = SMALLEST) -> tuple[str, int]:
    """A line and its size, px: smaller where it is too wide, but not below `smallest`; then its end is cut off."""
    fits = fit_size(text, size, width, face)
    if fits >= smallest:
        return text, fits
    kept = text
    while kept and text_width(f"{kept}…", smallest, face) > width:
        kept = kept[:-1].rstrip(" .")
    return f"{kept}…", smallest


def parts(text: str) -> list[str]:
    """The parts of a text between which a line may break: not at a no-break space."""
    return [part for part in text.replace("\n", " ").split(" ") if part]


def wrap(text: str, size: int, width: float, face: str = "body") -> list[str]:
    """Break a text into lines at most `width` px wide."""
    lines = [""]
    for part in parts(text):
        longer = f"{lines[-1]} {part}".strip()
        if lines[-1] and text_width(longer, size, face) > width:
            lines.append(part)
        else:
            lines[-1] = longer
    return lines


def wrap_balanced(text: str, count: int, size: int = BODY, face: str = "body") -> list[str]:
    """Break a text into at most `count` lines, the longest as short as possible."""
    words = parts(text)
    widths = {
        text_width(" ".join(words[i:j]), size, face) for i in range(len(words)) for j in range(i + 1, len(words) + 1)
    }
    return next((lines for w in sorted(widths) if len(lines := wrap(text, size, w, face)) <= count), [])


def fit_lines(
    text: str, room: float, max_lines: int, sizes: Sequence[int] = range(BODY, SMALLEST, -2)
) -> tuple[int, list[str]]:
    """The first of `sizes` (px) at which a text fits `max_lines` lines of `room` px, else SMALLEST; and those lines."""
    text = _with_breaks(text, room)
    for size in sizes:
        lines = wrap(text, size, room)
        if len(lines) <= max_lines and _are_in(lines, size, room):
            return size, lines
    return SMALLEST, wrap(text, SMALLEST, room)


def fit_paragraphs(
    sentences: Sequence[str], room: float, height: float, gap: float, sizes: Sequence[int]
) -> tuple[int, list[list[str]]] | None:
    """The first of `sizes` (px) at which all sentences fit `height` px, `gap` px between them; and the lines of each.

    None if they do not.
    """
    for size in sizes:
        found = [wrap(_with_breaks(sentence, room), size, room) for sentence in sentences]
        high = LINE_PITCH * size * sum(map(len, found)) + gap * (len(found) - 1)
        if high <= height and all(_are_in(lines, size, room) for lines in found):
            return size, found
    return None


def _are_in(lines: Sequence[str], size: int, room: float) -> bool:
    """True if no line is wider than `room` px."""
    return all(text_width(line, size, "body") <= room for line in lines)


def _with_breaks(text: str, room: float) -> str:
    """A text whose words, such as the path of a port, are short enough for a line of `room` px at SMALLEST."""
    words = []
    for part in parts(text):
        while text_width(part, SMALLEST, "body") > room:
            count = next(n for n in range(len(part), 0, -1) if text_width(part[:n], SMALLEST, "body") <= room)
            words.append(part[:count])
            part = part[count:]
        words.append(part)
    return " ".join(words)


@cached
def word(text: str, size: int, color: Color, face: str = "hero", glow: float = 0.7, level: int = 8) -> LitImage:
    """One glowing line with its capitals centred on (0, 0), at `level`/8 of its brightness."""
    if level < 8:
        whole = word(text, size, color, face, glow)
        image = whole.image.copy()
        image.fill([255 * level // 8] * 3, special_flags=pygame.BLEND_RGB_MULT)
        return LitImage(image, whole.at)
    w, h = round(text_width(text, size, face)) + 64, round(size * 1.5) + 48
    ink = GlowCanvas(w, h)
    ink.text(text, size, w / 2, h / 2, color, face, "c")
    return LitImage(ink.lit(glow), (-(w // 2), -(h // 2)))


@cached
def text(
    line: str, size: int = BODY, color: Color = ICE, face: str = "body", align: str = "c", room: int = 1728
) -> LitImage:
    """One line with its capitals centred on y = 0, shrunk to `room` px. Every face except "body" glows faintly."""
    size = fit_size(line, size, room, face)
    edge = 4 if face == "body" else 32  # px of margin for the glow
    w, h = round(text_width(line, size, face)) + 2 * edge, 2 * size + 2 * edge
    ink = GlowCanvas(w, h).text(line, size, edge, h / 2, color, face)
    left = -edge - round((w - 2 * edge) * {"l": 0.0, "c": 0.5, "r": 1.0}[align])
    return LitImage(ink.plain() if face == "body" else ink.lit(0.45), (left, -h // 2))


def paragraph(sentence: str, room: int, max_lines: int = 4, color: Color = ICE, align: str = "l") -> list[LitImage]:
    """A sentence as at most `max_lines` lines of `room` px; longer ones are set smaller."""
    size, lines = fit_lines(sentence, room, max_lines, range(readable(BODY), SMALLEST, -2))
    return [text(line, size, color, "body", align, room) for line in lines]


def write_lines(layer: Layer, sentence: str, x: float, y: float, room: float, color: Color) -> float:
    """Draw a sentence on a layer, smaller where it needs more than three lines. Returns the y of the next line, px."""
    size, lines = fit_lines(sentence, room, 3, (BODY, 36, 32))
    for line in lines:
        layer.canvas.body(line, x, y, color, "l", size)
        y += LINE_PITCH * size
    return y


@cached
def glyph(char: str, size: int, color: Color, glow: float = 0.7) -> tuple[Sprite, float]:
    """A rendered digit or sign, anchored at its left edge and the middle of the capitals, and its advance, px."""
    advance = font("hero", size * 2).size(char)[0] / 2
    w, h = math.ceil(advance) + 48, size + 56
    ink = GlowCanvas(w, h).text(char, size, 24, h / 2, color, "hero")
    return trim(ink.lit(glow), 24, h / 2), advance


def number_width(text: str, size: int) -> float:
    """Width of a number set in glyphs, px."""
    return sum(glyph(char, size, ICE)[1] for char in text)
