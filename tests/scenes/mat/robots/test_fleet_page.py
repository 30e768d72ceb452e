"""The fleet page: robot status, pairing, latency, faults."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from pigaming_app.hardware.emulator.camera import TRAITS
from pigaming_app.hardware.radio.packets import DEADMAN, EMPTY, PARKED, RESTARTED
from pigaming_app.hardware.radio.protocol import Misfit
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.session.real import RealSession
from pigaming_app.scenes.mat.mat import SessionMat
from pigaming_app.scenes.mat.robots.avoid_discs import hit
from pigaming_app.scenes.mat.robots.fleet_page import ABOVE, MESSAGE, ROWS, FleetPage
from pigaming_app.scenes.mat.session import session_of
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets import setting_row as dials
from tests.scenes.arcade import Arcade

pytest.importorskip("cv2")


@pytest.fixture(scope="module")
def mat() -> Iterator[EmulatedSession]:
    mat = EmulatedSession(live=False)
    yield mat
    mat.end()


@pytest.fixture
def arcade(arcade: Arcade, mat: EmulatedSession) -> Iterator[Arcade]:
    arcade.open(FleetPage(arcade.context))
    arcade.wait(1.1, fps=50)
    yield arcade
    mat.close()


def idle(arcade: Arcade, page: FleetPage) -> None:
    """Wait until all robots stand still."""
    for _ in range(60):
        arcade.wait(0.5, fps=50)
        if not page.check.busy:
            return
    raise AssertionError("still busy")


def test_a_cable_is_refused_for_matches_where_it_is_chosen(arcade: Arcade, mat: EmulatedSession) -> None:
    arcade.context.settings.radio = "stock"
    page = arcade.open(FleetPage(arcade.context))
    arcade.press(Button.UP)
    assert page.focus.name == "radio"
    assert "no deadman" in page.line("radio")
    arcade.press(Button.LEFT)
    assert "no deadman" not in page.line("radio")


def test_the_exposure_is_shown_and_a_long_one_or_a_poor_calibration_warned_about(
    arcade: Arcade, mat: EmulatedSession
) -> None:
    page = arcade.shown(FleetPage)
    assert page._state().endswith("1/167 s")
    assert page._notice() == ""
    quality = mat.quality
    assert quality is not None
    mat.quality = replace(quality, detection=0.6, anyway=True)
    assert page._notice() == "Calibrated anyway: about 60 % of the markers are found."
    camera = mat.arena.camera
    camera.traits, camera.manual = TRAITS["stubborn"], 1 / 30  # the driver has forgotten it
    arcade.wait(1.2, fps=50)
    assert page._state().endswith("1/30 s")
    assert "smear at 1/30\u00a0s" in page._notice()
    mat.quality, camera.traits, camera.manual = quality, TRAITS["good"], 0.006


def test_batteries_and_visible_robots_are_shown(arcade: Arcade, mat: EmulatedSession) -> None:
    mat.arena.faults.switch("robot_off", True, 2)
    mat.arena.faults.switch("marker_covered", True, 3)
    mat.arena.faults.switch("old_firmware", True, 1)
    arcade.wait(3.0, fps=50)
    page = arcade.shown(FleetPage)
    heard, _, seen, _ = page.lines[0]
    assert heard.startswith("5.")
    assert "V" in heard
    assert seen == "seen  ·  Pololu 3pi"
    assert page.lines[1][::2] == ("old firmware", "flash it anew")
    assert page.lines[2][0] == "no signal"
    assert page.lines[3][2] == "not seen  ·  Pololu 3pi"
    for name, robot in mat.arena.faults.on():
        mat.arena.faults.switch(name, False, robot)


def test_why_a_robot_cannot_drive_is_shown_with_its_remedy(
    arcade: Arcade, mat: EmulatedSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = arcade.shown(FleetPage)
    fine = page.check.health(0)
    lines = {
        "key": ("another key", "copy its config.py anew"),
        "no_arena": ("no arena number", "flash it anew"),
        "foreign": ("no signal", "only from arena 78"),
    }
    states = [(replace(fine, misfit=Misfit(reason, 78, 0.0)), shown) for reason, shown in lines.items()]
    for state, shown in states:
        monkeypatch.setattr(page.check, "health", lambda robot, state=state: state)
        assert page._read(0)[::2] == shown


def test_every_flag_of_a_report_is_shown(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    page = arcade.shown(FleetPage)
    for flags, first, second in (
        (EMPTY, "battery empty: 4.2 V", "change it"),
        (PARKED, "stopped by its button", "press the button again"),
        (DEADMAN, "receives no commands", "seen"),
        (RESTARTED, "4.2 V", "seen  ·  restarted by its watchdog"),
    ):
        report = page.check.link.telemetry[0]._replace(flags=flags, battery=4.2)
        monkeypatch.setattr(page.check.link._protocol, "_telemetry", {0: report})
        line = page._read(0)
        assert line[0].startswith(first)
        assert line[2] == second


def test_discs_hide_neither_rows_nor_figures(arcade: Arcade, mat: EmulatedSession) -> None:
    page = arcade.shown(FleetPage)
    arcade.wait(1.0, fps=20, draw=True)
    assert page.discs is not None
    discs = page.discs.circles({0, 1, 2, 3})
    assert len(discs) == 12
    assert not hit(page.aside.placed, discs)
    arcade.press(Button.DOWN)
    assert page.focus.name == "latency"
    box = page.focus.spots[0].rect
    rows = page.aside.placed[0]
    at = [rows.at[i] + (box.center[i] - rows.home.topleft[i]) * rows.scale for i in (0, 1)]
    page.handle(InputEvent(Button.POINT, Device("mouse"), at=(at[0], at[1])))
    assert page.focus.name == "pair", "clicks follow the moved block"


def test_all_rows_of_a_real_mat_have_room_above_the_message():
    assert dials.spots(ROWS, ABOVE)[-1].rect.bottom + 20 < MESSAGE.top
    assert [spot.rect.y for spot in dials.spots(ROWS[:7], ABOVE)] == [spot.rect.y for spot in dials.spots(ROWS[:7])]


@pytest.mark.long
def test_swapped_markers_are_found_and_remembered(arcade: Arcade, mat: EmulatedSession) -> None:
    page = arcade.shown(FleetPage)
    rig = page.check.rig
    assert rig is not None
    one, two = mat.arena.poses()[:2]
    heard = mat.arena.firmwares
    heard[0].robot, heard[1].robot = heard[1].robot, heard[0].robot  # swap the radios of two robots
    try:
        arcade.press(Button.FIRE)
        assert page.check.busy
        idle(arcade, page)
        assert rig.channels[:2] == (1, 0)
        assert arcade.context.settings.radios == [2, 1, 3, 4]
        assert "This is now saved" in page.message
        assert Settings.load(folders().config)[0].radios == [2, 1, 3, 4]
    finally:
        heard[0].robot, heard[1].robot = heard[1].robot, heard[0].robot
        mat.arena.place(0, one)
        mat.arena.place(1, two)


def test_any_press_stops_what_moves(arcade: Arcade, mat: EmulatedSession) -> None:
    page = arcade.shown(FleetPage)
    arcade.press(Button.FIRE)
    arcade.wait(1.2, fps=50)
    assert any(robot.left for robot in mat.arena.robots)
    arcade.press(Button.BACK)
    assert arcade.shown(FleetPage) is page
    arcade.wait(0.3, fps=50)
    assert not any(robot.left or robot.right for robot in mat.arena.robots)
    assert not page.check.busy


@pytest.mark.long
def test_the_delay_of_the_whole_loop_is_measured(arcade: Arcade) -> None:
    page = arcade.shown(FleetPage)
    page.check.begin()
    page.check._todo = [0]
    assert page.check._next()
    idle(arcade, page)
    late = page.check.latencies[0]
    assert late is not None
    assert 0.05 < late < 0.15


def test_without_camera_and_radio_it_says_what_is_wrong_and_settings_can_be_changed(
    controls: Controls, home: Path
) -> None:
    arcade = Arcade(controls, "pt")
    settings = arcade.context.settings
    settings.port = "/dev/nowhere"
    mat = RealSession(settings, lambda: "1")
    arcade.context.mat = SessionMat(arcade.context, mat)
    arcade.open(FleetPage(arcade.context))
    try:
        page = arcade.shown(FleetPage)
        assert "calibra" in page._state()
        arcade.wait(0.5)
        arcade.until(lambda: mat.fault is not None, 5.0)
        assert "A porta /dev/nowhere não existe" in str(page._fault())
        arcade.press(Button.UP, Button.LEFT)
        assert settings.radio == "api2"
        arcade.press(Button.RIGHT)
        assert settings.radio == "api1"
        assert Settings.load(folders().config)[0].radio == "api1"
        arcade.wait(1.5, draw=True)
    finally:
        arcade.press(Button.BACK)
    assert session_of(arcade.context).fault is None
