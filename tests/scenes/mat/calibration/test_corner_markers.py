"""The corner markers: they lie in the side margins and reveal a displaced camera."""

from pathlib import Path

import pygame
import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.calibration.drift import PAUSE, WARN
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.scenes.mat.calibration.corner_markers import draw_corners, tiles
from pigaming_app.scenes.views.background import LEFT
from pigaming_app.sim.world import WIDTH
from pigaming_app.ui.draw.pixels import pixels_of


def test_the_markers_stand_beside_the_arena_and_on_the_canvas() -> None:
    canvas = pygame.Rect(0, 0, 1920, 1080)
    for tile, at in tiles():
        place = tile.get_rect(topleft=at)
        assert canvas.contains(place)
        assert place.right <= LEFT or place.left >= LEFT + WIDTH


@pytest.mark.long
@pytest.mark.usefixtures("controls")
def test_a_bumped_camera_is_detected_without_false_alarms(home: Path) -> None:
    mat = EmulatedSession(live=False)
    rig = mat.open()
    screen = pygame.Surface((1920, 1080), depth=32)

    def pictures(count: int) -> None:
        for _ in range(count):
            screen.fill("black")
            draw_corners(screen)
            mat.show(lambda: pixels_of(screen))
            mat.advance(1 / 30)

    mat.arena.camera.painter.refresh = 1
    pictures(45)
    assert 0.0 < rig.drift() < WARN
    mat.arena.faults.switch("camera_bumped", True)
    pictures(75)
    assert rig.drift() > PAUSE
    mat.arena.faults.switch("camera_bumped", False)
    pictures(75)
    assert rig.drift() < WARN
    mat.end()
