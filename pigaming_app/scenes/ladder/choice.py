"""The choice of a ladder: one game, or all of them. A climb that was left is taken up where it stopped."""

import pygame

from pigaming_app.events.ladder import ALL, climbed_games, stars_and_losses, table_of
from pigaming_app.scenes.flow.match_words import LIT
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.ladder.climber import Climber, begun, device_of, resumable_climbs
from pigaming_app.scenes.ladder.climbers import Climbers, game_name
from pigaming_app.scenes.ladder.rungs import LadderPage
from pigaming_app.scenes.ladder.strengths import Strengths
from pigaming_app.scenes.ladder.summit import Summit
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.views.game_tile import TILE_H, TileStrip, tile
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, STEEL, dim, panel
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out

TOP = 212  # px
ALL_BOX = pygame.Rect(LEFT, TOP + TILE_H + 24, RIGHT - LEFT, 132)
RULES_Y = 876


class LadderChoice(Page):
    """The page with a tile for each game, and one for all. `game`: focused at first."""

    title = "ladder.title"
    idle, stay = 60.0, 6.0
    hints = (
        (Button.FIRE, "ladder.hint_ok"),
        (Button.Y, "ladder.hint_climbers"),
        (Button.X, "ladder.hint_strengths"),
        (Button.BACK, "ladder.hint_back"),
    )

    def __init__(self, context: Context, game: str) -> None:
        self.tiles = TileStrip(climbed_games(), TOP)
        super().__init__(context, Focus(self._spots(), game))
        self._follow()
        self.saved: dict[str, Climber] = {}

    def on_enter(self) -> None:
        """Read the climbs that were left."""
        self.context.sounds.music("title")
        self.saved, damaged = resumable_climbs()
        if damaged:
            self.show_message(self.context.words("ladder.damaged"), wrong=True)

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE chooses a ladder, Y shows the best climbers, X the strength of the AIs."""
        if event.button is Button.Y:
            self.context.sounds.play("accept")
            return Push(Climbers(self.context, self.focus.name))
        if event.button is Button.X:
            self.context.sounds.play("accept")
            climbed = climbed_games()
            return Push(Strengths(self.context, self.focus.name if self.focus.name in climbed else climbed[0]))
        turn = super().press(event)
        self._follow()
        return turn

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        self.context.sounds.play("accept")
        return Push(self._page(name, event))

    def advance(self, seconds: float) -> StackOperation:
        self.tiles.update(seconds)
        return None

    @property
    def subtitle(self) -> str:
        return self.context.words("ladder.invitation")

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the tiles and the rules."""
        words = self.context.words
        self.tiles.draw(screen, self._tile)
        black_out(screen, ALL_BOX)
        wide_tile(game_name(words, ALL), self._line(ALL), self.focus.name == ALL).draw(screen, *ALL_BOX.topleft)
        self.focus.draw(screen)
        text(words("ladder.rules"), BODY, MIST).draw(screen, 960, RULES_Y)

    # ---- inside

    def _spots(self) -> list[FocusSpot]:
        return [*self.tiles.spots(), FocusSpot(ALL, ALL_BOX)]

    def _follow(self) -> None:
        """Keep the focused tile in the picture."""
        if self.tiles.follow(self.focus):
            self.focus.set_spots(self._spots())

    def _tile(self, game: str) -> LitImage:
        return tile(game, self.context.words(f"games.{game}"), self._line(game), game == self.focus.name)

    def _page(self, game: str, event: InputEvent) -> LadderPage | Summit:
        """The page of a climb that was left, or of a new one."""
        device = device_of(event)
        if game not in self.saved:
            return LadderPage(self.context, begun(game, device))
        climber = self.saved[game]
        climber = Climber(climber.climb, climber.number, device)
        return Summit(self.context, climber) if climber.climb.at_top else LadderPage(self.context, climber)

    def _line(self, game: str) -> str:
        """The line of a tile: the climb that was left, else today's best, else an invitation."""
        words = self.context.words
        if game in self.saved and not self.saved[game].climb.at_top:
            return words("ladder.left", stars=LIT * self.saved[game].climb.level)
        if best := self.context.scores.best(table_of(game), 1):
            return words("ladder.best", initials=best[0].initials, stars=LIT * stars_and_losses(best[0].score)[0])
        return words("ladder.each_game" if game == ALL else "best.first")


@cached
@resumable
def wide_tile(name: str, line: str, hot: bool) -> Steps[LitImage]:
    """The tile for all games; top left at (0, 0)."""
    w, h = ALL_BOX.size
    layer = Layer(0, 0, w, h)
    panel(layer.glow, 0, 0, w, h, dim(FOCUS, 0.55) if hot else STEEL)
    layer.canvas.text(name, fit_size(name, LABEL, w // 2 - 60), 32, h / 2, FOCUS if hot else ICE)
    layer.canvas.body(line, w - 32, h / 2, ICE if hot else MIST, "r", fit_size(line, BODY, w // 2, "body"))
    yield
    return (yield from layer.render_steps())
