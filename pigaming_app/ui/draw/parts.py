"""Small shared parts: badges, buttons, hints, panels and focus brackets."""

from collections.abc import Sequence

from pigaming_app.ui.draw import theme
from pigaming_app.ui.draw.glow import GlowCanvas, LayeredCanvas
from pigaming_app.ui.draw.icons import icon

ARROWS = {"↑": "up", "↓": "down", "←": "left", "→": "right"}  # missing from our fonts
KEYPAD = "keypad"  # stands for the keys that steer on it
SIGNS = {
    **ARROWS,
    **{"Cross": "cross", "Circle": "circle", "Square": "square", "Triangle": "triangle"},  # PlayStation's
    KEYPAD: "keypad",
}


def badge(ink: GlowCanvas, player: int, x: float, y: float, r: float = 32, color: theme.Color | None = None) -> None:
    """Shape and number of seat 0..3, always together and upright."""
    color = color or theme.PLAYERS[player]
    low, size = (0.16, 1.14) if player == 1 else (0.0, 1.3)  # the triangle sits lower and has a smaller number
    points = [(x + py, y + r * low - px) for px, py in theme.shape_points(player, r)]
    ink.fill(points, color).line(points, theme.mix(color, theme.WHITE, 0.35), max(2, r * 0.09), True)
    ink.text(str(player + 1), round(r * size), x, y + r * low * 1.75, theme.BLACK, "hero", "c")


def button_width(label: str, size: int = theme.BODY) -> float:
    """Width of a button, px. "<>" is drawn as two arrows; keys of SIGNS are drawn as icons."""
    if len(label) == 1 or label in SIGNS:
        return 60
    return 104 if label == "<>" else max(60, theme.text_width(label, size) + 36)


def button(
    canvas: LayeredCanvas, x: float, y: float, label: str, color: theme.Color = theme.ICE, size: int = theme.BODY
) -> float:
    """Draw a pad button or key with the label printed on the device, from its left edge x. Returns its width."""
    w, r = button_width(label, size), 30
    if label in ARROWS or label == KEYPAD or w != 60:
        canvas.glow.line(theme.cut_box(x, y - r + 2, w, 2 * r - 4, 10), color, theme.THIN, True)
    else:
        canvas.glow.ring(x + r, y, r - 2, color, theme.THIN)
    if label == "<>":
        icon(canvas.crisp, "left", x + 30, y, 15, color, 5)
        icon(canvas.crisp, "right", x + w - 30, y, 15, color, 5)
    elif label in SIGNS:
        icon(canvas.crisp, SIGNS[label], x + w / 2, y, 16, color, 5)
    else:
        canvas.crisp.text(label, size, x + w / 2, y, color, "head", "c")
    return w


def prompt_size(prompts: Sequence[tuple[str, str]], room: float, gap: float = 0.0) -> int:
    """The largest type size up to BODY, px, at which buttons with their texts, `gap` px apart, fit `room` px."""
    for size in range(theme.BODY, 28, -2):
        widths = [button_width(label, size) + 18 + theme.text_width(what, size, "body") for label, what in prompts]
        if sum(widths) + gap * (len(widths) - 1) <= room:
            return size
    return 28


def hints(canvas: LayeredCanvas, items: Sequence[tuple[str, str]], y: float = 980, gap: float = 56) -> None:
    """A centred row of (button label, action text)."""
    widths = [button_width(label) + 18 + theme.text_width(what, theme.BODY, "body") for label, what in items]
    x = (1920 - sum(widths) - gap * (len(items) - 1)) / 2
    for (label, what), w in zip(items, widths, strict=True):
        canvas.body(what, x + button(canvas, x, y, label) + 18, y, theme.MIST)
        x += w + gap


def panel(
    ink: GlowCanvas,
    x: float,
    y: float,
    w: float,
    h: float,
    color: theme.Color = theme.STEEL,
    width: float = theme.THIN,
    c: float = 20,
) -> None:
    """An outlined box with cut corners that hides the background."""
    ink.solid(theme.cut_box(x, y, w, h, c)).line(theme.cut_box(x, y, w, h, c), color, width, True)


def brackets(
    ink: GlowCanvas,
    x: float,
    y: float,
    w: float,
    h: float,
    color: theme.Color = theme.FOCUS,
    arm: float = 48,
    c: float = 20,
    width: float = theme.BOLD,
    out: float = 0,
) -> None:
    """Four corner brackets round a box, `out` px outside it, so that focus is not shown by colour alone."""
    x, y, w, h = x - out, y - out, w + 2 * out, h + 2 * out
    for sx, sy, px, py in ((1, 1, x, y), (-1, 1, x + w, y), (-1, -1, x + w, y + h), (1, -1, x, y + h)):
        corner = [(px, py + sy * (c + arm)), (px, py + sy * c), (px + sx * c, py), (px + sx * (c + arm), py)]
        ink.neon(corner, color, width)
