"""What a link must know of those it talks to: how commands become bytes, and bytes telemetry."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol

from pigaming_app.hardware.signals import Telemetry, WheelCommand


class LinkQuality(NamedTuple):
    """How well a robot is heard."""

    share: float  # of the reports expected in the last seconds, 0 to 1
    strength: int | None  # dBm of the newest report, where the radio tells
    echo: float | None  # s from sending a command to the report that names it


class RadioProtocol(Protocol):
    """How commands become bytes and bytes telemetry."""

    @property
    def telemetry(self) -> Mapping[int, Telemetry]:
        """The newest of every robot heard, by robot."""

    def open(self, now: float) -> bytes:
        """The line is open, perhaps again: what to say first."""

    def command(self, wheels: Sequence[WheelCommand | None], now: float) -> bytes:
        """What to send to the robots 0 to 3; None stops."""

    def hear(self, heard: bytes, now: float) -> None:
        """Take in what came, also when nothing came."""

    def quality(self, robot: int, now: float) -> LinkQuality:
        """How well a robot is heard."""

    def trouble(self, now: float) -> tuple[str, str] | None:
        """Reason and detail, see `serial_line.radio_message`, if the line is open but something is wrong."""
