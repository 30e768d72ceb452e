"""Marker discs: even grey under every marker, whatever the game draws and wherever other robots are."""

from math import hypot
from typing import cast

import pygame
import pytest

from pigaming_app.hardware.control.rig import Rig
from pigaming_app.scenes.mat.robots.marker_discs import DISC, RING, MarkerDiscs
from pigaming_app.sim.plant import Sighting
from pigaming_app.ui.draw import GREY
from pigaming_app.ui.input.controls import Controls

LID = 36  # px, radius


class Seen:
    """A rig with fixed sightings."""

    def __init__(self, *sightings: Sighting) -> None:
        self.sightings = list(sightings)
        self.asked = 0.0

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


def test_simulated_and_lost_robots_have_no_disc(controls: Controls) -> None:
    screen = pygame.Surface((1920, 1080))
    lit(screen, Seen(Sighting(400.0, 300.0, 0.0, 0.0), Sighting(900.0, 300.0, 0.0, 3.0)), {1})
    for x in (560, 1060):
        assert screen.get_at((x, 440))[:3] == (200, 255, 90)
