"""Panels of the brain overlay, in place of the HUD: action, reason and wishes of the AI.

Left: the robot, its action and the reason. Right: a bar for every wish, the chosen one in white, and the stick; brains
that choose among moves show a value per move instead. Networks show how much each topic matters, and beside it, for
every part of the action, the probabilities of the choices.
"""

from collections.abc import Mapping, Sequence

import pygame

from pigaming_app.ai.brain.thoughts import MoveKey
from pigaming_app.games.registry import OURS
from pigaming_app.scenes.brain.rose import tone
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import fit_size, word
from pigaming_app.ui.draw.sprites import Batch, Sprite, put, trim
from pigaming_app.ui.draw.surface_cache import cached

Y, H, EDGE = 24, 106, 24  # px: top and height of both boxes, margin of their sprites
TEXT = 104  # px from the left edge of a box to its texts
BAR_W, BAR_H, PITCH, LEAST_GAP = 36, 48, 72, 14  # px
CHOICE_W, CHOICE_PITCH = 7, 12  # px: bars of choices
HEAD_W, HEAD_GAP, DIVIDED = 38, 8, 20  # px: least width of a head; between heads; round the line before them
TOP, SIGN_Y = 10, 83  # px from a box's top to its bars and to the middle of their signs
CELL, GAP = 28, 30  # px: size of a stick cell; gap between stick and sign
LEVELS = 10  # colour levels of a cell in each direction
CRATES = {"raw": 0, "half": 1, "done": 2, "damaged": 3, "load": 1}  # signs that are crates
PAIRS = {"others": ("ai", "ai"), "drive": ("up", "down"), "turn": ("left", "right")}  # signs of two icons
SIGNS = {
    "cover": "shield", "attack": "faster", "fire": "shoot", "dodge": "ricochet", "free": "turn_left",
    "collect": "plus", "left": "left", "line": "up", "right": "right", "brake": "stay", "turbo": "fastest",
    "back": "behind", "put": "down", "wait": "clock",
    "swing": "turn_right",
    "near": "ai", "bullets": "ricochet", "mines": "mine", "pickups": "plus", "self": "shield", "score": "crown",
    "target": "circle", "choices": "unknown", "machines": "mine", "people": "triangle", "course": "ahead", "oil": "oil",
    "pads": "faster", "shoot": "shoot", "fork": "plus", "item": "square",
}  # fmt: skip


def blank(screen: pygame.Surface, left: int, right: int) -> None:
    """Clear the HUD between two x coordinates of the canvas."""
    screen.fill(kit.BLACK, (left, 0, right - left, Y + H + 4))


def draw_words(screen: pygame.Surface, x: int, w: int, seat: int, doing: str, because: str) -> None:
    """The left box."""
    put_on(screen, box(seat, w, True), x, Y)
    lines(screen, x + TEXT, w - TEXT - 20, doing, because)


def draw_wishes(
    screen: pygame.Surface,
    x: int,
    w: int,
    seat: int,
    wishes: Mapping[str, float],
    chosen: object,
    signs: Mapping[str, str],
    aside: float = 200.0,
) -> None:
    """The right box of a brain with wishes: one bar each; `aside`: px kept free at its right end.

    `signs`: see GameScreens.
    """
    put_on(screen, box(seat, w, False), x, Y)
    light: Batch = []
    room = w - 24 - aside
    pitch = min(PITCH, room / max(1, len(wishes)))
    left = x + 24 + (room - pitch * len(wishes)) / 2
    width = BAR_W if pitch > BAR_W + LEAST_GAP else round(pitch - LEAST_GAP)
    for i, (name, value) in enumerate(wishes.items()):
        at = left + pitch * (i + 0.5)
        draw_bar(screen, light, at, seat, value, name == chosen, width)
        put(light, sign(signs.get(name, name), kit.WHITE if name == chosen else kit.MIST), at, Y + SIGN_Y)
    screen.fblits(light, pygame.BLEND_RGB_ADD)


def draw_bar(screen: pygame.Surface, light: Batch, x: float, seat: int, value: float, chosen: bool, w: int) -> None:
    """A bar round x, filled to `value`, 0..1."""
    put(light, bar(seat, chosen, False, w), x, Y + TOP)
    if tall := round(BAR_H * min(1.0, max(0.0, value))):
        image, dx, dy = bar(seat, chosen, True, w)
        hidden = EDGE + BAR_H - tall
        area = 0, hidden, image.get_width(), tall + EDGE
        screen.blit(image, (x + dx, Y + TOP + dy + hidden), area, special_flags=pygame.BLEND_RGB_ADD)


def draw_heads(
    screen: pygame.Surface,
    right: float,
    seat: int,
    heads: Mapping[str, Sequence[float]],
    choices: Mapping[str, int],
    signs: Mapping[str, str],
) -> None:
    """Probabilities of the choices at the right end of that box, the chosen ones in white; of buttons, of a press."""
    light: Batch = []
    x = right - heads_width(heads) + DIVIDED
    put(light, divider(seat), x - DIVIDED / 2, Y)
    for name, chances in heads.items():
        shown, first = (chances[1:], 1) if len(chances) == 2 else (chances, 0)
        w = head_width(chances)
        left = x + (w - CHOICE_PITCH * (len(shown) - 1)) / 2
        for i, chance in enumerate(shown):
            draw_bar(screen, light, left + CHOICE_PITCH * i, seat, chance, choices[name] == first + i, CHOICE_W)
        put(light, sign(signs.get(name, name), kit.MIST), x + w / 2, Y + SIGN_Y)
        x += w + HEAD_GAP
    screen.fblits(light, pygame.BLEND_RGB_ADD)


def heads_width(heads: Mapping[str, Sequence[float]]) -> float:
    """Width of the probabilities of all choices, with their margins, px."""
    return DIVIDED + sum(head_width(chances) + HEAD_GAP for chances in heads.values()) + 8


def head_width(chances: Sequence[float]) -> float:
    """Width of one head, px."""
    return max(HEAD_W, CHOICE_PITCH * (len(chances) if len(chances) > 2 else 1))


def draw_held(screen: pygame.Surface, right: int, seat: int, held: MoveKey, buttons: Sequence[tuple[str, int]]) -> None:
    """Stick and buttons at the right end of that box; `right` is its x."""
    light: Batch = []
    stick(light, right - 128, Y + H / 2, {}, held, kit.PLAYERS[seat])
    for i, (name, down) in enumerate(buttons):
        y = Y + H / 2 + 44 * (i - (len(buttons) - 1) / 2)
        put(light, sign(name, kit.WHITE if down else kit.dim(kit.MIST, 0.35)), right - 46, y)
    screen.fblits(light, pygame.BLEND_RGB_ADD)


def draw_moves(
    screen: pygame.Surface,
    x: int,
    w: int,
    seat: int,
    moves: Mapping[MoveKey, float],
    chosen: object,
    sure: Sequence[str],
) -> None:
    """The right box of a brain that chooses among moves: values without and with fire, and the confidence `sure`."""
    put_on(screen, box(seat, w, False), x, Y)
    light: Batch = []
    for fire, at in ((0, x + 84), (1, x + 228)):
        values = {
            (linear, angular): value for (linear, angular, with_fire), value in moves.items() if with_fire == fire
        }
        held = chosen if isinstance(chosen, tuple) and chosen[2] == fire else None
        stick(light, at, Y + H / 2, values, held, kit.PLAYERS[seat])
        if fire:
            put(light, sign("fire", kit.WHITE if held else kit.dim(kit.MIST, 0.5)), at + 76, Y + H / 2)
    screen.fblits(light, pygame.BLEND_RGB_ADD)
    lines(screen, x + 360, w - 380, *sure)


def lines(screen: pygame.Surface, x: float, room: float, title: str, text: str) -> None:
    """A title and a smaller line below it, starting at x."""
    for line, size, face, color, y in (
        (title, kit.LABEL, "head", kit.WHITE, 34),
        (text, kit.BODY, "body", kit.MIST, 80),
    ):
        if line:
            size = fit_size(line, size, room, face)
            lit = word(line, size, color, face, 0.35 if face == "head" else 0.0)
            lit.draw(screen, x + kit.text_width(line, size, face) / 2, Y + y)


def stick(
    light: Batch, x: float, y: float, values: Mapping[tuple[int, int], float], held: MoveKey | None, color: kit.Color
) -> None:
    """Nine cells round (x, y), ahead is up. `values`: -1..1 per cell; the held one has a white edge."""
    for linear in (1, 0, -1):
        for angular in (-1, 0, 1):
            here = held is not None and held[:2] == (linear, angular)
            level = round(LEVELS * values.get((linear, angular), 0.0))
            fill = tone(level) if level else color if here and not values else (34, 42, 54)
            put(light, cell(fill, here), x + angular * CELL, y - linear * CELL)


# ---- sprites


def put_on(screen: pygame.Surface, image: pygame.Surface, x: float, y: float) -> None:
    """Add a box whose corner, without its margin, is at (x, y)."""
    screen.blit(image, (x - EDGE, y - EDGE), special_flags=pygame.BLEND_RGB_ADD)


@cached
def box(seat: int, w: int, named: bool) -> pygame.Surface:
    """The outline of a box; `named`: with the robot's badge and the AI sign."""
    ink, color = kit.GlowCanvas(w + 2 * EDGE, H + 2 * EDGE).set_transform(EDGE, EDGE), kit.PLAYERS[seat]
    ink.line(kit.cut_box(0, 0, w, H), color, kit.THIN, True)
    if named:
        kit.badge(ink, seat, 52, 36, 24)
        kit.icon(ink, "ai", 52, 82, 20, kit.mix(color, kit.WHITE, 0.5), 3)
    return ink.lit(0.7)


@cached
def bar(seat: int, chosen: bool, full: bool, w: int) -> Sprite:
    """A bar `w` px wide, full or empty, anchored at the middle of its top."""
    ink = kit.GlowCanvas(w + 2 * EDGE, BAR_H + 2 * EDGE).set_transform(EDGE + w / 2, EDGE)
    outline = kit.cut_box(-w / 2, 0, w, BAR_H, min(6, w / 4))
    color = kit.WHITE if chosen else kit.dim(kit.PLAYERS[seat], 0.75)
    if full:
        ink.fill(outline, color)
        return Sprite(ink.lit(0.5), -EDGE - w // 2, -EDGE)
    ink.line(outline, kit.ICE if chosen else kit.dim(color, 0.5), kit.LINE - 3, True)
    return Sprite(ink.plain(), -EDGE - w // 2, -EDGE)


@cached
def divider(seat: int) -> Sprite:
    """The line between two parts of a box, anchored at its upper edge."""
    ink = kit.GlowCanvas(2 * EDGE, H + 2 * EDGE).set_transform(EDGE, EDGE)
    ink.line([(0, 14), (0, H - 14)], kit.dim(kit.PLAYERS[seat], 0.5), kit.THIN)
    return Sprite(ink.plain(), -EDGE, -EDGE)


@cached
def sign(name: str, color: kit.Color) -> Sprite:
    """The sign of a wish: an icon, or a crate's state. A circle for what is unknown: plug-ins name their own wishes."""
    ink = kit.GlowCanvas(96, 96, 3).set_transform(48, 48)
    if name in CRATES and "factory" in OURS:
        from pigaming_app.scenes.views.sprites.factory import state_icon

        state_icon(ink, CRATES[name], 0, 0, 17, color)
    elif name in PAIRS:
        for side, part in zip((-1, 1), PAIRS[name], strict=True):
            dx, dy = (0, 10 * side) if name == "drive" else (10 * side, 0)
            kit.icon(ink, part, dx, dy, 10, color, 4)
    elif name == "walls":
        ink.line(kit.cut_box(-19, -6, 38, 12, 4), color, 4, True)
    else:
        kit.icon(ink, SIGNS.get(name, name if name in kit.ICONS else "circle"), 0, 0, 18, color, 5)
    return trim(ink.lit(0.4), 48, 48)


@cached
def cell(fill: kit.Color, held: bool) -> Sprite:
    """One cell of a stick."""
    half = CELL / 2 - 2
    ink = kit.GlowCanvas(64, 64, 3).set_transform(32, 32)
    ink.fill(kit.cut_box(-half, -half, 2 * half, 2 * half, 5), fill)
    if held:
        ink.line(kit.cut_box(-half - 1, -half - 1, 2 * half + 2, 2 * half + 2, 5), kit.WHITE, kit.THIN, True)
    return trim(ink.lit(0.4), 32, 32)
