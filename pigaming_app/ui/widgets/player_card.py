"""The card of a player, in the lobby and where initials are chosen: its size, and the bar at its foot.

A card is W x H px, its upper left at (0, 0) of its own.
"""

from pigaming_app.ui.draw import (
    BODY,
    FOCUS,
    ICE,
    LABEL,
    LINE,
    PLAYERS,
    THIN,
    button,
    button_width,
    cut,
    dim,
    icon,
    text_width,
)
from pigaming_app.ui.draw.layers import Lit, Pane, span
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fitted
from pigaming_app.ui.widgets.labels import LEVELS, dimmed

W, H = span(0, 3)[1], 600
MIDDLE = W / 2
BAR_Y = 538
BAR = (24, 500, W - 48, 76)


@cached
def ready(player: int, said: str) -> Lit:
    """The bar of somebody who is ready."""
    pane, color = Pane(*BAR), PLAYERS[player]
    pane.hot.fill(cut(*BAR, 14), dim(color, 0.28)).line(cut(*BAR, 14), color, THIN, True)
    size = fitted(said, LABEL, W - 150)
    icon(pane.hot, "check", MIDDLE - text_width(said, size) / 2 - 16, BAR_Y, 22, color, LINE + 1)
    pane.page.text(said, size, MIDDLE + 22, BAR_Y, ICE, "head", "c")
    return pane.done()


@cached
def asked(label: str, said: str, level: int) -> Lit:
    """The bar of somebody who has to press a button to be ready."""
    if level < LEVELS:
        return dimmed(asked(label, said, LEVELS), level / LEVELS)
    wide = button_width(label)
    size = fitted(said, BODY, W - 40 - wide - 18, "body")
    x = MIDDLE - (wide + 18 + text_width(said, size, "body")) / 2
    pane = Pane(*BAR)
    pane.page.body(said, x, BAR_Y, ICE, "l", size)
    button(pane.page, x + text_width(said, size, "body") + 18, BAR_Y, label, FOCUS)
    return pane.done()
