"""Layout of the drivers' captions beside their robots, so that they cover neither each other nor a robot."""

from collections.abc import Sequence

import pygame

from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.sim.world import HEIGHT, RADIUS, WIDTH

ARENA = pygame.Rect(LEFT + 24, TOP, int(WIDTH) - 48, int(HEIGHT))
BODY = 8  # px between a robot and its box


def robot_boxes(robots: Sequence[tuple[float, float]], radius: float = RADIUS) -> list[pygame.Rect]:
    """The box of each robot. `robots`: positions on the canvas, px."""
    half = round(radius) + BODY
    return [pygame.Rect(round(x) - half, round(y) - half, 2 * half, 2 * half) for x, y in robots]


def caption_boxes(
    robots: Sequence[tuple[float, float]],
    sizes: Sequence[tuple[int, int]],
    reach: Sequence[float],
    radius: float = RADIUS,
) -> list[pygame.Rect]:
    """The box of each robot's caption, on the canvas, px.

    `robots`: positions on the canvas; `sizes`: width and height of each caption; `reach`: vertical distance of each
    caption from its robot. A caption is above or below its robot, where the arena has more room, unless it would cover
    another caption or robot there and less of them at another side.
    """
    bodies = robot_boxes(robots, radius)
    placed: list[pygame.Rect] = []
    for (x, y), size, offset in zip(robots, sizes, reach, strict=True):
        near = offset if y < TOP + HEIGHT / 2 else -offset
        beside = round(radius) + BODY + 12 + size[0] / 2
        side = beside if x < LEFT + WIDTH / 2 else -beside
        shifts = ((0, near), (0, -near), (side, 0), (-side, 0), (0, near + near / abs(near) * size[1]))
        boxes = []
        for dx, dy in shifts:
            box = pygame.Rect((0, 0), size)
            box.center = round(x + dx), round(y + dy)
            boxes.append(box.clamp(ARENA))
        placed.append(min(boxes, key=lambda box: sum(_overlap(box, other) for other in (*placed, *bodies))))
    return placed


def _overlap(box: pygame.Rect, other: pygame.Rect) -> int:
    common = box.clip(other)
    return common.w * common.h
