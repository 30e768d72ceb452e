"""A match: seats, ticks, final standings and winners."""

from itertools import pairwise

import pytest

from pigaming_app.games.match import IdlePlayer, Match
from pigaming_app.sim.record import digest
from tests.matches import Stick, finished, match_of, run, setup_of


def setup(teams=(0, 1, 2, 3), brains=("random",) * 4):
    return setup_of("pitanks", brains, minutes=0.1, variant="plain", teams=teams)


def with_scores(scores, teams=(0, 1, 2, 3), brains=("random",) * 4):
    match = Match(setup(teams, brains))
    for robot, score in zip(match.state.robots, scores, strict=True):
        robot.score = score
    return match.outcome()


def test_a_seat_is_handed_over_in_the_middle_of_a_match():
    match = Match(setup())
    match.sit(0, Stick(1.0))
    run(match, 25)
    x = match.state.robots[0].x
    assert x > 150.0
    match.sit(0, Stick(-1.0))
    run(match, 50)
    assert match.state.robots[0].x < x - 100.0
    match.sit(0, IdlePlayer())
    run(match, 40)
    assert abs(match.state.robots[0].linear) < 1.0


def test_handing_over_to_the_like_changes_nothing():
    one, other = Match(setup()), Match(setup())
    one.sit(2, Stick(0.5, 0.5))
    for tick in range(100):
        if tick % 7 == 0:
            other.sit(2, Stick(0.5, 0.5))
        one.tick()
        other.tick()
    assert digest(one.state) == digest(other.state)


def test_a_match_of_six_seconds_takes_three_hundred_ticks():
    match = Match(setup())
    played = 0
    while not match.over:
        match.tick()
        played += 1
    assert played == 300
    assert match.seconds == pytest.approx(6.0)
    assert match.seconds_left == pytest.approx(0.0)
    assert match.outcome().seconds == pytest.approx(6.0)


def test_the_best_score_comes_first_and_wins():
    outcome = with_scores([1, 4, -5, 0])
    assert [(row.seat, row.place, row.score) for row in outcome.rows] == [(1, 1, 4), (0, 2, 1), (3, 3, 0), (2, 4, -5)]
    assert outcome.winners == (1,)


def test_equal_scores_share_a_place_and_the_next_is_left_out():
    outcome = with_scores([2, -2, 2, -2])
    assert [(row.seat, row.place) for row in outcome.rows] == [(0, 1), (2, 1), (1, 3), (3, 3)]
    assert outcome.winners == ()


def test_a_tie_behind_the_winner_does_not_affect_the_win():
    outcome = with_scores([-2, 4, -2, 0])
    assert outcome.winners == (1,)
    assert [row.place for row in outcome.rows] == [1, 2, 3, 3]


def test_a_team_adds_up_and_wins_together():
    outcome = with_scores([5, -3, -1, -1], teams=(0, 1, 0, 1))
    assert outcome.winners == (0, 2)
    assert [(row.seat, row.team, row.place) for row in outcome.rows] == [(0, 0, 1), (2, 0, 1), (3, 1, 3), (1, 1, 3)]


def test_one_against_three():
    outcome = with_scores([2, 1, 1, 1], teams=(0, 1, 1, 1))
    assert outcome.winners == (1, 2, 3)
    assert outcome.rows[-1].seat == 0
    assert outcome.rows[-1].place == 4


def test_an_empty_seat_is_in_no_table():
    outcome = with_scores([1, 0, -1, 9], brains=("random", "random", "random", "off"))
    assert [row.seat for row in outcome.rows] == [0, 1, 2]
    assert outcome.winners == (0,)


def test_the_table_counts_what_the_game_counts():
    match = Match(setup())
    tank = match.state.tanks[1]
    tank.hits, tank.taken, tank.shots, tank.landed = 3, 2, 8, 2
    facts = {row.seat: dict(row.stats) for row in match.outcome().rows}
    assert facts[1] == {"hits": 3, "taken": 2, "aim": 0.25}
    assert facts[0] == {"hits": 0, "taken": 0, "aim": 0.0}
    assert tuple(facts[0]) == match.game.columns


def test_the_series_tells_every_change_and_ends_at_the_score():
    match = finished(match_of("pitanks", ["hand3"] * 4, minutes=0.5, variant="plain"))
    outcome = match.outcome()
    for seat, line in enumerate(outcome.series):
        times, scores = zip(*line, strict=True)
        assert (times[0], scores[0]) == (0.0, 0)
        assert list(times) == sorted(times)
        assert all(a != b for a, b in pairwise(scores))
        assert scores[-1] == match.state.robots[seat].score
    assert any(len(line) > 1 for line in outcome.series)
