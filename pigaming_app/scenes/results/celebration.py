"""A celebration on the results: the winner drives along the line under its name and turns for joy, and sparks fly."""

import math
import random

import pygame

from pigaming_app.scenes.views.sprites.effects import SPARK_LEVELS, SPARK_SIZES, SPARK_TURNS, sparks
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.ui.draw import PLAYERS
from pigaming_app.ui.draw.layers import LEFT, RIGHT
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, put, step

Y = 176  # of the line, px
DRIVE = 2.0  # seconds along the line
SPIN = 1.4  # seconds for a turn
REST = 6.0  # seconds from turn to turn
BURST = 36  # sparks at once
FALL = 260.0  # px/s²


class Spark:
    """One spark: it flies, falls and goes out."""

    def __init__(self, x: float, y: float, chance: random.Random) -> None:
        angle, speed = chance.uniform(0, math.tau), 60 + 300 * chance.random()
        self.x, self.y, self.vx, self.vy = x, y, math.cos(angle) * speed, math.sin(angle) * speed - 120
        self.size, self.life, self.age = chance.choice(SPARK_SIZES), chance.uniform(0.5, 1.1), 0.0

    def move(self, seconds: float) -> bool:
        """Fly on; false when it has gone out."""
        self.age += seconds
        self.x, self.y, self.vy = self.x + self.vx * seconds, self.y + self.vy * seconds, self.vy + FALL * seconds
        return self.age < self.life


class Celebration:
    """The winner `player` celebrates near (x, y), where its crown is. `sparks`: bursts of light are wanted."""

    def __init__(self, player: int, x: float, y: float, sparks: bool) -> None:
        self.player, self.x, self.y = player, x, y
        self.chance = random.Random()
        self.bursts = [0.0, 0.5, 1.1, 2.0, 3.2] if sparks else []
        self.sparks: list[Spark] = []
        self.age = 0.0

    def update(self, seconds: float) -> None:
        """Let it go on."""
        self.age += seconds
        while self.bursts and self.bursts[0] <= self.age:
            self.bursts.pop(0)
            x, y = self.x + self.chance.uniform(-160, 160), self.y + self.chance.uniform(-20, 30)
            self.sparks += [Spark(x, y, self.chance) for _ in range(BURST)]
        self.sparks = [spark for spark in self.sparks if spark.move(seconds)]

    @property
    def reach(self) -> float:
        """How far along the line the winner is, px from its left end."""
        share = min(1.0, self.age / DRIVE)
        return (1.0 - (1.0 - share) ** 2) * (RIGHT - 40 - LEFT)

    def draw(self, screen: pygame.Surface) -> None:
        """Add sparks and winner to the screen."""
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
