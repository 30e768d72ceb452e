"""Fleet state of a mat: radio and vision status, pairing, latency. Model only: no drawing."""

import logging
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from pigaming_app.hardware.commissioning.latency import LatencyTest
from pigaming_app.hardware.commissioning.pairing import Pairing, PairingCase, PairingFinding
from pigaming_app.hardware.commissioning.speed_trial import SpeedTrial
from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.radio.packets import DEADMAN, EMPTY, PARKED, RESTARTED
from pigaming_app.hardware.radio.protocol import Misfit
from pigaming_app.hardware.robot_kinds import RobotKind, robot_kind
from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable
from pigaming_app.hardware.session.store import tops_by_radio
from pigaming_app.scenes.flow.timestep import FixedTimestep
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import english

SEEN = 0.5  # s since the last sighting for which a robot counts as seen
LOOKS = 3.0  # s, timeout of the search before robots move
RATE = 1.0  # s, averaging window of the frame rate

log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class RobotStatus:
    """Status of one robot: battery in V (0: not measured), share of reports received (0..1), visible, latency in s if
    measured; its kind, why it cannot be driven, and whether it reports that no commands arrive, that it refuses its
    motors because of its battery, that its button was pressed, or that its watchdog has restarted it.
    """

    battery: float | None
    share: float
    seen: bool
    latency: float | None
    kind: RobotKind
    misfit: Misfit | None
    deaf: bool
    empty: bool
    parked: bool
    restarted: bool
    name: str  # announced by a Wi-Fi robot; empty if it is only its number


@dataclass
class FleetState:
    """Live state of the fleet. `sentence`: why robots are unavailable, or the result of an action."""

    session: RobotSession
    settings: Settings
    rig: Rig | None = None
    link: Any = None
    refusal: OperatorMessage | None = None
    rate: float = 0.0  # frames/s
    findings: list[PairingFinding] = field(default_factory=list)
    latencies: dict[int, float | None] = field(default_factory=dict)  # latency in s, by robot; None: not measurable
    pairing: Pairing | None = None
    shake: LatencyTest | None = None
    drive: SpeedTrial | None = None
    driven: SpeedTrial | None = None  # the one that has ended

    def __post_init__(self) -> None:
        self._timestep = FixedTimestep()
        self._todo: list[int] = []  # robots still to be measured
        self._next_job: Callable[[], bool] | None = None  # job that starts once all robots are seen
        self._searched = 0.0  # s spent searching
        self._counted, self._pictures, self._newest = 0.0, 0, 0.0

    def begin(self) -> None:
        """Open camera and radio, as far as available."""
        self.refusal = None
        try:
            self.rig = self.session.open()
            self.link = self.rig.link
        except RobotsUnavailable as error:
            log.warning("%s", english().long_sentence(error.message))
            self.refusal = error.message
            self.rig, self.link = None, self.session.open_link()

    def end(self) -> None:
        """Stop the robots and release camera and radio."""
        self.stop()
        self.session.close()
        self.rig = self.link = None

    @property
    def busy(self) -> bool:
        """True while robots are being moved."""
        return any((self.pairing, self.shake, self.drive, self._next_job))

    @property
    def looking(self) -> bool:
        """True while busy with fewer robots visible than reporting."""
        robots = range(ROBOTS)
        return self.busy and sum(self._seen(robot) for robot in robots) < sum(self.heard(robot) for robot in robots)

    @property
    def moving(self) -> int | None:
        """Index of the radio whose robot is being moved."""
        if self.pairing is not None:
            return self.pairing.spinning
        return self.shake.robot if self.shake else None

    def stop(self) -> None:
        """Stop all motion."""
        self.pairing, self.shake, self.drive, self._todo, self._next_job = None, None, None, [], None
        if self.rig is not None:
            self.rig.recorder = None
            self.rig.send([None] * ROBOTS)

    def pair(self) -> bool:
        """Search for all robots, then spin one after the other; False if none reports."""
        return self._search(self._pair)

    def measure(self) -> bool:
        """Search for all robots, then measure the latency of each one seen; False if none reports."""
        return self._search(self._measure)

    def try_speeds(self) -> bool:
        """Search for all robots, then drive them all; False if none reports."""
        return self._search(self._start_drive)

    def update(self, seconds: float) -> bool:
        """Advance; True at the moment a job finishes."""
        seconds = self.session.advance(seconds)
        if self.rig is None:
            return False
        self._count(self.rig, seconds)
        self._searched += seconds
        done = False
        if self._next_job is not None and (self._searched > LOOKS or not self.looking):
            begin, self._next_job = self._next_job, None
            done = not begin()
        for _ in range(self._timestep.due(seconds)):
            if self.pairing is not None:
                done = self._pair_on(self.rig, self.pairing) or done
            elif self.shake is not None:
                done = self._shake_on(self.shake) or done
            elif self.drive is not None:
                done = self._drive_on(self.drive) or done
            else:
                self.rig.send([None] * ROBOTS)
        return done

    def heard(self, robot: int) -> bool:
        """True if a robot has reported recently."""
        return self.link is not None and robot in self.link.telemetry and self.link.quality(robot).share > 0.0

    def health(self, robot: int) -> RobotStatus:
        """Status of a robot."""
        report = self.link.telemetry.get(robot) if self.heard(robot) else None
        share = self.link.quality(robot).share if report else 0.0
        board = self.link.boards.get(robot) if self.link is not None else None
        kind = robot_kind(self.settings.kinds[robot], board, self.session.usual)
        misfit = self.link.misfit(robot) if self.link is not None else None
        battery, latency = report.battery if report else None, self.latencies.get(robot)
        flags = report.flags if report else 0
        deaf, parked, restarted = bool(flags & DEADMAN), bool(flags & PARKED), bool(flags & RESTARTED)
        empty = bool(flags & EMPTY) or 0.0 < (battery or 0.0) < kind.stop_mv / 1000
        seen, name = self._seen(robot), self._name(robot)
        return RobotStatus(battery, share, seen, latency, kind, misfit, deaf, empty, parked, restarted, name)

    # ---- inside

    def _seen(self, robot: int) -> bool:
        return self.rig is not None and self.rig.sense()[robot].age < SEEN

    def _name(self, robot: int) -> str:
        """Name that a Wi-Fi robot on a radio channel has announced, unless it is just its number."""
        network = self.session.network
        ours = [found.announced for found in network.robots if found.status == "ours"] if network else []
        name = next((found.name for found in ours if found.address == robot + 1), "")
        return "" if name == f"Robot {robot + 1}" else name

    def _search(self, job: Callable[[], bool]) -> bool:
        if self.rig is None or not any(self.heard(robot) for robot in range(ROBOTS)):
            return False
        self._next_job, self._searched = job, 0.0
        return True

    def _pair(self) -> bool:
        assert self.rig is not None
        self.findings, self.pairing = [], Pairing(self.rig)
        return True

    def _measure(self) -> bool:
        self._todo = [robot for robot in range(ROBOTS) if self.heard(robot) and self._seen(robot)]
        self.latencies = {}
        return self._next()

    def _count(self, rig: Rig, seconds: float) -> None:
        self._counted += seconds
        if rig.tracker.last_captured != self._newest:
            self._newest = rig.tracker.last_captured
            self._pictures += 1
        if self._counted >= RATE:
            self.rate = self._pictures / self._counted
            self._counted, self._pictures = 0.0, 0

    def _pair_on(self, rig: Rig, pairing: Pairing) -> bool:
        if not pairing.tick():
            return False
        self.findings = sorted(pairing.findings)
        rig.channels = pairing.channels
        self.settings.radios = [channel + 1 for channel in pairing.channels]
        self.settings.camera_delay = round(1000.0 * rig.camera_delay)
        self.pairing = None
        return True

    def _shake_on(self, shake: LatencyTest) -> bool:
        if not shake.tick():
            return False
        result = shake.result()
        self.latencies[shake.robot] = result.total if result else None
        return not self._next()

    def _start_drive(self) -> bool:
        robots = [robot for robot in range(ROBOTS) if self.heard(robot) and self._seen(robot)]
        self.driven = None
        self.drive = SpeedTrial(self.rig, robots) if robots and self.rig is not None else None
        return self.drive is not None

    def _drive_on(self, drive: SpeedTrial) -> bool:
        if not drive.tick():
            return False
        self.drive, self.driven = None, drive
        if not drive.held_up:
            self.settings.tops = tops_by_radio(drive.tops_mm, drive.rig.channels, self.settings.tops)
        return True

    def _next(self) -> bool:
        """Measure the next robot; False if none is left."""
        self.shake = LatencyTest(self.rig, self._todo.pop(0)) if self._todo and self.rig is not None else None
        return self.shake is not None


def worst_finding(findings: list[PairingFinding]) -> PairingFinding | None:
    """The most important finding of a pairing: a robot not found, then a swapped one."""
    order = (PairingCase.TWICE, PairingCase.SEVERAL, PairingCase.WIRED, PairingCase.NONE, PairingCase.SWAPPED)
    faults = [finding for case in order for finding in findings if finding.case is case]
    return faults[0] if faults else None
