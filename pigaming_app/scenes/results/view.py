"""Rendering of the results page as cached widgets: title, rows, plot, revealed one after the other."""

from collections.abc import Sequence

import pygame

from pigaming_app.games.game import Row, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.results.awards.award import places
from pigaming_app.scenes.results.headline import EndedMatch, is_allied
from pigaming_app.scenes.results.high_scores import clock, contest, format_score, high_score_tables
from pigaming_app.scenes.results.page_head import FIRST, RevealedPage, RevealedPart, row_starts, share_of
from pigaming_app.scenes.results.plot import Curve, LapPlot, Plot, dot, team_curve
from pigaming_app.scenes.views.hud.ai_sign import ai_mark
from pigaming_app.scenes.views.sprites.stars import HIGH, star_row
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_size, span
from pigaming_app.ui.i18n import Words, numeral

TOP, ROW, PITCH = 280, 120, 136
TIMES = ("best", "total")  # columns in s
KIND = "party"  # rules that show no score below zero
PLACE_X, BADGE_X, AI_X = 68, 172, 236  # px from a row's left edge: centres of place, badge and AI icon
FIGURES = (226, 828)  # px from a row's left edge: left and right limit of the columns
APART_X = 22  # px, minimum gap between columns


class ResultsPage(RevealedPage):
    """The results page without the votes."""

    def __init__(self, context: Context, ended: EndedMatch, finished: bool) -> None:
        super().__init__(context, ended, finished)
        self.outcome, self.setup = outcome, setup = ended.outcome, ended.setup
        self.by_team = len(self.teams) < len(outcome.rows)
        game = games()[setup.game]
        columns = game.variants[setup.variant].columns or game.columns
        self.columns = ("score", *columns) if game.scored else columns
        self.stars, self.winners = self.head.stars, self.head.winners
        self.plot: Plot

    def draw(self, screen: pygame.Surface, age: float) -> None:
        """Draw the page `age` seconds after it was opened; the plot with its lines as far as they are revealed."""
        super().draw(screen, age)
        drawn = (age - FIRST) / (self.ready_at - FIRST)
        if 0.0 < drawn < 1.0:
            for at, color in self.plot.heads(drawn):
                dot(screen, at, color)
            now, _ = self.plot.to_screen(drawn * self.plot.seconds, 0)
            self.lines.draw(screen, share=share_of(self.lines, now))
        elif drawn >= 1.0:
            self.lines.draw(screen)
            self.ends.draw(screen)

    # ---- widgets

    def _render_parts(self) -> Steps[None]:
        """Render one widget per step."""
        yield from super()._render_parts()
        self.parts.append(RevealedPart(self._columns(), 0.1))
        yield
        y = TOP
        for i, team in enumerate(self.teams):
            self.parts.append(RevealedPart(self._team(team, y), row_starts(i, len(self.teams))))
            y += PITCH * len(team)
            yield
        if len(self.outcome.rows) < 4 and (records := self._records()):
            self.parts.append(RevealedPart(records, self.ready_at))
            yield
        x, w = span(6, 6)
        self.plot = self._plot(x, w)
        if is_allied(self.setup) and self.finished:
            self.parts.append(RevealedPart(star_row(self.stars, x, TOP, w), self.head.title_at))
            yield
        self.parts.append(RevealedPart(self.plot.grid(), 0.1))
        yield
        self.lines = self.plot.lines()
        yield
        self.ends = self.plot.ends()
        yield

    def _columns(self) -> LitImage:
        """Column headings."""
        words = self.context.words
        x, w = span(0, 6)
        plot_x, _ = span(6, 6)
        layer = Layer(x, 206, 2 * w, 60)
        heads = [words(f"results.{name}") for name in self.columns]
        ends = self._ends()
        team = words("results.together" if is_allied(self.setup) else "results.team")
        if self.by_team:
            layer.canvas.body(team, x + 24, 236, kit.MIST)
        begins = [24 + kit.text_width(team, kit.BODY, "body") if self.by_team else 0, *ends]
        rooms = [end - begin - APART_X for begin, end in zip(begins, ends, strict=False)]
        size = min(fit_size(head, kit.BODY, room, "body") for head, room in zip(heads, rooms, strict=True))
        for head, end in zip(heads, ends, strict=True):
            layer.canvas.body(head, x + end, 236, kit.MIST, "r", size)
        layer.canvas.body(self._plot_heading(), plot_x, 236, kit.MIST)
        return layer.render()

    def _plot_heading(self) -> str:
        words = self.context.words
        if self.stars:
            seconds = int(self.outcome.seconds)
            return words("results.all_in", time=f"{seconds // 60}:{seconds % 60:02}")
        return words("results.plot_pitanks" if "score" in self.columns else f"results.plot_{self.setup.game}")

    def _team(self, rows: Sequence[Row], y: int) -> LitImage:
        """Panel with the row of one robot, or of all robots of a team."""
        x, w = span(0, 6)
        h = PITCH * len(rows) - (PITCH - ROW)
        wins = rows[0].seat in self.winners
        layer = Layer(x, y, w, h)
        kit.panel(layer.glow, x, y, w, h, self._team_color(rows) if wins else kit.STEEL, kit.LINE if wins else kit.THIN)
        score = sum(row.score for row in rows)
        by_place = not self.by_team or (score < 0 and self.setup.variant == KIND)
        number = str(places(self.outcome)[rows[0].seat]) if by_place else numeral(score)
        color = kit.ICE if wins else kit.MIST
        layer.canvas.text(number, fit_size(number, kit.SUB, 104), x + PLACE_X, y + h / 2, color, "head", "c")
        for i, row in enumerate(rows):
            self._row(layer, row, x, y + ROW / 2 + PITCH * i, color)
        return layer.render()

    def _team_color(self, rows: Sequence[Row]) -> kit.Color:
        return kit.FOCUS if self.stars else kit.PLAYERS[min(row.seat for row in rows)]

    def _row(self, layer: Layer, row: Row, x: int, y: float, color: kit.Color) -> None:
        """One robot: badge, score and the statistics of the game."""
        kit.badge(layer.glow, row.seat, x + BADGE_X, y, 38)
        brain = self.ended.brain(row.seat)
        if brain:
            ai_mark(layer.glow, brain, x + AI_X, y, kit.MIST)
        ends = self._ends()
        for name, before, right in zip(self.columns, (FIGURES[0] - APART_X, *ends), ends, strict=False):
            (text, size, face), room = self._cell(name, row), right - before - APART_X
            if name == self.columns[0]:
                size = fit_size(text, size, room - (50 if brain else 0), face)
                layer.canvas.text(text, size, x + right, y, kit.mix(kit.PLAYERS[row.seat], kit.WHITE, 0.3), face, "r")
            else:
                layer.canvas.crisp.text(text, fit_size(text, size, room), x + right, y, color, face, "r")

    def _cell(self, name: str, row: Row) -> tuple[str, int, str]:
        """Text of a row in a column, its size and face."""
        if name == "score":
            return score_cell(self.context.words, self.setup, row)
        text = self.context.words.decimal(cell(name, row))
        return (text, kit.SUB, "hero") if name == self.columns[0] else (text, kit.LABEL, "head")

    def _ends(self) -> list[float]:
        """Right edge of each column, px from a row's left edge, according to its content."""
        words, wanted = self.context.words, []
        for name in self.columns:
            cells = [kit.text_width(*self._cell(name, row)) for row in self.outcome.rows]
            wanted.append(max(*cells, kit.text_width(words(f"results.{name}"), kit.BODY, "body")))
        return ends(wanted, *FIGURES, APART_X)

    def _records(self) -> LitImage | None:
        """Best scores of both tables in the space of a missing row; None if both are empty."""
        scores, setup, words = self.context.scores, self.setup, self.context.words
        tables = [(board, scores.best(board.table, board.days)) for board in high_score_tables(contest(setup))]
        if not any(rows for _, rows in tables):
            return None
        x, w = span(0, 6)
        y = TOP + 3 * PITCH + ROW // 2
        layer = Layer(x, y - ROW // 2, w, ROW)
        for left, (board, rows) in zip((x + 24, x + w // 2 + 24), tables, strict=True):
            kit.icon(layer.glow, "crown", left + 24, y - 34, 20, kit.FOCUS, 3)
            heading = words(board.heading, goal=setup.goal)
            layer.canvas.body(heading, left + 64, y - 32, kit.MIST, "l", fit_size(heading, kit.BODY, 330, "body"))
            if rows:
                layer.canvas.text(rows[0].initials, kit.LABEL, left, y + 32, kit.ICE, "hero")
                best = words.decimal(format_score(rows[0].score, board.table))
                layer.canvas.text(best, kit.LABEL, left + 370, y + 32, kit.ICE, "hero", "r")
        return layer.render()

    def _plot(self, x: int, w: int) -> Plot:
        """Plot of scores or laps."""
        if games()[self.setup.game].timed:
            rows = sorted(self.outcome.rows, key=lambda row: row.seat)
            laps = [Curve((row.seat,), tuple((i + 1.0, lap) for i, lap in enumerate(row.times))) for row in rows]
            return LapPlot(x, TOP, w, 528, laps, self.setup.goal)
        top = TOP + HIGH if is_allied(self.setup) and self.finished else TOP
        return Plot(x, top, w, 528 + TOP - top, self._curves(), self.outcome.seconds)

    def _curves(self) -> list[Curve]:
        series = self.outcome.series
        if not self.by_team:
            return sorted(
                (Curve((row.seat,), tuple(series[row.seat])) for row in self.outcome.rows), key=lambda c: c.players
            )
        seats = [sorted(row.seat for row in team) for team in self.teams]
        return [team_curve(team, [series[seat] for seat in team]) for team in seats]


def ends(wanted: Sequence[float], left: float, right: float, apart: float) -> list[float]:
    """Right edges of columns with the wanted widths; surplus or missing space is shared equally."""
    room = right - left - apart * (len(wanted) - 1)
    spare = (room - sum(wanted)) / len(wanted)
    widths = [width + spare if spare >= 0.0 else width * room / sum(wanted) for width in wanted]
    return [left + sum(widths[: i + 1]) + apart * i for i in range(len(widths))]


def score_cell(words: Words, setup: Setup, row: Row) -> tuple[str, int, str]:
    """The score of a row, its size and face; below zero in the rules `party` the hits taken."""
    if row.score >= 0 or setup.variant != KIND:
        return numeral(row.score), kit.SUB, "hero"
    return words("results.hits_taken", count=round(row.stats.get("taken", -row.score))), kit.BODY, "body"


def cell(name: str, row: Row) -> str:
    """Text of a row in a column with a statistic."""
    value = row.stats[name]
    if name in TIMES:
        return clock(value)
    return f"{round(100 * value)}%" if name == "aim" else numeral(round(value))
