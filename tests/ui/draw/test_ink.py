"""Glow rendering: light near the drawing, black elsewhere."""

from itertools import pairwise
from unittest.mock import Mock

import pygame
import pytest

from pigaming_app.ui.draw import (
    BLUE,
    ICONS,
    LABEL,
    PLAYERS,
    WHITE,
    GlowCanvas,
    LayeredCanvas,
    badge,
    hints,
    icon,
    shape_points,
)

pytestmark = pytest.mark.usefixtures("_glow")


def test_black_stays_black_away_from_ink():
    image = GlowCanvas(400, 300).neon([(100, 150), (200, 150)], BLUE).lit()

    assert image.get_at((150, 150)).b == 255
    assert image.get_at((150, 160)).b > 30, "it glows ten pixels away"
    for place in ((0, 0), (399, 299), (300, 150), (150, 60)):
        assert image.get_at(place)[:3] == (0, 0, 0)


def test_the_core_of_a_line_keeps_its_hue():
    red, green, blue, _ = GlowCanvas(200, 100).line([(20, 50), (180, 50)], BLUE, 12).lit().get_at((100, 50))

    assert red < 90 < green < blue


def test_black_lettering_stays_black_under_glow():
    image = GlowCanvas(120, 120).disc(60, 60, 50, WHITE).text("1", 60, 60, 60, (0, 0, 0), "hero", "c").lit()

    assert image.get_at((62, 60))[:3] == (0, 0, 0)


def test_a_page_lights_only_what_was_drawn_and_shows_every_sheet():
    page = LayeredCanvas(800, 400)
    page.glow.disc(100, 100, 20, BLUE)
    page.text("M", LABEL, 400, 100, align="c")
    page.crisp.disc(700, 100, 20, WHITE)
    image = page.render()

    assert image.get_at((100, 100))[:3] == BLUE
    assert image.get_at((700, 100))[:3] == (255, 255, 255)
    assert image.get_at((700, 125))[:3] == (0, 0, 0), "body text has no glow"
    assert max(image.get_at((x, 100)).b for x in range(370, 430)) > 200
    assert image.get_at((400, 390))[:3] == (0, 0, 0)


@pytest.mark.parametrize("ss", [1, 2, 3])
def test_ink_that_crosses_tiles_and_bands_has_no_seams(ss: int):
    """A canvas in bands has the pixels of pygame's own surface, drawn whole and scaled down."""
    points = [(-30.5, -40.2), (690.4, 150.9), (80.6, 350.3)]
    image = GlowCanvas(700, 300, ss).fill(points, BLUE).disc(300.7, 118.3, 60.5, WHITE).plain()

    whole = pygame.Surface((700 * ss, 300 * ss))
    pygame.draw.polygon(whole, BLUE, [(x * ss, y * ss) for x, y in points])
    pygame.draw.circle(whole, WHITE, (300.7 * ss, 118.3 * ss), 60.5 * ss)
    assert (
        pygame.surfarray.array3d(image) == pygame.surfarray.array3d(pygame.transform.smoothscale(whole, (700, 300)))
    ).all()


def test_no_surface_of_a_page_is_as_large_as_its_sheet(monkeypatch):
    surface = Mock(wraps=pygame.Surface)
    monkeypatch.setattr(pygame, "Surface", surface)
    page = LayeredCanvas()
    page.glow.void([(100, 100), (1800, 1000)], 8)
    page.text("M", LABEL, 400, 1000)
    page.render()
    assert max(w * h for w, h in (call.args[0] for call in surface.call_args_list)) == 1920 * 1080


def test_solid_hides_the_ground_in_a_sprite_only_where_it_lies():
    sprite = GlowCanvas(60, 60).solid([(10, 10), (50, 10), (50, 50), (10, 50)]).sprite()

    assert sprite.get_at((30, 30))[:4] == (0, 0, 0, 255)
    assert sprite.get_at((5, 5)).a == 0


@pytest.mark.parametrize("name", ICONS)
def test_every_icon_fits_its_square(name):
    image = icon(GlowCanvas(100, 100), name, 50, 50, 40, WHITE).plain()
    lit = [(x, y) for x in range(100) for y in range(100) if image.get_at((x, y)).g > 60]

    assert len(lit) > 150
    assert all(4 <= x <= 95 and 4 <= y <= 95 for x, y in lit)


def test_players_differ_in_shape_and_colour():
    areas = []
    for player in range(4):
        corners = shape_points(player, 20)
        pairs = pairwise([*corners, corners[0]])
        areas.append(abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in pairs)) / 2)
        badge(GlowCanvas(80, 80), player, 40, 40)

    assert len(set(PLAYERS)) == len({len(shape_points(p, 20)) for p in range(3)}) + 1 == 4
    assert max(areas) / min(areas) < 1.6, "of equal visual weight"


def test_hints_stand_in_the_middle():
    page = LayeredCanvas()
    hints(page, [("A", "OK"), ("<>", "Change"), ("START", "Go")])
    row = page.render().subsurface((0, 940, 1920, 80))
    lit = [x for x in range(0, 1920, 2) if any(row.get_at((x, y)).g > 90 for y in range(0, 80, 4))]

    assert abs((lit[0] + lit[-1]) / 2 - 960) < 8


@pytest.mark.parametrize("face", ["head", "hero", "body"])
@pytest.mark.parametrize("word", ["ÉE", "ÖE", "ÇE", "★ÉE"])
def test_accents_do_not_move_a_line(face: str, word: str) -> None:
    """Capitals stand on the same line with and without accents."""
    feet = []
    for text in ("E", word):
        image = GlowCanvas(600, 400, 1).text(text, 160, 560, 200, WHITE, face, "r").plain()
        rows = pygame.surfarray.array3d(image)[520:560].max(axis=(0, 2))  # of the E at the end
        feet.append(int(rows.nonzero()[0][-1]))
    assert feet[0] == pytest.approx(feet[1], abs=2)
