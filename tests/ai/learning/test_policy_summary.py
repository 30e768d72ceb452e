"""Policy summaries of tables filled by hand."""

import pytest

from pigaming_app.ai.learning.policy_summary import ACTION_NAMES, direction
from pigaming_app.ai.qlearning.features import NONE, state
from pigaming_app.ai.qlearning.table import ACTIONS, MOVES, QTable
from pigaming_app.sim.record import packed

COLD = 1.0 / 50.0
SHOOT = next(k for k, move in enumerate(MOVES) if move == (0.0, 0.0, 1))
LEFT = next(k for k, move in enumerate(MOVES) if move == (0.0, -1.0, 0))


def filled(*entries: tuple[int, int, int, int, float]) -> QTable:
    """A table from entries (opponent's sector, wall's sector, move, visits, Q)."""
    table = QTable()
    for opponent, wall, move, often, q in entries:
        k = state(opponent, wall, NONE) * ACTIONS + move
        table.n[k], table.q[k] = often, q
    return table


def test_a_direction_never_seen_has_no_plan() -> None:
    found = direction(filled((3, NONE, SHOOT, 5, 1.0)), 4, COLD)
    assert (found.seen, found.action) == (0, "unknown")


def test_it_does_what_it_found_best_and_worth_is_weighed_by_how_often_a_state_was_seen() -> None:
    table = filled((0, NONE, SHOOT, 30, 20.0), (0, 5, LEFT, 10, 4.0))
    found = direction(table, 0, COLD)
    assert found.seen == 40
    assert found.value == pytest.approx(0.75 * 20.0 + 0.25 * 4.0)
    assert found.shares[SHOOT] == pytest.approx(0.75)
    assert found.action == "shoot"


def test_what_was_never_tried_is_done_rather_than_what_went_wrong() -> None:
    found = direction(filled((8, NONE, SHOOT, 1, -1.0)), 8, COLD)
    assert found.value == -1.0, "what was never tried says nothing about how good it is there"
    assert found.shares[SHOOT] < 1e-9
    assert found.shares[LEFT] == pytest.approx(1.0 / (ACTIONS - 1))
    assert found.action == "unknown", "half of all moves shoot: that is chance, no plan"


def test_both_bodies_of_a_table_have_the_same_plan() -> None:
    import numpy as np

    table = filled((0, NONE, SHOOT, 30, 20.0), (0, 5, LEFT, 10, 4.0))
    fast = packed([table]).view(np.recarray)[0]
    assert direction(fast, 0, COLD) == direction(table, 0, COLD)


def test_every_move_has_a_word() -> None:
    assert len(ACTION_NAMES) == ACTIONS
    assert ACTION_NAMES.count("shoot") == 9
    assert {ACTION_NAMES.count(word) for word in ("ahead", "behind", "stay")} == {1}
