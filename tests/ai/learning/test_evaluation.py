"""Incremental evaluation: the result does not depend on the size of the steps."""

import pytest

from pigaming_app.ai.learning.evaluation import HANDMADE, Evaluation
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.learning.training import GAME, contest
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.game import Setup

HARD, IDLE, OWN = BRAINS[GAME]["level5"], BRAINS[GAME]["idle"], BRAINS[GAME][HANDMADE]


def played(evaluation: Evaluation, ticks: int) -> Evaluation:
    while not evaluation.over:
        evaluation.play(ticks)
    return evaluation


@pytest.mark.parametrize("ticks", [7, 10_000])
def test_a_little_at_a_time_comes_to_the_same(ticks: int) -> None:
    evaluation = played(Evaluation(HARD, IDLE, 4, 3, minutes=0.3), ticks)
    assert (evaluation.wins, evaluation.ties, evaluation.losses) == contest(HARD, IDLE, 4, 3, minutes=0.3, fast=False)


def test_whoever_is_better_wins_on_both_sides() -> None:
    evaluation = played(Evaluation(HARD, IDLE, 4, 3, minutes=0.5), 500)
    assert (evaluation.wins, evaluation.share) == (4, 1.0)
    assert played(Evaluation(IDLE, HARD, 4, 3, minutes=0.5), 500).share == 0.0


def test_against_one_like_itself_it_is_a_half() -> None:
    evaluation = played(Evaluation(OWN, OWN, 20, 9, minutes=0.3), 500)
    assert evaluation.share == pytest.approx(0.5, abs=0.25)
    assert played(Evaluation(IDLE, IDLE, 2, 9, minutes=0.05), 500).share == 0.5


def test_after_its_end_nothing_more_is_played() -> None:
    evaluation = played(Evaluation(IDLE, IDLE, 2, 1, minutes=0.02), 50)
    evaluation.play(50)
    assert evaluation.wins + evaluation.ties + evaluation.losses == 2


def test_evaluations_that_share_their_starts_leave_them_as_they_were() -> None:
    unplayed: dict[tuple[Setup, bool], Batch] = {}
    for _ in range(2):
        evaluation = played(Evaluation(HARD, IDLE, 4, 3, minutes=0.3, unplayed=unplayed), 500)
        assert (evaluation.wins, evaluation.ties, evaluation.losses) == contest(
            HARD, IDLE, 4, 3, minutes=0.3, fast=False
        )
    assert [batch.ticks() for batch in unplayed.values()] == [0, 0]
