"""Fixtures of the tests of ui and scenes, which run without a screen and without a sound card."""

import os
import threading
import time
from collections.abc import Iterator
from pathlib import Path

os.environ["SDL_VIDEODRIVER"] = "dummy"
os.environ["SDL_AUDIODRIVER"] = "dummy"
os.environ["PYGAME_HIDE_SUPPORT_PROMPT"] = "1"
os.environ["SDL_JOYSTICK_ALLOW_BACKGROUND_EVENTS"] = "1"  # as in the arcade: pads count though a window was closed

import pygame
import pytest

from pigaming_app.ui.input.controls import Controls


@pytest.fixture
def controls() -> Iterator[Controls]:
    pygame.display.init()
    pygame.display.set_mode((1920, 1080))
    pygame.event.clear()
    yield Controls()
    pygame.event.clear()


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
