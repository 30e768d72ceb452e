"""Between two rounds: the last winner and the standings. During a round: the standings in the left margin."""

import math
from collections.abc import Callable, Sequence

import pygame

from pigaming_app.games.game import Outcome
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.play.side_hints import X
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_size, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words, numeral, signed
from pigaming_app.ui.widgets.dialog import FOOT, HEAD, W, Y, overlay
from pigaming_app.ui.widgets.dialog import X as SHEET_X
from pigaming_app.ui.widgets.pips import pips

SECONDS = 6.0  # s between two rounds
PIP = 11  # px
MARGIN_X, MARGIN_Y, MARGIN_W = 1920 - X, 190, 136  # px: middle, top and width of the standings in the margin
MARGIN_PITCH = 68  # px from one robot to the next
SCORES = SHEET_X + 560  # px, x of the points of the last round


class RoundBreak:
    """The page between two rounds, over the darkened picture of the last one. `drivers`: of each seat at its end."""

    def __init__(self, words: Words, rounds: Rounds, drivers: Sequence[str]) -> None:
        self.words, self.rounds, self.drivers = words, rounds, drivers
        self.age = 0.0
        self.picture: pygame.Surface | None = None

    @property
    def over(self) -> bool:
        """True when the next round begins."""
        return self.age >= SECONDS

    def update(self, seconds: float) -> None:
        self.age += seconds

    def draw(self, screen: pygame.Surface, behind: Callable[[], pygame.Surface]) -> None:
        """Draw the page; `behind` returns the darkened match."""
        last = self.rounds.outcomes[-1]
        if self.picture is None:
            color = kit.PLAYERS[last.winners[0]] if last.winners else kit.STEEL
            self.picture = overlay(behind(), color, self._paint, (self.words.language, id(self)))
        screen.blit(self.picture, (0, 0))
        left = max(1, math.ceil(SECONDS - self.age))
        line = self.words("rounds.next", round=self.rounds.number, seconds=left)
        text(line, kit.LABEL, kit.FOCUS, "head", "c", W - 80).draw(screen, 960, FOOT + 60)

    def _paint(self, layer: Layer) -> None:
        last, wins = self.rounds.outcomes[-1], self.rounds.wins()
        x = SHEET_X + 72.0
        for seat in last.winners:
            kit.badge(layer.glow, seat, x + 46, Y + 116, 46)
            x += 116
        title = round_title(self.words, last, self.rounds.number - 1, self.drivers)
        layer.canvas.text(title, fit_size(title, kit.SUB, SHEET_X + W - 60 - x), x, Y + 116, kit.ICE)
        rows = self.rounds.outcome().rows
        pitch = (FOOT - HEAD) / len(rows)
        points = {row.seat: row.score for row in last.rows}
        for i, row in enumerate(rows):
            y = HEAD + pitch * (i + 0.5)
            kit.badge(layer.glow, row.seat, SHEET_X + 118, y, 30)
            pips(layer, SHEET_X + 220, y, wins[row.seat], self.rounds.needed, kit.PLAYERS[row.seat], 16)
            layer.canvas.text(
                signed(points[row.seat]),
                kit.LABEL,
                SCORES,
                y,
                kit.mix(kit.PLAYERS[row.seat], kit.WHITE, 0.3),
                "hero",
                "r",
            )
            total = self.words("rounds.total", points=numeral(row.score))
            layer.canvas.body(total, SHEET_X + W - 72, y, kit.MIST, "r", fit_size(total, kit.BODY, 440, "body"))


def round_title(words: Words, last: Outcome, number: int, drivers: Sequence[str]) -> str:
    """The winner of a round, in one line. `drivers`: "human" or the AI of each seat at its end."""
    if not last.winners:
        return words("rounds.tied", round=number)
    if len({row.team for row in last.rows}) < len(last.rows):
        team = next(row.team for row in last.rows if row.seat == last.winners[0])
        return words("rounds.team_won", round=number, team=team + 1)
    seat = last.winners[0]
    return words("rounds.won" if drivers[seat] == "human" else "rounds.ai_won", round=number, player=seat + 1)


def draw_margin(screen: pygame.Surface, words: Words, rounds: Rounds, seats: Sequence[int]) -> None:
    """The number of the present round, and the rounds won by each robot, in the left margin."""
    wins = rounds.wins()
    standings = tuple((seat, wins.get(seat, 0)) for seat in seats)
    number = min(rounds.number, rounds.best_of)
    margin(words("rounds.round"), f"{number}/{rounds.best_of}", standings, rounds.needed).draw(screen)


@cached
def margin(label: str, figure: str, standings: tuple[tuple[int, int], ...], needed: int) -> LitImage:
    """A word above a number, and a badge with pips for each robot."""
    layer = Layer(MARGIN_X - MARGIN_W / 2, MARGIN_Y - 24, MARGIN_W, 160 + MARGIN_PITCH * len(standings))
    size = min(kit.BODY, round(kit.BODY * MARGIN_W / kit.text_width(label, kit.BODY)))
    layer.canvas.text(label, size, MARGIN_X, MARGIN_Y, kit.ICE, "head", "c")
    layer.canvas.text(figure, kit.LABEL, MARGIN_X, MARGIN_Y + 58, kit.FOCUS, "head", "c")
    for i, (seat, won) in enumerate(standings):
        y = MARGIN_Y + 140 + MARGIN_PITCH * i
        kit.badge(layer.glow, seat, MARGIN_X - 38, y, 22)
        pips(layer, MARGIN_X + 12, y, won, needed, kit.PLAYERS[seat], PIP)
    return layer.render()
