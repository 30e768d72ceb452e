"""Where the jobs `robots` and `fidelity` get robots from: the real ones, or the emulated arena in made-up time."""

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol

from pigaming_app.sim.world import DT
from pigaming_app.storage.settings import Settings, folders

CALIBRATION = "calibration.toml"  # in the folder of the settings, as is
ROBOTS, EMULATED = "robots.toml", "robots-emulated.toml"


class Workshop(Protocol):
    """A rig, and a way to let 1/50 s pass."""

    rig: Any
    mm: float  # of an arena px

    def tick(self) -> None: ...

    def close(self) -> None: ...


class RealWorkshop:
    """The camera and the radio of the settings, or those asked for. Raises NoGround, NoVision, DrivetrainError."""

    def __init__(self, camera: int | None = None, port: str | None = None) -> None:
        from pigaming_app.hardware.session.assembly import connect, ground_of, measured

        config = folders().config
        ground = ground_of(config / CALIBRATION)
        self.mm = ground.mm
        self.rig = connect(wiring(camera, port), ground, measured(config / ROBOTS))
        self.rig.channels = tuple(radio - 1 for radio in Settings.load(config)[0].radios)
        self._next = time.monotonic()

    def tick(self) -> None:
        """Wait until 1/50 s has passed since the last time."""
        self._next = max(self._next + DT, time.monotonic() - DT)
        time.sleep(max(0.0, self._next - time.monotonic()))

    def close(self) -> None:
        """Stop all robots, let go of camera and radio."""
        self.rig.close()


class EmulatedWorkshop:
    """The emulated arena, calibrated. Its time passes as fast as this machine can. Raises NoVision."""

    def __init__(self, seed: int) -> None:
        from pigaming_app.hardware.vision.markers import opencv

        opencv()
        from pigaming_app.hardware.proof.testbed import Bed

        self.bed = Bed(seed, 30.0)
        self.rig, self.mm = self.bed.rig, self.bed.ground.mm
        self.bed.find()

    def tick(self) -> None:
        """1/50 s of its time."""
        self.bed.tick()

    def close(self) -> None:
        """Nothing is left of it."""
        self.rig.close()


def wiring(camera: int | None = None, port: str | None = None) -> Any:
    """What the settings say is plugged in where, unless something else is asked for."""
    from pigaming_app.hardware.session.assembly import Wiring

    settings, _ = Settings.load(folders().config)
    number = settings.camera if camera is None else camera
    return Wiring(number, port or settings.port, settings.baud, settings.radio)


def open_workshop(emulate: int | None, camera: int | None, port: str | None) -> Workshop:
    """The emulated arena of a seed, or the real one. Raises ValueError, ImportError, NoVision."""
    return EmulatedWorkshop(emulate) if emulate is not None else RealWorkshop(camera, port)


def keep_radios(channels: Sequence[int]) -> None:
    """Remember which radio drives which marker. Raises NotSaved."""
    config = folders().config
    settings, _ = Settings.load(config)
    settings.radios = [channel + 1 for channel in channels]
    settings.save(config)


def kept_robots(emulated: bool) -> Path:
    """Where the measured robots are kept; those of the emulated arena not among the real ones."""
    return folders().config / (EMULATED if emulated else ROBOTS)
