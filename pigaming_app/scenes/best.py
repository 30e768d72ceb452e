"""The best of an arena, in two tables: today's beside that of all time, or of two feats, such as lap and race."""

from collections.abc import Iterator, Sequence

import pygame

from pigaming_app.games.arenas import load
from pigaming_app.games.game import Feat
from pigaming_app.scenes.feats import boards, told
from pigaming_app.scenes.frame_budget import budget
from pigaming_app.scenes.house import House
from pigaming_app.scenes.ink import FOCUS, ICE, LABEL, LINE, MIST, STEEL, SUB, THIN, TITLE, icon, panel
from pigaming_app.scenes.pane import LEFT, RIGHT, Lit, Pane, backdrop, fitted, span
from pigaming_app.scenes.press import Act, Press
from pigaming_app.scenes.prompts import Prompts
from pigaming_app.scenes.stack import Pop, Turn
from pigaming_app.scores import Score

ROWS = 8
TOP, PITCH = 316, 72
STAY = 12.0  # seconds
DEAF = 0.4  # seconds in which presses are ignored
APART, WIPE = 0.07, 0.25  # seconds from row to row, for one row


class Best:
    """Both tables; `fresh`: the rows that have just come in, shown in yellow."""

    def __init__(self, house: House, game: str, arena: str, goal: int, fresh: Sequence[Score] = ()) -> None:
        self.house, self.game, self.arena, self.goal, self.fresh = house, game, arena, goal, list(fresh)
        self.age = 0.0
        self.lit: list[tuple[float, Lit]] = []
        self.pieces = self._make()
        self.prompts = Prompts(house, [(Act.FIRE, "results.on")])

    def entered(self) -> None:
        """Nothing to begin."""

    def on(self, press: Press) -> Turn:
        """Any button leads on."""
        press = self.prompts.meant(press)
        if self.age > DEAF and press.act in (Act.FIRE, Act.START, Act.BACK, Act.ALT, Act.CLICK):
            self.house.sounds.play("back")
            return Pop()
        return None

    def update(self, seconds: float) -> Turn:
        """Stay a while."""
        self.age += seconds
        return Pop() if self.age > STAY else None

    def draw(self, screen: pygame.Surface) -> None:
        """Paint the tables and what leads on."""
        self.paint(screen)
        self.prompts.draw(screen)

    def paint(self, screen: pygame.Surface) -> None:
        """Paint the tables alone; their rows come in one after the other."""
        for piece in self.pieces:
            self.lit.append(piece)
            budget.pause()
        screen.blit(backdrop(), (0, 0))
        for begins, lit in self.lit:
            share = min(1.0, (self.age - begins) / WIPE)
            lit.draw(screen, share=1 - (1 - share) ** 2)

    def _make(self) -> Iterator[tuple[float, Lit]]:
        """One piece of the page after the other, and the second at which each comes in."""
        words = self.house.words
        pane = Pane(LEFT, 54, RIGHT - LEFT, 130)
        pane.page.text(words("results.scores"), TITLE, LEFT, 112)
        title = load(self.game, self.arena).title.get(words.language, self.arena)
        where = f"{words('games.' + self.game)}  ·  {title}"
        pane.page.body(where, RIGHT, 112, MIST, "r", fitted(where, 40, 800, "body"))
        pane.hot.line([(LEFT, 176), (RIGHT, 176)], STEEL, THIN).line([(LEFT, 176), (LEFT + 218, 176)], FOCUS, LINE)
        yield 0.0, pane.done()
        for first, board in zip((0, 6), boards(self.game, self.arena, self.goal), strict=True):
            x, w = span(first, 6)
            rows = self.house.scores.best(self.game, board.table, board.days)[:ROWS]
            head = Pane(x, 216, w, 670)
            panel(head.hot, x, 276, w, 24 + PITCH * ROWS + 8, STEEL, THIN)
            head.page.text(words(board.heading, goal=self.goal), LABEL, x, 236, ICE)
            yield 0.1, head.done()
            for i in range(ROWS):
                row = rows[i] if i < len(rows) else None
                yield 0.2 + APART * i, self._row(row, board.feat, i, x, w)

    def _row(self, row: Score | None, feat: Feat, i: int, x: int, w: int) -> Lit:
        y = TOP + PITCH * i + PITCH // 2 - 20
        pane = Pane(x, y - 36, w, 72)
        color = FOCUS if row in self.fresh else ICE if i == 0 and row else MIST
        pane.page.cold.text(str(i + 1), LABEL, x + 84, y, color, "head", "r")
        if row is None:
            pane.page.cold.line([(x + 150, y), (x + 300, y)], STEEL, THIN)
            return pane.done()
        pane.page.text(row.initials, SUB, x + 150, y, color, "hero")
        if row in self.fresh:
            icon(pane.hot, "left", x + 420, y, 20, FOCUS, LINE)
        pane.page.text(told(row.score, feat), SUB, x + w - 48, y, color, "hero", "r")
        return pane.done()
