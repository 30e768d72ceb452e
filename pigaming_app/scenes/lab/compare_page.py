"""A small league of what the robot knew after 0, 10, 50 and 200 matches, what it knows now, and the hand-made robot.

Everyone plays everyone, a little in every frame; the table sorts itself while the matches come in.
"""

from dataclasses import dataclass
from itertools import combinations
from time import perf_counter

import pygame

from pigaming_app.ai import BRAINS
from pigaming_app.ai.brain.kind import Kind
from pigaming_app.ai.experiments.evaluation import HANDMADE, Exam
from pigaming_app.ai.experiments.training import GAME
from pigaming_app.scenes.flow.stack import Pop, Turn
from pigaming_app.scenes.lab.bench import IDLE, LabHost
from pigaming_app.scenes.lab.layout import GOOD, NOTHING
from pigaming_app.ui.draw import BODY, FOCUS, ICE, LABEL, MIST, STEEL, SUB, THIN, cut_box, icon
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, backdrop
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size, text
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.labels import heading

MATCHES = {True: 10, False: 2}  # of every two, compiled and plain
MINUTES = 1.0
SEED = 3000
SLICE = 0.005  # seconds of a frame
TICKS = 60  # between two looks at the clock
TOP, PITCH, HIGH = 292, 104, 88
COLUMNS = (("won", 1130), ("tied", 1330), ("lost", 1540), ("points", 1772))  # right edges, px
WIN, TIE = 3, 1  # points, as in football
GLIDE = 8.0  # of the way to its new place that a row goes in a second


@dataclass
class Entrant:
    """One row of the table."""

    name: str
    kind: Kind
    own: bool = True  # a robot of this training
    won: int = 0
    tied: int = 0
    lost: int = 0
    y: float = 0.0

    @property
    def points(self) -> int:
        return WIN * self.won + TIE * self.tied


class ComparePage:
    """The league of one training."""

    def __init__(self, lab: LabHost) -> None:
        self.lab, self.context = lab, lab.context
        words, trainer = self.context.words, lab.trainer
        kept = trainer.checkpoints()
        self.players = [Entrant(words("lab.after", matches=n), kept[n].kind) for n in sorted(kept)]
        now = trainer.moment.matches
        if now not in kept:
            self.players.append(Entrant(words("lab.now", matches=now), trainer.checkpoint("now").kind))
        self.players.append(Entrant(words("lab.handmade"), BRAINS[GAME][HANDMADE], own=False))
        for i, player in enumerate(self.players):
            player.y = TOP + PITCH * i
        self.pairs = list(combinations(self.players, 2))
        self.whole = len(self.pairs)
        self.exam: Exam | None = None
        self.prompts = self.context.prompts([(Button.BACK, "lab.hint_lab")])

    def entered(self) -> None:
        """Nothing to begin."""

    def on(self, event: InputEvent) -> Turn:
        """Any button leads back."""
        event = self.prompts.as_button(event)
        if event.button in (Button.BACK, Button.FIRE, Button.START):
            self.context.sounds.play("back")
            return Pop()
        return None

    def update(self, seconds: float) -> Turn:
        """Play on for some milliseconds, and let the rows glide."""
        if self.context.idle > IDLE:
            return Pop()
        end = perf_counter() + SLICE
        while self.pairs and perf_counter() < end:
            self._play()
        for row, player in enumerate(self.order()):
            away = TOP + PITCH * row - player.y
            player.y += away * min(1.0, GLIDE * seconds) if abs(away) > 1.0 else away
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """Paint the table."""
        words = self.context.words
        screen.blit(backdrop(), (0, 0))
        heading(words("lab.compare_title")).draw(screen)
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
        self.prompts.draw(screen)

    def order(self) -> list[Entrant]:
        """The players, the best first; equals as they were."""
        return sorted(self.players, key=lambda player: -player.points)

    # ---- inside

    def _play(self) -> None:
        one, other = self.pairs[0]
        if self.exam is None:
            fast, arena = self.lab.trainer.fast, self.lab.trainer.training.arena
            self.exam = Exam(one.kind, other.kind, MATCHES[fast], SEED, MINUTES, arena, fast)
        self.exam.play(TICKS)
        if self.exam.over:
            exam, self.exam = self.exam, None
            self.pairs.pop(0)
            one.won, one.tied, one.lost = one.won + exam.wins, one.tied + exam.ties, one.lost + exam.losses
            other.won, other.tied, other.lost = other.won + exam.losses, other.tied + exam.ties, other.lost + exam.wins
            if not self.pairs:
                self.context.sounds.play("win")

    def _bar(self, screen: pygame.Surface) -> None:
        """How much has been played."""
        done = (self.whole - len(self.pairs)) / self.whole
        box = pygame.Rect(LEFT, 926, RIGHT - LEFT, 10)
        screen.fill(NOTHING, box)
        screen.fill(GOOD, (box.x, box.y, round(box.w * done), box.h))


@cached
def row(name: str, own: bool, best: bool) -> LitImage:
    """A row without its numbers; upper left at (0, 0)."""
    w = RIGHT - LEFT
    layer = Layer(0, 0, w, HIGH)
    layer.glow.line(cut_box(0, 0, w, HIGH, 14), FOCUS if best else STEEL, THIN, True)
    icon(layer.glow, "crown" if best else "ai", 62, HIGH / 2, 26, FOCUS if best else MIST, THIN)
    color = FOCUS if best else ICE if own else MIST
    layer.canvas.body(name, 124, HIGH / 2, color, "l", fit_size(name, LABEL, 780, "body"))
    return layer.done()
