"""Widgets of a lobby seat card: the player's colour, shape and number, a robot on a turntable, the driver.

Every widget is cached; the top left of a card is at (0, 0).
"""

import math
from collections.abc import Callable, Iterator
from functools import partial

from pigaming_app.scenes.views.sprites.robot import seat_robot
from pigaming_app.scenes.views.sprites.teams import TEAMS, emblem
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_lines, fit_size, wrap
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import LEVELS, dimmed
from pigaming_app.ui.widgets.player_card import MIDDLE, H, W

ROBOTS = ((236, 1.7, 106), (204, 1.25, 78), (168, 0.85, 48))  # px, centre; scale; px, turntable radius: by extra rows
REAL_Y, ROW_Y, DEVICE_Y, DRIVE_Y = 254, 316, 378, 444  # px, centres; ROW_Y: the team, or the real robot without teams
ROW_H = 60
STRENGTH = (24, 420, W - 48, 156)  # px
STARS_Y, STAR_SIZE = 470, 56  # px
PLUS_Y, OUTLINE = 256, 80  # px: centre and size of the shape on an empty seat
ASKS_Y, BUTTONS_Y, BUTTON_PITCH, GAP = 398, 502, 66, 12
SPOKES, TURNS = 5, 8  # arcs of a turntable, cached positions between two of them
UP = -math.pi / 2
UPRIGHT, GLANCE = HEADINGS * 3 // 4, 7  # heading of a waiting robot, and how far it looks to either side


@cached
@resumable
def frame(player: int, text: str, bold: bool) -> Steps[LitImage]:
    """Card of an occupied seat."""
    layer = Layer(0, 0, W, H)
    kit.panel(layer.glow, 0, 0, W, H, kit.PLAYERS[player], kit.LINE if bold else kit.THIN)
    kit.badge(layer.glow, player, 72, 76, 36)
    layer.canvas.text(text, fit_size(text, kit.LABEL, W - 160), 136, 76, kit.ICE)
    yield
    return (yield from layer.render_steps())


@cached
@resumable
def empty(player: int, text: str) -> Steps[LitImage]:
    """Card of an empty seat."""
    layer, color = Layer(0, 0, W, H), kit.PLAYERS[player]
    layer.glow.dashes(kit.cut_box(0, 0, W, H, 20), kit.dim(color, 0.6), kit.THIN, 22, 16)
    kit.badge(layer.glow, player, 72, 76, 36, kit.dim(color, 0.75))
    layer.canvas.text(text, fit_size(text, kit.LABEL, W - 160), 136, 76, kit.MIST)
    outline = [(MIDDLE + y * OUTLINE, PLUS_Y - x * OUTLINE) for x, y in kit.shape_points(player, 1)]
    layer.glow.dashes(outline, kit.dim(color, 0.7), kit.LINE, 24, 18)
    yield
    return (yield from layer.render_steps())


@cached
@resumable
def by_phone(player: int, text: str, call: str, others: str) -> Steps[LitImage]:
    """Card of an empty seat with room for a QR code: how to join by phone, and that others may join, too."""
    layer, color = Layer(0, 0, W, H), kit.PLAYERS[player]
    layer.glow.dashes(kit.cut_box(0, 0, W, H, 20), kit.dim(color, 0.6), kit.THIN, 22, 16)
    kit.badge(layer.glow, player, 72, 76, 36, kit.dim(color, 0.75))
    layer.canvas.text(text, fit_size(text, kit.LABEL, W - 160), 136, 76, kit.MIST)
    layer.canvas.text(call, fit_size(call, kit.LABEL, W - 60), MIDDLE, ASKS_Y + 132, kit.FOCUS, "head", "c")
    layer.canvas.body(others, MIDDLE, ASKS_Y + 176, kit.MIST, "c", fit_size(others, 32, W - 60, "body"))
    yield
    return (yield from layer.render_steps())


@cached
@resumable
def plug_in(player: int, text: str, call: str, others: str) -> Steps[LitImage]:
    """Card of an empty seat for which there is no device: a pad, and a phone if there are `others`; how to get them."""
    layer, color = Layer(0, 0, W, H), kit.PLAYERS[player]
    layer.glow.dashes(kit.cut_box(0, 0, W, H, 20), kit.dim(color, 0.6), kit.THIN, 22, 16)
    kit.badge(layer.glow, player, 72, 76, 36, kit.dim(color, 0.75))
    layer.canvas.text(text, fit_size(text, kit.LABEL, W - 160), 136, 76, kit.MIST)
    kit.icon(layer.glow, "pad", MIDDLE - 76 if others else MIDDLE, PLUS_Y, 66, kit.MIST, kit.THIN)
    if others:
        kit.icon(layer.glow, "phone", MIDDLE + 92, PLUS_Y, 60, kit.MIST, kit.THIN)
    yield
    layer.canvas.body(call, MIDDLE, ASKS_Y, kit.ICE, "c", fit_size(call, kit.readable(kit.BODY), W - 48, "body"))
    size, lines = fit_lines(others, W - 48, 3, (kit.readable(34), 34, 30))
    for i, line in enumerate(lines):
        layer.canvas.body(line, MIDDLE, ASKS_Y + 66 + 1.3 * size * i, kit.MIST, "c", size)
    yield
    return (yield from layer.render_steps())


@cached
def invitation(player: int, text: str, labels: tuple[str, ...], level: int) -> LitImage:
    """Prompt of an empty seat to press one of the buttons `labels`. `level` 0: another seat is filled first."""
    if 0 < level < LEVELS:
        return dimmed(invitation(player, text, labels, LEVELS), level / LEVELS)
    layer = Layer(0, 230, W, 370)
    kit.icon(
        layer.glow,
        "plus",
        MIDDLE,
        PLUS_Y,
        30,
        kit.PLAYERS[player] if level else kit.dim(kit.PLAYERS[player], 0.6),
        kit.LINE,
    )
    layer.canvas.body(
        text,
        MIDDLE,
        ASKS_Y,
        kit.ICE if level else kit.STEEL,
        "c",
        fit_size(text, kit.readable(kit.BODY), W - 48, "body"),
    )
    rows = rows_of(labels)
    for i, row in enumerate(rows):
        x = MIDDLE - (sum(map(kit.button_width, row)) + GAP * (len(row) - 1)) / 2
        y = BUTTONS_Y + BUTTON_PITCH * (i - (len(rows) - 1) / 2)
        for label in row:
            x += kit.button(layer.canvas, x, y, label, kit.FOCUS if level else kit.STEEL) + GAP
    return layer.render()


def rows_of(labels: tuple[str, ...]) -> list[list[str]]:
    """Pack button labels into as few rows as fit on a card (first fit, widest first)."""
    rows: list[list[str]] = []
    for label in sorted(labels, key=kit.button_width, reverse=True):
        room = W - 36 - kit.button_width(label) - GAP
        row = next((row for row in rows if sum(kit.button_width(other) + GAP for other in row) <= room + GAP), None)
        if row is None:
            rows.append([label])
        else:
            row.append(label)
    return [sorted(row, key=labels.index) for row in sorted(rows, key=lambda row: min(map(labels.index, row)))]


@cached
def driver(sign: str, name: str) -> LitImage:
    """Icon and name of the driver: a pad, the steering keys or an AI."""
    layer = Layer(24, DEVICE_Y - 44, W - 48, 88)
    kit.icon(layer.glow, sign, 78, DEVICE_Y, 36, kit.MIST, kit.THIN)
    marks = name.split()
    if marks and all(mark in kit.ARROWS for mark in marks):
        for i, mark in enumerate(marks):
            kit.icon(layer.glow, kit.ARROWS[mark], 154 + 52 * i, DEVICE_Y, 18, kit.ICE, kit.LINE)
    else:
        layer.canvas.body(name, 136, DEVICE_Y, kit.ICE, "l", fit_size(name, kit.readable(kit.BODY), W - 160, "body"))
    return layer.render()


@cached
def strength(text: str, stars: str, color: kit.Color | None) -> LitImage:
    """Strength of an AI, between the arrows that change it: the stars of a level, if it is one, above its name.
    `color`: of the player who has selected it, if any.
    """
    layer, room = Layer(*STRENGTH), W - 190
    layer.glow.line(kit.cut_box(*STRENGTH, 14), color or kit.STEEL, kit.THIN, True)
    if stars:
        layer.canvas.text(stars, STAR_SIZE, MIDDLE, STARS_Y, kit.ICE, "head", "c")
    lines = [text] if stars else wrap(text, kit.BODY, room)
    size = min(fit_size(line, kit.readable(kit.BODY), room) for line in lines)
    middle = 534 if stars else 498
    for i, line in enumerate(lines):
        layer.canvas.text(line, size, MIDDLE, middle + 1.2 * size * (i - (len(lines) - 1) / 2), kit.ICE, "head", "c")
    _arrows(layer, 498, color or kit.MIST, 20)
    return layer.render()


@cached
def driving(text: str, picture: str, color: kit.Color | None) -> LitImage:
    """Driving style, its picture and name. `color`: see `strength`, also for the other rows."""
    layer, x, size = choice_row(text, DRIVE_Y, color, 76)
    kit.icon(layer.glow, picture, x + 28, DRIVE_Y, 27, kit.ICE, kit.THIN)
    layer.canvas.crisp.text(text, size, x + 76, DRIVE_Y, kit.ICE, "head")
    return layer.render()


@cached
def team(text: str, number: int, color: kit.Color | None) -> LitImage:
    """Team number and team bars."""
    layer, x, size = choice_row(text, ROW_Y, color, 44)
    for i in range(number + 1):
        layer.glow.line([(x + 14 * i, ROW_Y - 17), (x + 14 * i, ROW_Y + 17)], kit.ICE, kit.LINE)
    layer.canvas.crisp.text(text, size, x + 44, ROW_Y, kit.ICE, "head")
    return layer.render()


@cached
def side(text: str, number: int, color: kit.Color | None) -> LitImage:
    """Side of the factory with its emblem and colour."""
    layer, x, size = choice_row(text, ROW_Y, color, 48)
    emblem(layer.glow, number, x + 10, ROW_Y, 24)
    layer.canvas.crisp.text(text, size, x + 48, ROW_Y, TEAMS[number], "head")
    return layer.render()


@cached
def real(text: str, on: bool, middle: int, color: kit.Color | None) -> LitImage:
    """Real or simulated robot. `middle`: y of its centre, px."""
    layer, x, size = choice_row(text, middle, color, 54, "body")
    light = kit.GREEN if on else kit.MIST
    layer.glow.ring(x + 18, middle, 18, light, kit.THIN)
    if on:
        layer.canvas.crisp.disc(x + 18, middle, 12, kit.GREY)
    layer.canvas.body(text, x + 54, middle, kit.ICE if on else kit.MIST, "l", size)
    return layer.render()


def choice_row(
    text: str, middle: int, color: kit.Color | None, sign: int, face: str = "head"
) -> tuple[Layer, float, int]:
    """Row with the arrows that change it, outlined in `color` if selected. `sign`: px for the sign before the text.
    Returns the layer, x of the sign (px) and the font size.
    """
    box = (24, middle - ROW_H / 2, W - 48, ROW_H)
    layer = Layer(*box)
    if color:
        layer.glow.line(kit.cut_box(*box, 12), color, kit.THIN, True)
    size = fit_size(text, kit.readable(kit.BODY), W - 196 - sign, face)
    _arrows(layer, middle, color or kit.STEEL, 16)
    return layer, MIDDLE - (kit.text_width(text, size, face) + sign) / 2, size


def _arrows(layer: Layer, middle: float, color: kit.Color, r: int) -> None:
    for name, x in (("left", 56), ("right", W - 56)):
        kit.icon(layer.glow, name, x, middle, r, color, kit.LINE)


@cached
@resumable
def turntable(player: int, turn: int, lit: bool, r: int) -> Steps[LitImage]:
    """Arcs around (0, 0) on a circle of `r` px, rotated by `turn` of TURNS steps towards the next arc."""
    half = r + 30
    ink = kit.GlowCanvas(2 * half, 2 * half)
    color: kit.Color = kit.dim(kit.PLAYERS[player], 0.8 if lit else 0.35)
    for i in range(SPOKES):
        start = 0.25 + (i + turn / TURNS) * math.tau / SPOKES
        ink.arc(half, half, r, start, start + 0.7, color, kit.THIN)
    yield
    return LitImage((yield from ink.lit_steps(1.0)), (-half, -half))


@cached
def robot(player: int, turn: int, scale: float) -> Sprite:
    """Robot of a seat at heading `turn` of HEADINGS."""
    return seat_robot(player, turn * math.tau / HEADINGS, scale)


def prewarm_jobs() -> Iterator[Callable[[], object]]:
    """Prewarm jobs for the larger widgets, in the order of likely use."""
    for player in range(4):
        yield partial(robot, player, UPRIGHT, ROBOTS[0][1])
        for turn in range(TURNS):
            yield partial(turntable, player, turn, False, ROBOTS[0][2])
    for off in range(1, GLANCE + 1):
        for player in range(4):
            yield partial(robot, player, UPRIGHT + off, ROBOTS[0][1])
            yield partial(robot, player, UPRIGHT - off, ROBOTS[0][1])
    for player in range(4):
        for turn in range(TURNS):
            yield partial(turntable, player, turn, True, ROBOTS[0][2])
