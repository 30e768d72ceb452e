"""Matches with real robots on the emulated arena in simulated time."""

from collections.abc import Callable
from datetime import date
from math import hypot
from pathlib import Path
from typing import Any

import pygame
import pytest

from pigaming_app.games.game import Setup
from pigaming_app.games.rounds import Rounds
from pigaming_app.hardware.calibration.drift import PAUSE, WARN
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.scenes.features.replays import verify
from pigaming_app.scenes.kiosk.operator.page import OperatorPage, end_all
from pigaming_app.scenes.mat.before_match import UnavailablePage
from pigaming_app.scenes.mat.robots.fault_page import FaultPage
from pigaming_app.scenes.mat.robots.match_scene import RealMatch
from pigaming_app.scenes.mat.robots.swap_page import SwapPage
from pigaming_app.scenes.mat.session import session_of
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.scene import MatchScene, match_of
from pigaming_app.scenes.results.scene import Results
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.storage.day_log import Battery, DayLog, PlayedMatch, read_day
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.draw import GREY
from pigaming_app.ui.draw.pixels import pixels_of
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.cases import one_in, repeated
from tests.hardware.sentences import sentence
from tests.matches import setup_of
from tests.scenes.arcade import Arcade
from tests.ui.input.virtual_pad import VirtualPad

pytest.importorskip("cv2")

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")
FPS = 50


def match_for(game: str, brains: str, minutes: float) -> Setup:
    return setup_of(game, brains, "", minutes, 3, "pickups" if game == "pitanks" else "")  # without overtime


def play(arcade: Arcade, seconds: float, lit: bool = False) -> None:
    """Advance simulated time; with `lit`, the screen is projected onto the mat."""
    for _ in range(round(seconds * FPS)):
        arcade.frame(1 / FPS, draw=lit)
        if lit:
            mat = session_of(arcade.context)
            assert isinstance(mat, EmulatedSession)
            mat.show(lambda: pixels_of(arcade.screen))


def until(arcade: Arcade, kind: type | Callable[[], object], timeout: float = 8.0) -> None:
    """Advance until a scene of this type is on top, or a condition holds."""
    for _ in range(round(timeout * FPS)):
        if isinstance(arcade.stack.top, kind) if isinstance(kind, type) else kind():
            return
        arcade.frame(1 / FPS)
    raise AssertionError(f"{type(arcade.stack.top).__name__} is on top after {timeout} s")


def goes_on(arcade: Arcade, match: RealMatch) -> None:
    """Advance until robots have driven for half a second."""
    tick = match.match.state.tick
    until(arcade, lambda: match.match.state.tick > tick + 25, 2.5)


def opened(
    arcade: Arcade, game: str, brains: str, minutes: float, real: tuple[int, ...] = (0, 1), **more: Any
) -> RealMatch:
    """A match whose real robots still have to take their places."""
    match = match_of(arcade.context, match_for(game, brains, minutes), more.pop("devices", []), real, **more)
    assert isinstance(match, RealMatch)
    return arcade.open(match)


def begun(arcade: Arcade, real: tuple[int, ...] = (0, 1), minutes: float = 2.0) -> RealMatch:
    """A running PiTanks match whose robots may start from their current positions."""
    match = opened(arcade, "pitanks", "level3 level1 off off", minutes, real)
    started(arcade, match)
    return match


@pytest.mark.long
def test_rounds_are_played_with_robots_that_take_their_places_again(arcade: Arcade) -> None:
    rounds = Rounds(3)
    first = opened(arcade, "pitanks", "level1 level1 off off", 0.02, rounds=rounds)
    started(arcade, first, 0.1)
    until(arcade, lambda: first.ending.round_break and first.ending.round_break.age > 1.0, 10.0)
    arcade.stack.top.draw(arcade.screen)
    arcade.press(Button.STOP)
    assert isinstance(arcade.stack.top, FaultPage), "the emergency stop works in the break"
    first.plant.safety.release()
    until(arcade, RealMatch)
    until(arcade, lambda: arcade.stack.top is not first, 15.0)
    second = arcade.stack.top
    assert isinstance(second, RealMatch)
    assert second.gathering is not None
    assert second.real == {0, 1}
    assert second.rounds is rounds
    assert rounds.number == 2
    second.stop()
    until(arcade, Results)
    results = arcade.stack.top
    assert isinstance(results, Results)
    assert results.recording is not None
    assert verify(results.recording)


def started(arcade: Arcade, match: RealMatch, seconds: float = 0.5) -> None:
    """Start from the current positions and wait until the robots drive."""
    play(arcade, 1.0)
    arcade.press(Button.START)
    until(arcade, lambda: match.match.seconds > seconds, 7.0)


def test_robots_drive_to_their_places_and_play_with_a_disc_under_each(arcade: Arcade, mat: EmulatedSession) -> None:
    match = opened(arcade, "pitanks", "level1 level1 off off", 0.02)
    starts = [(robot.x, robot.y, robot.heading) for robot in match.match.state.robots[:2]]
    for robot, (x, y, heading) in enumerate(starts):
        mat.arena.place(robot, (x + (800.0 - x) * 0.06, y + (450.0 - y) * 0.06, heading + 0.2))
    play(arcade, 0.5, lit=True)
    assert match.gathering is not None
    until(arcade, lambda: match.gathering is None, 30.0)
    for (x, y, _), start in zip(mat.arena.poses(), starts, strict=False):
        assert hypot(x - start[0], y - start[1]) < 20.0
    until(arcade, lambda: match.match.seconds > 0.0, 5.0)
    play(arcade, 0.2, lit=True)
    assert match.match.seconds > 0.0
    for x, y, _ in mat.arena.poses()[:2]:
        for dx, dy in ((0, 0), (25, 25), (-25, 25), (25, -25), (-25, -25)):
            assert arcade.screen.get_at((round(160 + x + dx), round(140 + y + dy)))[:3] == GREY
    until(arcade, WinnersMoment)


@pytest.mark.long
@pytest.mark.parametrize("game", repeated(["pitanks", "factory", "race"]))
def test_a_short_match_of_every_game_is_played_to_its_end(arcade: Arcade, game: str) -> None:
    match = opened(arcade, game, "level3 level1 level3 level1", 0.05, (0, 2))
    play(arcade, 1.0)
    arcade.press(Button.START)
    until(arcade, Results, 28.0)
    assert match.match.over


@pytest.mark.long
def test_a_fault_pauses_with_its_reason_and_the_match_goes_on_when_it_is_gone(
    arcade: Arcade, mat: EmulatedSession
) -> None:
    """One after another, in the same match."""
    match = begun(arcade)
    for fault, says in (
        ("camera_frozen", "camera"),
        ("marker_covered", "lost"),
        ("marker_held", "held"),
        ("marker_twice", "twice"),
        ("radio_unplugged", "radio"),
        ("robot_off", "silent"),
        ("battery_low", "empty"),
    ):
        mat.arena.faults.switch(fault, True, 1)
        until(arcade, FaultPage, 3.0)
        play(arcade, 0.1)
        page = arcade.shown(FaultPage)
        assert page.faults[0].name == says
        assert page.faults[0].robot in (1, None)
        before = match.match.state.tick
        play(arcade, 0.7)
        assert match.match.state.tick == before
        assert mat.arena.clock() - max(mat.arena.last_driven[:2]) > 0.5
        mat.arena.faults.switch(fault, False, 1)
        until(arcade, RealMatch)
        goes_on(arcade, match)


@pytest.mark.long
def test_a_match_drives_with_the_drift_that_its_session_measures(arcade: Arcade, mat: EmulatedSession) -> None:
    """The scene draws the corner markers; their drift is measured independently of it."""
    match = begun(arcade)
    before, mat.arena.camera.painter.refresh = mat.arena.camera.painter.refresh, 1
    play(arcade, 1.5, lit=True)
    assert 0.0 < match.plant.rig.drift() < WARN
    mat.arena.faults.switch("camera_bumped", True)
    play(arcade, 2.5, lit=True)
    assert match.plant.rig.drift() > PAUSE
    assert arcade.shown(FaultPage).faults[0].name == "drift"
    mat.arena.camera.painter.refresh = before


@pytest.mark.long
def test_the_all_stop_holds_until_fire_is_held(arcade: Arcade, mat: EmulatedSession) -> None:
    match = begun(arcade)
    arcade.press(Button.STOP)
    arcade.shown(FaultPage)
    pressed = mat.arena.clock()
    play(arcade, 1.0)
    assert max(mat.arena.last_driven) - pressed < 0.3
    assert arcade.shown(FaultPage).faults[0].name == "stopped"
    for kind in (pygame.KEYDOWN, pygame.KEYUP):
        pygame.event.post(pygame.Event(kind, key=pygame.K_SPACE, scancode=pygame.KSCAN_SPACE, mod=0))
        play(arcade, 1.2)
    until(arcade, RealMatch)
    goes_on(arcade, match)


def test_both_shoulders_of_a_pad_are_the_all_stop(controls: Controls) -> None:
    with VirtualPad() as pad:
        controls.presses(pygame.event.get())
        controls.presses(pygame.event.get())
        heard = []
        for button in ("leftshoulder", "rightshoulder"):
            pad.press(button)
            heard.append([event.button for event in controls.presses(pygame.event.get())])
    assert heard == [[], [Button.STOP]]


@pytest.mark.long
def test_a_robot_in_trouble_is_replaced_by_a_simulated_one_with_one_press(arcade: Arcade, mat: EmulatedSession) -> None:
    match = begun(arcade)
    mat.arena.faults.switch("robot_off", True, 1)
    until(arcade, FaultPage, 3.0)
    play(arcade, 0.1)
    arcade.press(Button.X)
    until(arcade, RealMatch)
    assert match.real == {0}
    robot = match.match.state.robots[1]
    pose = robot.x, robot.y, robot.heading
    goes_on(arcade, match)
    until(arcade, lambda: (robot.x, robot.y, robot.heading) != pose)


@pytest.mark.long
def test_a_pause_offers_to_swap_robots_and_the_real_one_takes_its_place_first(arcade: Arcade) -> None:
    match = begun(arcade, real=(0,))
    arcade.press(Button.START)
    arcade.shown(Pause)
    arcade.press(Button.DOWN, Button.FIRE)
    page = arcade.shown(SwapPage)
    arcade.press(Button.DOWN, Button.FIRE)
    assert page.wanted == {0: True, 1: True}
    arcade.press(Button.BACK, Button.BACK)
    assert arcade.shown(RealMatch).gathering is not None
    play(arcade, 1.0)
    arcade.press(Button.START)
    assert match.plant.real == {0, 1}
    play(arcade, 4.5)
    assert match.gathering is None


@pytest.mark.long
def test_a_battery_that_runs_low_is_only_said(
    arcade: Arcade, mat: EmulatedSession, caplog: pytest.LogCaptureFixture
) -> None:
    match = begun(arcade)
    before, mat.arena.robots[1].battery = mat.arena.robots[1].battery, 4.2
    ticks = match.match.state.tick
    play(arcade, 1.5)
    mat.arena.robots[1].battery = before
    assert arcade.shown(RealMatch) is match
    assert match.match.state.tick > ticks + 50
    assert "The battery of robot 2 is low: change it soon." in caplog.text


@pytest.mark.long
def test_a_battery_that_was_empty_pauses_until_the_robot_takes_commands_again(
    arcade: Arcade, mat: EmulatedSession, caplog: pytest.LogCaptureFixture
) -> None:
    begun(arcade)
    body = mat.arena.robots[1]
    before, body.battery = body.battery, 3.95
    until(arcade, FaultPage, 3.0)
    body.battery = 4.2  # cells recover without load; the robot still refuses to drive
    play(arcade, 1.5)
    assert [(fault.name, fault.robot) for fault in arcade.shown(FaultPage).faults] == [("empty", 1)]
    body.battery = 4.45
    until(arcade, RealMatch, 2.0)
    body.battery = before
    assert caplog.text.count("Its motors stay off until then") == 1


@pytest.mark.long
def test_a_robot_whose_deadman_tripped_is_named_on_screen_and_once_in_the_log(
    arcade: Arcade, mat: EmulatedSession, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The robot still reports but receives nothing, as with a loose antenna."""
    match = begun(arcade)
    monkeypatch.setattr(mat.arena.firmwares[1], "_obey", lambda packet, now: None)
    play(arcade, 0.6)
    assert match.runner.notice.box
    until(arcade, FaultPage, 2.0)
    play(arcade, 1.0)
    assert ("deadman", 1) in [(fault.name, fault.robot) for fault in arcade.shown(FaultPage).faults]
    assert caplog.text.count("Robot 2 has stopped") == 1
    monkeypatch.undo()
    until(arcade, RealMatch, 2.0)


@pytest.mark.long
def test_a_restart_keeps_its_real_robots(arcade: Arcade, mat: EmulatedSession) -> None:
    match = begun(arcade)
    match.restart()
    play(arcade, 0.1)
    again = arcade.shown(RealMatch)
    assert again is not match
    assert again.real == {0, 1}
    started(arcade, again)
    assert mat.open() is again.plant.rig


@pytest.mark.long
def test_simulated_robots_begin_where_real_ones_are_missing(arcade: Arcade, mat: EmulatedSession) -> None:
    mat.arena.faults.switch("marker_covered", True, 1)
    mat.arena.faults.switch("robot_off", True, 2)
    match = opened(arcade, "pitanks", "level1 level1 level1 off", 1.0, (0, 1, 2))
    play(arcade, 2.5, lit=True)
    arcade.press(Button.X)
    assert match.real == {0}
    assert match.gathering is not None
    until(arcade, lambda: match.gathering is None, 30.0)
    play(arcade, 5.0)
    assert match.match.seconds > 0.5
    x, y, _ = mat.arena.poses()[0]
    assert hypot(x - match.match.state.robots[0].x, y - match.match.state.robots[0].y) < 30.0


@pytest.mark.long
def test_leaving_a_match_lets_go_of_the_robots(arcade: Arcade, mat: EmulatedSession) -> None:
    match = begun(arcade)
    match.stop()
    until(arcade, Results, 12.0)
    mat.arena.advance(0.3)
    assert mat.arena.clock() - max(mat.arena.last_driven) > 0.2
    assert mat.fault is None


@pytest.mark.parametrize("again", one_in(2, [False, True]))
def test_no_match_begins_with_robots_on_a_cable(arcade: Arcade, mat: EmulatedSession, again: bool) -> None:
    """Including a rematch after the radio was changed."""
    if again:
        match = begun(arcade)
        arcade.context.settings.radio = "stock"
        match.restart()
        play(arcade, 0.1)
    else:
        arcade.context.settings.radio = "stock"
        arcade.open(match_of(arcade.context, match_for("race", "level3 level1 off off", 0.1), [], (0,)))
    page = arcade.shown(UnavailablePage)
    assert "no deadman" in sentence(page.reason)
    arcade.frame(draw=True)
    arcade.press(Button.X)
    assert "no deadman" in sentence(arcade.shown(UnavailablePage).reason)
    assert mat._rig is None
    mat.arena.advance(0.3)
    assert mat.arena.clock() - max(mat.arena.last_driven) > 0.2


def test_the_reason_is_shown_and_simulated_robots_play(
    arcade: Arcade, mat: EmulatedSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing() -> None:
        raise RobotsUnavailable(OperatorMessage("no_camera", number=3))

    monkeypatch.setattr(mat, "open", missing)
    page = match_of(arcade.context, match_for("pitanks", "level3 level1 off off", 0.1), [], (0,))
    assert isinstance(page, UnavailablePage)
    arcade.open(page)
    assert sentence(arcade.shown(UnavailablePage).reason) == "There is no camera 3: plug one in."
    arcade.press(Button.FIRE)
    assert type(arcade.shown(MatchScene)) is MatchScene


@pytest.mark.long
def test_the_day_log_has_the_match_and_the_batteries_and_the_operators_page_ends_it(
    arcade: Arcade, mat: EmulatedSession, tmp_path: Path
) -> None:
    arcade.context.day_log = DayLog(tmp_path)
    stopped: list[int] = []
    arcade.context.emergency_stops += [mat.close, lambda: stopped.append(len(arcade.stack.scenes))]
    match = begun(arcade)
    assert not match.preparing
    assert match.camera_image is not None
    tick = match.match.state.tick
    arcade.open(OperatorPage(arcade.context, tuple(arcade.stack.scenes)))
    play(arcade, 1.0)
    assert match.match.state.tick == tick
    arcade.stack.apply(end_all(arcade.context))
    assert arcade.stack.top is arcade.title
    assert stopped == [4]
    records, _ = read_day(tmp_path, date.today())
    (played,) = (record for record in records if isinstance(record, PlayedMatch))
    assert (played.robots, played.complete, played.ais) == ("emulated", False, 2)
    assert [record.robot for record in records if isinstance(record, Battery)] == [1, 2]


@pytest.mark.long
def test_real_robots_stand_still_during_the_ceremony_of_a_goal(arcade: Arcade) -> None:
    match = opened(arcade, "football", "level5 level5 off off", 1.0)
    started(arcade, match)
    until(arcade, lambda: not match.preparing)
    goes_on(arcade, match)
    state = match.match.state
    ball = state.ball
    ball.out, ball.holder, ball.x, ball.y, ball.vx, ball.vy, ball.touched = 0, 0, 1560.0, 450.0, 900.0, 0.0, 1
    until(arcade, lambda: match.held, 1.0)
    play(arcade, 0.6)
    assert match.held
    body = match.plant.rig
    before = [(seen.x, seen.y) for seen in body.sense()[:2]]
    play(arcade, 1.0)
    assert match.held
    after = [(seen.x, seen.y) for seen in body.sense()[:2]]
    assert all(hypot(a - c, b - d) < 8.0 for (a, b), (c, d) in zip(before, after, strict=True)), (before, after)
    goes_on(arcade, match)
    match.stop()
    until(arcade, Results)
