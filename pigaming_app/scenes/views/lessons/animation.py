"""Shared parts of the lesson pictures: closed paths, additive sprites, a robot with its treads."""

import math
from dataclasses import dataclass

import pygame

from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.ui.draw import ADD, Point
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, step
from pigaming_app.ui.widgets.labels import blit_sprite

TREADS, TREAD_GAP = 16, 18.0  # marks behind the robot, and px between them


@dataclass(frozen=True)
class Loop:
    """A closed path, clockwise round (0, 0): the sides of a `w` x `h` px box, joined by arcs of radius `bend`."""

    w: float
    h: float
    distort: float

    @property
    def straights(self) -> tuple[float, float]:
        """Lengths of the horizontal and of the vertical straights, px."""
        return self.w - 2 * self.distort, self.h - 2 * self.distort

    @property
    def length(self) -> float:
        """Perimeter, px."""
        return 2 * sum(self.straights) + math.tau * self.distort

    def at(self, way: float) -> tuple[float, float, float, bool]:
        """x, y, heading (rad) and whether it turns, `way` px from the left end of the upper straight."""
        across, down = self.straights
        way %= self.length
        corners = ((1, -1), (1, 1), (-1, 1), (-1, -1))
        for i, straight in enumerate((across, down, across, down)):
            heading = i * math.pi / 2
            cx, cy = corners[i][0] * across / 2, corners[i][1] * down / 2  # centre of the following bend
            nx, ny = math.sin(heading) * self.distort, -math.cos(heading) * self.distort
            if way < straight:
                back = straight - way
                return cx + nx - back * math.cos(heading), cy + ny - back * math.sin(heading), heading, False
            way -= straight
            if way < self.distort * math.pi / 2:
                a = heading + way / self.distort
                return cx + math.sin(a) * self.distort, cy - math.cos(a) * self.distort, a, True
            way -= self.distort * math.pi / 2
        return nx, ny, 0.0, False

    def outline(self, out: float, points: int = 120) -> list[Point]:
        """The path offset outwards by `out` px, as `points` points."""
        outline_points = []
        for i in range(points):
            x, y, heading, _ = self.at(i * self.length / points)
            outline_points.append((x + out * math.sin(heading), y - out * math.cos(heading)))
        return outline_points


def add(screen: pygame.Surface, sprite: Sprite, x: float, y: float) -> None:
    """Add a light sprite with its anchor at (x, y)."""
    screen.blit(sprite.image, (round(x + sprite.dx), round(y + sprite.dy)), special_flags=ADD)


def drive_round(screen: pygame.Surface, player: int, loop: Loop, x: float, y: float, way: float) -> bool:
    """Draw a robot with treads and light, `way` px along a loop round (x, y); true if it is turning."""
    for i in range(TREADS, 0, -1):
        tx, ty, heading, _ = loop.at(way - 20 - i * TREAD_GAP)
        level = max(1, effects.TREAD_LEVELS * (TREADS - i) // TREADS)
        add(screen, effects.tread(player, step(heading, effects.TURNS), level), x + tx, y + ty)
    rx, ry, heading, turning = loop.at(way)
    add(screen, effects.beam(player, step(heading, effects.BEAM_TURNS)), x + rx, y + ry)
    blit_sprite(screen, tank(player, step(heading, HEADINGS)), x + rx, y + ry)
    return turning


def drive_by(screen: pygame.Surface, player: int, x: float, y: float, way: float) -> None:
    """Draw a robot at (x, y) that has driven `way` px to the right, with its treads."""
    for i in range(min(TREADS, int(way / TREAD_GAP)), 0, -1):
        level = max(1, effects.TREAD_LEVELS * (TREADS - i) // TREADS)
        add(screen, effects.tread(player, 0, level), x - 20 - i * TREAD_GAP, y)
    add(screen, effects.beam(player, 0), x, y)
    blit_sprite(screen, tank(player, 0), x, y)
