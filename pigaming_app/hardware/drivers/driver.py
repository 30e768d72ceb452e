"""The face of drivers: facts about robots and their radio that a driver declares, and the link that it opens.

Wheel speeds go in through a CommandLink, 50 times a second; telemetry and faults come out of it. `robots check` tests
what is declared here.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pigaming_app.hardware.robot_kinds import DEFAULT, RobotKind
from pigaming_app.sim.world import DT
from pigaming_app.storage.messages import OperatorMessage

if TYPE_CHECKING:
    from pigaming_app.hardware.drivers.stand import RobotStand
    from pigaming_app.hardware.radio.link import CommandLink
    from pigaming_app.hardware.radio.serial_line import OpenPort
    from pigaming_app.hardware.radio.wifi import WifiNetwork
    from pigaming_app.hardware.ros.robots import RosPoses
    from pigaming_app.hardware.signals import Clock

RATE = 1.0 / DT  # commands a second: one a tick
FARTHEST = 100.0  # mm, of a marker's middle from that between the wheels
LONGEST_DEAD, MANY = 10.0, 1e5  # s; mm or mV: more is no robot
LONGEST_SILENCE = 0.3  # s without a command after which the motors of a match's robots must be off


@dataclass(frozen=True)
class LinkSite:
    """Where a driver opens its link: the user's settings, or the emulated arena.

    `open_port(baud)` is the serial port `port`, at `baud` unless the driver has a rate of its own; `network` makes that
    of our Wi-Fi robots; `poses` are those of a ROS network.
    """

    arena: int
    clock: "Clock"
    port: str = ""
    baud: int = 57600
    open_port: "Callable[[int], OpenPort] | None" = None
    network: "Callable[[], WifiNetwork] | None" = None
    poses: "RosPoses | None" = None


@dataclass(frozen=True, kw_only=True, eq=False)
class RobotDriver:
    """A driver. `open(site)` returns its link, not started; one that does not come up reports its `fault`.

    `silence`: s without a command after which its robots switch their motors off by themselves; None: never.
    `stopped_by`: what does so, in a few English words. `dead_time`: s from sending a command to the motors' response,
    until it has been measured. `rate`: commands a second that its link sends, at most RATE. `marker_mm`: by how much
    the middle of a marker lies ahead of that between the wheels. `serial`: port and baud rate of the settings count.
    `kind`: size and battery limits of a robot that neither the settings nor its announcement name. `title`: a proper
    name for the settings; those of the arcade have texts. `stand(seed)`: its emulated robots, without which a plug-in's
    play no match; those of the arcade: `proof.stands`.
    """

    name: str
    open: "Callable[[LinkSite], CommandLink]"
    silence: float | None
    stopped_by: str
    dead_time: float = 0.03
    rate: float = RATE
    marker_mm: float = 0.0
    serial: bool = True
    kind: RobotKind = DEFAULT
    title: str = ""
    stand: "Callable[[int], RobotStand] | None" = None

    def __post_init__(self) -> None:
        """Raises TypeError or ValueError with the name of a field that has a wrong value."""
        for name, kind in (("name", str), ("stopped_by", str), ("title", str), ("serial", bool), ("kind", RobotKind)):
            _require(name, value := getattr(self, name), isinstance(value, kind), f"a {kind.__name__}")
        _require("open", self.open, callable(self.open), "a function of a LinkSite")
        _require("stand", self.stand, self.stand is None or callable(self.stand), "a function of a seed, or None,")
        _require("silence", self.silence, self.silence is None or _is_number(self.silence), "a number, or None,")
        _require_number("dead_time", self.dead_time, most=LONGEST_DEAD)
        _require_number("rate", self.rate, 1.0, RATE)
        _require_number("marker_mm", self.marker_mm, -FARTHEST, FARTHEST)
        for name in ("warn_mv", "stop_mv", "radius_mm", "wheel_mm", "base_mm"):
            _require_number(f"kind.{name}", getattr(self.kind, name), 1.0 if name.endswith("_mm") else 0.0)

    @property
    def delay(self) -> float:
        """The dead time, and the time for which commands wait at a rate below RATE, on the average, s."""
        return self.dead_time + 0.5 * (1.0 / self.rate - 1.0 / RATE)

    def connect(self, site: LinkSite) -> "CommandLink":
        """Open its link, which sends at its rate; not started."""
        link = self.open(site)
        link.pace(self.rate)
        return link

    @property
    def problem(self) -> OperatorMessage | None:
        """Why its robots cannot play matches by what it declares, or None; see also `fitness.match_problem`."""
        name = self.title or self.name
        if self.silence is None:
            return OperatorMessage("driver_endless", name=name)
        if not 0.0 < self.silence <= LONGEST_SILENCE:
            own, most = f"{1000 * self.silence:.0f}", f"{1000 * LONGEST_SILENCE:.0f}"
            return OperatorMessage("driver_late", name=name, own=own, most=most)
        return None


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _require(name: str, value: object, fits: bool, needed: str) -> None:
    if not fits:
        raise TypeError(f"{name} = {value!r}: {needed} is needed")


def _require_number(name: str, value: float, least: float = 0.0, most: float = MANY) -> None:
    """Raises TypeError, or ValueError for a number out of range."""
    _require(name, value, _is_number(value), "a number")
    if not least <= value <= most:
        raise ValueError(f"{name} = {value}: {least:g} to {most:g} is needed")
