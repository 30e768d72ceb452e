"""The tool bar: two columns of tiles beside the board."""

from collections.abc import Mapping
from dataclasses import dataclass

import pygame

from pigaming_app.scenes.editor.board import BOARD
from pigaming_app.scenes.editor.icons import draw_icon
from pigaming_app.ui.draw import FOCUS, ICE, MIST, STEEL, THIN, cut_box, dim
from pigaming_app.ui.draw.layers import LEFT, Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.focus import Focus, FocusSpot

W, H, GAP_X, ROWS = 122, 88, 20, 8  # px
PITCH = (BOARD.h - H) / (ROWS - 1)
RIGHT_COLUMN = LEFT + W + GAP_X
TOOLS, DIALS = 4, 4  # tiles for them, at most
FIXED = ("copy", "delete", "mirror", "grid", "undo", "redo", "play", "save")
NAMES = (*(f"tool {i}" for i in range(TOOLS)), *(f"dial {i}" for i in range(DIALS)), *FIXED)


@dataclass(frozen=True)
class Tile:
    """The content of a tile. `on`: it is the chosen tool; `live`: a press has an effect."""

    icon: str
    value: str = ""
    on: bool = False
    live: bool = True


class ToolBar:
    """Focus on the tiles. `open`: directions move the focus, not the pointer."""

    def __init__(self) -> None:
        self.focus = Focus([FocusSpot(name, box(i)) for i, name in enumerate(NAMES)])
        self.open, self.pointed = False, ""  # `pointed`: the tile under the mouse

    def handle(self, event: InputEvent) -> bool:
        """Move the focus by a direction; false if it leaves to the right."""
        if event.button is Button.RIGHT and self.focus.spot.rect.x >= RIGHT_COLUMN:
            self.open = event.repeat
            return event.repeat
        if event.button is Button.LEFT and self.focus.spot.rect.x < RIGHT_COLUMN:
            return True
        self.focus.handle(event)
        return True

    def hit(self, event: InputEvent) -> str | None:
        """The tile under the mouse."""
        return self.focus.spot_at(event)

    def update(self, seconds: float) -> None:
        self.focus.update(seconds)

    def point(self, event: InputEvent) -> None:
        """Follow the mouse; any other input hides the name of the tile under it."""
        self.pointed = (self.hit(event) or "") if event.button is Button.POINT else ""

    def draw(self, screen: pygame.Surface, tiles: Mapping[str, Tile], words: Words) -> None:
        """Draw the tiles, and the name of the one with the focus or under the mouse."""
        for i, name in enumerate(NAMES):
            at = box(i).topleft
            if shown := tiles.get(name):
                state = "dim" if not shown.live else "on" if shown.on else "live"
                tile(shown.icon, shown.value, state).draw(screen, *at)
            else:
                free().draw(screen, *at)
        if self.open:
            self.focus.draw(screen)
        named = self.focus.name if self.open else self.pointed
        if named in tiles and (key := f"editor.tool_{tiles[named].icon}") in words:
            plate = caption(words(key), FOCUS)
            plate.draw(screen, RIGHT_COLUMN + W + 24 + plate.width / 2, box(NAMES.index(named)).centery)


def box(i: int) -> pygame.Rect:
    """Rectangle of the i-th tile."""
    return pygame.Rect(LEFT + i % 2 * (W + GAP_X), round(BOARD.y + i // 2 * PITCH), W, H)


@cached
def tile(icon: str, value: str, state: str) -> LitImage:
    """A tile; top left at (0, 0). `state`: on, live or dim."""
    layer = Layer(0, 0, W, H)
    edge, color = {"on": (FOCUS, FOCUS), "live": (STEEL, ICE), "dim": (dim(STEEL, 0.5), dim(MIST, 0.35))}[state]
    layer.glow.line(cut_box(0, 0, W, H, 14), edge, THIN, True)
    draw_icon(layer.glow, icon, W / 2, H / 2, 26, color, value)
    return layer.render()


@cached
def free() -> LitImage:
    """A tile without content."""
    layer = Layer(0, 0, W, H)
    layer.canvas.crisp.dashes(cut_box(0, 0, W, H, 14), dim(STEEL, 0.35), 2, 6, 10)
    return layer.render()
