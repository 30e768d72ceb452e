"""Icons for faults of real robots: camera, radio, battery, stop button, robot."""

import math
from collections.abc import Callable

from pigaming_app.hardware.control.safety import REMOTE
from pigaming_app.ui.draw import LINE, Color, GlowCanvas, cut_box, regular_polygon

Draw = Callable[[GlowCanvas, float, float, float, Color], None]


def sign(ink: GlowCanvas, name: str, x: float, y: float, r: float, color: Color) -> None:
    """Icon of a fault category, `r` px to each side of (x, y)."""
    SIGNS.get(name, _robot)(ink, x, y, r, color)


def _camera(ink: GlowCanvas, x: float, y: float, r: float, color: Color) -> None:
    ink.line(cut_box(x - r, y - 0.5 * r, 1.5 * r, r, 12), color, LINE, True).ring(
        x - 0.25 * r, y, 0.28 * r, color, LINE
    )
    ink.line(
        [(x + 0.5 * r, y - 0.1 * r), (x + r, y - 0.4 * r), (x + r, y + 0.4 * r), (x + 0.5 * r, y + 0.1 * r)], color
    )


def _radio(ink: GlowCanvas, x: float, y: float, r: float, color: Color) -> None:
    ink.line([(x, y - 0.2 * r), (x, y + r)], color, LINE).disc(x, y - 0.2 * r, 0.12 * r, color)
    for reach in (0.45, 0.8):
        for side in (0.0, math.pi):
            ink.arc(x, y - 0.2 * r, reach * r, side - 0.7, side + 0.7, color, LINE)


def _battery(ink: GlowCanvas, x: float, y: float, r: float, color: Color) -> None:
    ink.line(cut_box(x - r, y - 0.5 * r, 1.8 * r, r, 10), color, LINE, True)
    ink.line([(x + r, y - 0.2 * r), (x + r, y + 0.2 * r)], color, 2 * LINE)
    ink.line([(x - 0.7 * r, y - 0.22 * r), (x - 0.7 * r, y + 0.22 * r)], color, 2 * LINE)


def _stop(ink: GlowCanvas, x: float, y: float, r: float, color: Color) -> None:
    turned = [
        (x + px * math.cos(math.pi / 8) - py * math.sin(math.pi / 8), y + px * math.sin(math.pi / 8) + py * 0.924)
        for px, py in regular_polygon(8, r)
    ]
    ink.line(turned, color, LINE, True).line([(x - 0.45 * r, y), (x + 0.45 * r, y)], color, 2 * LINE)


def _robot(ink: GlowCanvas, x: float, y: float, r: float, color: Color) -> None:
    ink.ring(x, y, 0.75 * r, color, LINE)
    for side in (-1, 1):
        ink.line([(x + side * 0.95 * r, y - 0.3 * r), (x + side * 0.95 * r, y + 0.3 * r)], color, 2 * LINE)
    ink.line([(x - 0.3 * r, y - 0.05 * r), (x, y - 0.4 * r), (x + 0.3 * r, y - 0.05 * r)], color, LINE)


def _crossed_eye(ink: GlowCanvas, x: float, y: float, r: float, color: Color) -> None:
    ink.arc(x, y + 0.75 * r, 1.25 * r, -2.5, -0.64, color, LINE).arc(x, y - 0.75 * r, 1.25 * r, 0.64, 2.5, color, LINE)
    ink.ring(x, y, 0.3 * r, color, LINE).line([(x - 0.8 * r, y + 0.8 * r), (x + 0.8 * r, y - 0.8 * r)], color, LINE)


SIGNS: dict[str, Draw] = {
    **dict.fromkeys(("camera", "drift", "drifts"), _camera),
    **dict.fromkeys(("lost", "held", "twice"), _crossed_eye),
    **dict.fromkeys(("radio", "silent", "old", "no_arena", "foreign", "key", "deadman", *REMOTE.values()), _radio),
    **dict.fromkeys(("empty", "low"), _battery),
    "stopped": _stop,
}
