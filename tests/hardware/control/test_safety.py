"""The table of faults, row by row."""

import pytest

from pigaming_app.hardware.control.safety import CALM, RULES, Health, Response, Safety
from pigaming_app.ui.i18n import LANGUAGES, Words

GOOD = Health(picture_age=0.09, battery=5.0)


def judged(sign, others=GOOD, now=1.0):
    """Responses for robot 0 and the others if only robot 0 has this condition, and the names of the faults."""
    safety = Safety()
    held = safety.judge([sign, others, others, None], now)
    assert held[3] == Response.WARN
    return held[0], held[1], [(fault.name, fault.robot, fault.pauses) for fault in safety.faults]


@pytest.mark.parametrize(
    ("sign", "own", "others", "faults"),
    [
        (GOOD, Response.WARN, Response.WARN, []),
        (GOOD._replace(picture_age=0.199), Response.WARN, Response.WARN, []),
        (GOOD._replace(picture_age=0.201), Response.STOP, Response.STOP, [("camera", None, True)]),
        (GOOD._replace(unseen=0.099), Response.WARN, Response.WARN, []),
        (GOOD._replace(unseen=0.101), Response.HALF, Response.WARN, [("unseen", 0, False)]),
        (GOOD._replace(unseen=0.251), Response.STOP, Response.WARN, [("unseen", 0, False)]),
        (GOOD._replace(unseen=1.001), Response.STOP, Response.WARN, [("lost", 0, True), ("unseen", 0, False)]),
        (
            GOOD._replace(unseen=1.001, rejection="size"),
            Response.STOP,
            Response.WARN,
            [("held", 0, True), ("unseen", 0, False)],
        ),
        (
            GOOD._replace(unseen=1.001, rejection="outside"),
            Response.STOP,
            Response.WARN,
            [("unseen", 0, False), ("outside", 0, True)],
        ),
        (GOOD._replace(duplicate=True), Response.STOP, Response.WARN, [("twice", 0, True)]),
        (GOOD._replace(outside=0.02), Response.INWARD, Response.WARN, [("outside", 0, False)]),
        (GOOD._replace(outside=3.1), Response.INWARD, Response.WARN, [("outside", 0, True)]),
        (GOOD._replace(parked=True), Response.OFF, Response.WARN, [("parked", 0, True)]),
        (GOOD._replace(silence=1.01), Response.OFF, Response.WARN, [("silent", 0, True)]),
        (GOOD._replace(misfit="old", silence=0.5), Response.OFF, Response.WARN, [("old", 0, True)]),
        (GOOD._replace(misfit="no_arena", silence=2.0), Response.OFF, Response.WARN, [("no_arena", 0, True)]),
        (GOOD._replace(misfit="foreign", silence=2.0), Response.OFF, Response.WARN, [("foreign", 0, True)]),
        (GOOD._replace(misfit="foreign", silence=0.1), Response.WARN, Response.WARN, []),  # ours reports too
        (GOOD._replace(battery=3.4, battery_low=3.3, battery_empty=3.0), Response.WARN, Response.WARN, []),
        (GOOD._replace(battery=4.41), Response.WARN, Response.WARN, []),
        (GOOD._replace(battery=4.39), Response.WARN, Response.WARN, [("low", 0, False)]),
        (GOOD._replace(battery=3.99), Response.OFF, Response.WARN, [("empty", 0, True)]),
        (
            GOOD._replace(battery=4.2, undervoltage=True),
            Response.OFF,
            Response.WARN,
            [("empty", 0, True)],
        ),
        (GOOD._replace(deadman_seconds=0.001), Response.WARN, Response.WARN, [("deadman", 0, False)]),
        (GOOD._replace(deadman_seconds=0.6), Response.STOP, Response.WARN, [("deadman", 0, True)]),
        (GOOD._replace(unlinked=True), Response.STOP, Response.STOP, [("radio", None, True)]),
        (GOOD._replace(drift=5.1), Response.WARN, Response.WARN, [("drifts", None, False)]),
        (GOOD._replace(drift=15.1), Response.STOP, Response.STOP, [("drift", None, True), ("drifts", None, False)]),
    ],
)
def test_every_line_of_the_table(sign, own, others, faults):
    assert judged(sign) == (own, others, faults)


def test_of_two_faults_the_stricter_holds_and_both_are_said():
    own, _, faults = judged(GOOD._replace(unseen=0.15, battery=3.9))
    assert own == Response.OFF
    assert [name for name, _, _ in faults] == ["unseen", "empty"]


def test_a_match_goes_on_only_when_the_fault_has_been_gone_for_a_moment():
    safety = Safety()
    safety.judge([GOOD._replace(picture_age=0.5)] * 4, 10.0)
    assert safety.pauses
    assert safety.faults[0].since == 10.0
    assert safety.judge([GOOD] * 4, 10.1)[0] == Response.STOP
    assert safety.pauses
    safety.judge([GOOD] * 4, 10.0 + CALM + 0.01)
    assert not safety.pauses
    assert safety.faults == []


def test_a_fault_that_comes_back_starts_its_moment_anew():
    safety = Safety()
    safety.judge([GOOD._replace(duplicate=True)], 10.0)
    safety.judge([GOOD], 10.4)
    safety.judge([GOOD._replace(duplicate=True)], 10.45)
    safety.judge([GOOD], 10.8)
    assert safety.pauses
    assert safety.faults[0].since == 10.0


def test_coasting_ends_at_once_when_the_robot_is_seen_again():
    safety = Safety()
    assert safety.judge([GOOD._replace(unseen=0.2)], 1.0) == [Response.HALF]
    assert safety.judge([GOOD], 1.02) == [Response.WARN]


def test_the_all_stop_holds_everybody_until_it_is_released():
    safety = Safety()
    safety.all_stop()
    for now in (1.0, 2.0, 60.0):
        assert safety.judge([GOOD, GOOD], now) == [Response.STOP, Response.STOP]
        assert [fault.name for fault in safety.faults] == ["stopped"]
    safety.release()
    safety.judge([GOOD, GOOD], 60.0 + CALM + 0.01)
    assert safety.faults == []


def test_nothing_is_asked_of_a_simulated_robot():
    safety = Safety()
    safety.all_stop()
    assert safety.judge([None, None], 1.0) == [Response.WARN, Response.WARN]


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_fault_has_a_plain_reason(language):
    words = Words(language)
    for name in {rule.name for rule in RULES}:
        assert len(words(f"faults.{name}", robot=1, button="F1")) > 15


def test_a_robot_that_is_no_real_one_any_more_takes_its_faults_along():
    safety = Safety()
    safety.judge([Health(unseen=2.0), Health(battery=3.0), None, None], 0.0)
    assert {fault.name for fault in safety.faults if fault.pauses} == {"lost", "empty"}
    safety.forget(0, last=False)
    assert {fault.name for fault in safety.faults if fault.pauses} == {"empty"}
    safety.judge([None, Health(), None, None], 0.1)
    assert {fault.robot for fault in safety.faults} == {1}
    safety.forget(1, last=True)
    safety.judge([None] * 4, 0.2)
    assert not safety.pauses
