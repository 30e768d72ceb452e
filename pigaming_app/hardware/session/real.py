"""The mat: everything outside the computer that real robots need, real or emulated, and its parts while they are used.

`open` starts camera, tracker and radio for a match or a page, `close` stops the robots and ends every thread. What is
wrong is one sentence, `trouble`; the arcade plays on with simulated robots.
"""

import logging
from typing import TYPE_CHECKING, Protocol

from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.window import Canvas

if TYPE_CHECKING:
    from pigaming_app.hardware.calibration.ground_plane import Ground
    from pigaming_app.hardware.control.rig import Rig, Talks
    from pigaming_app.hardware.messages import Said
    from pigaming_app.hardware.radio.link import Link
    from pigaming_app.hardware.session.assembly import Wiring

LIGHT_AFTER = 0.035  # s from a picture being painted until its light lands on the mat

log = logging.getLogger("pigaming")


class NoMat(Exception):
    """The robots cannot be used; its argument is one sentence, mostly a `said.Said`."""


class Mat(Protocol):
    """A mat with robots, or what stands in for it."""

    emulated: bool

    @property
    def trouble(self) -> str | None:
        """What is wrong with camera or radio, in one sentence; None: nothing, or they are not in use."""

    def open(self) -> "Rig":
        """Start, or go on with, what real robots need. Raises NoMat."""

    def listen(self) -> "Link | None":
        """The radio alone, where `open` raises; None where there is none either."""

    def close(self) -> None:
        """Stop the robots and end all threads. May be called again."""

    def end(self) -> None:
        """Close for good."""

    def advance(self, seconds: float) -> float:
        """Let time pass, where it does not pass by itself; how much has passed."""


class RealMat:
    """The camera and the radio of the settings."""

    emulated = False

    def __init__(self, settings: Settings, canvas: Canvas) -> None:
        self.settings, self.canvas = settings, canvas
        self._rig: Rig | None = None
        self._link: Link | None = None

    @property
    def trouble(self) -> str | None:
        """What is wrong with camera or radio."""
        if self._rig is not None:
            return trouble_of(self._rig)
        return told(self._link) if self._link else None

    def open(self) -> "Rig":
        """Start camera, tracker and radio in their threads. Raises NoMat."""
        if self._rig is None:
            from pigaming_app.hardware.calibration.ground_plane import NoGround
            from pigaming_app.hardware.session.assembly import connect, measured
            from pigaming_app.hardware.vision.markers import NoVision
            from pigaming_app.sim.drivetrain import DrivetrainError

            try:
                ground = kept_ground("calibration.toml", self.canvas.projection)
                self._rig = connect(self._wiring, ground, measured(folders().config / "robots.toml"))
            except (NoGround, NoVision, DrivetrainError, ImportError) as trouble:
                raise refused(trouble) from trouble
            self._rig.channels = tuple(one - 1 for one in self.settings.radios)
        return self._rig

    def listen(self) -> "Link | None":
        """The radio of the settings."""
        if self._link is None:
            from pigaming_app.hardware.session.assembly import linked

            self._link = linked(self._wiring).start()
        return self._link

    def close(self) -> None:
        """Stop the robots and end all threads."""
        rig, self._rig, link, self._link = self._rig, None, self._link, None
        if rig is not None:
            rig.close()
        if link is not None:
            link.close()

    def end(self) -> None:
        """Close for good."""
        self.close()

    def advance(self, seconds: float) -> float:
        """Real time passes by itself."""
        return seconds

    @property
    def _wiring(self) -> "Wiring":
        from pigaming_app.hardware.session.assembly import Wiring

        chosen = self.settings
        return Wiring(chosen.camera, chosen.port, chosen.baud, chosen.radio)


def unfit(settings: Settings) -> "Said | None":
    """Why no match may begin with real robots on the radio of these settings, emulated ones included; None: it may."""
    if settings.radio != "stock":
        return None
    from pigaming_app.hardware.radio.stock_protocol import NO_DEADMAN

    return NO_DEADMAN


def kept_ground(file: str, projection: str) -> "Ground":
    """The calibration kept for this projection. Raises NoGround."""
    from pigaming_app.hardware.calibration.ground_plane import read, written
    from pigaming_app.hardware.session.assembly import ground_of

    ground = ground_of(folders().config / file)
    return read(written(ground), projection, ground.lens.size)


def trouble_of(rig: "Rig") -> str | None:
    """What a camera or a link says is wrong with it."""
    return exact(rig, "camera") or exact(rig, "radio")


def exact(rig: "Rig", fault: str) -> str | None:
    """What the part that a fault is about says itself."""
    if fault == "camera":
        return getattr(rig.eye, "trouble", None)
    return told(rig.link) if fault == "radio" else None


def told(link: "Talks") -> str | None:
    """What a link says is wrong with it, with a key for other languages."""
    from pigaming_app.hardware.messages import Said

    trouble = link.trouble
    if trouble is None:
        return None
    return Said(str(trouble), f"radio_{trouble.reason}", port=trouble.port, detail=trouble.detail)


def refused(trouble: BaseException) -> NoMat:
    """The same trouble as NoMat; the log has it too."""
    from pigaming_app.hardware.messages import said

    sentence = said(trouble)
    log.warning("%s", sentence)
    return NoMat(sentence)
