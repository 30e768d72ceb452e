"""Recovery: after a scene has failed the title is intact, whatever the scene did to the screen."""

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pygame
import pytest

from pigaming_app.hardware.calibration.corner_pin import CornerPin
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Push, Scene, StackOperation
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.start import run
from pigaming_app.scenes.title import scene as title
from tests.cases import one_in
from tests.scenes.arcade import Floor

pytestmark = pytest.mark.usefixtures("_cache_of_its_own")

STEP = 1 / 30
QUARTER = pygame.Rect(0, 0, 960, 540)
Damage = Callable[[Context, pygame.Surface], object]


class Failing(Floor):
    """A scene that damages the screen and fails while drawing."""

    def __init__(self, context: Context, damage: Damage) -> None:
        self.context, self.damage = context, damage

    def draw(self, screen: pygame.Surface) -> None:
        screen.fill("black")
        kept = self.damage(self.context, screen)
        raise ValueError(f"on purpose, with {type(kept)}")


class Clinging(Failing):
    """A scene that also fails in `on_leave`."""

    def on_leave(self) -> None:
        raise RuntimeError("it does not let go")


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    yield tmp_path
    pygame.display.quit()


def pictures(first: Callable[[Context], Scene], frames: int = 4) -> list[bytes]:
    """Every picture of the arcade from the start; the pointer may leave the window."""
    shown: list[bytes] = []

    def over() -> bool:
        assert not pygame.event.get_grab()
        shown.append(pygame.image.tobytes(pygame.display.get_surface(), "RGB"))
        return len(shown) == frames

    assert run(Options(headless=True, first_scene=first, frames=20, step=STEP, should_close=over)) == 0
    return shown


@cache
def whole() -> list[bytes]:
    """The pictures after a scene that failed without damage."""
    return pictures(lambda context: Failing(context, lambda context, screen: None))


def clip(context: Context, screen: pygame.Surface) -> None:
    screen.set_clip(QUARTER)


def clip_twice_removed(context: Context, screen: pygame.Surface) -> pygame.Surface:
    screen.set_clip(QUARTER)
    part = screen.subsurface(QUARTER)
    part.set_clip((0, 0, 10, 10))
    return part


def locks(context: Context, screen: pygame.Surface) -> None:
    for _ in range(3):
        screen.lock()


def pixels(context: Context, screen: pygame.Surface) -> object:
    return [context, pygame.PixelArray(screen)]


def transparency(context: Context, screen: pygame.Surface) -> None:
    screen.set_alpha(80)
    screen.set_colorkey("black")


def cached_picture(context: Context, screen: pygame.Surface) -> None:
    title.ground().fill("red", QUARTER)
    title.ground().set_clip(QUARTER)


def pinned(context: Context, screen: pygame.Surface) -> None:
    context.canvas.pin(CornerPin((100, 100, 1800, 80, 1820, 1000, 80, 1020)))


def grabbed(context: Context, screen: pygame.Surface) -> None:
    pygame.event.set_grab(True)


@pytest.mark.parametrize(
    "damage", one_in(2, [clip, clip_twice_removed, locks, pixels, transparency, cached_picture, pinned, grabbed])
)
def test_the_title_is_intact_after_a_failure(damage: Damage) -> None:
    assert pictures(lambda context: Failing(context, damage)) == whole()
    assert not pygame.display.get_init() or not pygame.event.get_grab()


def test_a_picture_in_pinned_corners_is_whole_too(home: Path) -> None:
    (home / "config").mkdir()
    (home / "config" / "settings.toml").write_text("corners = [96, 54, 1824, 60, 1800, 1026, 90, 1020]\n")
    expected = pictures(lambda context: Failing(context, lambda context, screen: None))
    assert expected != whole()
    assert pictures(lambda context: Failing(context, clip)) == expected


@pytest.mark.parametrize("under", [False, True])
def test_a_scene_that_fails_in_left_does_not_stop_recovery(home: Path, under: bool) -> None:
    class Opening(Failing):
        """A scene that pushes another onto itself."""

        def update(self, seconds: float) -> StackOperation:
            return Push(Failing(self.context, clip))

        def on_leave(self) -> None:
            raise RuntimeError("it does not let go")

    def first(context: Context) -> Scene:
        return Opening(context, clip) if under else Clinging(context, clip)

    assert pictures(first) == whole()
    log = (home / "data" / "pigaming.log").read_text()
    assert "on purpose" in log
    assert "it does not let go" in log


def test_all_scenes_are_closed_even_if_one_raises() -> None:
    gone: list[str] = []

    class Holding(Failing):
        def on_leave(self) -> None:
            gone.append("low")

    class Bottom(Holding):
        def update(self, seconds: float) -> StackOperation:
            return Push(Clinging(self.context, clip))

    pictures(lambda context: Bottom(context, clip))
    assert gone == ["low"]


def test_a_title_that_cannot_be_made_again_ends_the_arcade_in_one_line(
    home: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def broken(context: Context, screen: pygame.Surface) -> None:
        monkeypatch.setattr(title.Title, "on_enter", lambda self: 1 / 0)

    assert run(Options(headless=True, first_scene=lambda context: Failing(context, broken), frames=9, step=STEP)) == 1
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "pigaming.log" in error
    assert "ZeroDivisionError" in (home / "data" / "pigaming.log").read_text()
