"""Layout of a player's card, in the lobby and in the choice of initials, and the bar at its foot.

A card is W x H px, with its upper left corner at (0, 0).
"""

from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_size, span
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import LEVELS, dimmed

W, H = span(0, 3)[1], 600
MIDDLE = W / 2
BAR_Y = 538
BAR = (24, 500, W - 48, 76)


@cached
@resumable
def ready_bar(player: int, sentence: str) -> Steps[LitImage]:
    """The bar of a player who is ready."""
    layer, color = Layer(*BAR), kit.PLAYERS[player]
    layer.glow.fill(kit.cut_box(*BAR, 14), kit.dim(color, 0.28)).line(kit.cut_box(*BAR, 14), color, kit.THIN, True)
    size = fit_size(sentence, kit.LABEL, W - 150)
    kit.icon(layer.glow, "check", MIDDLE - kit.text_width(sentence, size) / 2 - 16, BAR_Y, 22, color, kit.LINE + 1)
    layer.canvas.text(sentence, size, MIDDLE + 22, BAR_Y, kit.ICE, "head", "c")
    return (yield from layer.render_steps())


@cached
def ask_bar(label: str, sentence: str, level: int) -> LitImage:
    """The bar that asks a player to press a button when ready."""
    if level < LEVELS:
        return dimmed(ask_bar(label, sentence, LEVELS), level / LEVELS)
    size = kit.prompt_size([(label, sentence)], W - 40)
    x = MIDDLE - (kit.button_width(label, size) + 18 + kit.text_width(sentence, size, "body")) / 2
    layer = Layer(*BAR)
    layer.canvas.body(sentence, x, BAR_Y, kit.ICE, "l", size)
    kit.button(layer.canvas, x + kit.text_width(sentence, size, "body") + 18, BAR_Y, label, kit.FOCUS, size)
    return layer.render()
