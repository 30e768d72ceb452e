"""Victory animation on the results page: the winner drives along the title line and spins, with sparks."""

import math
import random

import pygame

from pigaming_app.scenes.views.sprites.effects import SPARK_LEVELS, SPARK_SIZES, SPARK_TURNS, sparks
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.ui.draw import PLAYERS
from pigaming_app.ui.draw.layers import LEFT, RIGHT
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, put, step

Y = 176  # px, the line
DRIVE = 2.0  # s along the line
SPIN = 1.4  # s per spin
REST = 6.0  # s between spins
BURST = 36  # sparks per burst
FALL = 260.0  # px/s²


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


class Celebration:
    """Victory animation of `player` at (x, y), the position of its crown. `sparks`: include bursts of light."""

    def __init__(self, player: int, x: float, y: float, sparks: bool) -> None:
        self.player, self.x, self.y = player, x, y
        self.rng = random.Random()
        self.bursts = [0.0, 0.5, 1.1, 2.0, 3.2] if sparks else []
        self.sparks: list[Spark] = []
        self.age = 0.0

    def update(self, seconds: float) -> None:
        self.age += seconds
        while self.bursts and self.bursts[0] <= self.age:
            self.bursts.pop(0)
            x, y = self.x + self.rng.uniform(-160, 160), self.y + self.rng.uniform(-20, 30)
            self.sparks += [Spark(x, y, self.rng) for _ in range(BURST)]
        self.sparks = [spark for spark in self.sparks if spark.move(seconds)]

    @property
    def reach(self) -> float:
        """Position of the winner along the line, px from its left end."""
        share = min(1.0, self.age / DRIVE)
        return (1.0 - (1.0 - share) ** 2) * (RIGHT - 40 - LEFT)

    def draw(self, screen: pygame.Surface) -> None:
        """Draw sparks and winner."""
        color = PLAYERS[self.player]
        light: Batch = []
        for spark in self.sparks:
            level = min(SPARK_LEVELS - 1, int(SPARK_LEVELS * (1 - spark.age / spark.life)))
            turn = step(math.atan2(spark.vy, spark.vx), SPARK_TURNS)
            put(light, sparks(color, spark.size, turn)[level], spark.x, spark.y)
        screen.fblits(light, pygame.BLEND_RGB_ADD)
        dancing = self.age - DRIVE
        angle = math.tau * min(1.0, dancing % REST / SPIN) if dancing > 0 else 0.0
        robot: Batch = []
        put(robot, tank(self.player, step(angle, HEADINGS)), LEFT + self.reach, Y)
        screen.fblits(robot, pygame.BLEND_PREMULTIPLIED)
