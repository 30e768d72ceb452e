"""The stars of allies on the results page: they light up one after the other, each with a burst of sparks."""

import math
import random

import pygame

from pigaming_app.scenes.results.celebration import Spark
from pigaming_app.scenes.views.sprites.effects import SPARK_LEVELS, SPARK_TURNS, sparks
from pigaming_app.scenes.views.sprites.factory import star
from pigaming_app.ui.draw import FOCUS, LINE, STEEL, THIN, GlowCanvas
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.sprites import Batch, put, step
from pigaming_app.ui.draw.surface_cache import cached

STARS, R, HIGH = 3, 92, 232  # number; px: radius, height of the row
APART, POP, POPS = 0.5, 0.2, 4  # s from one star to the next; s in which one shrinks to its size, and its sizes then
BURST = 40  # sparks of a star


class StarRow:
    """`won` of three stars, centred at y in the columns from x, `w` px wide. `sparkle`: with sparks."""

    def __init__(self, won: int, x: float, y: float, w: float, sparkle: bool) -> None:
        self.won, self.y, self.sparkle = won, y, sparkle
        self.xs = [x + w * (2 * i + 1) / (2 * STARS) for i in range(STARS)]
        self.rng = random.Random()
        self.sparks: list[Spark] = []
        self.age = 0.0
        self.lit = 0

    def update(self, seconds: float) -> None:
        """Advance; the first star lights up at once."""
        self.age += seconds
        if self.lit < self.won and self.age >= self.lit * APART:
            if self.sparkle:
                self.sparks += [Spark(self.xs[self.lit], self.y, self.rng) for _ in range(BURST)]
            self.lit += 1
        self.sparks = [spark for spark in self.sparks if spark.move(seconds)]

    def draw(self, screen: pygame.Surface) -> None:
        """Draw empty and lit stars, then the sparks."""
        for i, x in enumerate(self.xs):
            pop = min(POPS - 1, int((self.age - i * APART) / POP * POPS))
            image = sign(pop) if i < self.lit else empty()
            image.draw(screen, round(x), round(self.y))
        light: Batch = []
        for spark in self.sparks:
            level = min(SPARK_LEVELS - 1, int(SPARK_LEVELS * (1 - spark.age / spark.life)))
            turn = step(math.atan2(spark.vy, spark.vx), SPARK_TURNS)
            put(light, sparks(FOCUS, spark.size, turn)[level], spark.x, spark.y)
        screen.fblits(light, pygame.BLEND_RGB_ADD)


@cached
def sign(pop: int) -> LitImage:
    """A star that has been won, larger for a smaller `pop` (0..POPS - 1)."""
    r = R * (1.0 + 0.5 * (1.0 - (pop + 1) / POPS))
    half = round(r) + 40
    ink = GlowCanvas(2 * half, 2 * half).set_transform(half, half)
    ink.fill(star(0, 0, r), FOCUS).line(star(0, 0, r), FOCUS, LINE, True)
    return LitImage(ink.lit(0.9), (-half, -half))


@cached
def empty() -> LitImage:
    """A star that has not been won."""
    half = R + 40
    ink = GlowCanvas(2 * half, 2 * half).set_transform(half, half)
    return LitImage(ink.line(star(0, 0, R), STEEL, THIN, True).lit(0.6), (-half, -half))
