"""How strong the AIs of a game are: the ratings of a league as bars with 95 % intervals, best at the top."""

import logging
from collections.abc import Sequence

import pygame

from pigaming_app import ASSETS
from pigaming_app.ai.registry import level_of
from pigaming_app.events.league_files import Ratings, Strength, ratings_of
from pigaming_app.scenes.flow.match_words import brain_name
from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.storage.plugins.parts import data_folders
from pigaming_app.storage.settings import folders
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import signed
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.labels import sign

ROWS = 12  # at most
GAME_Y, TOP, BOTTOM, NOTE_Y = 226, 272, 896, 924  # px
PITCH = 76  # px from row to row, at most
NAMES, BARS, VALUES = LEFT, (556, 1640), RIGHT  # px: left edge, ends of the longest bar, right edge
ARROW = 20  # px
APART, WIPE = 0.06, 0.35  # s: delay from row to row, wipe of one row
NAMED = ("idle", "random", "hand1", "hand2", "hand3")  # AIs that no other screen names

log = logging.getLogger("pigaming")


class Strengths(Page):
    """The page of a game; LEFT and RIGHT show another one, any button leaves."""

    title = "strengths.title"
    idle, stay = 60.0, 6.0
    closing = Button.FIRE, Button.START, Button.X, Button.CLICK
    hints = ((Button.FIRE, "results.on"), (Button.RIGHT, "ladder.hint_games"))

    def __init__(self, context: Context, game: str) -> None:
        super().__init__(context)
        self._show(game)

    def press(self, event: InputEvent) -> StackOperation:
        if event.button in (Button.LEFT, Button.RIGHT):
            names = shown_games()
            step = 1 if event.button is Button.RIGHT else -1
            self._show(names[(names.index(self.game) + step) % len(names)])
            self.context.sounds.play("move")
        return None

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the name of the game and the bars."""
        words, name = self.context.words, self.context.words(f"games.{self.game}")
        text(name, kit.LABEL, kit.ICE, "head").draw(screen, 960, GAME_Y)
        reach = kit.text_width(name, kit.LABEL) / 2 + 60
        for side, x in (("left", 960 - reach), ("right", 960 + reach)):
            sign(side, ARROW, kit.FOCUS, kit.LINE).draw(screen, x, GAME_Y)
        if self.ratings:
            self._bars(screen, shown(self.ratings))
            text(words("strengths.measure"), kit.BODY, kit.MIST).draw(screen, 960, NOTE_Y)
        else:
            text(words("strengths.none"), kit.LABEL, kit.MIST, "head").draw(screen, 960, 540)

    # ---- inside

    def _show(self, game: str) -> None:
        """Read and show the ratings of a game."""
        self.game, self.age = game, 0.0
        shipped = dict(data_folders("brains")).get(game, ASSETS / "brains")
        self.ratings, problems = ratings_of(game, (folders().data, shipped))
        for sentence in problems:
            log.warning("%s", sentence)
        self.show_message(self.context.words("strengths.damaged") if problems else "", wrong=True)

    @property
    def subtitle(self) -> str:
        """Rules and number of matches of the league."""
        if not self.ratings:
            return ""
        words = self.context.words
        rules = words(f"setup.{self.game}_{self.ratings.variant}")
        return f"{rules}  ·  {words('strengths.matches', matches=self.ratings.matches)}"

    def _bars(self, screen: pygame.Surface, rows: Sequence[Strength]) -> None:
        pitch = min(PITCH, (BOTTOM - TOP) // len(rows))
        low, high = min(row.low for row in rows), max(row.high for row in rows)
        margin = 0.08 * (high - low) or 1.0
        left, right = BARS

        def place(points: float) -> int:
            return round(left + (right - left) * (points - low + margin) / (high - low + margin))

        for i, row in enumerate(rows):
            share = (self.age - APART * i) / WIPE
            if share > 0.0:
                words, brain = self.context.words, row.brain
                name = words(f"strengths.{brain}") if brain in NAMED else brain_name(words, self.game, brain)
                ends = place(row.low), place(row.rating), place(row.high)
                color = kit.FOCUS if level_of(row.brain) else kit.MIST
                lit = bar(name, signed(row.rating), ends, pitch, color)
                lit.draw(screen, 0, TOP + pitch * i + pitch // 2, 1 - (1 - min(1.0, share)) ** 2)


def shown(ratings: Ratings) -> list[Strength]:
    """At most ROWS of the ratings: all levels, and the best of the others."""
    levels = [row for row in ratings.strengths if level_of(row.brain)]
    others = [row for row in ratings.strengths if not level_of(row.brain)]
    return sorted([*levels, *others][:ROWS], key=lambda row: -row.rating)


@cached
@resumable
def bar(name: str, value: str, ends: tuple[int, int, int], pitch: int, color: kit.Color) -> Steps[LitImage]:
    """A row with its middle at y = 0. `ends`: x of the lower end of the interval, of the rating, of the upper end."""
    low, at, high = ends
    half = round(0.27 * pitch)
    layer = Layer(NAMES, -pitch / 2, VALUES - NAMES, pitch)
    box = kit.cut_box(BARS[0], -half, max(24, at - BARS[0]), 2 * half, 8)
    layer.glow.fill(box, kit.dim(color, 0.22)).line(box, color, kit.THIN, True)
    size = min(kit.LABEL, round(0.8 * pitch))
    layer.canvas.text(name, fit_size(name, size, BARS[0] - NAMES - 36), BARS[0] - 36, 0, kit.ICE, "head", "r")
    layer.canvas.text(value, size, VALUES, 0, kit.ICE, "hero", "r")
    yield
    whisker = round(0.7 * half)
    for x in (low, high):
        layer.canvas.crisp.line([(x, -whisker), (x, whisker)], kit.ICE, kit.THIN)
    layer.canvas.crisp.line([(low, 0), (high, 0)], kit.ICE, kit.THIN)
    layer.glow.line([(BARS[0] - 12, -pitch / 2), (BARS[0] - 12, pitch / 2)], kit.STEEL, kit.THIN)
    yield
    return (yield from layer.render_steps())
