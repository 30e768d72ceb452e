"""Helpers for tests of sessions: a real session, a saved calibration, and waiting for threads."""

import threading
import time
from collections.abc import Callable
from dataclasses import replace

from pigaming_app.hardware.calibration.ground_plane import to_toml
from pigaming_app.hardware.calibration.quality import CameraQuality
from pigaming_app.hardware.session.real import RealSession
from pigaming_app.storage.settings import Settings, folders
from tests.hardware.mat import nominal

HERE = "1: 1920 × 1080"
UNMEASURED = CameraQuality()


def real_mat(settings: Settings | None = None) -> RealSession:
    return RealSession(settings or Settings(), lambda: HERE)


def calibrate(projection: str, quality: CameraQuality = UNMEASURED) -> None:
    """Save a calibration made with this projection and picture."""
    folder = folders().config
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "calibration.toml").write_text(
        to_toml(replace(nominal(), display=projection, quality=quality)), encoding="utf-8"
    )


def soon(true: Callable[[], bool], most: float = 30.0) -> bool:
    """Wait until the condition is true; False after `most` s."""
    end = time.monotonic() + most
    while time.monotonic() < end:
        if true():
            return True
        time.sleep(0.02)
    return False


def threads() -> set[str]:
    mine = ("rig", "link", "emulated arena", "camera")
    return {thread.name for thread in threading.enumerate() if thread.name.startswith(mine)}
