"""The main loop: it starts, survives a failing scene, whatever that did to the screen, and shuts down cleanly."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from importlib.util import find_spec
from itertools import product
from pathlib import Path
from time import monotonic, sleep
from typing import Any, cast

import pygame
import pytest

from pigaming_app.games.arenas import load
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.hardware.calibration.corner_pin import CornerPin
from pigaming_app.scenes import app as app_module
from pigaming_app.scenes.app import MAX_FAILURES, App
from pigaming_app.scenes.editor.scene import Editor
from pigaming_app.scenes.flow.scene import Context, Push, Scene, StackOperation
from pigaming_app.scenes.kiosk.operator.desk import OperatorDesk
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.start import opened, run
from pigaming_app.scenes.title import scene as title
from pigaming_app.scenes.title.scene import Title
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.widgets.notices import Notices
from tests.cases import one_in
from tests.scenes.arcade import Floor, setup

MORE: list[dict[str, Any]] = [{"kiosk": True}, {"display": 0}, {"display": 1}, {"display": 63, "kiosk": True}]
MORE += [{"emulator_seed": 1, "kiosk": True}] * (find_spec("cv2") is not None)
pytestmark = pytest.mark.usefixtures("_cache_of_its_own")
STEP = 1 / 60
ROOT = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    yield tmp_path
    pygame.display.quit()


@pytest.fixture
def seen(monkeypatch: pytest.MonkeyPatch) -> list[tuple[type, list[str]]]:
    """The scene on top and the notices after each frame."""
    found: list[tuple[type, list[str]]] = []
    frame = App._frame

    def watched(app: App, seconds: float) -> None:
        frame(app, seconds)
        found.append((type(app.stack.top), list(app.notices.waiting)))

    monkeypatch.setattr(App, "_frame", watched)
    return found


class Quiet(Floor):
    """A scene without behaviour that counts its frames."""

    def __init__(self, context: Context) -> None:
        self.context, self.frames = context, 0

    def update(self, seconds: float) -> StackOperation:
        self.frames += 1
        return None

    def draw(self, screen: pygame.Surface) -> None:
        screen.fill("black")


class Broken(Quiet):
    """A scene that fails in `update`."""

    def update(self, seconds: float) -> StackOperation:
        raise ValueError("on purpose")


def test_it_starts_with_the_title_of_which_a_picture_may_be_taken_and_keeps_its_settings(home: Path) -> None:
    picture = home / "title.png"
    assert run(Options(headless=True, screenshot=picture, step=STEP)) == 0
    assert picture.stat().st_size > 20_000
    assert (home / "config" / "settings.toml").is_file()


def test_a_scene_that_fails_gives_way_to_the_title_and_one_sentence(
    home: Path, seen: list[tuple[type, list[str]]], capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(Options(headless=True, first_scene=Broken, frames=4, step=STEP)) == 0
    assert seen == [(Title, ["Something went wrong. Back to the title."])] * 3
    assert "on purpose" in (home / "data" / "pigaming.log").read_text()
    assert "Traceback" not in capsys.readouterr().err
    (day,) = (home / "data" / "days").iterdir()
    assert [line["what"] for line in map(json.loads, day.read_text().splitlines())] == ["start", "failure", "end"]


def test_a_model_that_failed_in_a_match_is_named(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    monkeypatch.setattr("pigaming_app.scenes.app.failed", ["/somewhere/my policy.onnx"])
    monkeypatch.setattr(Notices, "add", lambda notices, line: said.append(line))
    assert run(Options(headless=True, frames=2, step=STEP)) == 0
    assert said == ["my policy failed and now stands still."]


def test_a_title_that_fails_for_ever_ends_the_arcade_in_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(Title, "draw", Broken.update)
    assert run(Options(headless=True, frames=100, step=STEP)) == 1
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "pigaming.log" in error


def test_robots_stand_still_when_a_scene_fails_and_when_the_arcade_ends() -> None:
    stopped: list[int] = []

    def first(context: Context) -> Scene:
        context.emergency_stops += [lambda: stopped.append(1), lambda: [][1], lambda: stopped.append(2)]
        return Broken(context)

    assert run(Options(headless=True, first_scene=first, frames=3, step=STEP)) == 0
    assert stopped == [1, 2, 1, 2]


def test_a_supervisor_ends_it_and_the_settings_are_kept(home: Path) -> None:
    class Ended(Quiet):
        def update(self, seconds: float) -> StackOperation:
            os.kill(os.getpid(), signal.SIGTERM)
            return None

    before = signal.getsignal(signal.SIGTERM)
    assert run(Options(headless=True, first_scene=Ended, frames=50, step=STEP)) == 0
    assert signal.getsignal(signal.SIGTERM) == before
    assert (home / "config" / "settings.toml").is_file()


def test_unreadable_settings_are_reported_on_the_screen_and_in_detail_on_stderr(
    home: Path, seen: list[tuple[type, list[str]]], capsys: pytest.CaptureFixture[str]
) -> None:
    (home / "config").mkdir()
    (home / "config" / "settings.toml").write_text('language = "pt"\nmusic = 99\n')
    run(Options(headless=True, frames=1, step=STEP))
    assert seen == [(Title, ["Não foi possível ler algumas opções. Usam-se as iniciais."])]
    assert "music = 99: expected a whole number <= 10" in capsys.readouterr().err


@pytest.mark.parametrize(("stored", "language"), [(None, "fr"), ('language = "de"\n', "de"), ("music = 3\n", "en")])
def test_only_the_very_first_start_takes_the_language_of_the_system(
    home: Path, monkeypatch: pytest.MonkeyPatch, stored: str | None, language: str
) -> None:
    monkeypatch.setenv("LANG", "fr_FR.UTF-8")
    if stored:
        (home / "config").mkdir()
        (home / "config" / "settings.toml").write_text(stored)
    with opened(Options(headless=True)) as app:
        assert app.context.words.language == app.context.settings.language == language
    assert Settings.load(home / "config")[0].language == language


def test_threads_in_the_background_yield_within_a_millisecond_while_it_is_open() -> None:
    """Also after the shortest of several threads has ended, such as those that check and plan a drawing."""
    before = sys.getswitchinterval()
    with opened(Options(headless=True)) as app:
        app.stack.apply(Push(Editor(app.context, "pitanks", "new-1", drawing_of(load("pitanks", "classic").source))))
        editor = app.stack.top
        assert isinstance(editor, Editor)
        end = monotonic() + 20.0
        while not (editor.bench.verdict and editor.bench.verdict.done):
            assert monotonic() < end
            sleep(0.01)
        assert sys.getswitchinterval() == pytest.approx(0.001)
        app.stack.clear()
    assert sys.getswitchinterval() == before


@pytest.mark.parametrize(("kiosk", "frames"), [(False, 1), (True, 10)])
def test_closing_the_window_ends_it_but_not_in_a_kiosk(kiosk: bool, frames: int) -> None:
    scenes: list[Quiet] = []

    class Closing(Quiet):
        def update(self, seconds: float) -> StackOperation:
            pygame.event.post(pygame.Event(pygame.QUIT))
            return super().update(seconds)

    def closing(context: Context) -> Scene:
        scenes.append(Closing(context))
        return scenes[0]

    assert run(Options(headless=True, first_scene=closing, frames=10, step=STEP, kiosk=kiosk)) == 0
    assert scenes[0].frames == frames


@pytest.mark.parametrize("kiosk", [False, True])
def test_f12_takes_a_picture_but_not_in_a_kiosk(home: Path, kiosk: bool) -> None:
    class Pressing(Quiet):
        def update(self, seconds: float) -> StackOperation:
            for key in (pygame.K_F3, pygame.K_F12) if not self.frames else ():
                pygame.event.post(pygame.Event(pygame.KEYDOWN, key=key, scancode=0, mod=0))
            return super().update(seconds)

    run(Options(headless=True, first_scene=Pressing, frames=30, step=STEP, kiosk=kiosk))
    assert bool(list((home / "data").glob("pictures/*.png"))) != kiosk


def test_a_pointer_that_lies_there_does_not_take_the_focus() -> None:
    titles: list[Title] = []

    def title(context: Context) -> Scene:
        titles.append(Title(context))
        pygame.event.post(pygame.Event(pygame.MOUSEMOTION, pos=(960, 600), rel=(0, 0), buttons=(0, 0, 0)))
        return titles[0]

    run(Options(headless=True, first_scene=title, frames=3, step=STEP))
    assert titles[0].focus.name == "pitanks"


@pytest.mark.usefixtures("_nothing_prewarmed")
def test_the_second_screen_follows_a_match(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    painted: list[int] = []
    show = OperatorDesk.show

    def watched(desk: OperatorDesk, seconds: float, left: float, scenes: Sequence[Scene]) -> None:
        show(desk, seconds, 1.0, scenes)
        assert desk.window
        assert desk.window.window
        painted.append(sum(pygame.transform.average_color(desk.window.window.get_surface())[:3]))

    monkeypatch.setattr(OperatorDesk, "show", watched)
    options = Options(
        headless=True,
        scoreboard=2,
        first_scene=lambda context: MatchScene(context, setup("level1 level1 off off", minutes=1.0)),
        frames=20,
        step=STEP,
    )
    assert run(options) == 0
    assert painted[0] == 0
    assert painted[-1] > 0


@pytest.mark.parametrize(("number", "more"), one_in(4, product((1, 2, 16), MORE)), ids=str)
def test_the_second_screen_goes_with_every_other_option(
    home: Path, capsys: pytest.CaptureFixture[str], number: int, more: dict[str, Any]
) -> None:
    assert run(Options(headless=True, scoreboard=number, frames=20, step=4 * STEP, **more)) == 0
    assert "second screen" not in capsys.readouterr().err, "it was lost"
    (file,) = (home / "data" / "days").iterdir()
    assert "failure" not in file.read_text()


@pytest.mark.parametrize("left_out", [False, True], ids=["a scene", "games that are left out"])
def test_it_gives_up_on_a_scene_that_fails_again_and_again_but_not_for_one_game_after_another(
    monkeypatch: pytest.MonkeyPatch, left_out: bool
) -> None:
    games: set[int] = set()

    def failing(seconds: float) -> None:
        raise ValueError("on purpose")

    def blame(error: BaseException) -> None:
        games.add(len(games) if left_out else 0)

    games.add(0)
    monkeypatch.setattr(app_module, "stopped", lambda: games)
    monkeypatch.setattr(app_module, "blame", blame)
    with opened(Options(headless=True, step=STEP)) as app:
        monkeypatch.setattr(app, "_frame", failing)
        ended = [app._frame_failed(STEP) and not app._recover() for _ in range(MAX_FAILURES + 2)]
    assert any(ended) != left_out


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


def pictures(first: Callable[[Context], Scene], frames: int = 4) -> list[bytes]:
    """Every picture of the arcade from the start; the pointer may leave the window."""
    shown: list[bytes] = []

    def over() -> bool:
        assert not pygame.event.get_grab()
        shown.append(pygame.image.tobytes(cast(pygame.Surface, pygame.display.get_surface()), "RGB"))
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
    "damage", one_in(4, [clip, clip_twice_removed, locks, pixels, transparency, cached_picture, pinned, grabbed])
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


CLOSED = """
import sys, time
from pigaming_app.scenes import start
from pigaming_app.scenes.launch import Options
from pigaming_app.ui.sounds import Sounds

start.CLOSING = 0.5
Sounds.close = lambda self: time.sleep(600)
sys.exit(start.run(Options(headless=True, frames=2, changed_settings={"music": 3})))
"""


def test_a_driver_that_hangs_while_closing_ends_with_everything_saved(home: Path) -> None:
    done = subprocess.run([sys.executable, "-c", CLOSED], cwd=ROOT, timeout=60, check=False)
    assert done.returncode == 0
    assert "music = 3" in (home / "config" / "settings.toml").read_text()
    assert "closing took longer" in (home / "data" / "pigaming.log").read_text()
    assert "<string>" in (home / "data" / "crash.log").read_text()
