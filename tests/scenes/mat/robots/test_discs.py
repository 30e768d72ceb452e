"""Discs of robots: even grey under every marker; and the blocks of a page around them stay readable and clickable."""

import math
import random
from math import hypot
from typing import cast

import pygame
import pytest

from pigaming_app.hardware.control.rig import Rig
from pigaming_app.scenes.mat.robots.avoid_discs import ROOM, BlockLayout, Circle, arrange, hit, near
from pigaming_app.scenes.mat.robots.marker_discs import DISC, RING, MarkerDiscs
from pigaming_app.sim.plant import Sighting
from pigaming_app.ui.draw import GREY
from pigaming_app.ui.input.controls import Controls

LID = 36  # px, radius


class Seen:
    """A rig with fixed sightings."""

    def __init__(self, *sightings: Sighting, wide: float = 0.0) -> None:
        self.sightings, self.wide = list(sightings), wide
        self.asked = 0.0

    def margin(self, robot: int, usual: float) -> float:
        return self.wide

    def sense(self, ahead: float = 0.0) -> list[Sighting]:
        self.asked = ahead
        return self.sightings


def lit(screen: pygame.Surface, seen: Seen, robots: set[int]) -> None:
    screen.fill((200, 255, 90))
    MarkerDiscs(cast(Rig, seen)).draw(screen, robots)


@pytest.mark.parametrize("gap", [2 * LID, 100, 150, 400])
def test_every_lid_is_lit_evenly_even_where_robots_touch(controls: Controls, gap: int) -> None:
    screen = pygame.Surface((1920, 1080))
    seen = Seen(Sighting(400.0, 300.0, 0.3, 0.0), Sighting(400.0 + gap, 300.0, 3.0, 0.0))
    lit(screen, seen, {0, 1})
    assert seen.asked > 0.0
    for sighting in seen.sightings:
        for x in range(-LID, LID + 1, 3):
            for y in range(-LID, LID + 1, 3):
                if hypot(x, y) <= LID:
                    assert screen.get_at((round(160 + sighting.x + x), round(140 + sighting.y + y)))[:3] == GREY


def test_ring_and_arrow_show_player_and_heading(controls: Controls) -> None:
    screen = pygame.Surface((1920, 1080))
    lit(screen, Seen(Sighting(400.0, 300.0, 0.0, 0.0)), {0})
    assert screen.get_at((560, 440 - RING))[2] > 150  # player 1 is blue
    assert screen.get_at((560, 440 - (DISC + RING) // 2))[:3] == (0, 0, 0)
    ahead = [screen.get_at((560 + x, 440 + y))[2] for x in range(90, 135) for y in range(-20, 21)]
    assert max(ahead) > 200


def test_a_wide_robot_stands_in_a_wide_disc(controls: Controls) -> None:
    screen = pygame.Surface((1920, 1080))
    lit(screen, Seen(Sighting(400.0, 300.0, 0.0, 0.0), wide=27.4), {0})
    assert screen.get_at((560, 440 - DISC - 26))[:3] == GREY
    assert screen.get_at((560, 440 - RING - 28))[2] > 150


def test_simulated_and_lost_robots_have_no_disc(controls: Controls) -> None:
    screen = pygame.Surface((1920, 1080))
    lit(screen, Seen(Sighting(400.0, 300.0, 0.0, 0.0), Sighting(900.0, 300.0, 0.0, 3.0)), {1})
    for x in (560, 1060):
        assert screen.get_at((x, 440))[:3] == (200, 255, 90)


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
