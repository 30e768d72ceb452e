"""The looks of a match: the colours of the teams, the size of the score."""

import math
from typing import cast

import pygame
import pytest

from pigaming_app.hardware.control.rig import Rig
from pigaming_app.scenes.mat.robots.marker_discs import RING, MarkerDiscs
from pigaming_app.sim.plant import Sighting
from pigaming_app.ui.draw.theme import read_large
from tests.football.pitch import match, put_robot
from tests.football.test_view import view_of

ICE, FIRE = (70, 210, 255), (255, 150, 40)  # as Robot Factory has them
GREEN, PINK = (20, 228, 140), (255, 144, 214)  # players 3 and 4
pytestmark = pytest.mark.usefixtures("_glow")


@pytest.fixture
def screen():
    pygame.display.init()
    pygame.font.init()
    return pygame.display.set_mode((1920, 1080))


def near(pixel, color, tolerance=40):
    return max(abs(a - b) for a, b in zip(pixel[:3], color, strict=True)) <= tolerance


def share(screen, x, y, radius, color):
    """The share of a circle around a point of the arena, px, that has a colour."""
    turns = [i * math.tau / 360 for i in range(360)]
    pixels = [
        screen.get_at((round(160 + x + radius * math.cos(a)), round(140 + y + radius * math.sin(a)))) for a in turns
    ]
    return sum(near(pixel, color) for pixel in pixels) / len(pixels)


def shown(football, screen):
    view = view_of(football)
    view.watch(football.state)
    view.watch(football.state)
    view.draw(screen, football.state, 1.0, 0.02)
    return view


def test_rings_have_the_colour_of_the_team_and_turrets_that_of_the_player(screen):
    football = match()
    for k in range(4):
        put_robot(football.state, k, 500.0 + 200.0 * k, 300.0)
    shown(football, screen)
    for k, (team, player) in enumerate([(ICE, None), (FIRE, None), (ICE, GREEN), (FIRE, PINK)]):
        x = 500.0 + 200.0 * k
        assert max(share(screen, x, 300.0, radius, team) for radius in (33, 34, 35)) > 0.3, k
        if player:
            assert share(screen, x, 300.0, 34, player) == 0.0
            assert share(screen, x, 300.0, 17, player) > 0.5
            assert share(screen, x, 300.0, 17, team) < 0.1


def test_panels_have_the_colour_of_the_team(screen):
    football = match()
    view = shown(football, screen)
    assert [view.hud.color(slot.seat) for slot in view.hud.slots] == [ICE, ICE, FIRE, FIRE]
    for slot in view.hud.slots:
        edge = [screen.get_at((slot.x + slot.w // 2 + dx, 34 + 92)) for dx in range(-40, 40)]
        assert all(near(pixel, ICE if slot.seat % 2 == 0 else FIRE, 60) for pixel in edge)


def changed(screen, football, view, change):
    """The box in the HUD that differs after a change of the state."""
    view.draw(screen, football.state, 1.0, 0.0)
    before = pygame.surfarray.array3d(screen)[:, :134].astype(int)
    change()
    view.draw(screen, football.state, 1.0, 0.0)
    after = pygame.surfarray.array3d(screen)[:, :134].astype(int)
    return abs(after - before).max(axis=2) > 120


def rows(differs, left, right):
    """The rows, px, in which pixels between two columns differ."""
    return [int(y) for y in differs[left:right].any(axis=0).nonzero()[0]]


@pytest.mark.parametrize("large", [False, True])
@pytest.mark.parametrize("present", [(0, 1, 2, 3), (0, 1), (0, 1, 2)])
def test_the_goals_are_the_largest_figures(screen, present, large):
    """1080 px are the height of the picture; at three metres digits of 60 px are legible, so 100 px are at five."""
    read_large(large)
    try:
        football = match(present=present)
        robot = football.state.robots[0]
        view = shown(football, screen)

        def goal():
            robot.score = 8

        goals = changed(screen, football, view, goal)
        assert len(rows(goals, 580, 808)) >= 85
        own = rows(goals, 160, 560)
        football.state.tick = 44 * 50 + 1
        clock = changed(screen, football, view, lambda: setattr(football.state, "tick", 88 * 50 + 1))
        assert len(rows(goals, 580, 808)) > 1.1 * len(rows(clock, 830, 1090)) > 0
        assert len(rows(goals, 580, 808)) > 1.4 * (own[-1] - own[0]) > 0
    finally:
        read_large(False)


def test_both_goals_totals_show_twelve_without_leaving_their_boxes(screen):
    football = match()
    view = shown(football, screen)
    for panel in view.hud.sums:
        for goals in (0, 9, 12, 20, 100):
            _, *digits = view.hud.sum_bits(panel, goals, False)
            left = min(at[0] for _, at, _ in digits)
            right = max(at[0] + image.get_width() for image, at, _ in digits)
            assert panel.x <= left + 32, goals
            assert right - 32 <= panel.x + 228, goals


def test_real_robots_stand_in_the_colour_of_their_team(screen):
    football = match()
    view = view_of(football)
    seen = [Sighting(300.0 + 300.0 * k, 450.0, 0.0, 0.0) for k in range(4)]

    class Seen:
        def margin(self, robot: int, usual: float) -> float:
            return 0.0

        def sense(self, ahead=0.0):
            return seen

    screen.fill("black")
    MarkerDiscs(cast(Rig, Seen())).draw(screen, {0, 1, 2, 3}, ring_color=view.color)
    for k, team in enumerate((ICE, FIRE, ICE, FIRE)):
        assert share(screen, 300.0 + 300.0 * k, 450.0, RING, team) > 0.6, k
