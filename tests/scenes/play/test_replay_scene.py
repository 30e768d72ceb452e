"""Demonstration matches and replays."""

from dataclasses import replace
from pathlib import Path
from time import thread_time

import pygame
import pytest

from pigaming_app.ai.registry import new_match
from pigaming_app.games.registry import games
from pigaming_app.games.replay import Replay
from pigaming_app.games.replay import recorded as recording_of
from pigaming_app.scenes.attract.scene import MINUTES, PAGE, Attract, DemoMatch, TimedPage
from pigaming_app.scenes.files import load_replay, save_replay
from pigaming_app.scenes.play.side_hints import boxes
from pigaming_app.scenes.replays.watch import IDLE, LINE_LEFT, LINE_RIGHT, LINE_Y, ReplayScene
from pigaming_app.sim.record import digest
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button, Device, InputEvent
from tests.matches import finished
from tests.scenes.arcade import Arcade, setup
from tests.scenes.attract.test_attract import scores_of
from tests.scenes.measuring import faults, lit_boxes, measuring


def test_attract_shows_a_match_then_how_to_play_then_the_scores(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert MINUTES <= 2.0
    monkeypatch.setattr("pigaming_app.scenes.attract.scene.MINUTES", 0.05)
    for game in games():
        scores_of(arcade.context, game)
    attract = arcade.open(Attract(arcade.context))
    assert isinstance(attract.show, DemoMatch)
    assert attract.show.runner.match.setup.minutes == 0.05
    shown = attract.show.runner.match.setup
    overtime = games()[shown.game].variants[shown.variant].overtime
    arcade.until(lambda: not isinstance(attract.show, DemoMatch), 8.0 + overtime)
    first = attract.show
    assert isinstance(first, TimedPage)
    arcade.wait(0.5, draw=True)
    arcade.until(lambda: attract.show is not first, PAGE + 1)
    assert isinstance(attract.show, TimedPage)
    arcade.wait(0.5, draw=True)
    arcade.until(lambda: isinstance(attract.show, DemoMatch), PAGE + 1)
    assert arcade.sounds.heard == [], "nobody is listening"


@pytest.mark.parametrize(
    "button", [Button.FIRE, Button.START, Button.LEFT, Button.BACK, Button.POINT, Button.CLICK, Button.FOUND]
)
def test_any_input_ends_it(arcade: Arcade, button: Button) -> None:
    arcade.open(Attract(arcade.context))
    arcade.wait(0.2, draw=True)
    arcade.press(button, device=Device("mouse") if button in (Button.POINT, Button.CLICK) else Device("keys"))
    assert arcade.stack.top is arcade.title


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """A file with a match of 6 s, and the digest of its end."""
    match = finished(new_match(setup("level5 level1 level3 off", 0.1)))
    save_replay(match, file := tmp_path_factory.mktemp("replay") / "match.replay")
    return file, digest(match.state)


def test_a_replay_plays_out_as_the_match_did(arcade: Arcade, recorded: tuple[Path, str]) -> None:
    scene = arcade.open(ReplayScene(arcade.context, load_replay(recorded[0])))
    taken = arcade.until(lambda: scene.ended)
    assert taken == pytest.approx(6.0, abs=0.1)
    assert digest(scene.runner.match.state) == recorded[1]
    arcade.shown(ReplayScene)


def test_a_replay_pauses_speeds_up_and_restarts(arcade: Arcade, recorded: tuple[Path, str]) -> None:
    scene = arcade.open(ReplayScene(arcade.context, load_replay(recorded[0])))
    arcade.wait(1.0, draw=True)
    arcade.press(Button.FIRE)
    before = scene.runner.match.state.tick
    arcade.wait(1.0, draw=True)
    assert scene.runner.match.state.tick == before
    arcade.press(Button.FIRE, Button.Y, Button.Y)
    arcade.wait(1.0, draw=True)
    assert scene.runner.match.state.tick - before == pytest.approx(200, abs=5)
    arcade.press(Button.Y)
    before = scene.runner.match.state.tick
    arcade.wait(1.0, draw=True)
    assert scene.runner.match.state.tick - before == pytest.approx(25, abs=3)
    arcade.press(Button.X)
    assert scene.runner.match.state.tick == 0
    arcade.press(Button.Y)
    arcade.until(lambda: scene.ended)
    arcade.press(Button.FIRE)
    assert not scene.ended
    arcade.press(Button.BACK)
    assert arcade.stack.top is arcade.setup


@pytest.fixture(scope="module")
def long() -> Replay:
    """A replay of 20 s."""
    match = finished(new_match(setup("level5 level1 level3 off", 1 / 3)))
    return recording_of(match)


def tick(scene: ReplayScene) -> int:
    return int(scene.runner.match.state.tick)


def test_left_and_right_jump_by_five_seconds_to_the_same_states(arcade: Arcade, long: Replay) -> None:
    scene = arcade.open(ReplayScene(arcade.context, long))
    arcade.wait(8.0)
    arcade.press(Button.FIRE)
    here, state = tick(scene), digest(scene.runner.match.state)
    arcade.press(Button.LEFT)
    assert tick(scene) == here - 250
    arcade.shown(ReplayScene)
    arcade.press(Button.RIGHT)
    assert (tick(scene), digest(scene.runner.match.state)) == (here, state)
    arcade.press(*[Button.LEFT] * 3)
    assert tick(scene) == 0
    arcade.press(*[Button.RIGHT] * 5)
    assert tick(scene) == 1000
    assert scene.ended
    assert digest(scene.runner.match.state) == long.digest
    arcade.press(Button.LEFT)
    assert not scene.ended
    arcade.press(Button.FIRE)
    arcade.until(lambda: scene.ended, 6.0)
    assert digest(scene.runner.match.state) == long.digest


def test_a_click_on_the_timeline_jumps_there(arcade: Arcade, long: Replay) -> None:
    scene = arcade.open(ReplayScene(arcade.context, long))
    arcade.click((LINE_LEFT + LINE_RIGHT) / 2, LINE_Y + 5)
    assert tick(scene) == 500
    arcade.click(LINE_RIGHT + 100, LINE_Y)
    assert tick(scene) == 1000
    arcade.click(0, LINE_Y)
    assert tick(scene) == 0


def test_an_abandoned_replay_returns_to_the_title_once_it_stands_still(arcade: Arcade, long: Replay) -> None:
    scene = arcade.open(ReplayScene(arcade.context, long))
    arcade.context.idle = IDLE + 1.0
    arcade.frame()
    assert arcade.stack.top is scene, "it is being watched"
    arcade.press(Button.FIRE)
    arcade.frame()
    assert arcade.stack.top is arcade.title


def test_a_jump_takes_less_than_50_ms(arcade: Arcade, long: Replay) -> None:
    arcade.open(ReplayScene(arcade.context, long))
    arcade.wait(2.0)
    durations = []
    for button in (Button.RIGHT, Button.RIGHT, Button.LEFT, Button.RIGHT, Button.LEFT):
        began = thread_time()
        arcade.press(button)
        durations.append(thread_time() - began)
    assert min(durations) < 0.05


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("paused", [False, True])
def test_the_bar_of_a_replay_stands_beside_the_arena(
    arcade: Arcade, recorded: tuple[Path, str], monkeypatch: pytest.MonkeyPatch, paused: bool
) -> None:
    scene = ReplayScene(arcade.context, load_replay(recorded[0]))
    arena = pygame.Rect(160, 136, 1600, 908)
    with measuring(monkeypatch) as screen:
        if paused:
            scene.handle(InputEvent(Button.FIRE, Device("keys")))
        monkeypatch.setattr(scene.runner, "draw", lambda canvas: canvas.fill("black"))
        monkeypatch.setattr(scene.runner, "draw_captions", lambda *_: None)
        scene.draw(screen)
        assert len(screen.texts) >= 8, "it is measured"
        assert faults(screen, pygame.Rect(4, 16, 1912, 1048)) == []
        assert not [box for box in lit_boxes(screen, 12) if arena.colliderect(box)]
    for button, box in zip(scene.prompts.buttons, boxes(scene.prompts.labels), strict=True):
        assert scene.hints.as_button(InputEvent(Button.CLICK, Device("mouse"), at=box.center)).button is button
        left = scene.hints.as_button(InputEvent(Button.CLICK, Device("mouse"), at=(box.left + 1, box.centery))).button
        assert left is (Button.LEFT if button is Button.RIGHT else button)


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_replay_of_another_engine_plays_with_a_notice(
    arcade: Arcade, recorded: tuple[Path, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = arcade.open(ReplayScene(arcade.context, replace(load_replay(recorded[0]), engine="another")))
    notice = arcade.context.words("replay.other_engine")
    with measuring(monkeypatch) as screen:
        scene.draw(screen)
        assert notice in [text.text for text in screen.texts]
        assert faults(screen, pygame.Rect(4, 16, 1912, 1048)) == []
        arcade.wait(7.0)
        screen.texts.clear()
        scene.draw(screen)
        assert notice not in [text.text for text in screen.texts]
    arcade.until(lambda: scene.ended)


def test_the_prompts_of_a_replay_match_its_state(arcade: Arcade, recorded: tuple[Path, str]) -> None:
    scene = arcade.open(ReplayScene(arcade.context, load_replay(recorded[0])))
    assert [text for _, text in scene.prompts.labels] == ["Pause", "5 seconds", "Speed", "From the start", "Back"]
    arcade.press(Button.FIRE)
    arcade.shown(ReplayScene)
    assert scene.prompts.labels[0][1] == "Play"
    arcade.press(Button.FIRE)
    arcade.until(lambda: scene.ended)
    arcade.shown(ReplayScene)
    assert [text for _, text in scene.prompts.labels] == ["From the start", "5 seconds", "Back"]
