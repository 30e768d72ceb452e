"""Safety: the table of faults and its evaluation.

Every tick the plant reports the health of each robot: age of the picture, age of its pose, battery and so on. `Safety`
evaluates RULES; a response applies at once, and a fault that pauses the match lasts until its condition has been clear
for CALM seconds. Two deadmen back it up: the link sends stop when the game falls silent, and the firmware stops a robot
that receives nothing.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

IN_A_HAND, BEYOND = ("size", "tilted"), "outside"  # why a marker was rejected: see Tracker.rejections
ASTRAY, STUCK = 0.4, 0.329  # s of motion without a command, and at rest despite one; see motion_check
CALM = 0.5  # s for which a condition must be clear before its fault ends


class Response(IntEnum):
    """Response of a rule; of several that apply, the highest holds."""

    WARN = 0  # report only
    INWARD = 1  # it may only drive back into the arena, enforced by virtual_walls
    HALF = 2  # half speed
    STOP = 3  # wheels commanded to stand
    OFF = 4  # motors off


class Health(NamedTuple):
    """Health of one robot; conditions of the whole rig are repeated for each."""

    picture_age: float = 0.0  # s, age of the newest picture
    unseen: float = 0.0  # s since it was seen, if there are newer pictures
    rejection: str = ""  # why a marker with its number was recently rejected: see Tracker.rejections
    duplicate: bool = False  # its marker was seen twice in one picture
    outside: float = 0.0  # s outside the arena
    astray: float = 0.0  # s of motion that no command explains: see motion_check
    stuck: float = 0.0  # s at rest despite a command to move
    leaving: bool = False  # astray and about to leave the arena
    silence: float = 0.0  # s since its last report
    misfit: str = ""  # why it reports but cannot be driven: see radio.protocol.Misfit
    battery: float = 9.9  # V
    battery_low: float = 4.4  # V, limits of its kind: see robot_kinds
    battery_empty: float = 4.0
    undervoltage: bool = False  # its battery was empty; it keeps its motors off until the battery has recovered
    parked: bool = False  # stopped by the button on it
    deadman_seconds: float = 0.0  # s of reports that its deadman stopped it
    unlinked: bool = False  # no radio
    drift: float = 0.0  # mm, drift of the corner markers
    stopped: bool = False  # the all-stop was pressed


@dataclass(frozen=True, eq=False)
class SafetyRule:
    """One row of the table: the response to a condition, for the robot or for everyone."""

    name: str  # text key: faults.NAME
    condition: Callable[[Health], bool]
    response: Response
    everyone: bool = False
    pauses: bool = False
    latched: bool = False  # kept until Safety.clear_fault; meanwhile no robot moves


def _disobeys(health: Health) -> bool:
    """True if motion contradicts the commands; a robot at rest without recent reports may just be switched off."""
    return health.leaving or health.astray > ASTRAY or (health.stuck > STUCK and health.silence < 0.35)


def _empty(health: Health) -> bool:
    """True if the battery is empty, or the robot refuses its motors because it was."""
    return health.battery < health.battery_empty or health.undervoltage


RULES = (
    SafetyRule("stopped", lambda s: s.stopped, Response.STOP, everyone=True, pauses=True),
    SafetyRule("radio", lambda s: s.unlinked, Response.STOP, everyone=True, pauses=True),
    SafetyRule("camera", lambda s: s.picture_age > 0.200, Response.STOP, everyone=True, pauses=True),
    SafetyRule("drift", lambda s: s.drift > 15.0, Response.STOP, everyone=True, pauses=True),
    SafetyRule("twice", lambda s: s.duplicate, Response.STOP, pauses=True),
    SafetyRule("held", lambda s: s.unseen > 1.000 and s.rejection in IN_A_HAND, Response.STOP, pauses=True),
    SafetyRule(
        "lost", lambda s: s.unseen > 1.000 and s.rejection not in (*IN_A_HAND, BEYOND), Response.STOP, pauses=True
    ),
    SafetyRule("disobeys", _disobeys, Response.STOP, pauses=True, latched=True),
    SafetyRule("unseen", lambda s: s.unseen > 0.250, Response.STOP),
    SafetyRule("unseen", lambda s: s.unseen > 0.100, Response.HALF),
    SafetyRule("empty", _empty, Response.OFF, pauses=True),
    SafetyRule("parked", lambda s: s.parked, Response.OFF, pauses=True),
    SafetyRule("old", lambda s: s.misfit == "old", Response.OFF, pauses=True),
    SafetyRule("no_arena", lambda s: s.misfit == "no_arena", Response.OFF, pauses=True),
    SafetyRule("foreign", lambda s: s.misfit == "foreign" and s.silence > 1.0, Response.OFF, pauses=True),
    SafetyRule("key", lambda s: s.misfit == "key" and s.silence > 1.0, Response.OFF, pauses=True),
    SafetyRule("silent", lambda s: s.silence > 1.0 and not s.misfit, Response.OFF, pauses=True),
    SafetyRule("deadman", lambda s: s.deadman_seconds > 0.5, Response.STOP, pauses=True),
    SafetyRule("deadman", lambda s: s.deadman_seconds > 0.0, Response.WARN),
    SafetyRule("outside", lambda s: s.unseen > 1.000 and s.rejection == BEYOND, Response.STOP, pauses=True),
    SafetyRule("outside", lambda s: s.outside > 3.0, Response.INWARD, pauses=True),
    SafetyRule("outside", lambda s: s.outside > 0.0, Response.INWARD),
    SafetyRule("low", lambda s: s.battery < s.battery_low and not _empty(s), Response.WARN),
    SafetyRule("drifts", lambda s: s.drift > 5.0, Response.WARN, everyone=True),
)


REMOTE: Mapping[str, str] = {  # names of the faults of robots whose poses come from a network, by name of the rule
    "camera": "poses",
    "lost": "pose",
    "silent": "pose",
    "unseen": "late",
    "radio": "network",
}


class Fault(NamedTuple):
    """A present fault. Its message is the text faults.NAME, with `robot` counted from 1."""

    name: str  # of its rule, or of REMOTE
    robot: int | None  # None: all robots
    response: Response
    pauses: bool
    since: float  # s


class Safety:
    """Evaluates RULES, and holds the all-stop and latched faults. `remote`: see Rig."""

    def __init__(self, remote: bool = False) -> None:
        self.stopped = False
        self._names = REMOTE if remote else {}
        self.faults: list[Fault] = []  # present faults, worst first, each once
        self._latched: set[tuple[SafetyRule, int]] = set()
        self._bad: dict[tuple[SafetyRule, int | None], tuple[float, float]] = {}  # first and last time, s

    def all_stop(self) -> None:
        """Stop every robot until `release`."""
        self.stopped = True

    def release(self) -> None:
        """End the all-stop."""
        self.stopped = False

    @property
    def latched(self) -> set[int]:
        """Robots with a latched fault."""
        return {robot for _, robot in self._latched}

    def clear_fault(self, robot: int) -> None:
        """Clear the latched faults of a robot after somebody has checked it."""
        self._latched = {key for key in self._latched if key[1] != robot}

    def forget(self, robot: int, last: bool) -> None:
        """Drop all faults of a robot that is no longer real; `last`: no real robot remains."""
        self.clear_fault(robot)
        self._bad = {key: times for key, times in self._bad.items() if key[1] != robot and not last}
        self.faults = [fault for fault in self.faults if fault.robot != robot and not last]

    @property
    def pauses(self) -> bool:
        """True if the match must pause."""
        return any(fault.pauses for fault in self.faults)

    def judge(self, health: Sequence[Health | None], now: float) -> list[Response]:
        """The response for each robot; updates `faults`. None: not a real robot, or not in the match."""
        real = {robot: state._replace(stopped=self.stopped) for robot, state in enumerate(health) if state is not None}
        held = [Response.WARN] * len(health)
        self.faults = []
        for rule in RULES:
            for robot in [None] if rule.everyone else real:
                concerned = list(real) if robot is None else [robot]
                active = any(map(rule.condition, map(real.__getitem__, concerned)))
                if rule.latched and robot is not None:
                    self._latched |= {(rule, robot)} if active else set()
                    active = (rule, robot) in self._latched
                since = self._since(rule, robot, active, now) if active or (rule, robot) in self._bad else None
                if since is None:
                    continue
                for other in real if rule.latched else concerned:
                    held[other] = max(held[other], rule.response)
                name = self._names.get(rule.name, rule.name)
                if (name, robot) not in [(fault.name, fault.robot) for fault in self.faults]:
                    self.faults.append(Fault(name, robot, rule.response, rule.pauses, since))
        self._explain()
        return held

    def _explain(self) -> None:
        """Unlatch faults that another pausing fault explains: the robot continues once that one has ended."""
        for fault in self.faults:
            if fault.pauses and not any(rule.latched for rule in RULES if rule.name == fault.name):
                self._latched = {key for key in self._latched if fault.robot not in (None, key[1])}

    def _since(self, rule: SafetyRule, robot: int | None, active: bool, now: float) -> float | None:
        """Start of a rule's present fault, s, or None. A rule that pauses outlasts its condition by CALM."""
        since, last = self._bad.get((rule, robot), (now, now))
        if active:
            self._bad[rule, robot] = since, now
            return since
        if (rule, robot) in self._bad and rule.pauses and now - last < CALM:
            return since
        self._bad.pop((rule, robot), None)
        return None
