"""Cards of the gallery: the picture of an arena and its name."""

import pygame

from pigaming_app.games.drawing.values import Drawing
from pigaming_app.scenes.editor.icons import draw_icon
from pigaming_app.scenes.editor.model.shapes import Paper, Tools
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import BODY, FOCUS, ICE, MIST, STEEL, THIN, GlowCanvas, cut_box, dim
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_text, span
from pigaming_app.ui.draw.surface_cache import cached

COLUMNS, ROWS = 4, 2
W, H = span(0, 3)[1], 332  # px
TOP, PITCH = 212, 372  # px
PICTURE = pygame.Rect(16, 14, W - 32, 240)
NAME_Y = H - 38
SIGN = 22  # px


def card_box(i: int) -> pygame.Rect:
    """Rectangle of the i-th card of a page."""
    return pygame.Rect(span(3 * (i % COLUMNS), 3)[0], TOP + i // COLUMNS * PITCH, W, H)


@cached
@resumable
def card(name: str, sign: str, own: bool, hot: bool) -> Steps[LitImage]:
    """The frame and the name of an arena, with a sign beside it; top left at (0, 0)."""
    layer = Layer(0, 0, W, H)
    layer.glow.line(cut_box(0, 0, W, H, 16), ICE if hot else STEEL, THIN, True)
    room = W - 48 - (2 * SIGN + 16 if sign else 0)
    line, size = fit_text(name, BODY, room)
    layer.canvas.text(line, size, 24, NAME_Y, FOCUS if hot else ICE if own else MIST)
    if sign:
        draw_icon(layer.glow, sign, W - 24 - SIGN, NAME_Y, SIGN, FOCUS)
    yield
    return (yield from layer.render_steps())


@cached
@resumable
def big_sign(sign: str) -> Steps[LitImage]:
    """A picture in place of that of an arena; top left at (0, 0)."""
    layer = Layer(*PICTURE)
    draw_icon(layer.glow, sign, PICTURE.centerx, PICTURE.centery, 64, FOCUS)
    yield
    return (yield from layer.render_steps())


@cached
@resumable
def picture(tools: Tools, drawing: Drawing, w: int, h: int) -> Steps[LitImage]:
    """A drawing in w x h px, playable or not; top left at (0, 0)."""
    k = min(w / (WIDTH + 40), h / (HEIGHT + 40))
    ink = GlowCanvas(w, h, 3)
    paper = Paper(ink, (w - k * WIDTH) / 2, (h - k * HEIGHT) / 2, k)
    paper.flat().line(cut_box(0, 0, WIDTH, HEIGHT, 28), dim(MIST, 0.7), 2 / k, True)
    yield
    yield from tools.draw_ground(paper, drawing)
    yield
    for item in tools.items(drawing):
        if not (shape := tools.shapes[item.kind]).is_handle:
            shape.draw(paper, tools.part(drawing, item), item.k)
            yield
    image = yield from ink.lit_steps(0.6)
    return LitImage(image, (0, 0))
