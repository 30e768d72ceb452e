"""How New Game appears on the screens."""

from collections.abc import Callable, Iterator

from pigaming_app.api.look import STYLE, Batch, GameScreens, GlowCanvas, SimpleView, dim, light_sprite, put, robot

from .rules import NewGame


class NewGameView(SimpleView):
    """The coin, besides walls, robots and points."""

    def samples(self) -> Iterator[Callable[[], object]]:
        yield coin

    def marks(self, under: Batch, over: Batch, state: NewGame, blend: float) -> None:
        put(under, coin(), *self.on_canvas(state.coin_x, state.coin_y))


@light_sprite(80, 0.9)
def coin(ink: GlowCanvas) -> None:
    """The coin."""
    draw_coin(ink, 0.0, 0.0, 40.0)


def draw_coin(ink: GlowCanvas, x: float, y: float, r: float) -> None:
    """A coin of radius `r` px."""
    ink.disc(x, y, r, dim(STYLE.focus, 0.3)).ring(x, y, r, STYLE.focus, STYLE.line).ring(
        x, y, 0.5 * r, STYLE.focus, STYLE.line
    )


def tile(ink: GlowCanvas, x: float, y: float) -> None:
    """The picture on the title, 560 x 284 px below and right of (x, y)."""
    draw_coin(ink, x + 280, y + 110, 56)
    robot(ink, 0, x + 130, y + 190, -0.4, 1.15)
    robot(ink, 1, x + 450, y + 190, 3.5, 1.15)


SCREENS = GameScreens(NewGameView, tile)
