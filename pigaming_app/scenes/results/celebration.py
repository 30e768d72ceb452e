"""Light and confetti of the winner's moment."""

import math
import random
from collections.abc import Sequence

import pygame

from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.scenes.views.sprites.effects import SPARK_LEVELS, SPARK_SIZES, SPARK_TURNS, sparks
from pigaming_app.ui.draw import ADD, FOCUS, ICE, PRE, Color, GlowCanvas, Point
from pigaming_app.ui.draw.sprites import Batch, Sprite, put, step, trim
from pigaming_app.ui.draw.surface_cache import cached

BURST = 36  # sparks per burst
FALL = 260.0  # px/s², of sparks
VOLLEY = 44  # pieces of confetti from each side
GRAVITY, DRAG, SINK = 1100.0, 1.1, 210.0  # px/s², 1/s, and px/s at which confetti sinks at most
TUMBLES = 6  # views of a tumbling piece
SIZES = (11, 15)  # px


class Spark:
    """A spark that flies, falls and fades."""

    def __init__(self, x: float, y: float, chance: random.Random) -> None:
        angle, speed = chance.uniform(0, math.tau), 60 + 300 * chance.random()
        self.x, self.y, self.vx, self.vy = x, y, math.cos(angle) * speed, math.sin(angle) * speed - 120
        self.size, self.life, self.age = chance.choice(SPARK_SIZES), chance.uniform(0.5, 1.1), 0.0

    def move(self, seconds: float) -> bool:
        """Advance by `seconds`; False once it has faded."""
        self.age += seconds
        self.x, self.y, self.vy = self.x + self.vx * seconds, self.y + self.vy * seconds, self.vy + FALL * seconds
        return self.age < self.life


class Piece:
    """A piece of confetti: shot up from a lower corner, then sinking, swaying and tumbling."""

    def __init__(self, side: int, color: Color, shape: int, chance: random.Random) -> None:
        self.x, self.y = 960 + side * 980.0, 1000.0
        self.vx, self.vy = -side * chance.uniform(250, 1500), -chance.uniform(800, 1750)
        self.color, self.shape, self.size = color, shape, chance.choice(SIZES)
        self.phase, self.rate = chance.uniform(0, math.tau), chance.uniform(5, 11)
        self.age = 0.0

    def move(self, seconds: float) -> bool:
        """Advance by `seconds`; False once it is below the picture."""
        self.age += seconds
        slower = max(0.0, 1.0 - DRAG * seconds)
        self.vx, self.vy = self.vx * slower, min(SINK, self.vy * slower + GRAVITY * seconds)
        sway = 60 * math.cos(3 * self.age + self.phase) if self.vy > 0 else 0.0
        self.x, self.y = self.x + (self.vx + sway) * seconds, self.y + self.vy * seconds
        return self.y < 1100

    @property
    def tumble(self) -> int:
        """The present view, 0..TUMBLES - 1."""
        return int((self.phase + self.rate * self.age) / math.tau * TUMBLES) % TUMBLES


class Celebration:
    """Sparks and confetti in the look of a game. `players`: the celebrated seats; `colors`: theirs or their team's."""

    def __init__(self, game: str, players: Sequence[int], colors: Sequence[Color]) -> None:
        self.game, self.players = game, list(players)
        self.colors = [*colors, *colors, FOCUS, ICE]
        self.rng = random.Random()
        self.sparks: list[tuple[Spark, Color]] = []
        self.pieces: list[Piece] = []

    def burst(self, x: float, y: float, color: Color) -> None:
        """Sparks round a point."""
        self.sparks += [(Spark(x, y, self.rng), color) for _ in range(BURST)]

    def volley(self) -> None:
        """Shoot confetti from both lower corners."""
        for side in (-1, 1):
            for _ in range(VOLLEY):
                shape = self.rng.choice(self.players)
                self.pieces.append(Piece(side, self.rng.choice(self.colors), shape, self.rng))

    def update(self, seconds: float) -> None:
        self.sparks = [(spark, color) for spark, color in self.sparks if spark.move(seconds)]
        self.pieces = [piece for piece in self.pieces if piece.move(seconds)]

    def draw(self, screen: pygame.Surface) -> None:
        light: Batch = []
        for spark, color in self.sparks:
            level = min(SPARK_LEVELS - 1, int(SPARK_LEVELS * (1 - spark.age / spark.life)))
            turn = step(math.atan2(spark.vy, spark.vx), SPARK_TURNS)
            put(light, sparks(color, spark.size, turn)[level], spark.x, spark.y)
        screen.fblits(light, ADD)
        paper: Batch = []
        for piece in self.pieces:
            put(paper, confetti(self.game, piece.shape, piece.color, piece.size, piece.tumble), piece.x, piece.y)
        screen.fblits(paper, PRE)


@cached
def confetti(game: str, shape: int, color: Color, size: int, tumble: int) -> Sprite:
    """A piece in a view of its tumbling."""
    half = size + 10
    ink = GlowCanvas(2 * half, 2 * half)
    flat, turn = 0.3 + 0.7 * abs(math.cos(tumble * math.pi / TUMBLES)), 0.5 + tumble * math.pi / TUMBLES
    c, s = math.cos(turn), math.sin(turn)

    def placed(points: list[Point]) -> list[Point]:
        return [(half + x * c - flat * y * s, half + x * s + flat * y * c) for x, y in points]

    SCREENS[game].confetti(ink, placed, size, shape, color)
    return trim(ink.sprite(0.5), half, half)
