"""Fixtures of the tests of scenes."""

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest


@pytest.fixture
def _home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))


@pytest.fixture
def _no_threads_stay() -> Iterator[None]:
    before = set(threading.enumerate())
    yield
    end = time.monotonic() + 3.0
    while left := set(threading.enumerate()) - before:
        assert time.monotonic() < end, f"still there: {left}"
        time.sleep(0.01)
