"""What stops robots: the table of faults, and how each is judged. The table is HARDWARE.md's, as data.

Every tick the plant reports signs: how old the picture is, how long ago each robot was seen, what its battery says.
`Safety` compares them with RULES; what they say is in force at once, and a fault that pauses the match stays until its
sign has been good for CALM seconds. Two deadmen stand behind it: the link sends stop when the game falls silent, and
the firmware stops robots that hear nothing at all.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

IN_A_HAND, BEYOND = ("size", "tilted"), "outside"  # why a marker is not believed to be on a robot on the mat
CALM = 0.5  # s for which a sign must be good before its fault is gone


class Response(IntEnum):
    """What a rule does to a robot; of several that apply, the highest holds."""

    WARN = 0  # nothing but say so
    INWARD = 1  # it may only drive back into the arena: walls.py sees to it
    HALF = 2  # half speed
    STOP = 3  # wheels told to stand
    OFF = 4  # motors off


class Health(NamedTuple):
    """How things stand with one robot; what concerns all is said to each."""

    picture: float = 0.0  # s, age of the newest picture
    unseen: float = 0.0  # s since it was seen, though there were newer pictures
    refused: str = ""  # why a marker with its number was lately not believed: see Tracker.refused
    doubled: bool = False  # its marker was seen twice at once
    outside: float = 0.0  # s for which it has been outside the arena
    astray: float = 0.0  # s for which it has moved as no command explains: see motion_check
    stuck: float = 0.0  # s for which it has stood though it was told to move
    leaving: bool = False  # astray on its way out of the arena
    silence: float = 0.0  # s since it was heard
    battery: float = 9.9  # V
    refuses: bool = False  # its battery was empty, and it keeps its motors off until that has recovered
    deaf: float = 0.0  # s for which it has reported that its deadman stopped it
    unlinked: bool = False  # the radio is gone
    drift: float = 0.0  # mm by which the corner markers have moved
    stopped: bool = False  # somebody pressed the all-stop


@dataclass(frozen=True)
class SafetyRule:
    """One line of the table: when `sign` is so bad, do this, to the robot or to everyone."""

    name: str  # its text: faults.NAME
    bad: Callable[[Health], bool]
    does: Response
    everyone: bool = False
    pauses: bool = False
    lasts: bool = False  # until somebody has looked: see Safety.forgive. Meanwhile nobody moves


def _disobeys(signs: Health) -> bool:
    """Whether a robot does not do as it is told; one that stands and was not heard lately may just be switched off."""
    return signs.leaving or signs.astray > 0.4 or (signs.stuck > 0.4 and signs.silence < 0.35)


RULES = (
    SafetyRule("stopped", lambda s: s.stopped, Response.STOP, everyone=True, pauses=True),
    SafetyRule("radio", lambda s: s.unlinked, Response.STOP, everyone=True, pauses=True),
    SafetyRule("camera", lambda s: s.picture > 0.200, Response.STOP, everyone=True, pauses=True),
    SafetyRule("drift", lambda s: s.drift > 15.0, Response.STOP, everyone=True, pauses=True),
    SafetyRule("twice", lambda s: s.doubled, Response.STOP, pauses=True),
    SafetyRule("held", lambda s: s.unseen > 1.000 and s.refused in IN_A_HAND, Response.STOP, pauses=True),
    SafetyRule(
        "lost", lambda s: s.unseen > 1.000 and s.refused not in (*IN_A_HAND, BEYOND), Response.STOP, pauses=True
    ),
    SafetyRule("disobeys", _disobeys, Response.STOP, pauses=True, lasts=True),
    SafetyRule("unseen", lambda s: s.unseen > 0.250, Response.STOP),
    SafetyRule("unseen", lambda s: s.unseen > 0.100, Response.HALF),
    SafetyRule("empty", lambda s: s.battery < 4.0 or s.refuses, Response.OFF, pauses=True),
    SafetyRule("silent", lambda s: s.silence > 1.0, Response.OFF, pauses=True),
    SafetyRule("deadman", lambda s: s.deaf > 0.5, Response.STOP, pauses=True),
    SafetyRule("deadman", lambda s: s.deaf > 0.0, Response.WARN),
    SafetyRule("outside", lambda s: s.unseen > 1.000 and s.refused == BEYOND, Response.STOP, pauses=True),
    SafetyRule("outside", lambda s: s.outside > 3.0, Response.INWARD, pauses=True),
    SafetyRule("outside", lambda s: s.outside > 0.0, Response.INWARD),
    SafetyRule("low", lambda s: s.battery < 4.4, Response.WARN),
    SafetyRule("drifts", lambda s: s.drift > 5.0, Response.WARN, everyone=True),
)


class Fault(NamedTuple):
    """Something that is wrong now. Its plain reason is the text faults.NAME, with `robot` counted from 1."""

    name: str
    robot: int | None  # None: all of them
    does: Response
    pauses: bool
    since: float  # s


class Safety:
    """Judges signs by RULES, and remembers the all-stop."""

    def __init__(self) -> None:
        self.stopped = False
        self.faults: list[Fault] = []  # what is wrong now, worst first, each once
        self._lasting: set[tuple[SafetyRule, int]] = set()
        self._bad: dict[tuple[SafetyRule, int | None], tuple[float, float]] = {}  # since when, and when last

    def all_stop(self) -> None:
        """Stop every robot until `release`."""
        self.stopped = True

    def release(self) -> None:
        """Somebody has looked and lets the robots go on."""
        self.stopped = False

    @property
    def lasting(self) -> set[int]:
        """The robots that wait until somebody has looked after them."""
        return {robot for _, robot in self._lasting}

    def forgive(self, robot: int) -> None:
        """Somebody has looked after this robot: what it did is past."""
        self._lasting = {key for key in self._lasting if key[1] != robot}

    def forget(self, robot: int, last: bool) -> None:
        """This robot is no real one any more, and so nothing is wrong with it; `last`: there are no others."""
        self.forgive(robot)
        self._bad = {key: times for key, times in self._bad.items() if key[1] != robot and not last}
        self.faults = [fault for fault in self.faults if fault.robot != robot and not last]

    @property
    def pauses(self) -> bool:
        """Whether the match must wait."""
        return any(fault.pauses for fault in self.faults)

    def judge(self, signs: Sequence[Health | None], now: float) -> list[Response]:
        """What holds for each robot, and what is wrong in `faults`. None: not a real robot, or not in the match."""
        real = {robot: sign._replace(stopped=self.stopped) for robot, sign in enumerate(signs) if sign is not None}
        held = [Response.WARN] * len(signs)
        self.faults = []
        for rule in RULES:
            for robot in [None] if rule.everyone else real:
                concerned = list(real) if robot is None else [robot]
                bad = any(rule.bad(real[one]) for one in concerned)
                if rule.lasts and robot is not None:
                    self._lasting |= {(rule, robot)} if bad else set()
                    bad = (rule, robot) in self._lasting
                since = self._since(rule, robot, bad, now)
                if since is None:
                    continue
                for one in real if rule.lasts else concerned:
                    held[one] = max(held[one], rule.does)
                if (rule.name, robot) not in [(fault.name, fault.robot) for fault in self.faults]:
                    self.faults.append(Fault(rule.name, robot, rule.does, rule.pauses, since))
        self._explain()
        return held

    def _explain(self) -> None:
        """What a robot did is explained by another fault that pauses: it goes on by itself once that is gone."""
        for fault in self.faults:
            if fault.pauses and not any(rule.lasts for rule in RULES if rule.name == fault.name):
                self._lasting = {key for key in self._lasting if fault.robot not in (None, key[1])}

    def _since(self, rule: SafetyRule, robot: int | None, bad: bool, now: float) -> float | None:
        """Since when a rule has been in force; None: it is not. One that pauses outlasts its sign by CALM."""
        since, last = self._bad.get((rule, robot), (now, now))
        if bad:
            self._bad[rule, robot] = since, now
            return since
        if (rule, robot) in self._bad and rule.pauses and now - last < CALM:
            return since
        self._bad.pop((rule, robot), None)
        return None
