"""The calibration wizard on the emulated arena: it recovers the ground truth; every failure is one sentence."""

import ast
import os
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pygame
import pytest

pytest.importorskip("cv2")

from pigaming_app import hardware
from pigaming_app.hardware.calibration import camera_task as looking
from pigaming_app.hardware.calibration import height_procedure as standing
from pigaming_app.hardware.calibration.boards import BOARD
from pigaming_app.hardware.calibration.corner_pin import CornerPin
from pigaming_app.hardware.calibration.ground_plane import CalibrationError
from pigaming_app.hardware.calibration.quality import assessed, used_anyway
from pigaming_app.hardware.emulator.camera import TRAITS
from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
from pigaming_app.hardware.radio.serial_line import ERRORS
from pigaming_app.hardware.session import store
from pigaming_app.hardware.signals import ExposureState
from pigaming_app.scenes.mat.calibration.boards_page import BoardsPage
from pigaming_app.scenes.mat.calibration.drift_page import DriftPage
from pigaming_app.scenes.mat.calibration.height_page import HeightPage
from pigaming_app.scenes.mat.calibration.result_page import CalibrationResult, ResultPage
from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw.pixels import pixels_of
from pigaming_app.ui.i18n import Words, texts
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets import setting_row as dials
from tests.scenes.operated import Operated

LONG = 120.0  # s, timeout of a test: the machine may be busy


class Wizard(NamedTuple):
    """A calibration by the wizard, with its page's state before, and its result on top."""

    home: Path
    arcade: Operated
    first: CalibrationPage
    before: str
    result: ResultPage


@pytest.fixture(scope="module")
def wizard() -> Iterator[Wizard]:
    """Calibrate once, after a look at the preview."""
    with tempfile.TemporaryDirectory() as home, pytest.MonkeyPatch.context() as patch:
        patch.setenv("PIGAMING_HOME", home)
        pygame.display.init()
        arcade = Operated(Controls(), EmulatedCalibrationSite(2))
        first = arcade.open(CalibrationPage(arcade.context, arcade.site))
        for _ in range(8):
            arcade.picture()
        before = first.state
        arcade.begin()
        yield Wizard(Path(home), arcade, first, before, arcade.pictures(ResultPage))


@pytest.fixture(scope="module")
def made(wizard: Wizard) -> CalibrationResult:
    """The calibration, shared by the tests of later pages."""
    return wizard.result.finding


def boards(arcade: Operated, made: CalibrationResult) -> BoardsPage:
    """The page of the boards, from which a calibration begins again."""
    return BoardsPage(arcade.context, arcade.site, made.number, made.measures)


def concluded(arcade: Operated, made: CalibrationResult) -> ResultPage:
    """The page of a calibration that has been made, above the wizard's first."""
    page = arcade.open(ResultPage(arcade.context, replace(made, site=arcade.site), lambda: boards(arcade, made)))
    return page


@pytest.fixture
def arcade(controls: Controls, _home: None) -> Operated:
    arcade = Operated(controls, EmulatedCalibrationSite(2))
    arcade.open(CalibrationPage(arcade.context, arcade.site))
    return arcade


def test_an_operator_previews_calibrates_and_saves(wizard: Wizard) -> None:
    home, arcade, first, before, result = wizard
    assert first.preview is not None
    assert first.preview.size == (1920, 1080)
    assert before == arcade.context.words("hardware.none")
    assert result.finding.good
    assert result.finding.residuals is not None
    assert result.finding.residuals.mean_mm < 1.5
    assert result.finding.residuals.max_mm < 3.0
    assert result.finding.ground is not None
    quality = result.finding.ground.quality
    assert quality.exposure == pytest.approx(0.006)
    assert quality.marker_px == pytest.approx(28.0, abs=1.0)
    assert quality.blur_px == pytest.approx(0.85, abs=0.15)
    assert quality.detection > 0.98
    assert arcade.shown(ResultPage) is result
    arcade.press(Button.FIRE)
    assert arcade.stack.top is first
    ground = store.load(store.calibration_file(arcade.site.name), arcade.context.canvas.projection, (1920, 1080))
    assert ground.width_mm == arcade.site.measures.width
    for _ in range(5):
        arcade.picture()
    assert f"{ground.mean_mm:.1f} mm" in first.state
    assert not (home / "config" / "calibration.toml").exists(), "an emulated one is not the real one"


def test_the_boards_are_shown_with_no_other_light(arcade: Operated) -> None:
    arcade.begin()
    arcade.picture()
    shown = pixels_of(arcade.context.canvas.screen)[:, :, 0]
    plain = BOARD.picture()
    assert np.array_equal(shown[:1044], plain[:1044])
    assert not np.array_equal(shown[1044:], plain[1044:]), "the progress is in the margin below"


@pytest.mark.long
def test_a_robot_on_the_spots_gives_the_camera_height(arcade: Operated) -> None:
    arcade.go("by")
    arcade.press(Button.RIGHT)
    assert "height" not in [spot.name for spot in arcade.shown(CalibrationPage).focus.spots]
    arcade.begin()
    arcade.pictures(HeightPage)
    arcade.shown(HeightPage)
    result = arcade.pictures(ResultPage)
    assert result.finding.good
    assert result.finding.ground.height == pytest.approx(arcade.site.arena.optics.lens.eye[2], rel=0.05)
    assert result.finding.marker_mm == pytest.approx(50.0, rel=0.04)
    arcade.shown(ResultPage)


@pytest.mark.long
def test_a_person_in_the_light_is_reported_and_a_repeat_succeeds(arcade: Operated) -> None:
    arcade.begin()
    result = arcade.pictures(ResultPage, covered=True)
    assert not result.finding.good
    assert isinstance(result.finding.trouble, OperatorMessage)
    assert result.finding.trouble.key == "few"
    assert result.picture is not None, "what the camera saw is shown"
    assert [spot.name for spot in result.focus.spots] == ["again", "leave"]
    arcade.shown(ResultPage)
    arcade.press(Button.FIRE)
    assert arcade.pictures(ResultPage).finding.good


@pytest.mark.long
def test_a_calibration_that_is_too_bad_cannot_be_saved(
    arcade: Operated, made: CalibrationResult, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pigaming_app.hardware.calibration.solver.MEAN_MM", 0.001)
    result = concluded(arcade, made)
    assert result.finding.residuals is not None
    assert [spot.name for spot in result.focus.spots] == ["again", "leave"]
    arcade.shown(ResultPage)
    arcade.press(Button.RIGHT, Button.FIRE)
    arcade.shown(CalibrationPage)
    with pytest.raises(CalibrationError):
        store.load(store.calibration_file(arcade.site.name), arcade.context.canvas.projection, (1920, 1080))


@pytest.mark.skipif(os.name == "posix" and os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_that_cannot_be_written(arcade: Operated, made: CalibrationResult, tmp_path: Path) -> None:
    (tmp_path / "config").mkdir()
    (tmp_path / "config").chmod(0o500)
    concluded(arcade, made)
    arcade.press(Button.FIRE)
    assert str(store.calibration_file(arcade.site.name)) in arcade.shown(ResultPage).message


def with_picture(made: CalibrationResult, exposure: float, blur: float) -> CalibrationResult:
    """The calibration with a picture of this exposure, s, and blur, px."""
    assert made.ground is not None
    state = ExposureState(exposure, 1 / 30, 0.0, False, True)
    quality = assessed(made.ground.quality.marker_px, blur, state)
    return replace(made, ground=replace(made.ground, quality=quality), exposure=state)


def test_a_picture_that_misses_markers_is_saved_only_by_the_second_choice_and_warned_about(
    arcade: Operated, made: CalibrationResult
) -> None:
    arcade.context.words.switch("pt")
    result = concluded(arcade, with_picture(made, 0.006, 2.4))
    assert [spot.name for spot in result.focus.spots] == ["again", "anyway", "leave"]
    assert result.focus.name == "again"
    arcade.picture()
    arcade.press(Button.RIGHT, Button.FIRE)
    quality = store.load(store.calibration_file(arcade.site.name)).quality
    assert quality.anyway
    assert quality.detection < 0.95
    first = arcade.shown(CalibrationPage)
    for _ in range(8):
        arcade.picture()
    assert first.state == arcade.context.words.sentence(used_anyway(quality))


def test_a_long_exposure_is_warned_about_though_the_calibration_is_accurate(
    arcade: Operated, made: CalibrationResult
) -> None:
    result = concluded(arcade, with_picture(made, 1 / 45, 0.8))
    assert result.finding.good
    assert result.finding.ground is not None
    assert "1/45\u00a0s" in result._warning(result.finding.ground.quality)[0]
    arcade.picture()
    arcade.press(Button.FIRE)
    kept = store.load(store.calibration_file(arcade.site.name)).quality
    assert kept.kept == (1 / 45, 0.0)
    assert not kept.anyway


@pytest.mark.long
@pytest.mark.usefixtures("_home")
def test_check_calibration_sets_the_exposure_again_and_shows_exposure_and_blur(controls: Controls) -> None:
    site = EmulatedCalibrationSite(2, traits=TRAITS["long"])
    arcade = Operated(controls, site)
    arcade.open(CalibrationPage(arcade.context, site))
    arcade.begin()
    arcade.pictures(ResultPage)
    arcade.press(Button.FIRE)
    camera = site.arena.camera
    camera.automatic = True  # another program used it
    assert camera.shutter == pytest.approx(1 / 30)
    arcade.open(DriftPage(arcade.context, site))
    checking = arcade.shown(DriftPage).work
    for _ in range(40):
        arcade.picture()
    assert camera.shutter == pytest.approx(0.0166)
    assert checking.quality is not None
    assert checking.quality.exposure == pytest.approx(0.0166)
    assert checking.quality.blur_px == pytest.approx(0.85, abs=0.2)
    camera.traits = TRAITS["stubborn"]  # a driver that forgets, and a lens that was knocked
    camera.manual, camera.painter._blur = 1 / 30, 2.2
    for _ in range(40):
        arcade.picture()
    assert not checking.quality.sufficient
    assert checking.quality.exposure == pytest.approx(1 / 30, rel=0.01)
    assert checking.quality.blur_px > 1.8


def test_a_mirrored_picture_is_turned_over_at_a_press_and_calibrated_again(
    arcade: Operated, made: CalibrationResult
) -> None:
    result = concluded(arcade, replace(made, trouble=OperatorMessage("mirrored"), ground=None))
    assert [spot.name for spot in result.focus.spots] == ["flip", "again", "leave"]
    arcade.picture()
    arcade.press(Button.FIRE)
    arcade.shown(BoardsPage)
    over = [1920, 0, 0, 0, 0, 1080, 1920, 1080]
    assert list(arcade.context.canvas.corners) == arcade.context.settings.corners == over
    concluded(arcade, replace(made, trouble=OperatorMessage("mirrored"), ground=None))
    arcade.press(Button.FIRE)
    assert arcade.context.canvas.corners == ()
    assert arcade.context.settings.corners == []


def test_a_weak_place_is_ringed(arcade: Operated, made: CalibrationResult) -> None:
    pictures = []
    for weak in (None, (1300.0, 200.0)):
        result = concluded(arcade, replace(made, weak=weak))
        arcade.picture()
        pictures.append(pixels_of(arcade.context.canvas.screen).astype(int))
        assert result.arrows is not None
    rows, columns = np.nonzero(np.abs(pictures[0] - pictures[1]).max(axis=2) > 60)
    assert len(rows) > 100
    assert np.ptp(rows) == pytest.approx(np.ptp(columns), abs=3)


def test_a_failed_save_is_reported_and_nothing_is_lost(
    arcade: Operated, made: CalibrationResult, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(path: Path, text: str) -> None:
        raise NotSaved(f"{path} was not saved: the disk is full.")

    concluded(arcade, made)
    monkeypatch.setattr(store, "write_with_backup", full)
    arcade.press(Button.FIRE)
    assert str(store.calibration_file(arcade.site.name)) in arcade.shown(ResultPage).message
    monkeypatch.undo()


def test_the_way_back_leads_out_of_every_page(arcade: Operated, made: CalibrationResult) -> None:
    arcade.begin()
    arcade.picture()
    arcade.press(Button.BACK)
    arcade.shown(CalibrationPage)
    concluded(arcade, made)
    arcade.press(Button.BACK)
    arcade.shown(CalibrationPage)
    arcade.press(Button.BACK)
    assert arcade.stack.top is arcade.setup


def test_a_camera_that_fails_during_calibration(arcade: Operated) -> None:
    arcade.begin()
    for _ in range(5):
        arcade.picture()
    arcade.site.arena.faults.switch("camera_frozen", True)
    result = arcade.pictures(ResultPage)
    assert result.finding.trouble == looking.NO_PICTURE
    arcade.shown(ResultPage)


def test_a_missing_robot_times_out(arcade: Operated, made: CalibrationResult, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(standing, "TIMEOUT", 1.0)
    monkeypatch.setattr(arcade.site, "stand", lambda x, y: arcade.site.clear(True))
    arcade.open(HeightPage(arcade.context, replace(made, site=arcade.site), lambda: boards(arcade, made)))
    result = arcade.pictures(ResultPage)
    assert result.finding.trouble.key == "nobody"


@pytest.mark.long
def test_a_moved_projector_is_detected_by_the_drift_page(arcade: Operated, made: CalibrationResult) -> None:
    concluded(arcade, made)
    arcade.press(Button.FIRE, Button.BACK)
    arcade.open(DriftPage(arcade.context, arcade.site))
    checking = arcade.shown(DriftPage).work
    for _ in range(24):
        arcade.picture()
    assert checking.mm is not None
    assert checking.mm < 2.0
    assert checking.marker_mm is None
    arcade.site.stand(*looking.SPOT)
    for _ in range(24):
        arcade.picture()
    assert checking.marker_mm == pytest.approx(50.0, rel=0.04), "the width of the mat was measured well"
    canvas = arcade.context.canvas
    canvas.pin(CornerPin([8, 0, 1928, 0, 1928, 1080, 8, 1080]))  # the projector is moved
    for _ in range(24):
        arcade.picture()
    assert checking.mm == pytest.approx(8 * checking.drift.ground.mm, abs=2.0)  # type: ignore[union-attr]
    canvas.pin(None)
    arcade.press(Button.BACK)
    assert arcade.stack.top is arcade.setup


@pytest.mark.long
@pytest.mark.usefixtures("_home", "_no_threads_stay")
def test_in_real_time_the_work_is_done_in_threads_that_end(controls: Controls) -> None:
    site = EmulatedCalibrationSite(1, live=True)
    arcade = Operated(controls, site)
    arcade.open(CalibrationPage(arcade.context, site))
    end = time.monotonic() + LONG
    first = arcade.shown(CalibrationPage)
    while first.preview is None or first.preview.small is None:
        arcade.picture()
        time.sleep(0.01)
        assert time.monotonic() < end
    arcade.begin()
    while not isinstance(arcade.stack.top, ResultPage):
        arcade.picture()
        time.sleep(0.01)
        assert time.monotonic() < end
    assert arcade.stack.top.finding.good
    arcade.press(Button.BACK, Button.BACK)
    site.close()


def test_a_click_sets_the_value_it_hits(arcade: Operated) -> None:
    first = arcade.go("by")
    spot = first.focus.spot.rect
    ruler, robot = (x + w / 2 for x, w in dials.chips((arcade.context.words("calibrate.ruler"), "Robot")))
    for x, by_robot in ((ruler, False), (robot, True), (robot, True), (ruler, False), (-60, False)):
        arcade.click(spot.x + x, spot.centery)
        assert (first.measures.height == 0.0) == by_robot
    width, place = first.measures.width, first.focus.rect("width")
    arcade.click(place.right - 60, place.centery)
    assert first.measures.width == width + 1
    arcade.click(place.x + dials.AT + 10, place.centery)
    assert first.measures.width == width
    arcade.click(*first.focus.rect("begin").center)
    arcade.shown(BoardsPage)


def test_a_calibration_of_another_display_camera_or_hand_is_refused(arcade: Operated, made: CalibrationResult) -> None:
    assert made.ground is not None
    store.save(made.ground, store.calibration_file(arcade.site.name))
    here = arcade.context.canvas.projection
    for key, where, size in (("other_display", "2: 640 × 480", (1920, 1080)), ("other_camera", here, (1280, 720))):
        with pytest.raises(CalibrationError) as refused:
            store.load(store.calibration_file(arcade.site.name), where, size)
        assert refused.value.message.key == key
    file = store.calibration_file(arcade.site.name)
    file.write_text(file.read_text().replace("height = ", "height = 1"))
    with pytest.raises(CalibrationError) as refused:
        store.load(store.calibration_file(arcade.site.name), here, (1920, 1080))
    assert refused.value.message.key == "changed"


def test_the_corner_pin_is_part_of_what_was_calibrated(arcade: Operated) -> None:
    canvas = arcade.context.canvas
    straight = canvas.projection
    canvas.pin(CornerPin([0, 0, 1920, 9, 1920, 1080, 0, 1080]))
    assert canvas.projection != straight
    canvas.pin(None)
    assert canvas.projection == straight


def test_every_message_key_has_a_sentence_in_both_languages() -> None:
    keys = set()
    for file in Path(hardware.__file__).parent.rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            named = getattr(node.func, "id", "") if isinstance(node, ast.Call) and node.args else ""
            if named in ("OperatorMessage", "radio_message"):
                prefix = "radio_" if named == "radio_message" else ""
                inside = [one.value for one in ast.walk(node.args[0]) if isinstance(one, ast.Constant)]  # type: ignore[attr-defined]
                keys |= {prefix + key for key in inside if isinstance(key, str) and key[:1].isalpha()}
    keys = keys - {"radio_"} | {f"radio_{reason}" for reason in ERRORS.values()}
    assert {"few", "busy", "no_camera", "other_display", "radio_program", "radio_denied"} <= keys
    for language in ("en", "pt"):
        assert {f"hardware.{key}" for key in keys} <= set(texts(language))
        assert "35" in Words(language).sentence(OperatorMessage("few", seen=1, all=35, needed=26))
