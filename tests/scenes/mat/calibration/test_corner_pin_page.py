"""The manual corner pin: live preview, only saved corners persist, impossible ones are never shown."""

from pathlib import Path

import pygame
import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.calibration.corner_pin import CornerPin
from pigaming_app.hardware.vision import markers
from pigaming_app.hardware.vision.markers import OpenCVMissing
from pigaming_app.scenes.app import App
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.mat.calibration.corner_pin_page import CORNERS, MAX_OFFSET, CornerPinPage, handle
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw import FOCUS
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.window import Canvas
from tests.scenes.arcade import Arcade

ASKEW = [40, 20, 1880, 60, 1900, 1060, 10, 1000]


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.open(CornerPinPage(arcade.context))


def shown(canvas: Canvas) -> pygame.Surface:
    """The window, after a white picture."""
    canvas.screen.fill("white")
    canvas.flip()
    window = pygame.display.get_surface()
    assert window is not None
    return window


def test_a_corner_moves_by_ten_or_by_one_and_the_picture_with_it(arcade: Arcade) -> None:
    canvas = arcade.context.canvas
    arcade.press(Button.RIGHT, Button.RIGHT, Button.DOWN, Button.X, Button.DOWN)
    assert canvas.corners[:2] == (20, 11)
    window = shown(canvas)
    assert window.get_at((10, 5))[:3] == (0, 0, 0)
    assert window.get_at((24, 15))[:3] == (255, 255, 255)
    assert window.get_at((1919, 0))[:3] == (255, 255, 255)
    assert canvas.to_canvas((20, 11)) == pytest.approx((0.0, 0.0), abs=0.01)
    arcade.shown(CornerPinPage)


@pytest.mark.parametrize("corner", range(4))
def test_the_arrow_points_at_the_chosen_corner_of_the_picture(corner: int) -> None:
    picture = pygame.Surface((1920, 1080))
    handle(corner).draw(picture)
    x, y = CORNERS[corner]
    quarter = pygame.Rect(960 if x else 0, 540 if y else 0, 960, 540)
    arrow = pygame.transform.flip(picture.subsurface(quarter), bool(x), bool(y))
    assert sum(arrow.get_at((at, at))[:3] == FOCUS for at in range(66, 166)) > 90, "from inside to the corner"
    assert arrow.get_at((120, 60))[:3] == arrow.get_at((60, 120))[:3] == FOCUS, "with two barbs"
    assert arrow.get_at((200, 9))[:3] == arrow.get_at((9, 200))[:3] == FOCUS, "in an angle along the edges"
    picture.fill("black", quarter)
    assert not pygame.mask.from_threshold(picture, "white", (200,) * 3).count(), "and nowhere else"


def test_fire_cycles_through_the_corners_and_a_click_selects_one(arcade: Arcade) -> None:
    page = arcade.shown(CornerPinPage)
    for corner in (1, 2, 3, 0):
        arcade.press(Button.FIRE)
        assert page.chosen == corner
    for at, corner in (((1700, 900), 2), ((100, 100), 0), ((1700, 60), 1), ((80, 1000), 3)):
        arcade.click(*at)
        assert page.chosen == corner


def test_a_saved_pin_persists(arcade: Arcade, home: Path) -> None:
    arcade.press(Button.RIGHT, Button.DOWN, Button.FIRE, Button.LEFT, Button.START)
    assert arcade.stack.top is arcade.setup
    settings, wrong = Settings.load(home / "config")
    assert not wrong
    assert settings.corners == [10, 10, 1910, 0, 1920, 1080, 0, 1080]
    arcade.context.settings.corners = settings.corners
    arcade.context.canvas.pin(None)
    App(Options(headless=True), arcade.context, [])
    assert list(arcade.context.canvas.corners) == settings.corners


def test_leaving_without_saving_restores_the_pin(arcade: Arcade) -> None:
    arcade.press(Button.BACK)
    arcade.context.canvas.pin(CornerPin(ASKEW))
    arcade.open(CornerPinPage(arcade.context))
    arcade.press(Button.RIGHT, Button.DOWN, Button.Y, Button.BACK)
    assert arcade.context.canvas.corners == tuple(ASKEW)


def test_in_a_mirror_corners_move_as_they_are_seen(arcade: Arcade) -> None:
    arcade.context.canvas.pin(CornerPin((1920, 0, 0, 0, 0, 1080, 1920, 1080)))
    arcade.open(CornerPinPage(arcade.context))
    arcade.press(Button.RIGHT, Button.DOWN)
    assert list(arcade.context.canvas.corners) == [1910, 10, 0, 0, 0, 1080, 1920, 1080]
    arcade.press(Button.Y)
    assert arcade.context.canvas.corners == ()


def test_reset_is_straight_and_costs_nothing(arcade: Arcade, home: Path) -> None:
    arcade.context.canvas.pin(CornerPin(ASKEW))
    arcade.press(Button.Y)
    assert arcade.context.canvas.corners == ()
    arcade.press(Button.START)
    assert Settings.load(home / "config")[0].corners == []
    assert arcade.context.canvas.screen is pygame.display.get_surface()


def test_corners_do_not_cross_and_do_not_get_lost(arcade: Arcade) -> None:
    page = arcade.shown(CornerPinPage)
    for _ in range(300):
        arcade.press(Button.RIGHT, Button.DOWN)
    assert page.corners[0] <= MAX_OFFSET
    assert page.message or page.corners[0] == MAX_OFFSET
    arcade.shown(CornerPinPage)
    arcade.context.canvas.flip()


def test_a_full_disk_is_reported_and_the_page_stays(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(self: Settings, folder: Path) -> None:
        raise NotSaved("the disk is full")

    monkeypatch.setattr(Settings, "save", full)
    arcade.press(Button.RIGHT, Button.START)
    assert arcade.shown(CornerPinPage).message == arcade.context.words("app.unsaved")


def test_without_opencv_the_page_says_so_and_the_arcade_shows_its_picture(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    def none() -> object:
        raise OpenCVMissing(OperatorMessage("no_opencv"))

    monkeypatch.setattr("pigaming_app.hardware.calibration.corner_pin.opencv", none)
    assert markers.opencv is not none
    arcade.press(Button.RIGHT)
    page = arcade.shown(CornerPinPage)
    assert page.message == arcade.context.words("hardware.no_opencv")
    assert page.corners == [0, 0, 1920, 0, 1920, 1080, 0, 1080]
    with pytest.raises(OpenCVMissing):
        arcade.context.canvas.pin(CornerPin(ASKEW))
    arcade.context.settings.corners = ASKEW
    app = App(Options(headless=True), arcade.context, [])
    assert arcade.context.words("app.pin") in app.notices.waiting
    assert shown(arcade.context.canvas).get_at((0, 0))[:3] == (255, 255, 255)


def test_a_window_of_another_size_is_pinned_too_and_watchers_see_it(arcade: Arcade) -> None:
    canvas = arcade.context.canvas
    seen: list[tuple[int, int]] = []
    canvas.watchers.append(lambda window: seen.append(window.get_size()))
    canvas.pin(CornerPin(ASKEW))
    pygame.display.set_mode((1280, 800), pygame.RESIZABLE)
    window = shown(canvas)
    assert seen[-1] == (1280, 800)
    assert window.get_at((4, 4))[:3] == (0, 0, 0), "the bar above"
    assert window.get_at((20, 46))[:3] == (0, 0, 0), "outside of the pinned corner"
    assert window.get_at((60, 80))[:3] == (255, 255, 255)


def test_impossible_corners_are_reported_at_the_start(arcade: Arcade) -> None:
    arcade.press(Button.BACK)
    arcade.context.settings.corners = [0, 0, 1920, 0, 0, 1080, 1920, 1080]
    app = App(Options(headless=True), arcade.context, [])
    assert arcade.context.words("app.pin") in app.notices.waiting
    assert arcade.context.canvas.corners == ()
