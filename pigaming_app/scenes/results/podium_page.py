"""The end of a match of several rounds: the podium, and the points of every round."""

from collections.abc import Iterator

import pygame

from pigaming_app.games.game import Row
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.results.headline import EndedMatch, headline, winning_color
from pigaming_app.scenes.results.page_head import line
from pigaming_app.scenes.results.podium import FIRST, Podium, stands
from pigaming_app.scenes.results.view import score_cell
from pigaming_app.scenes.views.hud.ai_sign import ai_mark
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import budget, finished_within
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, backdrop, fit_size, span
from pigaming_app.ui.i18n import numeral
from pigaming_app.ui.widgets.labels import black_out
from pigaming_app.ui.widgets.pips import pips

FOOT = 800  # px, y of the foot of the podium
TOP, ROW, PITCH = 280, 112, 132  # px
PIPS_X, ROUNDS_X, ROUND_PITCH = 220, 400, 104  # px from a row's left edge
PIP = 15  # px
TABLE_AT = 0.2  # s, when the table appears


class PodiumPage:
    """A page of `Results` for a match of several rounds; see `ResultsPage`."""

    def __init__(self, context: Context, ended: EndedMatch, finished: bool, rounds: Rounds) -> None:
        self.context, self.ended, self.finished, self.rounds = context, ended, finished, rounds
        self.outcome = outcome = ended.outcome
        self.winners = outcome.winners if finished else ()
        x, w = span(0, 6)
        places = [(row.place, row.team, row.seat) for row in outcome.rows]
        self.podium = Podium(x + w / 2, FOOT, stands(places))
        self.ready_at = FIRST + 0.6
        self.table: list[LitImage] = []
        self._rendering = self._render_parts()

    def prewarm(self, milliseconds: float) -> bool:
        """Render widgets for at most this many milliseconds; True when all are ready."""
        return finished_within(self._finish, milliseconds)

    def sounds(self) -> list[tuple[float, str, int | None]]:
        """Sounds of the reveal: (seconds, name, player)."""
        return self.podium.sounds()

    def draw(self, screen: pygame.Surface, age: float) -> None:
        """Draw the page `age` seconds after it was opened."""
        self._finish()
        screen.blit(backdrop(), (0, 0))
        x, w = span(6, 6)
        black_out(screen, *(pygame.Rect(x, TOP + PITCH * i, w, ROW) for i in range(len(self.outcome.rows))))
        self.podium.draw(screen, age)
        for part in self.table:
            part.draw(screen, share=min(1.0, max(0.0, (age - TABLE_AT) / 0.3)))
        if age >= FIRST:
            self.title.draw(screen)
            self.colored.draw(screen)
        else:
            self.steel.draw(screen)

    # ---- widgets

    def _finish(self) -> None:
        """Render the remaining widgets. Raises Unfinished if the frame budget is exhausted."""
        for _ in self._rendering:
            budget.pause()

    def _render_parts(self) -> Iterator[None]:
        """Render one widget per step."""
        color = winning_color(self.outcome, self.ended.setup) if self.winners else kit.ICE
        self.colored, self.steel = line(color, RIGHT - LEFT), line(kit.STEEL, RIGHT - LEFT, kit.THIN)
        yield
        self.title = self._title()
        yield
        self.table.append(self._heads())
        yield
        for i, row in enumerate(self.outcome.rows):
            self.table.append(self._row(row, TOP + PITCH * i))
            yield
        yield from self.podium.prewarm()

    def _title(self) -> LitImage:
        """Headline in the winner's colour."""
        words = self.context.words
        layer = Layer(LEFT, 54, RIGHT - LEFT, 116)
        x = LEFT
        for seat in self.winners:
            kit.badge(layer.glow, seat, x + 52, 110, 50)
            x += 128
        x += 14 if self.winners else 0
        ended = headline(words, self.ended)
        said = ended if self.finished else words("results.ended")
        color = winning_color(self.outcome, self.ended.setup) if self.winners else kit.ICE
        layer.canvas.text(said, fit_size(said, kit.TITLE, RIGHT - x), x, 112, color)
        return layer.render()

    def _heads(self) -> LitImage:
        """Column headings: wins, the number of each round, all points."""
        words = self.context.words
        x, w = span(6, 6)
        layer = Layer(x, 206, w, 60)
        said = words("rounds.wins")
        layer.canvas.body(said, x + PIPS_X - PIP, 236, kit.MIST, "l", fit_size(said, kit.BODY, 150, "body"))
        for k in range(len(self.rounds.outcomes)):
            layer.canvas.body(str(k + 1), x + ROUNDS_X + ROUND_PITCH * k, 236, kit.MIST, "r")
        said = words("results.score")
        layer.canvas.body(said, x + w - 32, 236, kit.MIST, "r", fit_size(said, kit.BODY, 180, "body"))
        return layer.render()

    def _row(self, row: Row, y: int) -> LitImage:
        """One robot: badge, rounds won, points of each round, all points."""
        x, w = span(6, 6)
        wins = row.seat in self.winners
        layer = Layer(x, y, w, ROW)
        kit.panel(
            layer.glow, x, y, w, ROW, kit.PLAYERS[row.seat] if wins else kit.STEEL, kit.LINE if wins else kit.THIN
        )
        middle = y + ROW / 2
        kit.badge(layer.glow, row.seat, x + 76, middle, 38)
        if brain := self.ended.brain(row.seat):
            ai_mark(layer.glow, brain, x + 146, middle, kit.MIST)
        pips(layer, x + PIPS_X, middle, int(row.stats["wins"]), self.rounds.needed, kit.PLAYERS[row.seat], PIP)
        for k, (points, ended) in enumerate(zip(self.rounds.points(row.seat), self.rounds.outcomes, strict=True)):
            color = kit.FOCUS if row.seat in ended.winners else kit.MIST
            said = numeral(points)
            size = fit_size(said, kit.LABEL, ROUND_PITCH - 16)
            right = x + ROUNDS_X + ROUND_PITCH * k
            layer.canvas.crisp.text(said, size, right, middle, color, "head", "r")
            if row.seat in ended.winners:
                layer.canvas.crisp.line(
                    [(right - kit.text_width(said, size), middle + 32), (right, middle + 32)], color, 4
                )
        said, size, face = score_cell(self.context.words, self.ended.setup, row)
        size = fit_size(said, size, 150, face)
        layer.canvas.text(said, size, x + w - 32, middle, kit.mix(kit.PLAYERS[row.seat], kit.WHITE, 0.3), face, "r")
        return layer.render()
