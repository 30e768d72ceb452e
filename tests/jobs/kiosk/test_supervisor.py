"""Supervision by a simulated clock: restarts, delays between them, hangs, and what ends it."""

import signal

from pigaming_app.jobs.kiosk.supervisor import Limits, RunEnd, Supervisor

LIMITS = Limits()


class Clock:
    def __init__(self) -> None:
        self.now, self.slept, self.interrupt_at = 0.0, list[float](), float("inf")

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self.now += seconds
        if self.now >= self.interrupt_at:
            raise KeyboardInterrupt


class Arcade:
    """Beats from `first` to `last` s after its start, and ends with `code` at `end` s."""

    def __init__(self, clock: Clock, code: int, end: float, first: float = 0.5, last: float = float("inf")) -> None:
        self.clock, self.code, self.began = clock, code, clock.now
        self.over, self.first, self.last = end, first, last
        self.calls: list[str] = []

    @property
    def beats(self) -> int:
        return max(0, int(60 * (min(self.clock.now - self.began, self.last) - self.first)))

    def poll(self) -> int | None:
        return self.code if self.clock.now - self.began >= self.over else None

    def end(self) -> None:
        self.calls.append("end")

    def kill(self) -> None:
        self.calls.append("kill")

    def close(self) -> None:
        self.calls.append("close")


def supervised(*plan: tuple[int, *tuple[float, ...]], interrupt_at: float = float("inf")):
    """Run a plan: the arguments of each arcade after the clock. Returns code, clock, arcades and endings."""
    clock = Clock()
    clock.interrupt_at = interrupt_at
    arcades: list[Arcade] = []
    endings: list[RunEnd] = []

    def start() -> Arcade:
        arcades.append(Arcade(clock, *plan[len(arcades)]))
        return arcades[-1]

    code = Supervisor(start, lambda _, ending: endings.append(ending), LIMITS, clock=clock, sleep=clock.sleep).run()
    assert all(arcade.calls[-1:] == ["close"] for arcade in arcades)
    return code, clock, arcades, endings


def test_an_arcade_closed_by_the_operator_is_not_started_again() -> None:
    code, _, arcades, endings = supervised((0, 20.0))
    assert (code, len(arcades), endings) == (0, 1, [])


def test_one_that_crashed_is_started_again_at_once() -> None:
    code, clock, arcades, endings = supervised((-signal.SIGSEGV, 20.0), (0, 10.0))
    assert (code, len(arcades)) == (0, 2)
    assert [(ending.reason, ending.detail) for ending in endings] == [("crash", "ended by SIGSEGV")]
    assert endings[0].seconds == 20.0
    assert clock.now == 30.0


def test_the_delays_grow_over_twenty_crashes_in_a_row_and_stay_bounded() -> None:
    _, clock, arcades, endings = supervised(*[(1, 1.0)] * 20, (0, 1.0))
    assert (len(arcades), len(endings)) == (21, 20)
    delays = [seconds for seconds in clock.slept if seconds != LIMITS.poll]
    assert delays == [0.0, 1.0, 2.0, 4.0, 8.0, 16.0, *[30.0] * 14]


def test_a_crash_after_a_long_run_is_the_first_in_a_row_again() -> None:
    _, clock, _, _ = supervised(*[(1, 1.0)] * 4, (1, LIMITS.stable), (1, 1.0), (0, 1.0))
    assert [seconds for seconds in clock.slept if seconds != LIMITS.poll] == [0.0, 1.0, 2.0, 4.0, 0.0, 1.0]


def test_a_hang_is_noticed_after_five_seconds_and_killed() -> None:
    code, clock, arcades, (ending,) = supervised((0, 1e9, 0.5, 10.0), (0, 1.0))
    assert code == 0
    assert arcades[0].calls == ["kill", "close"]
    assert (ending.reason, ending.code) == ("hang", None)
    assert 15.0 < ending.seconds < 16.0
    assert clock.now < 17.1


def test_the_first_frame_may_take_longer() -> None:
    _, _, _, (ending,) = supervised((0, 1e9, 1e9), (0, 50.0, 40.0))
    assert ending.reason == "hang"
    assert LIMITS.start < ending.seconds < LIMITS.start + 1.0


def test_a_suspended_machine_is_no_hang() -> None:
    clock = Clock()
    arcade = Arcade(clock, 0, 902.5, last=2.0)
    naps = iter([*[LIMITS.poll] * 8, 900.0])  # neither of the two ran for 900 s
    supervisor = Supervisor(
        lambda: arcade, lambda *_: None, LIMITS, clock=clock, sleep=lambda s: clock.sleep(next(naps, s))
    )
    assert supervisor.run() == 0
    assert arcade.calls == ["close"]


def test_one_that_cannot_start_is_not_tried_again_but_one_that_once_could_is() -> None:
    assert supervised((2, 1.0, 9.0))[0] == 2
    code, _, arcades, endings = supervised((1, 20.0), (2, 0.3), (0, 20.0))
    assert (code, len(arcades), len(endings)) == (0, 3, 2)


def test_ctrl_c_ends_both_also_between_two_starts() -> None:
    code, _, (arcade,), endings = supervised((0, 1e9), interrupt_at=7.0)
    assert (code, arcade.calls, endings) == (0, ["end", "close"], [])
    code, _, arcades, _ = supervised(*[(1, 1.0)] * 9, interrupt_at=8.5)
    assert (code, [arcade.calls for arcade in arcades]) == (0, [["close"]] * 4)


def test_a_report_that_fails_does_not_prevent_the_restart() -> None:
    clock = Clock()
    arcades = iter([Arcade(clock, 1, 1.0), Arcade(clock, 0, 9.0)])

    def full(*_: object) -> None:
        raise OSError("the disk is full")

    assert Supervisor(lambda: next(arcades), full, LIMITS, clock=clock, sleep=clock.sleep).run() == 0


def test_an_interruption_while_it_is_started_again_is_the_operators_end() -> None:
    clock = Clock()
    crashed = Arcade(clock, 1, 1.0)
    starts = iter((crashed,))

    def start() -> Arcade:
        for arcade in starts:
            return arcade
        raise KeyboardInterrupt

    assert Supervisor(start, lambda *_: None, LIMITS, clock=clock, sleep=clock.sleep).run() == 0
    assert crashed.calls == ["close"]
