"""The projector shows the window on the emulated mat, for windows of any shape."""

import numpy as np
import pytest

from pigaming_app.hardware.emulator.arena import EmulatedArena


@pytest.mark.parametrize(("size", "bars"), [((1080, 1920), 0), ((540, 960), 0), ((1024, 1280), 152), ((2160, 3840), 0)])
def test_the_picture_fills_the_projector_and_the_bars_are_left_out(size: tuple[int, int], bars: int) -> None:
    arena = EmulatedArena(1)
    window = np.zeros((*size, 4), np.uint8)
    window[bars : size[0] - bars] = 200
    window[bars : bars + 20, :40] = 90  # its upper left corner
    arena.project_window(window)
    arena.advance(0.1)
    shown = arena._shown
    assert shown.shape == (1080, 1920)
    assert shown[1070, 1910] == 200
    assert shown[2, 2] == pytest.approx(90, abs=2)
