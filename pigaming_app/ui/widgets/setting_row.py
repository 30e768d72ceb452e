"""Setting rows, one focused: toggles, meters, values between arrows, actions; and the panel that describes them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import pygame

from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_text, paragraph, span, text
from pigaming_app.ui.draw.sprites import Sprite, trim
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import glow_bar

PANEL = pygame.Rect(span(8, 4)[0], 210, span(8, 4)[1], 660)
W = span(0, 8)[1]
AT = 500  # px from a row's left edge to its value
ROOM = W - AT - 40
VALUE_ROOM = ROOM - 120  # px between the arrows of a value
CELL, CELLS = 40, 10  # px from one cell of a meter to the next
CENTRE = (PANEL.centerx, PANEL.y + 190)  # of the picture
RING_R, RING_STEPS = 150, 24  # px, and images of the ring round it


APART = 8  # px between rows that have a line between them
TOP, PITCH, HIGH = 246, 88, 64  # px: the middle of the first row, from row to row, height of a row
AT_MOST = 8  # rows at that pitch; more are closer


@dataclass(frozen=True)
class SettingValue:
    """The content of a row: options of a toggle, a meter of ten cells, a text between arrows, or an action."""

    kind: str  # toggle, meter, arrows, action
    options: tuple[str, ...]
    chosen: int = 0
    endless: bool = False  # the first option follows the last

    @property
    def count(self) -> int:
        """The number of values."""
        return CELLS + 1 if self.kind == "meter" else len(self.options)


def spots(names: Sequence[str], at_most: int = AT_MOST) -> list[FocusSpot]:
    """The spots of rows with these names; more than `at_most` have the room of so many."""
    x, w = span(0, 8)
    pitch = PITCH if len(names) <= at_most else PITCH * (at_most - 1) // (len(names) - 1)
    return [FocusSpot(name, pygame.Rect(x, TOP - HIGH // 2 + pitch * i, w, HIGH)) for i, name in enumerate(names)]


def draw_rows(screen: pygame.Surface, focus: Focus, labels: dict[str, str], values: dict[str, SettingValue]) -> None:
    """Draw the rows of a page."""
    glow_bar(screen, focus.box)
    for i, spot in enumerate(focus.spots):
        box, content, focused = spot.rect, values[spot.name], spot.name == focus.name
        label(labels[spot.name], focused).draw(screen, box.x + 40, box.centery)
        value(content.kind, content.options, content.chosen, focused).draw(screen, box.x, box.centery)
        if i and box.y >= (above := focus.spots[i - 1].rect.bottom) + APART:
            separator(box.w).draw(screen, box.x, (box.y + above) // 2)
    focus.draw(screen)


def label(name: str, focused: bool) -> LitImage:
    """The name of a row, its middle at y = 0."""
    return text(name, kit.readable(kit.BODY), kit.ICE if focused else kit.MIST, "body", "l", AT - 60)


@cached
def separator(w: int) -> LitImage:
    """The thin line between two rows."""
    return LitImage(
        kit.GlowCanvas(w, 4).line([(24, 2), (w - 24, 2)], kit.dim(kit.STEEL, 0.6), kit.HAIR).plain(), (0, -2)
    )


@cached
def value(kind: str, options: tuple[str, ...], chosen: int, focused: bool) -> LitImage:
    """The value of a row, its middle at y = 0: a toggle, a meter, a text between arrows, or an action."""
    layer = Layer(AT, -36, ROOM, 72)
    if kind == "toggle":
        for option, (x, w), on in zip(options, chips(options), range(len(options)), strict=True):
            lit = on == chosen
            edge = (kit.FOCUS if focused else kit.ICE) if lit else kit.STEEL
            layer.glow.line(kit.cut_box(x, -24, w, 48, 12), edge, kit.THIN, True)
            layer.canvas.crisp.text(option, kit.BODY, x + w / 2, 0, kit.ICE if lit else kit.MIST, "head", "c")
    elif kind == "meter":
        _meter(layer, chosen, focused)
    elif kind == "arrows":
        for sign, x in (("left", AT + 14), ("right", W - 54)):
            kit.icon(layer.glow, sign, x, 0, 18, kit.FOCUS if focused else kit.MIST, 5)
        option = options[chosen] if chosen < len(options) else ""
        option, size = fit_text(option, kit.readable(kit.BODY), VALUE_ROOM, "body")
        layer.canvas.crisp.text(option, size, (AT + W - 40) / 2, 0, kit.ICE, "body", "c")
    else:
        w = chips(options)[0][1]
        layer.glow.line(kit.cut_box(AT, -24, w, 48, 12), kit.FOCUS if focused else kit.STEEL, kit.THIN, True)
        layer.canvas.crisp.text(options[0], kit.BODY, AT + w / 2, 0, kit.ICE if focused else kit.MIST, "head", "c")
    return layer.render()


def _meter(layer: Layer, chosen: int, focused: bool) -> None:
    color = kit.FOCUS if focused else kit.MIST
    for i in range(CELLS):
        box = kit.cut_box(AT + CELL * i, -22, 30, 44, 6)
        if i < chosen:
            layer.glow.fill(box, color)
        else:
            layer.glow.line(box, kit.STEEL, 3, True)
    layer.canvas.crisp.text(str(chosen), kit.BODY, W - 40, 0, kit.ICE if focused else kit.MIST, "head", "r")


def chips(options: tuple[str, ...]) -> list[tuple[int, int]]:
    """x and width of a toggle's options, px from the row's left edge."""
    places: list[tuple[int, int]] = []
    x = AT
    for option in options:
        w = round(kit.text_width(option, kit.BODY)) + 40
        places.append((x, w))
        x += w + 12
    return places


def value_at(kind: str, options: tuple[str, ...], x: float) -> int | None:
    """The value of a toggle or meter at x px from the row's left edge; None if there is none."""
    if kind == "toggle":
        return next((i for i, (left, w) in enumerate(chips(options)) if left <= x < left + w), None)
    cell = math.ceil((x - AT) / CELL)
    return cell if 0 <= cell <= CELLS else None


def describe(screen: pygame.Surface, title: str, sentence: str) -> None:
    """Draw the name and description of a row in the panel."""
    for i, lit in enumerate(description(title, sentence)):
        lit.draw(screen, PANEL.x + 40, PANEL.y + 400 + (14 + 58 * i if i else 0))


@cached
def description(title: str, sentence: str) -> tuple[LitImage, ...]:
    """A title and its description, wrapped to the panel."""
    room = PANEL.w - 80
    return (text(title, kit.LABEL, kit.ICE, "head", "l", room), *paragraph(sentence, room, 3, kit.MIST))


def ring(screen: pygame.Surface, share: float) -> None:
    """The progress of a held button, round the picture: `share` in 0..1."""
    image, dx, dy = filling(math.ceil(share * RING_STEPS))
    screen.blit(image, (CENTRE[0] + dx, CENTRE[1] + dy), special_flags=pygame.BLEND_RGB_ADD)


@cached
def filling(step: int) -> Sprite:
    """A ring filled to `step` of RING_STEPS, centred on (0, 0)."""
    half = RING_R + 22
    ink = kit.GlowCanvas(2 * half, 2 * half)
    ink.arc(half, half, RING_R, math.tau * 0.75, math.tau * (0.75 + step / RING_STEPS), kit.ALARM, kit.LINE)
    return trim(ink.lit(0.8), half, half)
