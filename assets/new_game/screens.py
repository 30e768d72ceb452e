"""How New Game appears on the screens."""

from collections.abc import Iterator
from typing import Any

from pigaming_app.api.look import (
    FOCUS,
    LINE,
    Batch,
    GameScreens,
    GlowCanvas,
    Job,
    SimpleView,
    Sprite,
    cached,
    dim,
    on_canvas,
    put,
    robot,
    trim,
)


class NewGameView(SimpleView):
    """The coin, besides walls, robots and points."""

    def sprites(self) -> Iterator[Job]:
        yield coin

    def marks(self, under: Batch, over: Batch, state: Any, blend: float) -> None:
        put(under, coin(), *on_canvas(state.coin_x, state.coin_y))


@cached
def coin() -> Sprite:
    """The coin, as light to add."""
    ink = GlowCanvas(160, 160).set_transform(80, 80)
    draw_coin(ink, 0.0, 0.0, 40.0)
    return trim(ink.lit(0.9), 80, 80)


def draw_coin(ink: GlowCanvas, x: float, y: float, r: float) -> None:
    """A coin of radius `r` px."""
    ink.disc(x, y, r, dim(FOCUS, 0.3)).ring(x, y, r, FOCUS, LINE).ring(x, y, 0.5 * r, FOCUS, LINE)


def tile(ink: GlowCanvas, x: float, y: float) -> None:
    """The picture on the title, 560 x 284 px below and right of (x, y)."""
    draw_coin(ink, x + 280, y + 110, 56)
    robot(ink, 0, x + 130, y + 190, -0.4, 1.15)
    robot(ink, 1, x + 450, y + 190, 3.5, 1.15)


SCREENS = GameScreens(NewGameView, tile)
