"""The second window, with the view of the emulated camera."""

from pathlib import Path
from typing import Any

import pygame
import pytest

from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.mat.camera_window import SIZE, CameraWindow
from pigaming_app.scenes.start import run
from pigaming_app.ui.input.controls import Controls

pytest.importorskip("cv2")


def test_it_shows_the_newest_picture_and_can_be_closed_alone(controls: Controls) -> None:
    mat = EmulatedSession(live=False)
    window = CameraWindow(mat)
    try:
        window.update(0.1)
        assert window.window is not None
        assert window.window.get_surface().get_at((SIZE[0] // 2, SIZE[1] // 2))[:3] == (0, 0, 0)
        mat.open()
        mat.advance(0.3)
        window.update(0.1)
        seen = [window.window.get_surface().get_at((x, SIZE[1] // 2))[0] for x in range(0, SIZE[0], 40)]
        assert max(seen) > 20  # the room's light on the mat
        other = pygame.Event(pygame.WINDOWCLOSE, window=None)
        assert not window.close_if_requested(other)
        assert window.close_if_requested(pygame.Event(pygame.WINDOWCLOSE, window=window.window))
        assert window.window is None
        window.update(0.1)
    finally:
        window.close()
        mat.end()


def test_without_a_second_window_the_arcade_prints_a_reason_and_goes_on(
    controls: Controls, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise pygame.error("windows are sold out")

    monkeypatch.setattr(pygame, "Window", refuse)
    window = CameraWindow(EmulatedSession(live=False))
    window.update(1.0)
    assert "no second window" in capsys.readouterr().err
    assert window.window is None


def test_no_window_is_open_when_the_video_closes(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Else pygame frees it later, and with it a window that SDL has opened at the same address."""
    opened, at_the_end = [], []

    class Noted(pygame.Window):
        def __init__(self, *words: Any, **options: Any) -> None:
            super().__init__(*words, **options)
            opened.append(self)

        def destroy(self) -> None:
            opened.remove(self)
            super().destroy()

    quit_video = pygame.display.quit
    monkeypatch.setattr(pygame, "Window", Noted)
    monkeypatch.setattr(pygame.display, "quit", lambda: (at_the_end.append(len(opened)), quit_video()))  # type: ignore[func-returns-value]
    assert run(Options(headless=True, emulator_seed=1, scoreboard=1, frames=2)) == 0
    assert at_the_end == [0]
