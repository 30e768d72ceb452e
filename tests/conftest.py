"""Tests touch no screen, no sound card and no file of the user but the cache of compiled code."""

import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from pigaming_app.sim.kernel import _cache_folder

os.environ["SDL_VIDEODRIVER"] = "dummy"
os.environ["SDL_AUDIODRIVER"] = "dummy"
os.environ["PYGAME_HIDE_SUPPORT_PROMPT"] = "1"
os.environ.setdefault("NUMBA_CACHE_DIR", str(_cache_folder()))  # before home moves: compiling takes long


@pytest.fixture(autouse=True, scope="session")
def _a_home_of_their_own() -> Iterator[None]:
    with tempfile.TemporaryDirectory() as home, pytest.MonkeyPatch.context() as patch:
        patch.setenv("PIGAMING_HOME", home)
        yield


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's folders of one test."""
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path / "home"))
    return tmp_path / "home"
