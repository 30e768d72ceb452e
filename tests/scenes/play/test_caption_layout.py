"""Captions cover neither each other nor a robot, even on a narrow starting grid."""

import pytest

from pigaming_app.scenes.play.caption_layout import ARENA, caption_boxes, robot_boxes
from pigaming_app.scenes.views.background import LEFT, TOP

SIZE = (250, 68)
GRID = [(LEFT + x, TOP + y) for x, y in ((570, 55), (680, 55), (570, 150), (680, 150))]
CORNERS = [(LEFT + x, TOP + y) for x, y in ((40, 40), (1560, 40), (40, 860), (1560, 860))]


@pytest.mark.parametrize("robots", [GRID, CORNERS], ids=["grid", "corners"])
def test_no_caption_covers_another_caption_or_robot(robots: list[tuple[float, float]]) -> None:
    boxes, bodies = caption_boxes(robots, [SIZE] * 4, [90.0] * 4), robot_boxes(robots)
    for i, box in enumerate(boxes):
        assert box.size == SIZE
        assert ARENA.contains(box)
        assert box.collidelist([*boxes[:i], *boxes[i + 1 :], *bodies]) < 0


def test_a_caption_with_room_is_above_or_below_its_robot_where_the_arena_has_more() -> None:
    robots = [(LEFT + 800.0, TOP + 100.0), (LEFT + 800.0, TOP + 800.0)]
    centres = [box.center for box in caption_boxes(robots, [SIZE] * 2, [90.0] * 2)]
    assert centres == [(LEFT + 800, TOP + 190), (LEFT + 800, TOP + 710)]
