"""What can be known about the robots of a mat: who is heard and seen, who is who, how late it is. No drawing."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from pigaming_app.hardware.commissioning.latency import Shake
from pigaming_app.hardware.commissioning.pairing import Case, Finding, Pairing
from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.session.real import Mat, NoMat
from pigaming_app.scenes.flow.timestep import FixedTimestep
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.settings import Settings

SEEN = 0.5  # s within which a robot has been seen if it is seen
LOOKS = 3.0  # s for which robots that are heard are looked for before they move, at most
RATE = 1.0  # s over which pictures are counted


@dataclass(frozen=True)
class RobotHealth:
    """One robot: V, share of its reports that arrive (0..1), whether it is seen, s of latency if measured."""

    battery: float | None
    share: float
    seen: bool
    latency: float | None


@dataclass
class FleetState:
    """A look at the robots. `sentence`: why they cannot be used, or what has come of something."""

    mat: Mat
    settings: Settings
    rig: Rig | None = None
    link: Any = None
    refusal: str | None = None
    rate: float = 0.0  # pictures a second
    findings: list[Finding] = field(default_factory=list)
    late: dict[int, float | None] = field(default_factory=dict)  # s, by robot; None: it could not be measured
    pairing: Pairing | None = None
    shake: Shake | None = None

    def __post_init__(self) -> None:
        self._pace = FixedTimestep()
        self._todo: list[int] = []  # robots to be shaken
        self._next_job: Callable[[], bool] | None = None  # what begins once all robots are seen
        self._looked = 0.0  # s for which they have been looked for
        self._counted, self._pictures, self._newest = 0.0, 0, 0.0

    def begin(self) -> None:
        """Open everything, or as much as there is."""
        self.refusal = None
        try:
            self.rig = self.mat.open()
            self.link = self.rig.link
        except NoMat as trouble:
            self.refusal = trouble.args[0]
            self.rig, self.link = None, self.mat.listen()

    def end(self) -> None:
        """Stop the robots and let go."""
        self.stop()
        self.mat.close()
        self.rig = self.link = None

    @property
    def busy(self) -> bool:
        """Whether robots are being moved."""
        return self.pairing is not None or self.shake is not None or self._next_job is not None

    @property
    def looking(self) -> bool:
        """Whether robots are about to move, or do, and fewer are seen than are heard."""
        robots = range(ROBOTS)
        return self.busy and sum(self._seen(one) for one in robots) < sum(self.heard(one) for one in robots)

    @property
    def moving(self) -> int | None:
        """Which radio's robot is being moved, from 0."""
        if self.pairing is not None:
            return self.pairing.spinning
        return self.shake.robot if self.shake else None

    def stop(self) -> None:
        """Stop what moves."""
        self.pairing, self.shake, self._todo, self._next_job = None, None, [], None
        if self.rig is not None:
            self.rig.recorder = None
            self.rig.tell([None] * ROBOTS)

    def pair(self) -> bool:
        """Look for all robots, then spin one after the other; false: none is heard."""
        return self._search(self._pair)

    def measure(self) -> bool:
        """Look for all robots, then shake those that are seen, one after the other; false: none is heard."""
        return self._search(self._measure)

    def update(self, seconds: float) -> bool:
        """Let time pass; true at the moment in which something is done."""
        seconds = self.mat.advance(seconds)
        if self.rig is None:
            return False
        self._count(self.rig, seconds)
        self._looked += seconds
        done = False
        if self._next_job is not None and (self._looked > LOOKS or not self.looking):
            begin, self._next_job = self._next_job, None
            done = not begin()
        for _ in range(self._pace.due(seconds)):
            if self.pairing is not None:
                done = self._pair_on(self.rig, self.pairing) or done
            elif self.shake is not None:
                done = self._shake_on(self.shake) or done
            else:
                self.rig.tell([None] * ROBOTS)
        return done

    def heard(self, robot: int) -> bool:
        """Whether a robot has said something lately."""
        return self.link is not None and robot in self.link.telemetry and self.link.quality(robot).share > 0.0

    def health(self, robot: int) -> RobotHealth:
        """How a robot is."""
        report = self.link.telemetry.get(robot) if self.heard(robot) else None
        share = self.link.quality(robot).share if report else 0.0
        return RobotHealth(report.battery if report else None, share, self._seen(robot), self.late.get(robot))

    # ---- inside

    def _seen(self, robot: int) -> bool:
        return self.rig is not None and self.rig.sense()[robot].age < SEEN

    def _search(self, job: Callable[[], bool]) -> bool:
        if self.rig is None or not any(self.heard(robot) for robot in range(ROBOTS)):
            return False
        self._next_job, self._looked = job, 0.0
        return True

    def _pair(self) -> bool:
        assert self.rig is not None
        self.findings, self.pairing = [], Pairing(self.rig)
        return True

    def _measure(self) -> bool:
        self._todo = [robot for robot in range(ROBOTS) if self.heard(robot) and self._seen(robot)]
        self.late = {}
        return self._next()

    def _count(self, rig: Rig, seconds: float) -> None:
        self._counted += seconds
        if rig.tracker.looked != self._newest:
            self._newest = rig.tracker.looked
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
        self.pairing = None
        return True

    def _shake_on(self, shake: Shake) -> bool:
        if not shake.tick():
            return False
        found = shake.result()
        self.late[shake.robot] = found.total if found else None
        return not self._next()

    def _next(self) -> bool:
        """Shake the next robot; false: there is none left."""
        self.shake = Shake(self.rig, self._todo.pop(0)) if self._todo and self.rig is not None else None
        return self.shake is not None


def worst(findings: list[Finding]) -> Finding | None:
    """What most needs to be said of a pairing: a robot that was not found, then one that was swapped."""
    order = (Case.TWICE, Case.SEVERAL, Case.WIRED, Case.NONE, Case.SWAPPED)
    told = [finding for case in order for finding in findings if finding.case is case]
    return told[0] if told else None
