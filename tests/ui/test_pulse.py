"""Signs of life: a beat a frame, a copy of the screen every two seconds."""

from pathlib import Path

import pygame

from pigaming_app.storage.heartbeat import PICTURE, Heartbeat
from pigaming_app.ui.pulse import INTERVAL, Pulse


def test_every_frame_beats_and_few_copy_the_screen(tmp_path: Path) -> None:
    path, now = tmp_path / "beat", [0.0]
    path.touch()
    heartbeat = Heartbeat(path)
    pulse = Pulse(heartbeat, lambda: now[0])
    screen = pygame.Surface((1920, 1080))
    screen.fill("red")
    pulse.beat(screen)
    assert (heartbeat.beats, heartbeat.picture) == (1, None)
    now[0] = INTERVAL
    pulse.beat(screen)
    assert heartbeat.beats == 2
    assert heartbeat.picture == (PICTURE, b"\xff\0\0" * (PICTURE[0] * PICTURE[1]))
    screen.fill("blue")
    pulse.beat(screen)
    assert heartbeat.picture[1][:3] == b"\xff\0\0"
    heartbeat.close()
