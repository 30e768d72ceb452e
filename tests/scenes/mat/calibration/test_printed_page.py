"""The wizard over a printed floor, and a match there whose robots are seen on the screen."""

import pytest

pytest.importorskip("cv2")
pytest.importorskip("pypdfium2")

from pigaming_app.hardware.calibration.boards import ARENA_AT
from pigaming_app.hardware.calibration.site import Measurements
from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
from pigaming_app.hardware.proof.showings import ShowingSession
from pigaming_app.hardware.session import store
from pigaming_app.scenes.mat.calibration.printed_page import PrintedPage
from pigaming_app.scenes.mat.calibration.result_page import ResultPage
from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage
from pigaming_app.scenes.mat.mat import SessionMat
from pigaming_app.scenes.mat.robots.match_scene import RealMatch
from pigaming_app.scenes.play.scene import match_of
from pigaming_app.ui.draw import GREY, PLAYERS
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.hardware.paper import printed, printed_arena
from tests.matches import setup_of
from tests.scenes.arcade import Arcade
from tests.scenes.operated import Operated


def test_the_wizard_calibrates_a_printed_floor_and_remembers_that_it_is_one():
    arcade = Operated(Controls(), EmulatedCalibrationSite(arena=printed_arena(2)))
    first = arcade.open(CalibrationPage(arcade.context, arcade.site))
    arcade.context.canvas.watchers.clear()  # nothing is projected
    assert not first.printed
    assert {"display", "by"} <= {*first.rows}
    arcade.go("floor")
    arcade.press(Button.RIGHT)
    assert not {"display", "by"} & {*first.rows}
    arcade.go("begin")
    arcade.press(Button.FIRE)
    arcade.shown(PrintedPage)
    result = arcade.pictures(ResultPage)
    assert result.finding.good
    arcade.press(Button.FIRE)
    assert store.load(store.calibration_file("emulated"), "another screen").printed
    assert CalibrationPage(arcade.context, arcade.site).printed


def test_an_arena_too_small_for_its_robots_is_refused_with_the_smallest():
    arcade = Operated(Controls(), EmulatedCalibrationSite(arena=printed_arena(2)))
    page = arcade.open(CalibrationPage(arcade.context, arcade.site))
    page.measures = Measurements(700.0, 2500.0)
    arcade.go("begin")
    arcade.press(Button.FIRE)
    assert arcade.shown(CalibrationPage) is page
    assert page.message == "An arena of 700 mm is too small for robots of 95 mm: make it at least 752 mm wide."


@pytest.mark.long
@pytest.mark.again
def test_robots_are_seen_on_the_screen_and_nothing_is_lit_for_the_camera(arcade: Arcade):
    session = ShowingSession(printed(), 3, live=False)
    arcade.context.mat = SessionMat(arcade.context, session)
    match = match_of(arcade.context, setup_of("pitanks", "level3 level3", "", 0.5, 3, "pickups"), [], (0, 1))
    assert isinstance(match, RealMatch)
    arcade.open(match)
    for _ in range(50):
        arcade.frame(1 / 50)
    assert match.gathering is not None
    assert_shown(arcade, match, session)
    for _ in range(50 * 20):
        if match.gathering is not None or match.preparing:
            arcade.frame(1 / 50)
    for _ in range(50):
        arcade.frame(1 / 50)
    assert match.match.state.tick > 25
    assert_shown(arcade, match, session)
    session.end()


def assert_shown(arcade, match, session):
    """Each robot is drawn in its colour where it is, without the grey light for its marker."""
    match.draw(arcade.screen)
    for robot, (x, y, _) in enumerate(session.arena.poses()[:2]):
        middle = round(ARENA_AT[0] + x), round(ARENA_AT[1] + y)
        around = [(middle[0] + dx, middle[1] + dy) for dx in range(-40, 41) for dy in range(-40, 41)]
        colors = [arcade.screen.get_at(at)[:3] for at in around]
        assert colors.count(PLAYERS[robot]) > 40
        assert colors.count(GREY) < 10
