"""The window: every frame is 1920 x 1080, whatever the window or display."""

import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite
from pathlib import Path

import pygame
import pytest

from pigaming_app.ui.window import CURSOR_SECONDS, SIZE, Canvas, NoDisplay


@dataclass
class Wishes:
    display: int = 0
    fullscreen: bool = False


@pytest.fixture
def canvas() -> Iterator[Canvas]:
    opened = Canvas.open(Wishes(), headless=True)
    yield opened
    opened.close()


def resize(w: int, h: int) -> pygame.Surface:
    """A resize by the window manager."""
    return pygame.display.set_mode((w, h), pygame.RESIZABLE)


def lit(surface: pygame.Surface) -> pygame.Rect:
    """The bounding box of the non-black part of a surface."""
    return pygame.mask.from_threshold(surface, (255, 0, 0), (20, 20, 20)).get_bounding_rects()[0]


def test_at_full_size_scenes_paint_straight_on_the_window(canvas: Canvas) -> None:
    assert canvas.screen is pygame.display.get_surface()
    assert canvas.to_canvas((12, 34)) == (12.0, 34.0)


@pytest.mark.parametrize(
    ("window", "picture"),
    [
        ((960, 540), (0, 0, 960, 540)),
        ((1600, 1200), (0, 150, 1600, 900)),
        ((2560, 1080), (320, 0, 1920, 1080)),
        ((3840, 2160), (0, 0, 3840, 2160)),
        ((32, 18), (0, 0, 32, 18)),
    ],
)
def test_any_other_window_shows_all_of_it_undistorted(
    canvas: Canvas, window: tuple[int, int], picture: tuple[int, int, int, int]
) -> None:
    shown = resize(*window)
    shown.fill("white")
    assert canvas.screen.get_size() == SIZE
    canvas.screen.fill("red")
    canvas.flip()
    assert lit(shown) == pygame.Rect(picture)
    x, y, w, h = picture
    assert canvas.to_canvas((x, y)) == (0.0, 0.0)
    assert canvas.to_canvas((x + w / 2, y + h / 2)) == (960.0, 540.0)
    assert canvas.to_canvas((x + w, y + h)) == (1920.0, 1080.0)
    if picture != (0, 0, *window):
        assert tuple(shown.get_at((0, 0))) == (0, 0, 0, 255)
        assert min(canvas.to_canvas((0, 0))) < 0.0


@pytest.mark.parametrize("window", [(1, 1), (1, 900), (1600, 1)])
def test_a_window_of_no_size_does_no_harm(canvas: Canvas, window: tuple[int, int]) -> None:
    resize(*window)
    canvas.screen.fill("red")
    canvas.flip()
    assert canvas.screen.get_size() == SIZE
    assert all(map(isfinite, canvas.to_canvas((0, 0))))


def test_a_screenshot_is_the_whole_canvas(canvas: Canvas, tmp_path: Path) -> None:
    for size in (SIZE, (640, 480)):
        resize(*size)
        canvas.screen.fill("red")
        canvas.flip()
        path = tmp_path / "pictures" / f"{size[0]}.png"
        canvas.screenshot(path)
        assert lit(pygame.image.load(path)) == pygame.Rect((0, 0), SIZE)


def test_a_screenshot_that_cannot_be_saved_says_where(canvas: Canvas, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="file"):
        canvas.screenshot(tmp_path / "file" / "shot.png")


def test_a_display_that_is_gone_gives_the_first_and_a_notice(canvas: Canvas) -> None:
    canvas.show(display=7, fullscreen=True)
    assert canvas.display == 0
    assert canvas.notices == ["Display 8 is not there, so the picture is on display 1."]
    assert len(canvas.displays()) == pygame.display.get_num_displays()


@pytest.mark.parametrize("refusals", [1, 2, 99])
def test_a_window_that_cannot_be_made_never_ends_the_arcade(
    canvas: Canvas, monkeypatch: pytest.MonkeyPatch, refusals: int
) -> None:
    real = pygame.display.set_mode
    refused: list[object] = []

    def refuse(*args: object, **options: object) -> object:
        if len(refused) < refusals:
            refused.append(args)
            raise pygame.error("the cable came loose")
        return real(*args, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(pygame.display, "set_mode", refuse)
    canvas.show(display=0, fullscreen=True)
    assert canvas.notices == ["The picture could not be moved: the cable came loose."] * min(3, refusals)
    assert canvas.screen.get_size() == SIZE
    canvas.flip()


def test_without_a_window_flipping_and_pointing_still_do_not_fail(canvas: Canvas) -> None:
    pygame.display.quit()
    canvas.screen.fill("red")
    canvas.flip()
    assert canvas.to_canvas((5, 5)) == (5.0, 5.0)


def test_the_pointer_hides_when_nobody_moves_the_mouse(canvas: Canvas, monkeypatch: pytest.MonkeyPatch) -> None:
    now = [1000.0]
    monkeypatch.setattr("time.monotonic", lambda: now[0])
    monkeypatch.setattr(pygame.mouse, "get_pos", lambda: (7, 7))
    canvas.flip()
    now[0] += CURSOR_SECONDS - 0.1
    canvas.flip()
    assert pygame.mouse.get_visible()
    now[0] += 0.2
    canvas.flip()
    assert not pygame.mouse.get_visible()
    monkeypatch.setattr(pygame.mouse, "get_pos", lambda: (8, 7))
    canvas.flip()
    assert pygame.mouse.get_visible()


def test_a_video_driver_that_does_not_exist_is_no_display(monkeypatch: pytest.MonkeyPatch) -> None:
    pygame.display.quit()
    monkeypatch.setenv("SDL_VIDEODRIVER", "nonsense")
    with pytest.raises(NoDisplay, match=r"^There is no display .*nonsense.* --headless\.$"):
        Canvas.open(Wishes())


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems always have a display")
def test_without_a_display_it_says_so_and_names_headless() -> None:
    hidden = ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")
    bare = {name: value for name, value in os.environ.items() if name not in hidden}
    story = """
from types import SimpleNamespace
from pigaming_app.ui.window import Canvas, NoDisplay
try:
    Canvas.open(SimpleNamespace(display=0, fullscreen=False))
except NoDisplay as sentence:
    print(sentence)
print(Canvas.open(SimpleNamespace(display=0, fullscreen=True), headless=True).screen.get_size())
"""
    said = subprocess.run([sys.executable, "-c", story], env=bare, capture_output=True, text=True, check=True).stdout
    sentence, size = said.splitlines()
    assert sentence.startswith("There is no display")
    assert "--headless" in sentence
    assert size == "(1920, 1080)"
