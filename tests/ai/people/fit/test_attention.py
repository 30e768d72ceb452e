"""Lapses of people who are drawn here, tick by tick, and of whom half of the decisions do not show."""

import numpy as np
import pytest

from pigaming_app.ai.people.fit.attention import PACE, Pauses, attention_of, chances, decision_hazard, pauses_of
from pigaming_app.ai.people.fit.inputs import key_inputs
from pigaming_app.ai.people.fit.wishes import ASKED, Watched

MINUTE = 3000  # ticks


def played(period, odds, length, minutes, seed):
    """Somebody with two keys, whom all, some or no models ask for the other one, and FIRE, which follows a wish."""
    draw, ticks = np.random.default_rng(seed), int(minutes * MINUTE)
    asked = draw.choice(9, ticks // 40 + 1, p=[0.45, *[0.05] * 7, 0.2])
    fires = draw.random(ticks // 40 + 1) < 0.5
    actions, wishes = np.zeros((ticks, 5)), np.zeros((ticks, len(ASKED), 3))
    chance = draw.random((ticks, 5))
    key, fire, wait, away = 0.0, 0.0, 0, 0
    for tick in range(ticks):
        share, wished = asked[tick // 40], float(fires[tick // 40])
        wishes[tick, :, 0], wishes[tick, :share, 0], wishes[tick, :, 2] = key, 1.0 - key, wished
        if away:
            away -= 1
        else:
            if chance[tick, 0] < odds:
                away = 1 + int(2.0 * length * chance[tick, 1])
            wait -= 1
            if wait <= 0:
                wait = 1 + int(period * (0.7 + 0.6 * chance[tick, 2]))
                if chance[tick, 3] < share / 8.0:
                    key = 1.0 - key
            if wished != fire and chance[tick, 4] < 0.1:
                fire = wished
        actions[tick, 0], actions[tick, 2] = key, fire
    return Watched(actions, np.zeros((ticks, 2)), wishes, np.full((ticks, len(ASKED), 2), np.nan), 3.0, None)


@pytest.mark.parametrize(("period", "odds", "length"), [(12.0, 0.002, 30.0), (20.0, 0.001, 70.0)])
def test_lapses_are_found_though_most_decisions_do_not_show(period: float, odds: float, length: float) -> None:
    play = played(period, odds, length, 20.0, 1)
    assert len(key_inputs(play).decisions) < 0.6 * len(play.actions) / period
    found, errors = attention_of(pauses_of([play], [key_inputs(play)], False), period)
    assert found[0] == pytest.approx(np.log(odds), abs=3.0 * errors[0])
    assert found[1] == pytest.approx(np.log(length), abs=3.0 * errors[1])
    assert errors[1] < 0.1
    assert 1.0 / np.sqrt(odds * len(play.actions)) < errors[0] < 0.2  # no better than if every lapse were seen


def test_chances_of_pauses_are_those_of_pauses_that_are_drawn() -> None:
    period, odds, reach, shows, people, longest = 14.0, 0.004, 61.0, 0.6, 20000, 240
    draw = np.random.default_rng(2)

    def waits() -> np.ndarray:
        return np.asarray(1 + (period * draw.uniform(0.7, 1.3, people)).astype(int))

    wait, away, shown = waits(), np.zeros(people, int), np.full(people, longest + 1)
    leaves = draw.random(people) < odds  # in the tick of the decision with which the pause begins
    for tick in range(1, longest + 1):
        away = np.where(leaves, 1 + (reach * draw.random(people)).astype(int), away)
        here = away == 0
        away = np.maximum(away - 1, 0)
        wait = wait - here
        due = here & (wait <= 0)
        wait = np.where(due, waits(), wait)
        shown = np.where(due & (draw.random(people) < shows), np.minimum(shown, tick), shown)
        leaves = here & (draw.random(people) < odds)
    steps = longest // PACE
    length = PACE * np.arange(steps, 0, -1)
    ticks = np.zeros(longest + 1)
    pauses = Pauses(np.zeros(steps, int), length, np.full(steps, True), ticks, ticks > 0.0, ticks)
    found = chances(pauses, np.full(longest + 1, shows), decision_hazard(period), PACE * odds, reach / PACE)[::-1]
    drawn = np.bincount((shown + PACE - 1) // PACE, minlength=steps + 2)[1 : steps + 1] / people
    assert np.cumsum(found) == pytest.approx(np.cumsum(drawn), abs=0.015)
    pauses = Pauses(np.zeros(steps, int), length, np.full(steps, False), ticks, ticks > 0.0, ticks)
    still = chances(pauses, np.full(longest + 1, shows), decision_hazard(period), PACE * odds, reach / PACE)[::-1]
    assert still == pytest.approx(1.0 - np.cumsum(found), abs=0.01)


def test_who_presses_fire_attends() -> None:
    """The same long pause is a lapse to nobody who has pressed FIRE all through it."""
    ticks, hazard = np.zeros(121), decision_hazard(14.0)
    pause = np.array([0]), np.array([120]), np.array([True]), ticks
    silent = Pauses(*pause, ticks > 0.0, ticks + 0.05)
    fired = Pauses(*pause, np.arange(121) % 20 == 10, ticks + 0.05)
    often, never = (
        [chances(one, np.full(121, 0.9), hazard, odds, 60.0)[0] for one in (silent, fired)] for odds in (0.004, 1e-9)
    )
    assert often[0] > 100.0 * never[0]
    assert often[1] < 2.0 * never[1]
