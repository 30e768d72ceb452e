"""League of the robot's checkpoints at 0, 10, 50 and 200 matches, its present state and the hand-made robot.

Round robin, a few ticks per frame; the table is sorted while matches finish.
"""

from dataclasses import dataclass
from itertools import combinations
from time import perf_counter

import pygame

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.learning.evaluation import HANDMADE, Evaluation
from pigaming_app.ai.learning.training import GAME
from pigaming_app.ai.registry import BRAINS
from pigaming_app.scenes.flow.scene import Pop, StackOperation
from pigaming_app.scenes.lab.host import IDLE, LabHost
from pigaming_app.scenes.lab.layout import GOOD, NOTHING
from pigaming_app.scenes.pages.page import Page
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, STEEL, SUB, THIN, cut_box, icon
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button

MATCHES = {True: 10, False: 2}  # matches per pair, compiled and interpreted
MINUTES = 1.0
SEED = 3000
SLICE = 0.005  # s per frame
TICKS = 60  # ticks between two checks of the clock
TOP, PITCH, HIGH = 292, 104, 88
COLUMNS = (("won", 1130), ("tied", 1330), ("lost", 1540), ("points", 1772))  # px, right edges
WIN, TIE = 3, 1  # points
GLIDE = 8.0  # 1/s, rate at which a row approaches its new position


@dataclass
class Contender:
    """Row of the table."""

    name: str
    kind: BrainKind
    own: bool = True  # checkpoint of this training
    won: int = 0
    tied: int = 0
    lost: int = 0
    y: float = 0.0

    @property
    def points(self) -> int:
        return WIN * self.won + TIE * self.tied


class ComparePage(Page):
    """League of one training."""

    title, idle, when_idle = "lab.compare_title", IDLE, Pop()
    closing = Button.FIRE, Button.START
    hints = ((Button.BACK, "lab.hint_lab"),)

    def __init__(self, lab: LabHost) -> None:
        super().__init__(lab.context)
        self.lab = lab
        words, trainer = self.context.words, lab.trainer
        checkpoints = trainer.checkpoints()
        self.players = [Contender(words("lab.after", matches=n), checkpoints[n].kind) for n in sorted(checkpoints)]
        now = trainer.snapshot.matches
        if now not in checkpoints:
            self.players.append(Contender(words("lab.now", matches=now), trainer.checkpoint("now").kind))
        self.players.append(Contender(words("lab.handmade"), BRAINS[GAME][HANDMADE], own=False))
        for i, player in enumerate(self.players):
            player.y = TOP + PITCH * i
        self.pairs = list(combinations(self.players, 2))
        self.whole = len(self.pairs)
        self.exam: Evaluation | None = None

    def advance(self, seconds: float) -> StackOperation:
        """Advance the matches within the time slice, and animate the rows."""
        end = perf_counter() + SLICE
        while self.pairs and perf_counter() < end:
            self._play()
        for row, player in enumerate(self.order()):
            offset = TOP + PITCH * row - player.y
            player.y += offset * min(1.0, GLIDE * seconds) if abs(offset) > 1.0 else offset
        return None

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the table."""
        words = self.context.words
        for key, right in COLUMNS:
            text(words(f"lab.{key}"), BODY, MIST, "body", "r").draw(screen, right, 244)
        best = self.order()[0] if not self.pairs else None
        for player in self.players:
            row(player.name, player.own, player is best).draw(screen, LEFT, player.y)
            for (_, right), number in zip(COLUMNS, (player.won, player.tied, player.lost, player.points), strict=True):
                big = right == COLUMNS[-1][1]
                color = FOCUS if player is best else ICE if big else MIST
                text(str(number), SUB if big else LABEL, color, "head", "r").draw(screen, right, player.y + HIGH / 2)
        if self.pairs:
            self._bar(screen)

    def order(self) -> list[Contender]:
        """The entrants by points, best first; stable for ties."""
        return sorted(self.players, key=lambda player: -player.points)

    # ---- inside

    def _play(self) -> None:
        first, second = self.pairs[0]
        if self.exam is None:
            fast, arena = self.lab.trainer.fast, self.lab.trainer.arena
            self.exam = Evaluation(first.kind, second.kind, MATCHES[fast], SEED, MINUTES, arena, fast)
        self.exam.play(TICKS)
        if self.exam.over:
            exam, self.exam = self.exam, None
            self.pairs.pop(0)
            for entrant, wins, losses in ((first, exam.wins, exam.losses), (second, exam.losses, exam.wins)):
                entrant.won, entrant.lost = entrant.won + wins, entrant.lost + losses
                entrant.tied += exam.ties
            if not self.pairs:
                self.context.sounds.play("win")

    def _bar(self, screen: pygame.Surface) -> None:
        """Draw the progress bar."""
        done = (self.whole - len(self.pairs)) / self.whole
        box = pygame.Rect(LEFT, 926, RIGHT - LEFT, 10)
        screen.fill(NOTHING, box)
        screen.fill(GOOD, (box.x, box.y, round(box.w * done), box.h))


@cached
def row(name: str, own: bool, best: bool) -> LitImage:
    """Row without its numbers; top left at (0, 0)."""
    w = RIGHT - LEFT
    layer = Layer(0, 0, w, HIGH)
    layer.glow.line(cut_box(0, 0, w, HIGH, 14), FOCUS if best else STEEL, THIN, True)
    icon(layer.glow, "crown" if best else "ai", 62, HIGH / 2, 26, FOCUS if best else MIST, THIN)
    color = FOCUS if best else ICE if own else MIST
    layer.canvas.body(name, 124, HIGH / 2, color, "l", fit_size(name, LABEL, 780, "body"))
    return layer.render()
