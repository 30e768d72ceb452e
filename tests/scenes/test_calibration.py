"""The calibration wizard: on the emulated arena it finds what is true there; whatever is wrong is one sentence."""

import ast
import os
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware import calibrating, camera, cameras, looking, standing
from pigaming_app.hardware.cameras import Known
from pigaming_app.hardware.emulator.site import EmulatedSite
from pigaming_app.hardware.ground import NoGround
from pigaming_app.hardware.markers import NoVision
from pigaming_app.hardware.said import Said, said
from pigaming_app.hardware.site import Measures, RealSite
from pigaming_app.keeping import NotSaved
from pigaming_app.scenes import dials
from pigaming_app.scenes.calibration import boards, kept, page
from pigaming_app.scenes.calibration.boards import BoardsPage
from pigaming_app.scenes.calibration.check import CheckPage
from pigaming_app.scenes.calibration.outlines import OutlinesPage
from pigaming_app.scenes.calibration.page import CalibrationPage
from pigaming_app.scenes.calibration.result import Finding, ResultPage
from pigaming_app.scenes.calibration.telling import tell
from pigaming_app.scenes.canvas import Canvas
from pigaming_app.scenes.controls import Controls
from pigaming_app.scenes.pixels import pixels_of
from pigaming_app.scenes.press import Act, Device
from pigaming_app.scenes.stack import Scene
from pigaming_app.scenes.words import Words, texts
from pigaming_app.settings import Settings
from tests.scenes.arcade import Arcade

LONG = 30.0  # s after which a test gives up waiting


class Operated(Arcade):
    """An arcade whose window shines on an emulated mat, and an operator."""

    def __init__(self, controls: Controls, site: Any) -> None:
        super().__init__(controls)
        self.house.canvas = Canvas.open(Settings(fullscreen=False), headless=True)
        self.site = site
        if isinstance(site, EmulatedSite):
            self.house.canvas.watchers.append(lambda window: site.see(pixels_of(window)))

    def picture(self, covered: bool = False) -> None:
        """One picture, on the mat too; `covered`: somebody stands in the light of its right half."""
        self.frame()
        screen = self.house.canvas.screen
        self.stack.top.draw(screen)
        if covered:
            screen.fill((20, 20, 20), (700, 0, 1220, 1080))
        self.house.canvas.flip()

    def pictures(self, kind: type[Scene], most: int = 400, covered: bool = False) -> Any:
        """Pictures until a scene of this kind is on top."""
        for _ in range(most):
            if isinstance(self.stack.top, kind):
                return self.stack.top
            self.picture(covered)
        raise AssertionError(f"{type(self.stack.top).__name__} is on top")

    def go(self, row: str) -> CalibrationPage:
        """Put the focus on a row of the first page."""
        top = self.shown(CalibrationPage)
        while top.focus.name != row:
            self.press(Act.DOWN)
        return top

    def begin(self) -> None:
        self.go("begin")
        self.press(Act.FIRE)
        self.shown(BoardsPage)


@pytest.fixture
def _home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))


@pytest.fixture
def arcade(controls: Controls, _home: None) -> Operated:
    arcade = Operated(controls, EmulatedSite(2))
    arcade.open(CalibrationPage(arcade.house, arcade.site))
    return arcade


@pytest.fixture
def _no_threads_stay() -> Iterator[None]:
    before = set(threading.enumerate())
    yield
    end = time.monotonic() + 3.0
    while left := set(threading.enumerate()) - before:
        assert time.monotonic() < end, f"still there: {left}"
        time.sleep(0.01)


# ---- the emulated arena


def test_the_operator_sees_the_mat_calibrates_it_saves_and_is_told_so(arcade: Operated, tmp_path: Path) -> None:
    for _ in range(20):
        arcade.picture()
    first = arcade.shown(CalibrationPage)
    assert first.preview is not None
    assert first.preview.size == (1920, 1080)
    assert first.state == arcade.house.words("vision.none")
    arcade.begin()
    result = arcade.pictures(ResultPage)
    assert result.finding.good
    assert result.finding.residuals.mean_mm < 1.5
    assert result.finding.residuals.max_mm < 3.0
    arcade.shown(ResultPage)
    arcade.press(Act.FIRE)
    assert arcade.stack.top is first
    ground = kept.load(arcade.house.canvas.projection, arcade.site, (1920, 1080))
    assert ground.width_mm == arcade.site.measures.width
    for _ in range(5):
        arcade.picture()
    assert f"{ground.mean_mm:.1f} mm" in first.state
    assert not (tmp_path / "config" / "calibration.toml").exists(), "an emulated one is not the real one"


def test_the_boards_are_shown_with_no_other_light(arcade: Operated) -> None:
    arcade.begin()
    arcade.picture()
    shown = pixels_of(arcade.house.canvas.screen)[:, :, 0].copy()
    plain = calibrating.BOARD.picture()
    assert np.array_equal(shown[:1044], plain[:1044])
    assert not np.array_equal(shown[1044:], plain[1044:]), "the progress is in the margin below"


def test_a_robot_on_the_outlines_tells_how_high_the_camera_hangs(arcade: Operated) -> None:
    arcade.go("by")
    arcade.press(Act.RIGHT)
    assert "height" not in [spot.name for spot in arcade.shown(CalibrationPage).focus.spots]
    arcade.begin()
    arcade.pictures(OutlinesPage)
    arcade.shown(OutlinesPage)
    result = arcade.pictures(ResultPage)
    assert result.finding.good
    assert result.finding.ground.height == pytest.approx(arcade.site.arena.optics.lens.eye[2], rel=0.05)
    assert result.finding.marker_mm == pytest.approx(50.0, rel=0.04)
    arcade.shown(ResultPage)


def test_somebody_in_the_light_costs_one_sentence_and_again_helps(arcade: Operated) -> None:
    arcade.begin()
    result = arcade.pictures(ResultPage, covered=True)
    assert not result.finding.good
    assert isinstance(result.finding.trouble, Said)
    assert result.finding.trouble.key == "few"
    assert result.picture is not None, "what the camera saw is shown"
    assert [spot.name for spot in result.focus.spots] == ["again", "leave"]
    arcade.shown(ResultPage)
    arcade.press(Act.FIRE)
    assert arcade.pictures(ResultPage).finding.good


def test_a_calibration_that_is_too_bad_cannot_be_saved(arcade: Operated, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pigaming_app.hardware.solver.MEAN_MM", 0.001)
    arcade.begin()
    result = arcade.pictures(ResultPage)
    assert result.finding.residuals is not None
    assert [spot.name for spot in result.focus.spots] == ["again", "leave"]
    arcade.shown(ResultPage)
    arcade.press(Act.RIGHT)
    arcade.press(Act.FIRE)
    arcade.shown(CalibrationPage)
    with pytest.raises(NoGround):
        kept.load(arcade.house.canvas.projection, arcade.site, (1920, 1080))


@pytest.mark.skipif(os.name == "posix" and os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_that_cannot_be_written(arcade: Operated, tmp_path: Path) -> None:
    (tmp_path / "config").mkdir()
    (tmp_path / "config").chmod(0o500)
    arcade.begin()
    arcade.pictures(ResultPage)
    arcade.press(Act.FIRE)
    assert str(kept.path(arcade.site)) in arcade.shown(ResultPage).sentence


def test_what_cannot_be_saved_is_said_and_nothing_is_lost(arcade: Operated, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(path: Path, text: str) -> None:
        raise NotSaved(f"{path} was not saved: the disk is full.")

    arcade.begin()
    arcade.pictures(ResultPage)
    monkeypatch.setattr(kept, "keep", full)
    arcade.press(Act.FIRE)
    assert str(kept.path(arcade.site)) in arcade.shown(ResultPage).sentence
    monkeypatch.undo()


def test_the_way_back_leads_out_of_every_page(arcade: Operated) -> None:
    arcade.begin()
    arcade.picture()
    arcade.press(Act.BACK)
    arcade.shown(CalibrationPage)
    arcade.begin()
    arcade.pictures(ResultPage)
    arcade.press(Act.BACK)
    arcade.shown(CalibrationPage)
    arcade.press(Act.BACK)
    assert arcade.stack.top is arcade.setup


def test_a_camera_that_goes_blind_meanwhile(arcade: Operated) -> None:
    arcade.begin()
    for _ in range(20):
        arcade.picture()
    arcade.site.arena.faults.switch("camera_frozen", True)
    result = arcade.pictures(ResultPage)
    assert result.finding.trouble == looking.NO_PICTURE
    arcade.shown(ResultPage)


def test_nobody_puts_a_robot_on_the_outline(arcade: Operated, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(standing, "PATIENCE", 1.0)
    monkeypatch.setattr(arcade.site, "stand", lambda x, y: arcade.site.clear(True))
    arcade.go("by")
    arcade.press(Act.RIGHT)
    arcade.begin()
    result = arcade.pictures(ResultPage)
    assert result.finding.trouble.key == "nobody"


def test_moved_since_then_is_seen_on_the_page_that_checks(arcade: Operated) -> None:
    arcade.begin()
    arcade.pictures(ResultPage)
    arcade.press(Act.FIRE)
    arcade.press(Act.BACK)
    arcade.open(CheckPage(arcade.house, arcade.site))
    checking = arcade.shown(CheckPage).work
    for _ in range(24):
        arcade.picture()
    assert checking.mm is not None
    assert checking.mm < 2.0
    assert checking.marker_mm is None
    arcade.site.stand(*looking.SPOT)
    for _ in range(24):
        arcade.picture()
    assert checking.marker_mm == pytest.approx(50.0, rel=0.04), "the width of the mat was measured well"
    canvas = arcade.house.canvas
    canvas.pin([8, 0, 1928, 0, 1928, 1080, 8, 1080])  # somebody pushes the projector
    for _ in range(24):
        arcade.picture()
    assert checking.mm == pytest.approx(8 * checking.drift.ground.mm, abs=2.0)  # type: ignore[union-attr]
    canvas.pin([])
    arcade.press(Act.BACK)
    assert arcade.stack.top is arcade.setup


@pytest.mark.usefixtures("_home", "_no_threads_stay")
def test_in_real_time_the_work_is_done_in_threads_that_end(controls: Controls) -> None:
    site = EmulatedSite(1, live=True)
    arcade = Operated(controls, site)
    arcade.open(CalibrationPage(arcade.house, site))
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
    arcade.press(Act.BACK)
    arcade.press(Act.BACK)
    site.close()


# ---- real cameras, or none


class Driver:
    """A `cv2.VideoCapture` of the tests': it opens, or not, and sends grey pictures."""

    def __init__(self, opens: bool = True) -> None:
        self.opens, self.sends = opens, True

    def __call__(self, number: int) -> "Driver":
        return self

    def isOpened(self) -> bool:  # noqa: N802
        return self.opens

    def release(self) -> None:
        pass

    def get(self, what: int) -> float:
        return 0.0

    def set(self, what: int, value: float) -> bool:
        return True

    def read(self) -> tuple[bool, Any]:
        time.sleep(0.01)
        return self.sends, np.full((480, 640), 90, np.uint8) if self.sends else None


def real(controls: Controls, driver: Driver) -> Operated:
    site = RealSite(driver)
    arcade = Operated(controls, site)
    arcade.open(CalibrationPage(arcade.house, site))
    return arcade


def until(arcade: Operated, true: Any) -> None:
    end = time.monotonic() + LONG
    while not true():
        arcade.picture()
        assert time.monotonic() < end, "it did not happen"


@pytest.fixture
def _one_camera(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("pigaming_app.hardware.site.cameras", lambda: [Known(3, "Bright Eye")])
    monkeypatch.setattr(camera, "STALE", 0.1)
    monkeypatch.setattr(camera, "RETRY", 0.02)
    monkeypatch.setattr(cameras, "NODES", tmp_path)
    (tmp_path / "video3").touch()


@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
def test_the_camera_of_the_settings_is_gone_so_the_one_that_is_there_is_shown(controls: Controls) -> None:
    arcade = real(controls, Driver())
    first = arcade.shown(CalibrationPage)
    assert first.number == 3
    assert first.preview is not None
    until(arcade, lambda: first.preview.small is not None and first.preview.trouble is None)
    assert first.preview.size == (640, 480)
    arcade.press(Act.BACK)


@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
@pytest.mark.parametrize("language", ["en", "pt"])
def test_a_camera_that_does_not_open_is_a_sentence_and_comes_back_by_itself(controls: Controls, language: str) -> None:
    driver = Driver(opens=False)
    arcade = real(controls, driver)
    arcade.house.words.switch(language)
    first = arcade.shown(CalibrationPage)
    assert first.preview is not None
    until(arcade, lambda: isinstance(first.preview.trouble, Said) and first.preview.trouble.key != "yet")
    assert "3" in tell(arcade.house.words, first.preview.trouble or "")
    driver.opens = True
    until(arcade, lambda: first.preview.trouble is None and first.preview.small is not None)
    driver.sends = False
    until(arcade, lambda: first.preview.trouble is not None)
    arcade.press(Act.BACK)


@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
def test_a_camera_that_sees_no_board_is_told_so_and_one_that_stops_too(
    controls: Controls, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(RealSite, "settle", 0.05)
    monkeypatch.setattr(looking, "BLIND", 0.5)
    driver = Driver()
    arcade = real(controls, driver)
    arcade.begin()
    until(arcade, lambda: isinstance(arcade.stack.top, ResultPage))
    assert arcade.shown(ResultPage).finding.trouble.key == "few"  # type: ignore[union-attr]
    driver.sends = False
    arcade.press(Act.FIRE)
    until(arcade, lambda: isinstance(arcade.stack.top, ResultPage))
    assert isinstance(arcade.shown(ResultPage).finding.trouble, Said)
    arcade.press(Act.BACK)
    arcade.press(Act.BACK)


@pytest.mark.usefixtures("_home", "_no_threads_stay")
def test_without_opencv_the_page_says_so_and_the_arcade_goes_on(
    controls: Controls, monkeypatch: pytest.MonkeyPatch
) -> None:
    missing = NoVision(Said("OpenCV is not installed.", "no_opencv"))

    def none(*_: object, **__: object) -> object:
        raise missing

    monkeypatch.setattr(RealSite, "open", none)
    monkeypatch.setattr(boards, "picture", none)
    arcade = real(controls, Driver())
    first = arcade.shown(CalibrationPage)
    until(arcade, lambda: first.preview is not None and first.preview.trouble is not None)
    arcade.begin()
    until(arcade, lambda: isinstance(arcade.stack.top, ResultPage))
    assert arcade.shown(ResultPage).finding.trouble == said(missing)
    arcade.press(Act.BACK)
    arcade.press(Act.BACK)


@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
def test_what_breaks_in_the_thread_ends_in_a_sentence_not_in_silence(
    controls: Controls, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(image: object) -> object:
        raise RuntimeError("nobody thought of this")

    monkeypatch.setattr(looking, "shrunk", broken)
    arcade = real(controls, Driver())
    first = arcade.shown(CalibrationPage)
    until(arcade, lambda: first.preview is not None and first.preview.trouble == looking.BROKEN)
    arcade.press(Act.BACK)


@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
def test_lengths_are_set_with_a_pad_faster_when_held_and_kept(controls: Controls, tmp_path: Path) -> None:
    arcade = real(controls, Driver())
    first = arcade.go("width")
    before = first.measures.width
    arcade.press(Act.RIGHT, Device("pad", 0))
    assert first.measures.width == before + 1
    for _ in range(60):
        arcade.stack.top.on(page.Press(Act.RIGHT, Device("pad", 0), repeat=True))
    assert first.measures.width > before + 1000
    arcade.go("lid")
    for _ in range(3):
        arcade.press(Act.LEFT)
    assert first.measures.lid == 67
    arcade.press(Act.BACK)
    settings, wrong = Settings.load(tmp_path / "config")
    assert not wrong
    assert (settings.arena_mm, settings.lid_mm, settings.camera) == (first.measures.width, 67.0, 3)
    again = CalibrationPage(arcade.house, arcade.site)
    assert again.measures == Measures(first.measures.width, 2500.0, 67.0)


def test_a_mouse_sets_what_it_hits(arcade: Operated) -> None:
    first = arcade.go("by")
    spot = first.focus.spot.rect
    ruler, robot = (x + w / 2 for x, w in dials.chips((arcade.house.words("calibrate.ruler"), "Robot")))
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


# ---- files and texts


def test_a_calibration_of_another_display_camera_or_hand_is_refused(arcade: Operated, tmp_path: Path) -> None:
    arcade.begin()
    finding: Finding = arcade.pictures(ResultPage).finding
    assert finding.ground is not None
    kept.save(finding.ground, arcade.site)
    here = arcade.house.canvas.projection
    for key, where, size in (("other_display", "2: 640 × 480", (1920, 1080)), ("other_camera", here, (1280, 720))):
        with pytest.raises(NoGround) as refused:
            kept.load(where, arcade.site, size)
        assert said(refused.value).key == key  # type: ignore[attr-defined]
    file = kept.path(arcade.site)
    file.write_text(file.read_text().replace("height = ", "height = 1"))
    with pytest.raises(NoGround) as refused:
        kept.load(here, arcade.site, (1920, 1080))
    assert said(refused.value).key == "damaged"  # type: ignore[attr-defined]


def test_the_corner_pin_is_part_of_what_was_calibrated(arcade: Operated) -> None:
    canvas = arcade.house.canvas
    straight = canvas.projection
    canvas.pin([0, 0, 1920, 9, 1920, 1080, 0, 1080])
    assert canvas.projection != straight
    canvas.pin([])
    assert canvas.projection == straight


def test_every_sentence_with_a_key_is_said_in_both_languages() -> None:
    keys = set()
    for file in Path(calibrating.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Said" and len(node.args) > 1:
                inside = [one.value for one in ast.walk(node.args[1]) if isinstance(one, ast.Constant)]
                keys |= {key for key in inside if isinstance(key, str) and key[:1].isalpha()}
    assert {"few", "busy", "no_camera", "other_display"} <= keys
    for language in ("en", "pt"):
        assert {f"vision.{key}" for key in keys} <= set(texts(language))
        assert "35" in tell(Words(language), Said("", "few", seen=1, all=35, needed=26))
    assert tell(Words("pt"), "No key, no translation.") == "No key, no translation."


class Overhead(Driver):
    """A driver whose camera hangs over an emulated mat, and sends its pictures in colour."""

    def __init__(self, site: EmulatedSite) -> None:
        super().__init__()
        self.site = site

    def read(self) -> tuple[bool, Any]:
        self.site.arena.advance(1 / 30)
        frame = self.site.arena.camera.newest()
        return frame is not None, None if frame is None else np.repeat(frame.image[:, :, None], 3, axis=2)


@pytest.mark.usefixtures("_home", "_one_camera", "_no_threads_stay")
def test_a_real_camera_over_the_mat_is_calibrated_and_the_file_is_the_real_one(
    controls: Controls, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(RealSite, "settle", 0.3)
    mat = EmulatedSite(4)
    mat.clear(True)
    arcade = real(controls, Overhead(mat))
    arcade.house.canvas.watchers.append(lambda window: mat.see(pixels_of(window)))
    first = arcade.shown(CalibrationPage)
    first.measures = mat.measures
    arcade.begin()
    until(arcade, lambda: isinstance(arcade.stack.top, ResultPage))
    result = arcade.shown(ResultPage)
    assert result.finding.good, result.finding.trouble
    arcade.press(Act.FIRE)
    ground = kept.load(arcade.house.canvas.projection, arcade.site, (1920, 1080))
    assert (tmp_path / "config" / "calibration.toml").exists()
    assert ground.max_mm < 3.0
    arcade.press(Act.BACK)
