"""The two ceremonies of a match: how long they last, how FIRE ends them, and that a replay is what happened."""

from dataclasses import replace

import pygame
import pytest

from pigaming_app.games.match import Match
from pigaming_app.scenes.play.countdown import Countdown
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.scenes.views.hud.parts import CLOCK
from pigaming_app.sim.record import digest, to_bytes
from pigaming_app.ui.draw import text_width
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button
from pigaming_football.screens import ceremony
from pigaming_football.screens.view import FootballView
from tests.football.pitch import put_ball, put_robot
from tests.football.test_view import view_of
from tests.matches import match_of, setup_of
from tests.scenes.arcade import Arcade

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")
FPS = 30


def opened(arcade, brains="idle idle idle idle", variant="standard", devices=()):
    return arcade.open(MatchScene(arcade.context, setup_of("football", brains, "classic", 1.0, 3, variant), devices))


def view_in(scene) -> FootballView:
    view = scene.runner.view
    assert isinstance(view, FootballView)
    return view


def begun(arcade, *more, **named):
    """A match whose robots may drive, with the ball on its way to the goal on the right, which robot 3 touched last."""
    scene = opened(arcade, *more, **named)
    scene.opening.countdown.seconds_left = 0.05
    arcade.until(lambda: not scene.preparing)
    state = scene.match.state
    for k in range(4):
        put_robot(state, k, 300.0 + 60.0 * k, 150.0 + 150.0 * k)
    state.ball.out, state.ball.touched = 0, 3
    put_ball(state, 700.0, 450.0, 850.0)
    return scene


def scored(arcade, scene):
    """The frames until the goal, and the digest of the state after each tick."""
    states = {}
    while not scene.match.state.goals:
        arcade.frame(1 / FPS)
        states[scene.match.state.tick] = digest(scene.match.state)
        assert scene.match.state.tick < 200
    return states


def seconds_held(arcade, scene):
    """For how long the match stands."""
    tick, seconds = scene.match.state.tick, 0.0
    while scene.match.state.tick == tick:
        arcade.frame(1 / FPS)
        seconds += 1 / FPS
        assert seconds < 5.0
    return seconds


def test_the_match_is_held_for_two_seconds_after_a_goal(arcade: Arcade) -> None:
    scene = begun(arcade)
    scored(arcade, scene)
    assert scene.held
    assert seconds_held(arcade, scene) == pytest.approx(2.0, abs=2.5 / FPS)
    assert scene.match.state.ball.out > 100, "the pause of the rules is still to come"
    arcade.wait(1.0)
    assert scene.match.state.goals == 1
    assert not scene.held


def test_fire_ends_it_from_half_a_second_on(arcade: Arcade) -> None:
    scene = begun(arcade)
    scored(arcade, scene)
    tick = scene.match.state.tick
    arcade.wait(0.3)
    arcade.press(Button.FIRE)
    arcade.wait(0.3)
    arcade.press(Button.LEFT)
    arcade.frame()
    assert scene.held
    arcade.press(Button.FIRE)
    assert not scene.held
    arcade.wait(0.2)
    assert scene.match.state.tick > tick
    assert view_in(scene).said[0] == ""
    scene.draw(arcade.screen)
    assert view_in(scene).replay is None


def test_only_players_at_the_table_end_it(arcade: Arcade) -> None:
    _, seated = arcade.plug()
    _, free = arcade.plug()
    scene = begun(arcade, "human idle idle idle", devices=[seated])
    scored(arcade, scene)
    arcade.wait(0.6)
    arcade.press(Button.FIRE, device=free)
    assert scene.held
    arcade.press(Button.FIRE, device=seated)
    assert not scene.held


def test_a_replay_is_made_of_the_states_before_the_goal(arcade: Arcade) -> None:
    """Each picture of it shows robots and ball between two recorded ticks; the last is the one before the goal."""
    scene = begun(arcade)
    states, poses = {}, {}
    while not scene.match.state.goals:
        scene.runner.advance(0.02)
        state = scene.match.state
        states[state.tick] = to_bytes(state)
        poses[state.tick] = [(160 + robot.x, 140 + robot.y, robot.heading) for robot in state.robots]
    view, goal = view_in(scene), scene.match.state.tick
    assert view.replay is not None
    assert len(view.replay.clip) == ceremony.TICKS + 1
    frames = [states[tick] for tick in range(goal - len(view.replay.clip), goal)]
    assert list(view.replay.clip.frames) == frames
    played = digest(scene.match.state)
    shown = []
    for _ in range(60):
        arcade.frame(1 / FPS, draw=True)
        if view.replays:
            shown.append(view.replay.shown)
            tick = goal - len(view.replay.clip) + view.replay.place(view.since)[0]
            assert view.pose(2, 0.0) == pytest.approx(poses[tick][2])
            assert view.pose(2, 1.0) == pytest.approx(poses[tick + 1][2])
            assert view.shown_track.now[0] <= 1600.0
    assert shown[0] <= 2
    assert shown[-1] == ceremony.TICKS
    assert shown == sorted(shown)
    speed = (shown[-2] - shown[0]) / 50 / ((len(shown) - 2) / FPS)
    assert speed == pytest.approx(0.6, abs=0.05)
    assert digest(scene.match.state) == played, "nothing but the picture goes back"


def test_the_present_returns_after_a_replay(arcade: Arcade) -> None:
    scene = begun(arcade)
    scored(arcade, scene)
    view = view_in(scene)
    now = [(160 + robot.x, 140 + robot.y, robot.heading) for robot in scene.match.state.robots]
    arcade.wait(1.0, draw=True)
    assert view.replays
    assert view.hud.clock_words == "Replay"
    arcade.wait(1.1, draw=True)
    assert view.replay is None
    assert view.hud.clock_words == ""
    drawn = [view.pose(seat, 0.0) for seat in range(4)]
    assert [pose[:2] for pose in drawn] == [pytest.approx(pose[:2], abs=2.0) for pose in now]


@pytest.mark.parametrize("names", [(), ("Ada", "Bo", "Cyd", "Dee")])
def test_the_scorer_is_named(arcade: Arcade, names) -> None:
    scene = begun(arcade)
    view_in(scene).show_names(names)
    scored(arcade, scene)
    assert view_in(scene).said[0] == "Goal!"
    assert view_in(scene).said[3] == ("Cyd" if names else "Player 3")


@pytest.mark.parametrize(
    ("touched", "before", "word", "name"),
    [
        (3, 2, "Goal!", "Player 3"),
        (2, 3, "Goal!", "Player 3"),  # deflected
        (2, 4, "Own goal!", "Ice"),
        (2, 0, "Own goal!", "Ice"),
        (0, 0, "Own goal!", "Ice"),
    ],
)
def test_an_own_goal_is_called_one(arcade: Arcade, touched, before, word, name) -> None:
    """The goal on the right is that of robots 2 and 4, so it counts for Ice."""
    scene = begun(arcade)
    scene.match.state.ball.touched, scene.match.state.ball.before = touched, before
    scored(arcade, scene)
    said = view_in(scene).said
    assert (said[0], said[3]) == (word, name)


@pytest.mark.long
def test_a_match_with_ceremonies_is_the_match_without(arcade: Arcade) -> None:
    """Two seconds of waiting and a drawn replay change no state: actions and random numbers stay the same."""
    brains = "level5 level5 level5 level5"
    scene = opened(arcade, brains)
    while scene.match.state.goals < 1:
        arcade.frame(1 / FPS)
    arcade.wait(4.0, draw=True)
    plain = match_of("football", brains, "classic", 1.0, 3)
    while plain.state.tick < scene.match.state.tick:
        plain.tick()
    assert digest(plain.state) == digest(scene.match.state)


@pytest.mark.long
def test_the_goal_that_ends_a_match_has_its_ceremony_before_the_winners(arcade: Arcade) -> None:
    scene = begun(arcade, variant="cup")
    state = scene.match.state
    state.rules.ticks = state.tick + 1
    scored(arcade, scene)
    assert scene.match.over
    arcade.frame()
    assert scene.held
    seconds = arcade.until(lambda: isinstance(arcade.stack.top, WinnersMoment))
    assert seconds > 2.0 + 1.4
    arcade.shown(WinnersMoment)


def test_teams_and_ball_are_presented_for_two_seconds_before_the_countdown(arcade: Arcade) -> None:
    scene = opened(arcade)
    lead = Countdown(lead=2.0).seconds_left
    assert scene.opening.countdown.seconds_left == pytest.approx(lead)
    arcade.wait(1.0, draw=True)
    assert view_in(scene).presenting
    assert scene.opening.card is None, "the rules follow"
    arcade.wait(1.1, draw=True)
    assert not view_in(scene).presenting
    assert scene.opening.countdown.number == 3
    assert scene.opening.card is not None
    assert scene.match.state.tick == 0


def test_fire_ends_the_presentation(arcade: Arcade) -> None:
    scene = opened(arcade)
    arcade.wait(0.6)
    arcade.press(Button.FIRE)
    assert scene.opening.countdown.seconds_left == 3.0
    arcade.frame()
    assert scene.opening.countdown.number == 3
    assert not view_in(scene).presenting
    arcade.press(Button.FIRE)
    assert scene.opening.countdown.seconds_left > 2.9, "the countdown itself is not shortened"


def test_the_countdown_after_a_pause_has_no_ceremony(arcade: Arcade) -> None:
    scene = begun(arcade)
    scene.on_enter()
    assert scene.opening.countdown.seconds_left == pytest.approx(1.5)
    assert not scene.held


def test_without_a_scene_that_waits_there_is_no_ceremony() -> None:
    """A lesson, a replay file or attract mode plays on."""
    pygame.display.init()
    pygame.display.set_mode((1920, 1080))
    match = Match(replace(setup_of("football", "idle idle idle idle", "classic"), variant="standard"))
    view = view_of(match)
    match.state.ball.out = 0
    put_ball(match.state, 1540.0, 450.0, 900.0)
    while not match.state.goals:
        match.game.judge(match.state)
        view.watch(match.state)
    assert not view.presenting
    assert view.replay is None


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_words_fit(arcade: Arcade, language) -> None:
    match = match_of("football", "idle idle idle idle", "classic")
    view = view_of(match, language)
    for key in ("football.kick_off", "football.goal", "football.own_goal"):
        assert view.announcement(view.word(key), (255, 255, 255)).image.get_width() <= 1000 + 64
    assert text_width(view.word("football.replay"), 40, "head") <= CLOCK.w - 24, "legible at three metres"
    for side in ("lobby.side_1", "lobby.side_2"):
        assert text_width(view.word(side), 120, "hero") < 600
