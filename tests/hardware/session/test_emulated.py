"""The emulated session: drift supervision in every rig, and closing of camera and radio exactly once."""

from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.calibration.drift import PAUSE, WARN
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.session.lighting import Lighting
from pigaming_app.sim.world import DT, HZ, ROBOTS, World


@pytest.fixture(scope="module")
def session() -> Iterator[EmulatedSession]:
    session = EmulatedSession(1, live=False, lighting=Lighting(1))
    session.find()
    yield session
    session.end()


@pytest.mark.long
def test_who_drives_and_does_nothing_about_drift_is_stopped_when_the_camera_has_moved(session: EmulatedSession) -> None:
    world: Any = World()
    for robot in world.robots:
        robot.present = 1
    rig = session.open()
    plant = RealPlant(world, rig)

    def drive(seconds: float) -> None:
        for _ in range(round(seconds * HZ)):
            plant.sense()
            plant.drive([(0.0, 0.5)] * ROBOTS, DT)
            session.tick()

    session.arena.camera.painter.refresh = 1  # the margins too, in every picture
    drive(1.5)
    assert 0.0 < rig.drift() < WARN
    assert "drift" not in {fault.name for fault in plant.faults}
    session.arena.faults.switch("camera_bumped", True)
    drive(2.5)
    assert rig.drift() > PAUSE
    assert "drift" in {fault.name for fault in plant.faults if fault.pauses}
    session.arena.advance(0.3)
    assert not any(robot.left or robot.right for robot in session.arena.robots)
    session.arena.faults.switch("camera_bumped", False)
    drive(2.5)
    assert rig.drift() < WARN


def test_camera_and_radio_are_closed_once_and_opened_anew(
    session: EmulatedSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    rig = session.open()
    assert session.open() is rig
    closed: list[str] = []
    monkeypatch.setattr(rig.link, "close", lambda: closed.append("link"))
    monkeypatch.setattr(rig.camera, "close", lambda: closed.append("camera"))
    session.close()
    session.close()
    assert closed == ["link", "camera"]
    assert session.fault is None
    assert session.open() is not rig


def test_the_window_s_picture_is_asked_for_only_when_the_projector_is_due(session: EmulatedSession) -> None:
    import numpy as np

    asked: list[float] = []

    def pixels() -> Any:
        asked.append(session.arena.clock())
        return np.zeros((1080, 1920, 4), np.uint8)

    for _ in range(10):
        session.show(pixels)
        session.arena.advance(0.01)
    assert 4 <= len(asked) <= 6
