"""The guide: steps from the box to a match, done on their own pages, and found done on the next day."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.session import store
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.session.guide import SHEET, STEPS
from pigaming_app.jobs.mat.guide import GuideOptions, run
from pigaming_app.scenes.mat.calibration.corner_pin_page import CornerPinPage
from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage
from pigaming_app.scenes.mat.mat import SessionMat
from pigaming_app.scenes.mat.robots.fleet_page import FleetPage
from pigaming_app.scenes.mat.robots.guide_page import GuidePage
from pigaming_app.scenes.mat.robots.menu import RobotsMenu
from pigaming_app.scenes.mat.robots.set_up_page import SetUpPage
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade


def opened(arcade: Arcade) -> GuidePage:
    """The guide, as the menu opens it."""
    menu = arcade.open(RobotsMenu(arcade.context))
    assert menu.focus.name == "guide"
    arcade.press(Button.FIRE)
    return arcade.shown(GuidePage)


def done(page: GuidePage) -> list[str]:
    return [name for name, step in page.steps.items() if step.done]


def calibrate(arcade: Arcade, mat: EmulatedSession, projection: str | None = None) -> None:
    """Save the calibration of the emulated arena, as its wizard does."""
    mat.open()
    assert mat.ground is not None
    ground = replace(mat.ground, display=projection or arcade.context.canvas.projection)
    store.save(ground, store.calibration_file("emulated"))
    mat.close()


def test_the_first_step_that_is_missing_has_the_focus(arcade: Arcade, mat: EmulatedSession) -> None:
    for robot in range(4):
        mat.arena.faults.switch("robot_off", True, robot)
    page = opened(arcade)
    assert page.focus.name == "robots"
    assert done(page) == []


def test_robots_that_are_switched_on_are_counted_while_the_page_is_open(arcade: Arcade, mat: EmulatedSession) -> None:
    page = opened(arcade)
    arcade.wait(2.5, fps=50)
    assert page.value("robots").options == ("4 on the radio",)
    mat.arena.faults.switch("robot_off", True, 1)
    arcade.wait(4.0, fps=50)
    assert page.value("robots").options == ("3 on the radio",)
    assert done(page) == ["robots"]


def test_a_button_ends_that_the_focus_goes_on_by_itself(arcade: Arcade, mat: EmulatedSession) -> None:
    page = opened(arcade)
    arcade.press(Button.UP)
    before = page.focus.name
    arcade.wait(2.5, fps=50)
    assert (done(page), page.focus.name) == (["robots"], before)


@pytest.mark.parametrize(
    ("step", "kind"),
    [("robots", SetUpPage), ("pin", CornerPinPage), ("calibrate", CalibrationPage), ("pair", FleetPage)],
)
def test_each_step_opens_its_page_and_leads_back(
    arcade: Arcade, step: str, kind: type[SetUpPage], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pigaming_app.hardware.calibration.site.cameras", lambda: [])
    page = opened(arcade)
    page.focus.move_to(step)
    arcade.press(Button.FIRE)
    arcade.shown(kind)
    arcade.press(Button.BACK)
    assert arcade.shown(GuidePage) is page


def test_whoever_stopped_goes_on_the_next_day(
    arcade: Arcade, mat: EmulatedSession, controls: Controls, home: Path
) -> None:
    """Each morning another arcade opens, with nothing but the files of the day before."""
    days: list[tuple[list[str], str]] = []

    def another_day() -> tuple[Arcade, GuidePage]:
        morning = Arcade(controls)
        morning.context.settings = Settings.load(folders().config)[0]
        morning.context.mat = SessionMat(morning.context, mat)
        page = opened(morning)
        morning.wait(2.5, fps=50)
        days.append((done(page), page.focus.name))
        return morning, page

    today, page = another_day()
    page.focus.move_to("sheet")
    today.press(Button.FIRE)
    assert (home / "data" / SHEET).read_bytes().startswith(b"%PDF")
    assert str(home / "data" / SHEET) in page.message
    today.press(Button.BACK)
    today, page = another_day()
    today.press(Button.FIRE)
    today.shown(CornerPinPage)
    today.press(Button.RIGHT, Button.START)
    today.press(Button.BACK, Button.BACK)
    mat.close()
    today, page = another_day()
    calibrate(today, mat)
    today, page = another_day()
    assert page.focus.name == "mat"
    today.press(Button.FIRE)
    today, page = another_day()
    today.context.settings.camera_delay = 20  # as pairing leaves it
    today.context.settings.save(folders().config)
    today, page = another_day()
    today.context.settings.tops = [0, 0, 250, 0]  # as the test drive leaves it
    today.context.settings.save(folders().config)
    today, page = another_day()
    today.context.settings.real = [1]  # as the lobby leaves it
    today.context.settings.save(folders().config)
    today, page = another_day()
    names = [[*STEPS[:count]] for count in range(1, len(STEPS) + 1)]
    assert [found for found, _ in days] == names
    assert [focus for _, focus in days] == [*STEPS[1:], STEPS[-1]]


def test_a_calibration_of_another_display_is_told_where_it_is_made_again(arcade: Arcade, mat: EmulatedSession) -> None:
    calibrate(arcade, mat, "another display")
    page = opened(arcade)
    assert "calibrate" not in done(page)
    assert page.description("calibrate")[1] == "Display or corners have changed: calibrate again."


def test_the_command_prints_the_same_steps(
    home: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pigaming_app.jobs.mat.guide.LISTEN", 0.0)
    settings = Settings.load(folders().config)[0]
    settings.port = "/dev/nowhere"
    settings.save(folders().config)
    assert run(GuideOptions()) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(STEPS) + 1
    assert "[ ]" in lines[0]
    assert lines[-1].startswith("Next: Robots (")
    settings.camera_delay, settings.mat, settings.real, settings.corners = 0, True, [1], [0, 0, 9, 0, 9, 9, 0, 9]
    settings.tops = [0] * 4
    settings.save(folders().config)
    assert run(GuideOptions(json=True)) == 0
    found = json.loads(capsys.readouterr().out)
    assert {row["step"]: row["done"] for row in found["steps"]} == {name: name != "calibrate" for name in STEPS}
    assert found["next"] == "calibrate"
