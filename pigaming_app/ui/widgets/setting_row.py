"""What the options are set with: toggles, meters, arrows, and beside them a picture of what the row in focus means."""

import math

import pygame

from pigaming_app.scenes.title.logo import seat_robot
from pigaming_app.ui.draw.frame_budget import Steps, sliced
from pigaming_app.ui.draw.ink import (
    ALARM,
    BODY,
    FOCUS,
    HAIR,
    ICE,
    LABEL,
    LINE,
    MIST,
    STEEL,
    THIN,
    Color,
    Ink,
    cut,
    dim,
    icon,
    panel,
    text_width,
)
from pigaming_app.ui.draw.layers import Lit, Pane, fitted, lines_of, span
from pigaming_app.ui.draw.sprites import Sprite, trim
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import stamp, text

PANEL = pygame.Rect(span(8, 4)[0], 210, span(8, 4)[1], 660)
W = span(0, 8)[1]
AT = 500  # px from a row's left edge to its value
ROOM = W - AT - 40
CELL, CELLS = 40, 10  # px from one cell of a meter to the next
CENTRE = (PANEL.centerx, PANEL.y + 190)  # of the picture
RING_R, RING_STEPS = 150, 24  # px, and pictures of the ring


def label(said: str, hot: bool) -> Lit:
    """The name of a row, its middle at y = 0."""
    return text(said, BODY, ICE if hot else MIST, "body", "l", AT - 60)


@cached
def rule(w: int) -> Lit:
    """The hair line between two rows."""
    return Lit(Ink(w, 4).line([(24, 2), (w - 24, 2)], dim(STEEL, 0.6), HAIR).plain(), (0, -2))


@cached
def value(kind: str, options: tuple[str, ...], chosen: int, hot: bool) -> Lit:
    """What is set, its middle at y = 0: a toggle, a meter, a text between arrows, or a deed."""
    pane = Pane(AT, -36, ROOM, 72)
    if kind == "toggle":
        for said, (x, w), on in zip(options, chips(options), range(len(options)), strict=True):
            lit = on == chosen
            edge = (FOCUS if hot else ICE) if lit else STEEL
            pane.hot.line(cut(x, -27, w, 54, 12), edge, THIN, True)
            pane.page.cold.text(said, BODY, x + w / 2, 0, ICE if lit else MIST, "head", "c")
    elif kind == "meter":
        _meter(pane, chosen, hot)
    elif kind == "arrows":
        for sign, x in (("left", AT + 14), ("right", W - 54)):
            icon(pane.hot, sign, x, 0, 18, FOCUS if hot else MIST, 5)
        said = options[chosen] if chosen < len(options) else ""
        size = fitted(said, BODY, ROOM - 120, "body")
        pane.page.cold.text(said, size, (AT + W - 40) / 2, 0, ICE, "body", "c")
    else:
        w = chips(options)[0][1]
        pane.hot.line(cut(AT, -27, w, 54, 12), FOCUS if hot else STEEL, THIN, True)
        pane.page.cold.text(options[0], BODY, AT + w / 2, 0, ICE if hot else MIST, "head", "c")
    return pane.done()


def _meter(pane: Pane, chosen: int, hot: bool) -> None:
    color = FOCUS if hot else MIST
    for i in range(CELLS):
        box = cut(AT + CELL * i, -22, 30, 44, 6)
        if i < chosen:
            pane.hot.fill(box, color)
        else:
            pane.hot.line(box, STEEL, 3, True)
    pane.page.cold.text(str(chosen), BODY, W - 40, 0, ICE if hot else MIST, "head", "r")


def chips(options: tuple[str, ...]) -> list[tuple[int, int]]:
    """x and width of the options of a toggle, px from the row's left edge."""
    places: list[tuple[int, int]] = []
    x = AT
    for said in options:
        w = round(text_width(said, BODY)) + 40
        places.append((x, w))
        x += w + 12
    return places


def hit(kind: str, options: tuple[str, ...], chosen: int, x: float) -> int | None:
    """The value that a click means, x px from the row's left edge; None: it hits nothing."""
    if kind == "toggle":
        return next((i for i, (left, w) in enumerate(chips(options)) if left <= x < left + w), None)
    if kind == "meter":
        cell = math.ceil((x - AT) / CELL)
        return cell if 0 <= cell <= CELLS else None
    if x < AT:
        return None
    by = -1 if x < AT + ROOM / 2 else 1
    return max(0, min(len(options) - 1, chosen + by))


@cached
@sliced
def beside() -> Steps[Lit]:
    """The panel beside the rows; upper left at (0, 0)."""
    pane = Pane(0, 0, PANEL.w, PANEL.h)
    panel(pane.hot, 0, 0, PANEL.w, PANEL.h)
    yield
    return (yield from pane.lighting())


def about(screen: pygame.Surface, said: str, line: str) -> None:
    """What a row is called and does, in the panel."""
    for i, lit in enumerate(told(said, line)):
        lit.draw(screen, PANEL.x + 40, PANEL.y + 400 + (14 + 58 * i if i else 0))


@cached
def told(said: str, line: str) -> tuple[Lit, ...]:
    """A title, and a sentence in lines that fit into the panel."""
    room = PANEL.w - 80
    parts = (text(part, BODY, MIST, "body", "l") for part in lines_of(line, BODY, room))
    return (text(said, LABEL, ICE, "head", "l", room), *parts)


def sketch(screen: pygame.Surface, name: str, chosen: int, seconds: float) -> None:
    """The moving picture in the panel."""
    x, y = CENTRE
    since, jolt = seconds % 1.4, 0  # the robot of the picture is hit every 1.4 seconds
    if name == "flashes" and since < 0.6:
        _burst(chosen, int(since * 10)).draw(screen, x, y)
    if name == "shake" and chosen and since < 0.35:
        jolt = round(12 * math.sin(since * 64) * (1 - since / 0.35))
    if name in ("flashes", "shake"):
        stamp(screen, _robot(), x + jolt, y + jolt // 2)
    else:
        drawn(name, chosen, seconds).draw(screen, x, y)


def ring(screen: pygame.Surface, share: float) -> None:
    """What is being held down, round the picture in the panel: `share` of the time has passed, 0..1."""
    image, dx, dy = filling(math.ceil(share * RING_STEPS))
    screen.blit(image, (CENTRE[0] + dx, CENTRE[1] + dy), special_flags=pygame.BLEND_RGB_ADD)


@cached
def filling(step: int) -> Sprite:
    """A ring, `step` of RING_STEPS full, round (0, 0)."""
    half = RING_R + 22
    ink = Ink(2 * half, 2 * half)
    ink.arc(half, half, RING_R, math.tau * 0.75, math.tau * (0.75 + step / RING_STEPS), ALARM, LINE)
    return trim(ink.lit(0.8), half, half)


def drawn(name: str, chosen: int, seconds: float = 0.0) -> Lit:
    """The picture of a row at a moment."""
    if name == "sounds":
        return _speaker(chosen, int(seconds * 6) % 4)
    return _note(chosen, int(seconds * 8) % 8) if name == "music" else _drawn(name, chosen, int(seconds * 2) % 2)


@cached
def _robot() -> Sprite:
    return seat_robot(1, -0.6, 1.8)


@cached
def _burst(strength: int, stage: int) -> Lit:
    ink = Ink(400, 400).to(200, 200)
    fade = (1.0 - stage / 6) * (0.25, 0.6, 1.0)[strength]
    for i in range(12):
        c, s = math.cos(i * math.tau / 12 + 0.2), math.sin(i * math.tau / 12 + 0.2)
        near, far = 96 + 8 * stage, 112 + (4 + 8 * strength) + 10 * stage
        ink.line([(near * c, near * s), (far * c, far * s)], dim(FOCUS, fade), LINE)
    return Lit(ink.lit(0.5 + 0.5 * strength), (-200, -200))


@cached
def _speaker(loud: int, wave: int) -> Lit:
    ink = Ink(400, 320).to(200, 160)
    ink.line([(-92, -26), (-56, -26), (-10, -68), (-10, 68), (-56, 26), (-92, 26)], FOCUS, LINE, True)
    reach = (loud + 3) // 4  # of three waves
    for i, r in enumerate((46, 82, 118)):
        lit = i < reach
        bright = 1.0 if wave == i or wave == 3 else 0.7
        ink.arc(-10, 0, r, -0.62, 0.62, dim(FOCUS, bright) if lit else STEEL, LINE)
    return Lit(ink.lit(1.0), (-200, -160))


@cached
def _note(loud: int, beat: int) -> Lit:
    """Bars that dance, as high as the music is loud."""
    ink = Ink(440, 320).to(220, 160)
    for i in range(8):
        share = 0.35 + 0.65 * abs(math.sin(1.7 * i + beat * math.pi / 4))
        cells = round(6 * share * (loud / 10)) if loud else 0
        for j in range(6):
            box = cut(-166 + 42 * i, 74 - 30 * j, 30, 22, 5)
            if j < cells:
                ink.fill(box, FOCUS)
            else:
                ink.line(box, dim(STEEL, 0.7), HAIR, True)
    return Lit(ink.lit(0.7), (-220, -160))


@cached
def _drawn(name: str, chosen: int, beat: int) -> Lit:
    ink = Ink(480, 340).to(240, 170)
    if name == "language":
        for i, said in enumerate(("EN", "PT")):
            lit: Color = FOCUS if i == chosen else STEEL
            x, y = (-88, -40) if i == 0 else (72, 40)
            _bubble(ink, x, y, -1 if i == 0 else 1, lit)
            ink.text(said, LABEL, x, y, lit, "head", "c")
    elif name in ("display", "fullscreen"):
        _monitor(ink, bool(chosen) if name == "fullscreen" else False, beat)
    elif name == "padtest":
        icon(ink, "pad", 0, 10, 130, FOCUS, LINE)
        if beat:
            ink.disc(0.44 * 130, 10 - 0.28 * 130, 12, ICE)
    elif name == "robots":
        ink.ring(0, 0, 104, FOCUS, LINE).line(cut(-46, -46, 92, 92, 4), ICE, LINE, True)
        ink.fill([(-30, -30), (0, -30), (0, 0), (-30, 0)], ICE).fill([(0, 0), (30, 0), (30, 30), (0, 30)], ICE)
        for y in (-118, 118):
            ink.line([(-34, y), (34, y)], FOCUS, LINE)
        ink.line([(122, -22), (146, 0), (122, 22)], FOCUS, LINE)
    elif name == "reset":
        icon(ink, "crown", 0, 0, 96, FOCUS, LINE)
        ink.line([(-120, 96), (120, -96)], ICE, LINE)
    else:
        ink.arc(0, 6, 84, -math.pi / 2 + 0.5, 1.5 * math.pi - 0.5, FOCUS, LINE)
        ink.line([(0, -110), (0, -10)], FOCUS, LINE)
    return Lit(ink.lit(0.9), (-240, -170))


def _bubble(ink: Ink, x: float, y: float, side: int, color: Color) -> None:
    w, h = 150, 96
    ink.line(cut(x - w / 2, y - h / 2, w, h, 16), color, LINE, True)
    ink.line([(x + side * 30, y + h / 2), (x + side * 56, y + h / 2 + 30), (x + side * 56, y + h / 2)], color, LINE)


def _monitor(ink: Ink, full: bool, beat: int) -> None:
    ink.line(cut(-150, -104, 300, 184, 16), ICE, LINE, True)
    ink.line([(-60, 120), (60, 120)], ICE, LINE).line([(0, 80), (0, 120)], ICE, LINE)
    w, h = (264, 148) if full else (150, 84)
    ink.line(cut(-w / 2, -12 - h / 2, w, h, 10), FOCUS, LINE if beat else THIN, True)
