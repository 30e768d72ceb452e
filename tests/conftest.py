"""Fixtures. Tests use no display, no sound card and none of the user's files except the cache of compiled code."""

import gc
import os
import pickle
import random
import secrets
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

from pigaming_app.sim.kernel import _cache_folder
from pigaming_app.storage.background import BLAS

WORDY = ("pt", "de")

OTHER_RANDOMNESS = os.environ.get("PIGAMING_TEST_SEED", "")  # any text; without it, every run is the same

settings.register_profile(
    "any machine", deadline=None, suppress_health_check=[HealthCheck.too_slow], derandomize=not OTHER_RANDOMNESS
)
settings.load_profile("any machine")

os.environ["SDL_VIDEODRIVER"] = "dummy"
os.environ["SDL_AUDIODRIVER"] = "dummy"
os.environ["SDL_JOYSTICK_ALLOW_BACKGROUND_EVENTS"] = "1"  # as in the arcade: pads count though a window was closed
os.environ["LANG"] = "C.UTF-8"  # the arcade starts in English
os.environ.pop("LANGUAGE", None)
os.environ["PYTHON_KEYRING_BACKEND"] = "keyring.backends.fail.Keyring"  # never that of whoever runs the tests
os.environ["PYGAME_HIDE_SUPPORT_PROMPT"] = "1"
os.environ.update(dict.fromkeys(BLAS, "1"))  # as in every job, which comes too late here
os.environ.setdefault("NUMBA_CACHE_DIR", str(_cache_folder()))  # before home moves: compiling takes long


@pytest.fixture(autouse=True, scope="session")
def _a_home_of_their_own() -> Iterator[None]:
    with tempfile.TemporaryDirectory() as home, pytest.MonkeyPatch.context() as patch:
        patch.setenv("PIGAMING_HOME", home)
        yield


@pytest.fixture(autouse=True, scope="module")
def _no_arena_stays() -> Iterator[None]:
    """An arena in the common home would be one of a game's for all tests after it."""
    common = Path(os.environ["PIGAMING_HOME"])
    yield
    assert not list(common.rglob("arenas/*/*.toml"))


@pytest.fixture(autouse=True, scope="session")
def _one_process_for_many_arcades() -> Iterator[Callable[..., Any]]:
    """Parse each text of an arena once, as arenas never change; keep pictures and freed memory for the next test.

    Pictures have lines, but no glow round them, which takes most of the time: `_glow` is for tests of it. The value
    is the function that adds it.
    """
    from pigaming_app.games import arenas
    from pigaming_app.sim.arena import parse
    from pigaming_app.ui import memory
    from pigaming_app.ui.draw import glow
    from pigaming_app.ui.draw.surface_cache import surfaces

    gc.set_threshold(20_000, 20, 50)  # a collection takes 0.1 s among the objects of so many tests
    add_glow = glow.add_glow
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(glow, "add_glow", _no_steps)
        patch.setattr(arenas, "parse_arena", lru_cache(64)(parse))
        patch.setattr(memory, "return_large_blocks", lambda: None)
        patch.setattr(surfaces, "budget", 512 << 20)
        patch.setattr(surfaces, "release_matches", lambda: None)
        patch.setattr(surfaces, "release_pages", lambda: None)
        yield add_glow


def _no_steps(*_: object) -> Iterator[None]:
    yield from ()


@pytest.fixture
def _glow(_one_process_for_many_arcades: Callable[..., Any]) -> Iterator[None]:
    """Pictures as in the arcade, for tests that examine them."""
    from pigaming_app.ui.draw import glow
    from tests.scenes.measuring import empty_cache, forget

    with pytest.MonkeyPatch.context() as patch, empty_cache():
        patch.setattr(glow, "add_glow", _one_process_for_many_arcades)
        forget()
        yield
        forget()


@pytest.fixture(autouse=True)
def _the_same_seeds_in_every_run(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw seeds of matches and choices of the arcade by the name of the test, so that what fails, fails again."""
    chance = random.Random(f"{OTHER_RANDOMNESS}{request.node.nodeid}")
    monkeypatch.setattr(secrets, "randbelow", chance.randrange)
    monkeypatch.setattr(secrets, "choice", chance.choice)
    random.seed(chance.random())


@pytest.fixture
def _cache_as_in_the_arcade() -> Iterator[None]:
    """An empty surface cache with its own budget, released after a match: for tests of memory."""
    from pigaming_app.ui.draw.surface_cache import BUDGET, SurfaceCache, surfaces
    from tests.scenes.measuring import empty_cache

    with empty_cache(), pytest.MonkeyPatch.context() as patch:
        patch.setattr(surfaces, "budget", BUDGET)
        patch.setattr(surfaces, "release_matches", lambda: SurfaceCache.release_matches(surfaces))
        patch.setattr(surfaces, "release_pages", lambda: SurfaceCache.release_pages(surfaces))
        yield


@pytest.fixture(scope="module")
def _cache_of_its_own() -> Iterator[None]:
    """A surface cache for a module whose tests damage what it holds."""
    from tests.scenes.measuring import empty_cache

    with empty_cache():
        yield


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Of a test that runs in all languages, leave one of the two with the longest texts unmarked, by turns.

    The other one is `long`, and all others are `again`.

    The longest tests come first: a worker that takes one up as its last keeps all others waiting.
    """
    languages = [item for item in items if isinstance(item, pytest.Function) and "language" in _values(item)]
    both: dict[tuple[str, str], list[pytest.Function]] = {}
    for item in languages:
        if _values(item)["language"] in WORDY and not any(item.iter_markers("long")):
            both.setdefault(_twin(item), []).append(item)
    for turn, wordy in enumerate(both.values()):
        wordy.pop(turn % len(wordy))
        for other in wordy:
            other.add_marker(pytest.mark.long)
    for item in languages:
        if _values(item)["language"] not in WORDY and _twin(item) in both:
            item.add_marker(pytest.mark.long)
            item.add_marker(pytest.mark.again)
    items.sort(key=lambda item: not any(mark.kwargs.get("first") for mark in item.iter_markers("long")))


def _values(item: pytest.Function) -> Mapping[str, Any]:
    """The values of a parametrised case, by argument."""
    return item.callspec.params if hasattr(item, "callspec") else {}


def _twin(item: pytest.Function) -> tuple[str, str]:
    """Equal for the cases of one test that differ in the language only."""
    others = {name: value for name, value in _values(item).items() if name != "language"}
    return item.nodeid.partition("[")[0], repr(sorted(others.items(), key=lambda pair: pair[0]))


@pytest.fixture
def controls() -> Iterator[Any]:
    """Controls with an open window and an empty event queue."""
    import pygame

    from pigaming_app.ui.input.controls import Controls

    pygame.display.init()
    pygame.display.set_mode((1920, 1080))
    pygame.event.clear()
    yield Controls()
    pygame.event.clear()


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Temporary user folders for one test."""
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path / "home"))
    return tmp_path / "home"


@pytest.fixture(autouse=True, scope="session")
def _one_calibration(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Calibrate each emulated arena once per session; all workers share the result.

    The wizard does not take this way: it calibrates in every test.
    """
    from pigaming_app.hardware.session import emulated

    worker = os.environ.get("PYTEST_XDIST_WORKER", "")
    folder = tmp_path_factory.getbasetemp()
    folder = folder.parent if worker else folder
    calibrated = emulated.calibrated

    def once(arena: Any) -> Any:
        timing = arena.camera.timing
        file = (
            folder / f"ground-{arena.camera.painter._seed}-{timing.fps}-{timing.delay}-{arena._exposure_jitter}.pickle"
        )
        if not file.exists():
            unfinished = file.with_suffix(f".{worker or 'new'}")
            unfinished.write_bytes(pickle.dumps(calibrated(arena)))
            unfinished.replace(file)
        return pickle.loads(file.read_bytes())

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(emulated, "calibrated", once)
        yield


@pytest.fixture
def _home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))


@pytest.fixture
def _no_threads_stay() -> Iterator[None]:
    before = set(threading.enumerate())
    yield
    end = time.monotonic() + 30.0
    while left := set(threading.enumerate()) - before:
        assert time.monotonic() < end, f"still there: {left}"
        time.sleep(0.01)
