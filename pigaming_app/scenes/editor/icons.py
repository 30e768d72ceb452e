"""Pictures of the tools, on a 2 x 2 square as those of `ui.draw.icons`."""

import math
from collections.abc import Callable, Iterator, Mapping
from functools import partial

from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.ui.draw import ICONS, Color, GlowCanvas, cut_box, dim
from pigaming_app.ui.draw.pen import Icon, Pen, dot, line, together

CELLS = 5


def draw_icon(ink: GlowCanvas, name: str, x: float, y: float, r: float, color: Color, value: str = "") -> None:
    """Draw a picture round (x, y), `r` px to each side; `value`: what it shows, such as the health of a wall."""
    pen = Pen(ink, x, y, r, color, max(3.0, r * 0.12))
    if name in VALUED:
        VALUED[name](pen, value)
    else:
        next(pictures[name] for pictures in (PICTURES, ICONS, *_of_games()) if name in pictures)(pen)


def _of_games() -> Iterator[Mapping[str, Icon]]:
    return (tools.pictures for tools in EDITORS.values())


def _wall(pen: Pen) -> None:
    pen.line(*cut_box(-1.1, -0.32, 2.2, 0.64, 0.16), closed=True)
    for k in range(3):
        pen.fill(*cut_box(-0.86 + 0.6 * k, -0.14, 0.5, 0.28, 0.06))


def _rock(pen: Pen) -> None:
    pen.line(*cut_box(-0.8, -0.8, 1.6, 1.6, 0.4), closed=True)
    for a, b in ((-0.2, 0.5), (-0.5, 0.2), (-0.5, 0.5)):
        pen.line((a, b), (a + 0.7, b - 0.7))


def _mud(pen: Pen) -> None:
    for r in (1.0, 0.5):
        pen.line(*((r * math.cos(a / 10), 0.7 * r * math.sin(a / 10)) for a in range(0, 63, 3)), closed=True)
    pen.dot(0, 0, 0.13)


def _turn(pen: Pen) -> None:
    arc = [(0.78 * math.cos(a / 10), 0.78 * math.sin(a / 10)) for a in range(-8, 36, 2)]
    pen.line(*arc)
    x, y = arc[-1]
    pen.fill((x - 0.36, y + 0.02), (x + 0.36, y + 0.02), (x, y - 0.5))


def _size(pen: Pen) -> None:
    pen.line((-0.8, 0.8), (0.8, -0.8))
    for s in (1, -1):
        pen.line((s * 0.2, -s * 0.85), (s * 0.85, -s * 0.85), (s * 0.85, -s * 0.2))


def _thick(pen: Pen, value: str) -> None:
    """A bar between two arrows; `value`: its thickness."""
    half = min(0.5, float(value or 30) / 200)
    pen.fill((-1.0, -half), (1.0, -half), (1.0, half), (-1.0, half))
    for s in (1, -1):
        pen.line((-0.28, s * 1.05), (0.0, s * (half + 0.2)), (0.28, s * 1.05))


def _health(pen: Pen, value: str) -> None:
    """Cells, as many lit as bullets are needed; a solid wall is hatched."""
    pen.line(*cut_box(-1.15, -0.4, 2.3, 0.8, 0.16), closed=True)
    if value == "-1":
        for k in range(6):
            pen.line((-0.95 + 0.34 * k, 0.24), (-0.75 + 0.34 * k, -0.24))
        return
    for k in range(CELLS):
        left = -1.0 + 0.41 * k
        box = cut_box(left, -0.24, 0.32, 0.48, 0.06)
        if k < int(value or 0):
            pen.fill(*box)
        else:
            pen.ink.line(pen.at(box), dim(pen.color, 0.4), pen.w * 0.5, True)


def _delete(pen: Pen) -> None:
    pen.line((-0.85, -0.6), (0.85, -0.6))
    pen.line((-0.3, -0.6), (-0.3, -0.95), (0.3, -0.95), (0.3, -0.6))
    pen.line((-0.65, -0.6), (-0.5, 0.95), (0.5, 0.95), (0.65, -0.6))
    for x in (-0.2, 0.2):
        pen.line((x, -0.2), (x, 0.55))


def _undo(pen: Pen, side: float = 1.0) -> None:
    arc = [(side * (0.15 + 0.65 * math.cos(a / 10)), 0.2 + 0.55 * math.sin(a / 10)) for a in range(-16, 17, 2)]
    pen.line((side * -0.6, -0.36), *arc, (side * -0.45, 0.74))
    pen.fill((side * -1.0, -0.36), (side * -0.45, -0.82), (side * -0.45, 0.1))


def _grid(pen: Pen, value: str) -> None:
    """A magnet between dots of a grid; without it, dots alone."""
    for x in (-0.9, 0.0, 0.9):
        for y in (-0.9, 0.0, 0.9):
            pen.dot(x, y, 0.11)
    if value:
        pen.ring(0.34)
        for x, y in ((0, -1), (0, 1), (-1, 0), (1, 0)):
            pen.line((0.34 * x, 0.34 * y), (0.62 * x, 0.62 * y))


def _mirror(pen: Pen, value: str) -> None:
    """A shape and its images; `value`: the name of the symmetry."""
    shown = {
        "OFF": ((1, 1),),
        "ACROSS": ((1, 1), (-1, 1)),
        "TURN": ((1, 1), (-1, -1)),
        "FOUR": ((1, 1), (-1, 1), (1, -1), (-1, -1)),
    }[value]
    for sx, sy in ((1, 1), (-1, 1), (1, -1), (-1, -1)):
        points = ((-0.22 * sx, -0.2 * sy), (-0.95 * sx, -0.2 * sy), (-0.22 * sx, -0.95 * sy))
        if (sx, sy) in shown:
            pen.fill(*points)
        else:
            pen.ink.line(pen.at(points), dim(pen.color, 0.35), pen.w * 0.5, True)
    if value in ("ACROSS", "FOUR"):
        pen.line((0, -1.05), (0, 1.05))
    if value == "FOUR":
        pen.line((-1.05, 0), (1.05, 0))


def _dice(pen: Pen) -> None:
    pen.line(*cut_box(-0.85, -0.85, 1.7, 1.7, 0.2), closed=True)
    for x, y in ((-0.4, -0.4), (0.4, -0.4), (0, 0), (-0.4, 0.4), (0.4, 0.4)):
        pen.dot(x, y, 0.15)


def _worker(pen: Pen) -> None:
    """A person who changes sides."""
    pen.dot(0, -0.62, 0.26)
    pen.line((0, -0.3), (0, 0.3), (-0.3, 0.95))
    pen.line((0, 0.3), (0.3, 0.95))
    for s in (1, -1):
        pen.line((s * 0.5, 0.0), (s * 1.0, 0.0))
        pen.line((s * 0.75, -0.25), (s * 1.0, 0.0), (s * 0.75, 0.25))


def _slot(pen: Pen) -> None:
    for x, y in ((1, 1), (-1, 1), (1, -1), (-1, -1)):
        pen.line((x * 0.9, y * 0.35), (x * 0.9, y * 0.9), (x * 0.35, y * 0.9))


PICTURES: dict[str, Icon] = {
    "wall": _wall,
    "rock": _rock,
    "mud": _mud,
    "turn": _turn,
    "size": _size,
    "copy": together(
        line((-0.9, 0.35), (-0.9, -0.9), (0.35, -0.9)),
        line((-0.4, -0.4), (0.9, -0.4), (0.9, 0.9), (-0.4, 0.9), closed=True),
    ),
    "delete": _delete,
    "undo": _undo,
    "redo": partial(_undo, side=-1.0),
    "save": together(
        line((-0.9, -0.9), (0.5, -0.9), (0.9, -0.5), (0.9, 0.9), (-0.9, 0.9), closed=True),
        line((-0.45, 0.9), (-0.45, 0.2), (0.45, 0.2), (0.45, 0.9)),
        line((-0.4, -0.9), (-0.4, -0.4), (0.3, -0.4), (0.3, -0.9)),
    ),
    "dice": _dice,
    "rename": together(  # a letter and a cursor
        line((-1.0, 0.8), (-0.4, -0.8), (0.2, 0.8)),
        line((-0.78, 0.25), (-0.02, 0.25)),
        line((0.45, -0.95), (0.95, -0.95)),
        line((0.7, -0.95), (0.7, 0.95)),
        line((0.45, 0.95), (0.95, 0.95)),
    ),
    "share": together(
        line((-0.4, -0.3), (-0.85, -0.3), (-0.85, 0.95), (0.85, 0.95), (0.85, -0.3), (0.4, -0.3)),
        line((0, 0.4), (0, -0.8)),
        line((-0.38, -0.5), (0, -0.95), (0.38, -0.5)),
    ),
    "worker": _worker,
    "shared": _slot,
    "corner": together(  # a bend with its control point
        line((-0.9, 0.9), (-0.9, -0.1), (-0.75, -0.5), (-0.5, -0.75), (-0.1, -0.9), (0.9, -0.9)),
        line((0.0, 0.9), (0.0, 0.2), (0.2, 0.0), (0.9, 0.0)),
        dot(-0.9, -0.9, 0.22),
    ),
}
VALUED: dict[str, Callable[[Pen, str], None]] = {"thick": _thick, "health": _health, "grid": _grid, "mirror": _mirror}
