"""Statistics of made-up play whose answer is known; the regression against one that leaves out people one by one."""

import numpy as np
import pytest

from pigaming_app.ai.people.fit import fire
from pigaming_app.ai.people.fit.calibration import PENALTIES, preferring, ridge
from pigaming_app.ai.people.fit.differences import REACTIONS, nearest
from pigaming_app.ai.people.fit.wishes import ASKED, Watched


def pressed_after(lag, ticks=2000, every=100, held=20):
    """Somebody whose FIRE follows that of all models after `lag` ticks."""
    wished = (np.arange(ticks) % every < held).astype(float)
    actions, wishes = np.zeros((ticks, 5)), np.zeros((ticks, len(ASKED), 3))
    actions[lag:, 2], wishes[:, :, 2] = wished[: ticks - lag], wished[:, None]
    return Watched(actions, np.zeros((ticks, 2)), wishes, np.full((ticks, len(ASKED), 2), np.nan), 3.0, None)


@pytest.mark.parametrize("lag", [1, 6, 15])
def test_fire_that_follows_a_wish_is_late_by_the_time_between(lag: int) -> None:
    found = fire.edges([pressed_after(lag)])
    assert found["down_mean"] == pytest.approx(np.log(lag + 0.5))
    assert found["up_0.5"] == pytest.approx(np.log(lag + 0.5))
    assert found["down_spread"] == pytest.approx(0.0)


def test_fire_that_no_model_wished_counts_apart() -> None:
    play = pressed_after(6)
    play.wishes[:, :, 2] = 0.0
    assert fire.edges([play])["down_near"] == 0.0


@pytest.mark.parametrize("i", range(len(REACTIONS)))
def test_the_reaction_with_the_least_differences_is_the_nearest(i: int) -> None:
    draw = np.random.default_rng(i)
    sizes = 0.1 + 0.05 * np.abs(np.arange(len(REACTIONS)) - i)
    found = dict(nearest(sizes * draw.choice([-1.0, 1.0], (400, 1)) + 0.02 * draw.normal(size=(400, len(REACTIONS)))))
    assert found["nearest100"] == pytest.approx(np.log(ASKED[REACTIONS[i]].reaction), abs=0.12)


def test_a_regression_predicts_each_value_from_all_others() -> None:
    draw = np.random.default_rng(3)
    rows = draw.normal(size=(40, 60))  # more statistics than people
    values = np.stack([rows[:, 0] + 0.1 * draw.normal(size=40), draw.normal(size=40)], axis=1)
    weights, others = ridge(rows, values)

    def solved(kept: np.ndarray, penalty: float, column: int) -> np.ndarray:
        some = rows[kept]
        return np.asarray(np.linalg.solve(some.T @ some + penalty * np.eye(60), some.T @ values[kept, column]))

    for column in (0, 1):
        by_penalty = []
        for penalty in PENALTIES:
            left_out = [rows[i] @ solved(np.arange(40) != i, penalty, column) for i in range(40)]
            by_penalty.append(np.array(left_out))
        errors = [np.square(one - values[:, column]).sum() for one in by_penalty]
        best = int(np.argmin(errors))
        assert others[:, column] == pytest.approx(by_penalty[best])
        assert weights[:, column] == pytest.approx(solved(np.full(40, True), PENALTIES[best], column))


def test_of_few_people_a_statistic_that_tells_all_is_preferred() -> None:
    """The value is one of a hundred statistics, with little noise; forty people are told by the weights of sixty."""
    draw = np.random.default_rng(5)
    rows = draw.normal(size=(100, 100))
    values = rows[:, :1] + 0.05 * draw.normal(size=(100, 1))
    errors = [rows[60:] @ solve(rows[:60], values[:60])[0] - values[60:] for solve in (ridge, preferring)]
    equal, better = (float(np.std(error)) for error in errors)
    assert better < 0.1
    assert equal > 0.4
