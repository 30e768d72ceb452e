"""A conformance run finds each broken promise in robots with a fault; the arcade's own drivers keep them all."""

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from examples.lines.driver import DRIVER, Emulated
from pigaming_app.hardware.drivers import fitness
from pigaming_app.hardware.drivers.conformance import Conformance
from pigaming_app.hardware.drivers.driver import LONGEST_SILENCE, LinkSite, RobotDriver
from pigaming_app.hardware.drivers.ours import OURS
from pigaming_app.hardware.proof.stands import stand_of
from pigaming_app.hardware.robot_kinds import DEFAULT
from pigaming_app.hardware.signals import WheelCommand


class Endless(Emulated):
    """Robots without a deadman."""

    def advance(self, seconds: float) -> None:
        self._driven = [self._now] * self.robots
        super().advance(seconds)


class Sluggish(Emulated):
    """A deadman of 350 ms."""

    def advance(self, seconds: float) -> None:
        self._driven = [max(time, min(self._now - 0.05, time + 0.15)) for time in self._driven]
        super().advance(seconds)


class Slow(Emulated):
    """Lines under way for 80 ms."""

    def write(self, data: bytes) -> int:
        self._lines.extend((self._now + 0.08, line) for line in data.split(b"\n") if line)
        return len(data)


class Weak(Emulated):
    """A wheel of half the speed."""

    def speeds(self, robot: int) -> WheelCommand:
        left, right = super().speeds(robot)
        return WheelCommand(0.5 * left if robot == 2 else left, right)


class Reversed(Emulated):
    """Wheels that turn the other way."""

    def speeds(self, robot: int) -> WheelCommand:
        left, right = super().speeds(robot)
        return WheelCommand(-left, -right)


class Mute(Emulated):
    """A robot that never reports."""

    def advance(self, seconds: float) -> None:
        self._due[3] = float("inf")
        super().advance(seconds)


class Nervous(Emulated):
    """A deadman of 25 ms: a lost line stops the robot."""

    def advance(self, seconds: float) -> None:
        super().advance(seconds)
        for robot in range(self.robots):
            if self._now - self._driven[robot] >= 0.025:
                self._shares[robot] = WheelCommand(0.0, 0.0)


class Restless(Emulated):
    """A robot that drives on after its restart."""

    def switch(self, robot: int, on: bool) -> None:
        super().switch(robot, on)
        if on:
            self._driven[robot], self._shares[robot] = self._now, WheelCommand(0.6, 0.6)


class Lost(Emulated):
    """A robot that obeys nobody after its restart."""

    def switch(self, robot: int, on: bool) -> None:
        self._on[robot] = False


class Open(Emulated):
    """Robots that obey everybody."""

    def interfere(self, wheels: WheelCommand) -> bool:
        self._lines.extend((self._now, b"%d 600 -600" % robot) for robot in range(1, 5))
        return True


class Jammed(Emulated):
    """Another arcade stops the robots."""

    def interfere(self, wheels: WheelCommand) -> bool:
        self._lines.extend((self._now, b"%d 0 0" % robot) for robot in range(1, 5))
        return True


def broken(driver: RobotDriver, stand: Callable[[int], Emulated]) -> set[str]:
    found = [*Conformance(driver, stand(1)).run()]
    return {finding.promise for finding in found if finding.holds is False}


def test_the_example_keeps_its_promises() -> None:
    found = [*Conformance(DRIVER, Emulated(1)).run()]
    assert {finding.promise: finding.holds for finding in found} == {
        **dict.fromkeys([finding.promise for finding in found], True),
        "two arcades": None,
    }
    assert len(found) == 9


@pytest.mark.parametrize(
    ("stand", "promises"),
    [
        (Endless, {"silence"}),
        (Sluggish, {"silence"}),
        (Slow, {"dead time", "stop", "silence"}),  # 280 ms, not the declared 220
        (Weak, {"steps"}),
        (Reversed, {"steps"}),
        (Mute, {"reports"}),
        (Nervous, {"loss of 30 %"}),
        (Restless, {"restart"}),
        (Lost, {"restart"}),
        (Open, {"two arcades"}),
        (Jammed, {"two arcades"}),
    ],
)
def test_each_fault_breaks_its_promise_and_no_other(stand: Callable[[int], Emulated], promises: set[str]) -> None:
    assert broken(DRIVER, stand) == promises


def test_what_does_not_stop_by_itself_in_time_plays_no_match() -> None:
    assert DRIVER.problem is None
    assert replace(DRIVER, silence=LONGEST_SILENCE).problem is None
    for late in (None, LONGEST_SILENCE + 0.001, float("inf"), float("nan"), 0.0, -1.0):
        assert replace(DRIVER, silence=late).problem is not None
    assert {name for name, driver in OURS.items() if driver.problem} == {"stock"}


class Idle(Emulated):
    """Robots that report, and never drive."""

    def speeds(self, robot: int) -> WheelCommand:
        return WheelCommand(0.0, 0.0)

    def powered(self, robot: int) -> bool:
        return False


class Broken(Emulated):
    """Its code fails."""

    def advance(self, seconds: float) -> None:
        raise ZeroDivisionError


class Timeless(Emulated):
    """Its time stands still, so that no check of it ends."""

    def advance(self, seconds: float) -> None:
        pass


@pytest.mark.parametrize(
    ("stand", "key"),
    [
        (Emulated, ""),
        (Weak, ""),
        (Open, ""),
        (Endless, "driver_untrue"),
        (Sluggish, "driver_untrue"),
        (Mute, "driver_untrue"),
        (Idle, "driver_untrue"),
        (Broken, "driver_untrue"),
        (Timeless, "driver_untrue"),
        (None, "driver_unproven"),
    ],
)
def test_a_plug_in_plays_matches_if_its_emulated_robots_stop(
    monkeypatch: pytest.MonkeyPatch, stand: Callable[[int], Emulated] | None, key: str
) -> None:
    """Whether they do all else as declared is left to `robots check`."""
    if stand is Timeless:
        monkeypatch.setattr(fitness, "LIMIT", 0.3)
    problem = fitness.match_problem(replace(DRIVER, stand=stand))
    assert (problem.key if problem else "") == key


def test_a_driver_of_ours_needs_no_trial() -> None:
    assert [name for name, driver in OURS.items() if fitness.match_problem(driver)] == ["stock"]
    assert fitness.match_problem(replace(OURS["api2"])) is not None, "a copy is a plug-in's"


class Counted(Emulated):
    """Counts what is written to its line."""

    written = 0

    def write(self, data: bytes) -> int:
        self.written += 1
        return super().write(data)


@pytest.mark.parametrize("rate", [10.0, 25.0, 50.0])
def test_a_link_sends_as_often_as_its_driver_declares(rate: float) -> None:
    stand, seconds = Counted(1), 5
    driver = replace(DRIVER, rate=rate)
    link = driver.connect(LinkSite(1, stand.clock, "emulated", open_port=lambda baud: lambda: stand))
    for _ in range(500 * seconds):
        link.send([WheelCommand(0.6, 0.6)] * 4)
        link.pump()
        stand.advance(0.002)
    assert stand.written == pytest.approx(rate * seconds, abs=2)
    assert driver.delay == pytest.approx(DRIVER.dead_time + (1.0 / rate - 0.02) / 2.0)


class Lazy(Emulated):
    """A link that sends ten times a second, whatever it is asked for."""

    def __init__(self, seed: int) -> None:
        super().__init__(seed)
        self.link.pace(10.0)
        self.link.pace = lambda rate: None  # type: ignore[method-assign]


def test_a_lower_rate_is_no_fault_but_one_that_is_not_kept() -> None:
    assert broken(replace(DRIVER, rate=25.0), Emulated) == set()
    assert {"dead time", "stop"} <= broken(DRIVER, Lazy)


SIXTY: Any = "60"
NONE: Any = None


@pytest.mark.parametrize(
    ("wrong", "line"),
    [
        ({"silence": "0.2"}, "silence = '0.2': a number, or None, is needed"),
        ({"silence": True}, "silence = True: a number, or None, is needed"),
        ({"dead_time": "x"}, "dead_time = 'x': a number is needed"),
        ({"dead_time": float("nan")}, "dead_time = nan: 0 to 10 is needed"),
        ({"dead_time": -0.01}, "dead_time = -0.01: 0 to 10 is needed"),
        ({"rate": 51.0}, "rate = 51.0: 1 to 50 is needed"),
        ({"rate": "50"}, "rate = '50': a number is needed"),
        ({"marker_mm": 101}, "marker_mm = 101: -100 to 100 is needed"),
        ({"stand": 7}, "stand = 7: a function of a seed, or None, is needed"),
        ({"open": "connect"}, "open = 'connect': a function of a LinkSite is needed"),
        ({"title": None}, "title = None: a str is needed"),
        ({"serial": 1}, "serial = 1: a bool is needed"),
        ({"kind": "3pi"}, "kind = '3pi': a RobotKind is needed"),
        ({"kind": DEFAULT._replace(radius_mm=SIXTY)}, "kind.radius_mm = '60': a number is needed"),
        ({"kind": DEFAULT._replace(radius_mm=0.0)}, "kind.radius_mm = 0.0: 1 to 100000 is needed"),
        ({"kind": DEFAULT._replace(warn_mv=NONE)}, "kind.warn_mv = None: a number is needed"),
    ],
)
def test_a_field_of_a_wrong_type_is_named(wrong: dict[str, Any], line: str) -> None:
    with pytest.raises((TypeError, ValueError), match=f"^{re.escape(line)}$"):
        replace(DRIVER, **wrong)


@pytest.mark.parametrize(
    "name", ["api2", *(pytest.param(one, marks=pytest.mark.long) for one in ("api1", "transparent"))]
)
def test_xbees_keep_every_promise(name: str) -> None:
    require_all(name)


@pytest.mark.long
@pytest.mark.again  # minutes; their stops are in test_microbit.py, test_boards.py, test_wifi.py
@pytest.mark.usefixtures("micropython")
@pytest.mark.parametrize("name", ["relay", "udp"])
def test_boards_keep_every_promise(name: str) -> None:
    require_all(name)


def require_all(name: str) -> None:
    stand = stand_of(OURS[name], 2)
    assert stand is not None
    try:
        found = [*Conformance(OURS[name], stand).run()]
    finally:
        stand.close()
    assert [finding for finding in found if not finding.holds] == []
    assert len(found) == 9
