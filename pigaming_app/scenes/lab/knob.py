"""Dial from -10 to +10, zero at the top: one colour for positive values, another for negative ones."""

import math

from pigaming_app.scenes.lab.layout import BAD, GOOD, NOTHING
from pigaming_app.ui.draw import FOCUS, ICE, LABEL, STEEL, THIN, WHITE
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_size
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import signed

LIMIT = 10
RADIUS = 48  # px
SWEEP = math.radians(135)  # rad, from zero to either end
TOP = -math.pi / 2
ARROW = 88  # px from the centre of a held knob to the tip of an arrow


@cached
def dial(value: float, held: bool) -> LitImage:
    """Knob at `value`, centred on (0, 0). `held`: it is being adjusted."""
    layer = Layer(-110, -80, 220, 160)
    ink, end = layer.glow, TOP + SWEEP * max(-LIMIT, min(LIMIT, value)) / LIMIT
    layer.canvas.crisp.arc(0, 0, RADIUS, TOP - SWEEP, TOP + SWEEP, NOTHING, 12)
    if value:
        ink.arc(0, 0, RADIUS, TOP, end, GOOD if value > 0 else BAD, 12)
    for k in (-1, 0, 1):
        c, s = math.cos(TOP + SWEEP * k), math.sin(TOP + SWEEP * k)
        layer.canvas.crisp.line(
            [((RADIUS + 13) * c, (RADIUS + 13) * s), ((RADIUS + 19) * c, (RADIUS + 19) * s)], STEEL, THIN
        )
    layer.canvas.crisp.disc(RADIUS * math.cos(end), RADIUS * math.sin(end), 13, FOCUS if held else WHITE)
    shown = signed(value, 0 if value == round(value) else 1)
    layer.canvas.text(shown, fit_size(shown, LABEL - 8, 2 * RADIUS - 20), 0, 2, FOCUS if held else ICE, "head", "c")
    if held:
        for side in (-1, 1):
            layer.glow.fill([(side * ARROW, 0), (side * (ARROW - 18), -16), (side * (ARROW - 18), 16)], FOCUS)
    return layer.render()
