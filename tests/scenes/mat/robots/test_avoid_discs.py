"""Layout of the robots' page around four robots: every block stays readable and clickable."""

import math
import random

import pygame
import pytest

from pigaming_app.scenes.mat.robots.avoid_discs import ROOM, BlockLayout, Circle, arrange, hit, near

ROWS = pygame.Rect(72, 192, 1180, 628)  # seven rows
ROBOTS = pygame.Rect(1256, 202, 576, 502)
LINE = pygame.Rect(1256, 706, 576, 160)
HINTS = pygame.Rect(400, 940, 1100, 80)
SENTENCE = pygame.Rect(150, 866, 1620, 84)
PAGE = [ROWS, ROBOTS, LINE, HINTS, SENTENCE]


def standing(chance: random.Random) -> list[Circle]:
    """Four robots at random positions, with their arrows and tags."""
    found: list[Circle] = []
    for _ in range(4):
        x, y, a = 160 + chance.uniform(45, 1555), 140 + chance.uniform(45, 855), chance.uniform(0.0, math.tau)
        c, s = math.cos(a), math.sin(a)
        found += [(x, y, 95.0), (x + 110 * c, y + 110 * s, 40.0), (x - 122 * c, y - 122 * s, 40.0)]
    return found


def test_without_robots_everything_is_at_home() -> None:
    assert [(block.at, block.scale) for block in arrange(PAGE[:4], [])] == [(home.topleft, 1.0) for home in PAGE[:4]]


@pytest.mark.parametrize("seed", range(40))
def test_wherever_robots_stand_no_block_is_hidden_nor_over_another_one(seed: int) -> None:
    discs = standing(random.Random(seed))
    placed = arrange(PAGE, discs)
    assert not hit(placed, discs)
    boxes = [block.box for block in placed]
    assert all(ROOM.contains(box) for box in boxes)
    assert not [(a, b) for i, a in enumerate(boxes) for b in boxes[:i] if a.colliderect(b)]
    assert placed[0].scale >= 0.5, "40 px text is at least 20 px"


def test_a_block_stays_until_a_robot_reaches_it_and_comes_home_when_all_have_gone() -> None:
    aside, page = BlockLayout(), PAGE[:4]
    aside.update(0.1, page, [(600.0, 400.0, 95.0)])
    first = aside.placed
    assert not hit(first, [(600.0, 400.0, 95.0)])
    aside.update(1.0, page, [(590.0, 400.0, 95.0)])
    assert aside.placed == first
    aside.update(1.0, page, [])
    assert [block.at for block in aside.placed] == [home.topleft for home in page]


def test_a_click_means_what_is_shown_there() -> None:
    aside = BlockLayout()
    aside.update(0.1, PAGE, standing(random.Random(3)))
    for block in aside.placed:
        x, y = aside.back(block.box.center)
        assert abs(x - block.home.centerx) < 2
        assert abs(y - block.home.centery) < 2
    empty = next(
        (x, y)
        for x in range(0, 1920, 40)
        for y in range(200, 1080, 40)
        if not any(block.box.collidepoint(x, y) for block in aside.placed)
    )
    assert aside.back(empty) == (-1.0, -1.0)


def test_a_disc_reaches_a_box_round_its_corner_too() -> None:
    box = pygame.Rect(100, 100, 50, 50)
    assert near(box, (160.0, 160.0, 15.0))
    assert not near(box, (162.0, 162.0, 15.0))
