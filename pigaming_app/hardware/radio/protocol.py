"""The radio protocol interface of a link: commands to bytes, and bytes to telemetry."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol

from pigaming_app.hardware.signals import Telemetry, WheelCommand


class LinkQuality(NamedTuple):
    """Reception quality of a robot."""

    share: float  # reports received / expected over the last seconds, 0 to 1
    strength: int | None  # signal strength of the newest report, dBm; None if the radio does not measure it
    echo: float | None  # round trip from sending a command to the report that acknowledges it, s


class Misfit(NamedTuple):
    """A robot that reports but cannot be driven."""

    reason: str  # old: firmware of protocol 1; no_arena: flashed without an arena id; foreign: of another arena; key:
    # of another key, on Wi-Fi
    arena: int  # id in its reports, 0 if there is none
    received: float  # s, time of its last such report


class RadioProtocol(Protocol):
    """Encodes commands, decodes telemetry and diagnoses the radio."""

    @property
    def telemetry(self) -> Mapping[int, Telemetry]:
        """Newest telemetry of every robot received so far, by robot; of this arena's driveable robots only."""

    @property
    def misfits(self) -> Mapping[int, Misfit]:
        """Last report of every robot that cannot be driven, by robot."""

    @property
    def boards(self) -> Mapping[int, int]:
        """Board numbers that robots have announced, by robot: see robot_kinds. Robots without this are absent."""

    def open(self, now: float) -> bytes:
        """Reset for a newly opened line; returns the bytes to send first."""

    def command(self, wheels: Sequence[WheelCommand | None], now: float) -> bytes:
        """Bytes that command the robots 0 to 3; None: stop."""

    def receive(self, received: bytes, now: float) -> None:
        """Process received bytes; called even when there are none."""

    def quality(self, robot: int, now: float) -> LinkQuality:
        """Reception quality of a robot."""

    def fault(self, now: float) -> tuple[str, str] | None:
        """Reason and detail (see `serial_line.radio_message`) of a fault on an open line, or None."""
