"""The second screen follows the displays: those that are there, and those that come and go.

Their sizes are made up, as SDL's dummy driver has one display; the windows are SDL's, opened as the arcade asks.
"""

import pygame
import pytest

from pigaming_app.scenes.kiosk.operator.desk import OperatorDesk
from pigaming_app.scenes.kiosk.scoreboard.pages import Pages
from pigaming_app.scenes.kiosk.scoreboard.window import WINDOWED, ScoreboardWindow
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.window import Canvas
from tests.scenes.arcade import Arcade

DUMMY = (1024, 768)  # px, the display of SDL's dummy driver


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.context.canvas = Canvas.open(Settings(fullscreen=False), headless=True)


class Displays:
    """Sizes of the connected displays, and those asked for the windows that were opened. The arcade is on another one
    than the dummy driver's, where all windows of the second screen open.
    """

    def __init__(self, monkeypatch: pytest.MonkeyPatch, count: int) -> None:
        self.sizes = [(1920, 1080), (1366, 768), (1280, 800)][:count]
        self.opened: list[tuple[int, int]] = []
        monkeypatch.setattr(pygame.display, "get_desktop_sizes", lambda: list(self.sizes))
        opened = self.opened

        class Noted(pygame.Window):
            def __init__(self, title: str, size: tuple[int, int], *rest: object, **options: object) -> None:
                opened.append(size)
                super().__init__(title, size, *rest, **options)

        monkeypatch.setattr(pygame, "Window", Noted)
        pygame.display.set_window_position((-4000, 0))


def a_desk(arcade: Arcade, number: int | None, arena: int = 0) -> OperatorDesk:
    canvas = arcade.context.canvas
    canvas.headless, canvas.display = False, arena
    return OperatorDesk(arcade.context, number, True)


def seconds_later(desk: OperatorDesk, arcade: Arcade, frames: int = 130) -> None:
    for _ in range(frames):
        desk.show(1 / 60, 0.010, arcade.stack.scenes)


def test_a_display_that_is_unplugged_closes_it_and_plugged_again_brings_it_back(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    displays = Displays(monkeypatch, 2)
    desk = a_desk(arcade, 2)
    seconds_later(desk, arcade)
    assert displays.opened == [(1366, 768)]
    displays.sizes.pop()
    seconds_later(desk, arcade)
    assert desk.window
    assert desk.window.window is None
    assert list(desk.notices.waiting) == [arcade.context.words("scoreboard.none")]
    displays.sizes.append((1280, 800))
    seconds_later(desk, arcade)
    assert desk.window.window
    assert displays.opened == [(1366, 768), (1280, 800)]
    assert desk.window.board.picture.get_bounding_rect().w > 0
    desk.close()


def test_a_display_that_appears_during_play_is_filled(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    displays = Displays(monkeypatch, 1)
    desk = a_desk(arcade, 2)
    seconds_later(desk, arcade)
    assert displays.opened == [WINDOWED]
    displays.sizes.append((1366, 768))
    seconds_later(desk, arcade)
    assert displays.opened == [WINDOWED, (1366, 768)]
    desk.close()


def test_an_unplugged_arena_is_not_covered_and_returns_to_its_display(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    displays, moves = Displays(monkeypatch, 2), []
    desk = a_desk(arcade, 1, arena=1)
    monkeypatch.setattr(arcade.context.canvas, "show", lambda display, full: moves.append(display))
    gone = displays.sizes.pop()
    seconds_later(desk, arcade)
    assert desk.window
    assert desk.window.window is None
    assert moves == []
    displays.sizes.append(gone)
    seconds_later(desk, arcade)
    assert desk.window.window
    assert moves == [1]
    desk.close()


def test_one_closed_by_hand_stays_closed_until_f2(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    displays = Displays(monkeypatch, 2)
    desk = a_desk(arcade, 2)
    assert desk.window
    assert desk.close_if_requested(pygame.Event(pygame.WINDOWCLOSE, window=desk.window.window))
    displays.sizes.append((1280, 800))
    seconds_later(desk, arcade)
    assert desk.window.window is None
    page = arcade.context.shared(Pages).chosen
    desk.filter([pygame.Event(pygame.KEYDOWN, key=pygame.K_F2, scancode=0, mod=0)], arcade.stack.scenes)
    assert desk.window.window
    assert arcade.context.shared(Pages).chosen == page
    assert displays.opened == [(1366, 768)] * 2
    desk.close()


def test_a_window_that_breaks_during_play_is_given_up_with_a_notice(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    Displays(monkeypatch, 2)
    desk = a_desk(arcade, 2)
    assert desk.window
    assert desk.window.window
    desk.window.window.destroy()
    seconds_later(desk, arcade)
    assert desk.window.window is None
    assert "was lost" in capsys.readouterr().err
    assert list(desk.notices.waiting) == [arcade.context.words("scoreboard.none")]


@pytest.mark.parametrize(
    ("number", "arena_display", "own"),
    [(2, 0, True), (1, 0, False), (3, 0, False), (1, 1, True), (2, 1, False), (16, 63, False), (1, 2, False)],
)
def test_it_fills_a_display_of_its_own_and_is_small_elsewhere(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, number: int, arena_display: int, own: bool
) -> None:
    displays = Displays(monkeypatch, 2)
    shown = ScoreboardWindow(number, arena_display, [])
    assert shown.window
    assert shown.fills == own
    assert displays.opened == [displays.sizes[number - 1] if own else WINDOWED]
    assert (shown.window.position, shown.window.size) == (((0, 0), DUMMY) if own else ((24, 24), WINDOWED))
    shown.close()


def test_on_a_mirrored_display_it_would_cover_the_arcade_and_is_small(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    Displays(monkeypatch, 2)
    pygame.display.set_window_position((0, 0))
    shown = ScoreboardWindow(2, 0, [])
    assert shown.window
    assert (shown.fills, shown.window.size) == (False, WINDOWED)
    shown.close()
