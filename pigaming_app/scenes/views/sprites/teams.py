"""Colours and emblems of the two teams: Ice and Fire."""

import math

from pigaming_app.ui.draw import Color, GlowCanvas, Points

TEAMS: tuple[Color, Color] = ((70, 210, 255), (255, 150, 40))


def emblem(ink: GlowCanvas, team: int, x: float, y: float, r: float) -> None:
    """Snowflake for the first team, flame for the second."""
    color = TEAMS[team]
    if team == 0:
        for k in range(6):
            a = math.tau * k / 6 + math.pi / 2
            ux, uy = math.cos(a), math.sin(a)
            ink.line([(x, y), (x + r * ux, y + r * uy)], color, r * 0.16)
            for side in (-1, 1):
                b, qx, qy = a + 0.9 * side, x + 0.55 * r * ux, y + 0.55 * r * uy
                ink.line([(qx, qy), (qx + 0.34 * r * math.cos(b), qy + 0.34 * r * math.sin(b))], color, r * 0.14)
        return
    ink.fill(flame(x, y, r), color)
    ink.fill(flame(x, y + 0.38 * r, r * 0.5), (255, 226, 130))


def flame(x: float, y: float, r: float) -> Points:
    """Outline of a flame."""
    half = [(0.0, -1.05), (0.20, -0.62), (0.50, -0.25), (0.72, 0.22), (0.56, 0.74), (0.0, 1.0)]
    left = [(-0.56, 0.74), (-0.72, 0.24), (-0.60, -0.18), (-0.36, -0.42), (-0.26, -0.12), (-0.14, -0.60)]
    return [(x + r * u, y + r * v) for u, v in (*half, *left)]
