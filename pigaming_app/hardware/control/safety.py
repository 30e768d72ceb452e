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


class Does(IntEnum):
    """What a rule does to a robot; of several that apply, the highest holds."""

    WARN = 0  # nothing but say so
    INWARD = 1  # it may only drive back into the arena: walls.py sees to it
    HALF = 2  # half speed
    STOP = 3  # wheels told to stand
    OFF = 4  # motors off


class Signs(NamedTuple):
    """How things stand with one robot; what concerns all is said to each."""

    picture: float = 0.0  # s, age of the newest picture
    unseen: float = 0.0  # s since it was seen, though there were newer pictures
    refused: str = ""  # why a marker with its number was lately not believed: see Tracker.refused
    doubled: bool = False  # its marker was seen twice at once
    outside: float = 0.0  # s for which it has been outside the arena
    astray: float = 0.0  # s for which it has moved as no command explains: see obedience
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
class Rule:
    """One line of the table: when `sign` is so bad, do this, to the robot or to everyone."""

    name: str  # its text: faults.NAME
    bad: Callable[[Signs], bool]
    does: Does
    everyone: bool = False
    pauses: bool = False
    lasts: bool = False  # until somebody has looked: see Safety.forgive. Meanwhile nobody moves


def _disobeys(signs: Signs) -> bool:
    """Whether a robot does not do as it is told; one that stands and was not heard lately may just be switched off."""
    return signs.leaving or signs.astray > 0.4 or (signs.stuck > 0.4 and signs.silence < 0.35)


RULES = (
    Rule("stopped", lambda s: s.stopped, Does.STOP, everyone=True, pauses=True),
    Rule("radio", lambda s: s.unlinked, Does.STOP, everyone=True, pauses=True),
    Rule("camera", lambda s: s.picture > 0.200, Does.STOP, everyone=True, pauses=True),
    Rule("drift", lambda s: s.drift > 15.0, Does.STOP, everyone=True, pauses=True),
    Rule("twice", lambda s: s.doubled, Does.STOP, pauses=True),
    Rule("held", lambda s: s.unseen > 1.000 and s.refused in IN_A_HAND, Does.STOP, pauses=True),
    Rule("lost", lambda s: s.unseen > 1.000 and s.refused not in (*IN_A_HAND, BEYOND), Does.STOP, pauses=True),
    Rule("disobeys", _disobeys, Does.STOP, pauses=True, lasts=True),
    Rule("unseen", lambda s: s.unseen > 0.250, Does.STOP),
    Rule("unseen", lambda s: s.unseen > 0.100, Does.HALF),
    Rule("empty", lambda s: s.battery < 4.0 or s.refuses, Does.OFF, pauses=True),
    Rule("silent", lambda s: s.silence > 1.0, Does.OFF, pauses=True),
    Rule("deadman", lambda s: s.deaf > 0.5, Does.STOP, pauses=True),
    Rule("deadman", lambda s: s.deaf > 0.0, Does.WARN),
    Rule("outside", lambda s: s.unseen > 1.000 and s.refused == BEYOND, Does.STOP, pauses=True),
    Rule("outside", lambda s: s.outside > 3.0, Does.INWARD, pauses=True),
    Rule("outside", lambda s: s.outside > 0.0, Does.INWARD),
    Rule("low", lambda s: s.battery < 4.4, Does.WARN),
    Rule("drifts", lambda s: s.drift > 5.0, Does.WARN, everyone=True),
)


class Fault(NamedTuple):
    """Something that is wrong now. Its plain reason is the text faults.NAME, with `robot` counted from 1."""

    name: str
    robot: int | None  # None: all of them
    does: Does
    pauses: bool
    since: float  # s


class Safety:
    """Judges signs by RULES, and remembers the all-stop."""

    def __init__(self) -> None:
        self.stopped = False
        self.faults: list[Fault] = []  # what is wrong now, worst first, each once
        self._lasting: set[tuple[Rule, int]] = set()
        self._bad: dict[tuple[Rule, int | None], tuple[float, float]] = {}  # since when, and when last

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

    def judge(self, signs: Sequence[Signs | None], now: float) -> list[Does]:
        """What holds for each robot, and what is wrong in `faults`. None: not a real robot, or not in the match."""
        real = {robot: sign._replace(stopped=self.stopped) for robot, sign in enumerate(signs) if sign is not None}
        held = [Does.WARN] * len(signs)
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

    def _since(self, rule: Rule, robot: int | None, bad: bool, now: float) -> float | None:
        """Since when a rule has been in force; None: it is not. One that pauses outlasts its sign by CALM."""
        since, last = self._bad.get((rule, robot), (now, now))
        if bad:
            self._bad[rule, robot] = since, now
            return since
        if (rule, robot) in self._bad and rule.pauses and now - last < CALM:
            return since
        self._bad.pop((rule, robot), None)
        return None
