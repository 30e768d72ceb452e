"""The music of the scenes: menus, match, pause, last seconds, winner, results."""

import pytest

from pigaming_app.games.game import Setup
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import Results
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.ui.input.events import Button
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade, setup


def opened(arcade: Arcade, wish: Setup) -> MatchScene:
    scene = arcade.open(MatchScene(arcade.context, wish, [KEYS[0]]))
    scene.opening.countdown.seconds_left = 0.05
    arcade.until(lambda: not scene.preparing)
    return scene


@pytest.mark.parametrize("game", ["pitanks", "factory", "race", "football"])
def test_each_game_has_its_theme(arcade: Arcade, game: str) -> None:
    opened(arcade, setup_of(game, "human level1"))
    assert arcade.sounds.themes == [game]


def test_a_match_from_countdown_to_results(arcade: Arcade) -> None:
    scene = opened(arcade, setup("human level1 off off", minutes=1.0))
    scene.match.state.tick = round(39.5 * 50)
    arcade.until(lambda: "finale" in arcade.sounds.themes)
    assert 19.9 <= scene.match.seconds_left <= 20.0
    scene.match.state.tick = 60 * 50 - 10
    arcade.until(lambda: scene.match.over)
    arcade.frame()
    assert arcade.sounds.themes == ["pitanks", "finale", None]
    arcade.until(lambda: isinstance(arcade.stack.top, WinnersMoment))
    assert arcade.sounds.themes[-1] is None, "the winner's fanfare is alone"
    arcade.until(lambda: isinstance(arcade.stack.top, Results))
    assert arcade.sounds.themes[-1] == "title"


def test_the_music_pauses_with_the_match(arcade: Arcade) -> None:
    opened(arcade, setup("human level1 off off", minutes=1.0))
    arcade.press(Button.START)
    assert isinstance(arcade.stack.top, Pause)
    assert arcade.sounds.themes == ["pitanks", "held"]
    arcade.wait(1.0)
    arcade.press(Button.BACK)
    assert arcade.sounds.themes == ["pitanks", "held", "pitanks"]


def test_another_start_begins_the_music_anew(arcade: Arcade) -> None:
    scene = opened(arcade, setup("human level1 off off", minutes=1.0))
    scene.restart()
    arcade.frame()
    assert arcade.stack.top is not scene
    assert arcade.sounds.themes == ["pitanks", None, "pitanks"]


def test_the_last_lap_of_the_first_has_the_finale(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    """A race ends with its laps, long before its time."""
    scene = opened(arcade, setup_of("race", "human level5"))
    monkeypatch.setattr(scene.runner.view, "watch", lambda state: [("lap", 0, 0.0)])
    arcade.wait(0.2)
    assert arcade.sounds.themes == ["race"]
    monkeypatch.setattr(scene.runner.view, "watch", lambda state: [("last_lap", 0, 0.0)])
    arcade.wait(0.2)
    assert arcade.sounds.themes == ["race", "finale"]


def test_a_match_that_nobody_hears_has_no_finale(arcade: Arcade) -> None:
    scene = opened(arcade, setup("human level1 off off", minutes=0.1))
    scene.runner.loud = False
    arcade.sounds.themes.clear()
    arcade.wait(0.2)
    assert arcade.sounds.themes == []
