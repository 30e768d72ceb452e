"""From the options to all that robots need, and the sheet of markers in the user's folder."""

from pathlib import Path

import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.vision.markers import OpenCVMissing
from pigaming_app.scenes.calibration.corner_pin_page import PinPage
from pigaming_app.scenes.calibration.drift_page import CheckPage
from pigaming_app.scenes.calibration.setup_page import CalibrationPage
from pigaming_app.scenes.options.page import OptionsPage
from pigaming_app.scenes.robots.menu import SHEET, RobotsMenu
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Act
from pigaming_app.ui.window import Canvas
from tests.scenes.arcade import Arcade


@pytest.fixture
def arcade(controls: Controls, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Arcade:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    monkeypatch.setattr("pigaming_app.hardware.calibration.site.cameras", lambda: [])
    arcade = Arcade(controls)
    arcade.house.canvas = Canvas.open(Settings(fullscreen=False), headless=True)
    arcade.open(OptionsPage(arcade.house))
    go(arcade, OptionsPage, "robots")
    arcade.press(Act.FIRE)
    return arcade


def go(arcade: Arcade, kind: type[OptionsPage] | type[RobotsMenu], name: str) -> None:
    page = arcade.shown(kind)
    while page.focus.name != name:
        arcade.press(Act.DOWN)


@pytest.mark.parametrize(("name", "kind"), [("calibrate", CalibrationPage), ("check", CheckPage), ("pin", PinPage)])
def test_every_page_is_a_press_away_and_leads_back(arcade: Arcade, name: str, kind: type[PinPage]) -> None:
    go(arcade, RobotsMenu, name)
    arcade.press(Act.FIRE)
    arcade.shown(kind)
    arcade.press(Act.BACK)
    assert arcade.shown(RobotsMenu).focus.name == name
    arcade.press(Act.BACK)
    arcade.shown(OptionsPage)


@pytest.mark.parametrize("language", ["en", "pt"])
def test_the_sheet_is_written_and_it_says_where(arcade: Arcade, tmp_path: Path, language: str) -> None:
    arcade.house.words.switch(language)
    go(arcade, RobotsMenu, "sheet")
    arcade.press(Act.FIRE)
    written = tmp_path / "data" / SHEET
    assert written.read_bytes().startswith(b"%PDF")
    assert str(written) in arcade.shown(RobotsMenu).sentence


def test_a_sheet_that_cannot_be_written_is_one_sentence(
    arcade: Arcade, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "data" / SHEET).mkdir(parents=True)
    go(arcade, RobotsMenu, "sheet")
    arcade.press(Act.FIRE)
    assert arcade.shown(RobotsMenu).sentence == arcade.house.words("app.unsaved")

    def none(**_: object) -> bytes:
        raise OpenCVMissing(OperatorMessage("no_opencv"))

    monkeypatch.setattr("pigaming_app.hardware.calibration.marker_sheet.sheet", none)
    arcade.press(Act.FIRE)
    assert arcade.shown(RobotsMenu).sentence == arcade.house.words("hardware.no_opencv")


def test_children_in_a_kiosk_do_not_find_it(arcade: Arcade) -> None:
    arcade.house.kiosk = True
    assert "robots" not in OptionsPage(arcade.house).rows
    assert "robots" in OptionsPage(arcade.house, operator=True).rows
