"""The page before a match shows what the match will deal."""

import pygame
import pytest

from pigaming_app.games.factory.state import MACHINE_SLOTS
from pigaming_app.scenes.lobby.dealt import deal, first_state
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.views.preview import fitted
from pigaming_app.scenes.views.race.lines import frame, line_signs
from pigaming_app.scenes.views.sprites.teams import TEAMS
from pigaming_app.ui.draw import PLAYERS
from pigaming_app.ui.input.events import Button
from tests.matches import setup_of
from tests.scenes.arcade import Arcade
from tests.scenes.screens import seats

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")
SIZE = (1144, 648)


def most_like(image, x, y, r=14):
    """The player whose colour is most often near a point; None: of no player."""
    counts = [0] * 4
    for dx in range(-r, r + 1, 2):
        for dy in range(-r, r + 1, 2):
            pixel = image.get_at((round(x + dx), round(y + dy)))[:3]
            for player, color in enumerate(PLAYERS):
                counts[player] += max(abs(a - b) for a, b in zip(pixel, color, strict=True)) < 50
    return counts.index(max(counts)) if max(counts) > 8 else None


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_each_line_has_the_colour_of_the_seat_that_is_dealt_it(seed) -> None:
    pygame.display.init()
    pygame.display.set_mode((1920, 1080))
    setup = setup_of("race", "level1 level1 level1 level1", "classic", 10.0, seed, "standard")
    cover, (left, top, k) = deal(setup, *SIZE), fitted(*SIZE)
    state = first_state(setup)
    for i, racer in enumerate(state.racers):
        line = frame(state.course, state.lines[racer.line].along)
        assert most_like(cover.image, left + k * line.x, top + k * line.y) == i
        robot = state.robots[i]
        assert most_like(cover.image, left + k * robot.x, top + k * robot.y) == i


def test_a_party_has_one_white_line_and_no_colours_of_players() -> None:
    pygame.display.init()
    pygame.display.set_mode((1920, 1080))
    setup = setup_of("race", "level1 level1 off off", "classic", 10.0, 1, "party")
    cover, (left, top, k) = deal(setup, *SIZE), fitted(*SIZE)
    state = first_state(setup)
    for line in state.lines:
        at = frame(state.course, line.along)
        assert most_like(cover.image, left + k * at.x, top + k * at.y, 6) is None


def test_the_match_deals_what_the_page_has_shown(arcade: Arcade) -> None:
    page = arcade.open(MatchSetupPage(arcade.context, "race", seats("race")))
    arcade.wait(0.5, draw=True)
    shown = line_signs(first_state(page._setup()))
    seed = page.seed
    assert seed > 0
    arcade.press(Button.FIRE)
    match = arcade.reach(MatchScene)
    assert match.setup.seed == seed
    assert line_signs(match.match.state) == shown


def test_the_next_match_is_dealt_anew(arcade: Arcade) -> None:
    page = arcade.open(MatchSetupPage(arcade.context, "race", seats("race")))
    seeds = set()
    for _ in range(3):
        seeds.add(page.seed)
        page.on_enter()
    assert len(seeds) == 3


@pytest.mark.parametrize("seed", [1, 2])
def test_each_warehouse_has_the_colour_of_the_team_that_is_dealt_it(seed) -> None:
    """Seed 1 deals Ice the end where the file has it, seed 2 the other; seen on the edges of the warehouses."""
    pygame.display.init()
    pygame.display.set_mode((1920, 1080))
    setup = setup_of("factory", "level1 level1 level1 level1", "hall", 5.0, seed)
    cover, (left, top, k) = deal(setup, *SIZE), fitted(*SIZE)
    for slot in first_state(setup).slots[:MACHINE_SLOTS]:
        pixel = cover.image.get_at((round(left + k * (slot.x - 54)), round(top + k * slot.y)))[:3]
        assert max(abs(a - b) for a, b in zip(pixel, TEAMS[slot.team], strict=True)) < 60


@pytest.mark.parametrize("game", ["pitanks", "football"])
def test_each_robot_is_shown_on_its_start(game) -> None:
    pygame.display.init()
    pygame.display.set_mode((1920, 1080))
    for seed in (1, 2):
        setup = setup_of(game, "level1 level1 level1 off", seed=seed)
        cover, (left, top, k) = deal(setup, *SIZE), fitted(*SIZE)
        found = [most_like(cover.image, left + k * one.x, top + k * one.y) for one in first_state(setup).robots]
        assert found == [0, 1, 2, None]
