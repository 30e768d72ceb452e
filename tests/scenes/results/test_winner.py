"""The winner's moment: who is celebrated, how it sounds, how long it takes, and who may skip it."""

from dataclasses import replace

import pygame
import pytest

from pigaming_app.games.game import Outcome
from pigaming_app.games.registry import games
from pigaming_app.scenes.results.celebration import Celebration, confetti
from pigaming_app.scenes.results.scene import Results
from pigaming_app.scenes.results.winner import LENGTH, MIDDLE, POPS, SKIP, WinnersMoment, celebrated, popped, title
from pigaming_app.ui.draw import ICE, PLAYERS
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button
from tests.cases import one_in
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.scenes.results.test_results import outcome, results_of
from tests.scenes.screens import ENDINGS

FRAME = 1 / 30


def moment(arcade: Arcade, brains: str, ended: Outcome, teams: tuple[int, ...] = (0, 1, 2, 3)) -> WinnersMoment:
    results = results_of(arcade, setup(brains, 1.0, teams), ended)
    scene = arcade.open(WinnersMoment(arcade.context, results.ended, results))
    return scene


def with_stars(ended: Outcome, stars: int) -> Outcome:
    """The same for allies."""
    return replace(ended, rows=tuple(replace(row, stats={**row.stats, "stars": stars}) for row in ended.rows))


WON = outcome({0: 12, 1: -3, 2: 7, 3: 5}, (0,))


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", one_in(2, ENDINGS))
def test_every_ending_has_its_moment_within_the_picture(arcade: Arcade, name: str) -> None:
    results = ENDINGS[name].results(arcade)
    scene = arcade.open(WinnersMoment(arcade.context, results.ended, results))
    arcade.wait(LENGTH - 0.4, fps=5, draw=True)
    assert title(scene.name, scene.size, scene.color).image.get_width() <= 1920 - 2 * 96
    for pop in range(POPS):
        sprite = popped(scene.name, scene.size, scene.color, pop)
        assert MIDDLE[0] + sprite.dx >= 48, "as it appears, too"
        assert MIDDLE[0] + sprite.dx + sprite.image.get_width() <= 1920 - 48
    arcade.reach(Results, 2.0)


@pytest.mark.parametrize(
    ("brains", "scores", "winners", "teams", "seats", "sound"),
    [
        ("human human level5 human", {0: 12, 1: -3, 2: 7, 3: 5}, (0,), (0, 1, 2, 3), [0], "fanfare"),
        ("human level3 off off", {0: -14, 1: 4}, (1,), (0, 1, 2, 3), [1], "lose"),
        ("level1 level3 off off", {0: -14, 1: 4}, (1,), (0, 1, 2, 3), [1], "fanfare"),
        ("human off human level1", {0: 3, 2: 3, 3: -6}, (), (0, 1, 2, 3), [0, 2], "tie"),
        ("human human human level1", {0: -3, 1: -2, 2: 9, 3: -4}, (2, 0), (0, 1, 0, 1), [0, 2], "fanfare"),
        ("human human human human", {0: 1, 1: 1, 2: 1, 3: 1}, (), (0, 1, 2, 3), [0, 1, 2, 3], "tie"),
    ],
)
def test_the_first_are_celebrated_with_the_right_sound(
    arcade: Arcade,
    brains: str,
    scores: dict[int, int],
    winners: tuple[int, ...],
    teams: tuple[int, ...],
    seats: list[int],
    sound: str,
) -> None:
    ended = outcome(scores, winners, teams)
    assert celebrated(ended) == seats
    scene = moment(arcade, brains, ended, teams)
    assert scene.seats == seats
    arcade.wait(1.0, draw=True)
    assert arcade.sounds.heard == [sound]
    assert scene.color == (PLAYERS[winners[0]] if winners else ICE)


@pytest.mark.parametrize(("stars", "sound", "pieces"), [(3, "fanfare", True), (1, "fanfare", True), (0, "lose", False)])
def test_allies_get_stars_instead_of_a_crown(arcade: Arcade, stars: int, sound: str, pieces: bool) -> None:
    ended = outcome({0: 1, 1: 1, 2: 2, 3: 0}, (0, 1, 2, 3), (0, 0, 0, 0))
    scene = moment(arcade, "human level3 level3 level3", with_stars(ended, stars), (0, 0, 0, 0))
    arcade.wait(2.0, draw=True)
    assert arcade.sounds.heard == [sound]
    assert bool(scene.celebration.pieces) == pieces


def test_it_takes_three_seconds_and_leaves_the_results_ready(arcade: Arcade) -> None:
    scene = moment(arcade, "human human level5 human", WON)
    waited = arcade.until(lambda: arcade.stack.top is scene.then)
    assert waited == pytest.approx(LENGTH, abs=0.1)
    assert scene.then.prewarm(1.0)


def test_players_skip_it_after_a_second_and_free_devices_do_not(arcade: Arcade) -> None:
    scene = moment(arcade, "human level1 level5 level1", WON)
    arcade.wait(SKIP - 0.1)
    arcade.press(Button.FIRE)
    assert arcade.stack.top is scene
    arcade.wait(0.2)
    arcade.press(Button.FIRE, device=KEYS[3])
    arcade.press(Button.X)
    assert arcade.stack.top is scene
    arcade.press(Button.FIRE)
    assert arcade.stack.top is scene.then
    arcade.shown(Results)


def test_the_mouse_skips_it_too(arcade: Arcade) -> None:
    scene = moment(arcade, "human level1 level5 level1", WON)
    arcade.wait(SKIP + 0.1)
    arcade.click(960, 500)
    assert arcade.stack.top is scene.then


def test_without_flashes_there_is_confetti_and_no_burst(arcade: Arcade) -> None:
    arcade.context.settings.flashes = "off"
    scene = moment(arcade, "human level1 level5 level1", WON)
    for _ in range(60):
        arcade.frame(FRAME, draw=True)
        assert not scene.celebration.sparks
    assert scene.celebration.pieces


@pytest.mark.parametrize("stars", [None, 2])
def test_everything_is_rendered_before_it_is_shown(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, stars: int | None
) -> None:
    if stars is None:
        scene = moment(arcade, "human level1 level5 level1", WON)
    else:
        allies = outcome({0: 1, 1: 1, 2: 2, 3: 0}, (0, 1, 2, 3), (0, 0, 0, 0))
        scene = moment(arcade, "human level1 level5 level1", with_stars(allies, stars), (0, 0, 0, 0))
    while not scene.prewarm(50.0):
        pass
    made: list[object] = []
    real = pygame.transform.smoothscale_by
    monkeypatch.setattr(pygame.transform, "smoothscale_by", lambda *all_of_them: made.append(1) or real(*all_of_them))  # type: ignore[func-returns-value]
    arcade.wait(1.5, draw=True)
    assert not made


@pytest.mark.parametrize("game", games())
def test_confetti_comes_from_both_sides_and_falls_out_of_the_picture(game: str) -> None:
    pygame.display.set_mode((1920, 1080))
    party = Celebration(game, [1], [PLAYERS[1]])
    party.volley()
    assert {piece.x < 960 for piece in party.pieces} == {True, False}
    for _ in range(60):
        party.update(1 / 60)
    heights = [piece.y for piece in party.pieces]
    assert min(heights) < 700
    for _ in range(900):
        party.update(1 / 60)
    assert not party.pieces
    sprites = [confetti(game, 1, PLAYERS[1], 15, tumble).image for tumble in range(3)]
    assert all(max(image.get_size()) > 15 for image in sprites)
