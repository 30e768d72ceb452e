"""Watching: what runs while nobody plays, and matches that were recorded."""

from pathlib import Path

import pytest

from pigaming_app.ai import seated
from pigaming_app.games.replay import load, save
from pigaming_app.scenes.attract import PAGE, Attract, Demonstration, Page
from pigaming_app.scenes.controls import Controls
from pigaming_app.scenes.press import Act, Device
from pigaming_app.scenes.replay import ReplayScene
from pigaming_app.scores import Table
from pigaming_app.sim.record import digest
from tests.scenes.arcade import Arcade, setup


@pytest.fixture
def arcade(controls: Controls) -> Arcade:
    return Arcade(controls)


def test_attract_shows_a_match_then_how_to_play_then_the_scores(arcade: Arcade) -> None:
    arcade.house.scores.add(Table("pitanks", "classic", "points", rules="plain", length=2, people=1), "ABC", 7)
    attract = Attract(arcade.house)
    arcade.open(attract)
    assert isinstance(attract.show, Demonstration)
    assert attract.show.stage.match.setup.minutes <= 2.0
    arcade.until(lambda: not isinstance(attract.show, Demonstration), 125.0)
    first = attract.show
    assert isinstance(first, Page)
    arcade.wait(0.5, draw=True)
    arcade.until(lambda: attract.show is not first, PAGE + 1)
    assert isinstance(attract.show, Page)
    arcade.wait(0.5, draw=True)
    arcade.until(lambda: isinstance(attract.show, Demonstration), PAGE + 1)
    assert arcade.sounds.heard == [], "nobody is listening"


@pytest.mark.parametrize("act", [Act.FIRE, Act.START, Act.LEFT, Act.BACK, Act.POINT, Act.CLICK, Act.FOUND])
def test_any_input_ends_it(arcade: Arcade, act: Act) -> None:
    arcade.open(Attract(arcade.house))
    arcade.wait(0.2, draw=True)
    arcade.press(act, Device("mouse") if act in (Act.POINT, Act.CLICK) else Device("keys"))
    assert arcade.stack.top is arcade.title


@pytest.fixture
def recorded(tmp_path: Path) -> tuple[Path, str]:
    match = seated(setup("hard easy normal off", 0.1))
    while not match.over:
        match.tick()
    save(match, tmp_path / "match.replay")
    return tmp_path / "match.replay", digest(match.state)


def test_a_replay_plays_out_as_the_match_did(arcade: Arcade, recorded: tuple[Path, str]) -> None:
    scene = ReplayScene(arcade.house, load(recorded[0]))
    arcade.open(scene)
    taken = arcade.until(lambda: scene.ended)
    assert taken == pytest.approx(6.0, abs=0.1)
    assert digest(scene.stage.match.state) == recorded[1]
    arcade.shown(ReplayScene)


def test_a_replay_waits_hurries_and_begins_again(arcade: Arcade, recorded: tuple[Path, str]) -> None:
    scene = ReplayScene(arcade.house, load(recorded[0]))
    arcade.open(scene)
    arcade.wait(1.0, draw=True)
    arcade.press(Act.FIRE)
    before = scene.stage.match.state.tick
    arcade.wait(1.0, draw=True)
    assert scene.stage.match.state.tick == before
    for act in (Act.FIRE, Act.RIGHT, Act.RIGHT, Act.RIGHT):
        arcade.press(act)
    arcade.wait(1.0, draw=True)
    assert scene.stage.match.state.tick - before == pytest.approx(200, abs=5)
    arcade.press(Act.EXTRA)
    assert scene.stage.match.state.tick == 0
    arcade.press(Act.LEFT)
    arcade.until(lambda: scene.ended)
    arcade.press(Act.FIRE)
    assert not scene.ended
    arcade.press(Act.BACK)
    assert arcade.stack.top is arcade.setup


def test_a_replay_says_what_fire_does_now(arcade: Arcade, recorded: tuple[Path, str]) -> None:
    scene = ReplayScene(arcade.house, load(recorded[0]))
    arcade.open(scene)
    assert [text for _, text in scene.prompts.said] == ["Pause", "Speed", "From the start", "Back"]
    arcade.press(Act.FIRE)
    arcade.shown(ReplayScene)
    assert scene.prompts.said[0][1] == "Play"
    arcade.press(Act.FIRE)
    arcade.until(lambda: scene.ended)
    arcade.shown(ReplayScene)
    assert [text for _, text in scene.prompts.said] == ["From the start", "Back"]
