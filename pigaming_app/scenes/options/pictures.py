"""The animated picture beside the options that illustrates the focused row."""

import math
from collections.abc import Callable

import pygame

from pigaming_app.scenes.views.sprites.robot import seat_robot
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.sprites import Sprite
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.widgets.labels import blit_sprite
from pigaming_app.ui.widgets.setting_row import CENTRE


def sketch(screen: pygame.Surface, name: str, chosen: int, seconds: float) -> None:
    """Draw the picture in the panel."""
    x, y = CENTRE
    since, jolt = seconds % 1.4, 0  # the pictured robot is hit every 1.4 seconds
    if name == "flashes" and since < 0.6:
        _burst(chosen, int(since * 10)).draw(screen, x, y)
    if name == "shake" and chosen and since < 0.35:
        jolt = round(12 * math.sin(since * 64) * (1 - since / 0.35))
    if name == "rumble":
        jolt = round(7 * math.sin(since * 90)) if chosen and since < 0.5 else 0
        drawn(name, chosen).draw(screen, x + jolt, y)
    elif name in ("flashes", "shake"):
        blit_sprite(screen, _robot(), x + jolt, y + jolt // 2)
    else:
        drawn(name, chosen, seconds).draw(screen, x, y)


def drawn(name: str, chosen: int, seconds: float = 0.0) -> LitImage:
    """The picture of a row at a moment."""
    if name == "sounds":
        return _speaker(chosen, int(seconds * 6) % 4)
    return _note(chosen, int(seconds * 8) % 8) if name == "music" else _drawn(name, chosen, int(seconds * 2) % 2)


@cached
def added(sketch: Callable[[kit.GlowCanvas, int], object], beat: int) -> LitImage:
    """The picture of a row of a feature."""
    ink = kit.GlowCanvas(480, 340).set_transform(240, 170)
    sketch(ink, beat)
    return LitImage(ink.lit(0.9), (-240, -170))


@cached
def _robot() -> Sprite:
    return seat_robot(1, -0.6, 1.8)


@cached
def _burst(strength: int, stage: int) -> LitImage:
    ink = kit.GlowCanvas(400, 400).set_transform(200, 200)
    fade = (1.0 - stage / 6) * (0.25, 0.6, 1.0)[strength]
    for i in range(12):
        c, s = math.cos(i * math.tau / 12 + 0.2), math.sin(i * math.tau / 12 + 0.2)
        near, far = 96 + 8 * stage, 112 + (4 + 8 * strength) + 10 * stage
        ink.line([(near * c, near * s), (far * c, far * s)], kit.dim(kit.FOCUS, fade), kit.LINE)
    return LitImage(ink.lit(0.5 + 0.5 * strength), (-200, -200))


@cached
def _speaker(loud: int, wave: int) -> LitImage:
    ink = kit.GlowCanvas(400, 320).set_transform(200, 160)
    ink.line([(-92, -26), (-56, -26), (-10, -68), (-10, 68), (-56, 26), (-92, 26)], kit.FOCUS, kit.LINE, True)
    reach = (loud + 3) // 4  # number of waves lit, of three
    for i, r in enumerate((46, 82, 118)):
        lit = i < reach
        bright = 1.0 if wave == i or wave == 3 else 0.7
        ink.arc(-10, 0, r, -0.62, 0.62, kit.dim(kit.FOCUS, bright) if lit else kit.STEEL, kit.LINE)
    return LitImage(ink.lit(1.0), (-200, -160))


@cached
def _note(loud: int, beat: int) -> LitImage:
    """Bouncing bars, as high as the music volume."""
    ink = kit.GlowCanvas(440, 320).set_transform(220, 160)
    for i in range(8):
        share = 0.35 + 0.65 * abs(math.sin(1.7 * i + beat * math.pi / 4))
        cells = round(6 * share * (loud / 10)) if loud else 0
        for j in range(6):
            box = kit.cut_box(-166 + 42 * i, 74 - 30 * j, 30, 22, 5)
            if j < cells:
                ink.fill(box, kit.FOCUS)
            else:
                ink.line(box, kit.dim(kit.STEEL, 0.7), kit.HAIR, True)
    return LitImage(ink.lit(0.7), (-220, -160))


@cached
def _drawn(name: str, chosen: int, beat: int) -> LitImage:
    ink = kit.GlowCanvas(480, 340).set_transform(240, 170)
    if name == "language":
        for i, code in enumerate((LANGUAGES[chosen], LANGUAGES[(chosen + 1) % len(LANGUAGES)])):
            lit: kit.Color = kit.STEEL if i else kit.FOCUS
            x, y = (-88, -40) if i == 0 else (72, 40)
            _bubble(ink, x, y, -1 if i == 0 else 1, lit)
            ink.text(code.upper(), kit.LABEL, x, y, lit, "head", "c")
    elif name in ("display", "fullscreen", "picture"):
        _monitor(ink, name == "picture" or (name == "fullscreen" and bool(chosen)), beat)
    elif name == "controls":
        kit.icon(ink, "pad", 0, 10, 130, kit.FOCUS, kit.LINE)
        if beat:
            ink.disc(0.44 * 130, 10 - 0.28 * 130, 12, kit.ICE)
    elif name == "rumble":
        kit.icon(ink, "pad", 0, 10, 110, kit.FOCUS, kit.LINE)
        for side in (-1, 1):
            for i, reach in enumerate((142, 172)):
                half = 0.5 - 0.1 * i
                start = (math.pi if side < 0 else 0.0) - half
                ink.arc(0, 10, reach, start, start + 2 * half, kit.ICE if chosen else kit.dim(kit.STEEL, 0.7), kit.LINE)
    elif name in ("ease", "calm"):
        ink.arc(0, 96, 190, 1.5 * math.pi - 0.82, 1.5 * math.pi + 0.82, kit.ICE, kit.LINE)  # an eye
        ink.arc(0, -96, 190, 0.5 * math.pi - 0.82, 0.5 * math.pi + 0.82, kit.ICE, kit.LINE)
        ink.ring(0, 0, 46, kit.FOCUS, kit.LINE)
        ink.disc(0, 0, 20, kit.FOCUS if name == "ease" or not chosen else kit.STEEL)
    elif name == "large":
        ink.text("A", 2 * kit.LABEL, -60, 24, kit.dim(kit.STEEL, 0.9) if chosen else kit.FOCUS, "head", "c")
        ink.text("A", 4 * kit.LABEL, 70, 0, kit.FOCUS if chosen else kit.dim(kit.STEEL, 0.9), "head", "c")
    elif name in ("games", "added"):
        for i, (x, y) in enumerate(((-110, -62), (10, -62), (-110, 22), (10, 22))):
            last = i == 3 and (beat or name == "games")
            ink.line(kit.cut_box(x, y, 100, 68, 12), kit.FOCUS if last else kit.STEEL, kit.LINE, True)
        kit.icon(ink, "plus", 60, 56, 20, kit.FOCUS, kit.LINE)
    elif name == "reset":
        kit.icon(ink, "crown", 0, 0, 96, kit.FOCUS, kit.LINE)
        ink.line([(-120, 96), (120, -96)], kit.ICE, kit.LINE)
    elif name == "close":
        ink.arc(0, 6, 84, -math.pi / 2 + 0.5, 1.5 * math.pi - 0.5, kit.FOCUS, kit.LINE)
        ink.line([(0, -110), (0, -10)], kit.FOCUS, kit.LINE)
    else:
        raise KeyError(name)
    return LitImage(ink.lit(0.9), (-240, -170))


def _bubble(ink: kit.GlowCanvas, x: float, y: float, side: int, color: kit.Color) -> None:
    w, h = 150, 96
    ink.line(kit.cut_box(x - w / 2, y - h / 2, w, h, 16), color, kit.LINE, True)
    ink.line([(x + side * 30, y + h / 2), (x + side * 56, y + h / 2 + 30), (x + side * 56, y + h / 2)], color, kit.LINE)


def _monitor(ink: kit.GlowCanvas, full: bool, beat: int) -> None:
    ink.line(kit.cut_box(-150, -104, 300, 184, 16), kit.ICE, kit.LINE, True)
    ink.line([(-60, 120), (60, 120)], kit.ICE, kit.LINE).line([(0, 80), (0, 120)], kit.ICE, kit.LINE)
    w, h = (264, 148) if full else (150, 84)
    ink.line(kit.cut_box(-w / 2, -12 - h / 2, w, h, 10), kit.FOCUS, kit.LINE if beat else kit.THIN, True)
