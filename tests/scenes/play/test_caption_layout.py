"""Captions cover neither each other nor a robot, even on a narrow starting grid."""

import pygame
import pytest

from pigaming_app.scenes.play.caption_layout import BODY, SCREEN, caption_places
from pigaming_app.scenes.views.background import LEFT, TOP

SIZE = (250, 68)
GRID = [(LEFT + x, TOP + y) for x, y in ((570, 55), (680, 55), (570, 150), (680, 150))]
CORNERS = [(LEFT + x, TOP + y) for x, y in ((40, 40), (1560, 40), (40, 860), (1560, 860))]


@pytest.mark.parametrize("robots", [GRID, CORNERS], ids=["grid", "corners"])
def test_no_caption_covers_another_caption_or_robot(robots: list[tuple[float, float]]) -> None:
    boxes = []
    for centre in caption_places(robots, [SIZE] * 4, [90.0] * 4):
        box = pygame.Rect((0, 0), SIZE)
        box.center = centre
        boxes.append(box)
    bodies = [pygame.Rect(round(x) - BODY, round(y) - BODY, 2 * BODY, 2 * BODY) for x, y in robots]
    for i, box in enumerate(boxes):
        assert SCREEN.contains(box)
        assert box.collidelist([*boxes[:i], *boxes[i + 1 :], *bodies]) < 0


def test_a_caption_with_room_is_above_or_below_its_robot_where_the_arena_has_more() -> None:
    robots = [(LEFT + 800.0, TOP + 100.0), (LEFT + 800.0, TOP + 800.0)]
    assert caption_places(robots, [SIZE] * 2, [90.0] * 2) == [(LEFT + 800, TOP + 190), (LEFT + 800, TOP + 710)]
