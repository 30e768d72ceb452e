"""Matches that count for high scores, and their contests."""

from dataclasses import replace

import pytest

from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.results.high_scores import (
    contest,
    contests,
    counts,
    format_score,
    high_score_tables,
)
from pigaming_app.storage.scores import Scores

FREE, PAIRS = (0, 1, 2, 3), (0, 1, 0, 1)


def match(brains, teams=FREE, game="pitanks", minutes=2.0, goal=0, variant=None):
    one, two, three, four = (Seat(brain, team) for brain, team in zip(brains.split(), teams, strict=True))
    rules = games()[game]
    return Setup(game, "classic", (one, two, three, four), minutes, 1, variant or rules.default.name, goal)


@pytest.mark.parametrize(
    ("brains", "teams", "counted"),
    [
        ("human level3 off off", FREE, True),
        ("human human off off", FREE, True),
        ("human level5 q2 q1", FREE, True),
        ("human level3 level4 level5", FREE, True),
        ("human level2 off off", FREE, False),
        ("human q2 human level3", FREE, True),
        ("human level1 off off", FREE, False),
        ("human level5 level5 level1", FREE, False),
        ("human human human random", FREE, False),
        ("human idle off off", FREE, False),
        ("human classic off off", FREE, False),
        ("human MY-OWN off off", FREE, False),
        ("human off off off", FREE, False),
        ("human level3 level1 level3", PAIRS, True),  # the easy AI is a team mate
        ("human level3 level3 level1", PAIRS, False),
        ("human off human off", PAIRS, False),  # no opponents
    ],
)
def test_a_match_counts_against_people_and_opponents_no_weaker_than_normal(brains, teams, counted):
    assert counts(match(brains, teams), 0) is counted


@pytest.mark.parametrize("game", games())
def test_of_the_ais_of_a_game_only_the_weak_ones_do_not_count(game):
    weak = {"idle", "random", "level1", "level2", "hand1", "fsm", "classic"}
    counting = {brain for brain in BRAINS[game] if counts(match(f"human {brain} off off", game=game), 0)}
    assert set(BRAINS[game]) - counting == weak & set(BRAINS[game])


@pytest.mark.parametrize(
    ("brains", "teams", "people", "side"),
    [
        ("human level3 off off", FREE, 1, 0),
        ("human human human human", FREE, 4, 0),
        ("human level3 level3 level3", PAIRS, 1, 1),
        ("human human level3 level3", PAIRS, 2, 1),
        ("human level3 human level3", PAIRS, 2, 2),
        ("human human human level3", PAIRS, 3, 2),
        ("human human human human", PAIRS, 4, 2),
        ("human human off off", PAIRS, 2, 0),
    ],
)
def test_people_are_counted_and_those_of_the_own_team(brains, teams, people, side):
    table = contest(match(brains, teams), 0)
    assert (table.people, table.side) == (people, side)


def test_the_two_sides_of_a_match_may_stand_in_different_tables():
    setup = match("human human human level3", PAIRS)
    assert contest(setup, 0).side == 2
    assert contest(setup, 1).side == 1


def test_minutes_count_where_a_match_is_played_for_time_and_the_goal_where_it_is_played_for_one():
    assert contest(match("human level3 off off", minutes=0.5)).length == 0.5
    assert contest(match("human level3 off off", game="race", minutes=10.0, goal=5)).length == 5
    assert contest(match("human level3 off off", game="factory", minutes=3.0, goal=4)).length == 4


def test_a_race_has_a_table_of_laps_and_one_of_whole_races():
    first, second = high_score_tables(contest(match("human level3 off off", game="race", goal=3)))
    assert [(board.table.achievement, board.table.timed, board.days) for board in (first, second)] == [
        ("lap", True, None),
        ("race", True, None),
    ]
    assert format_score(61_230, first.table) == "1:01.23"


def test_unknown_games_and_rules_in_a_file_are_not_shown():
    scores, good = Scores(), contest(match("human level3 off off"))
    points = replace(good, achievement="points")
    for table in (
        points,
        replace(points, game="chess"),
        replace(points, achievement="goals"),
        replace(points, timed=True),
        replace(points, rules="none"),
        replace(points, people=7),
        replace(points, side=2),
    ):
        scores.add(table, "ABC", 5)
    assert contests(scores) == [good]
