"""The operator menu, opened from the options, and the marker sheet in the user's folder."""

from pathlib import Path

import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.session.guide import SHEET
from pigaming_app.hardware.vision.markers import OpenCVMissing
from pigaming_app.scenes.mat.calibration.corner_pin_page import CornerPinPage
from pigaming_app.scenes.mat.calibration.drift_page import DriftPage
from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage
from pigaming_app.scenes.mat.robots.menu import RobotsMenu
from pigaming_app.scenes.options.page import OptionsPage
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pigaming_app.hardware.calibration.site.cameras", lambda: [])
    arcade.open(OptionsPage(arcade.context))
    go(arcade, OptionsPage, "robots")
    arcade.press(Button.FIRE)


def go(arcade: Arcade, kind: type[OptionsPage] | type[RobotsMenu], name: str) -> None:
    page = arcade.shown(kind)
    while page.focus.name != name:
        arcade.press(Button.DOWN)


@pytest.mark.parametrize(
    ("name", "kind"), [("calibrate", CalibrationPage), ("check", DriftPage), ("pin", CornerPinPage)]
)
def test_every_page_is_a_press_away_and_leads_back(arcade: Arcade, name: str, kind: type[CornerPinPage]) -> None:
    go(arcade, RobotsMenu, name)
    arcade.press(Button.FIRE)
    arcade.shown(kind)
    arcade.press(Button.BACK)
    assert arcade.shown(RobotsMenu).focus.name == name
    arcade.press(Button.BACK)
    arcade.shown(OptionsPage)


def test_the_sheet_is_written_and_it_says_where(arcade: Arcade, home: Path) -> None:
    go(arcade, RobotsMenu, "sheet")
    arcade.press(Button.FIRE)
    written = home / "data" / SHEET
    assert written.read_bytes().startswith(b"%PDF")
    assert str(written) in arcade.shown(RobotsMenu).message


def test_a_sheet_that_cannot_be_written_is_one_sentence(
    arcade: Arcade, home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (home / "data" / SHEET).mkdir(parents=True)
    go(arcade, RobotsMenu, "sheet")
    arcade.press(Button.FIRE)
    assert arcade.shown(RobotsMenu).message == arcade.context.words("app.unsaved")

    def none(**_: object) -> bytes:
        raise OpenCVMissing(OperatorMessage("no_opencv"))

    monkeypatch.setattr("pigaming_app.scenes.mat.paper.marker_sheet.sheet", none)
    arcade.press(Button.FIRE)
    assert arcade.shown(RobotsMenu).message == arcade.context.words("hardware.no_opencv")
