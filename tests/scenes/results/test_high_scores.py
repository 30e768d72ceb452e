"""High scores: matches that count, their contests, the table that is shown first, and the way to the others."""

from dataclasses import replace

import pytest

from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.registry import games
from pigaming_app.scenes.results.high_scores import (
    HighScores,
    conditions,
    contest,
    contests,
    counts,
    format_score,
    high_score_tables,
)
from pigaming_app.storage.scores import Scores, ScoreTable
from pigaming_app.ui.draw import text_width
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.events import Button
from tests.matches import setup_of
from tests.scenes.arcade import Arcade
from tests.scenes.measuring import lit_boxes

ALONE = ScoreTable("pitanks", "classic", "points", rules="pickups", length=2, people=1)
PAIR = replace(ALONE, people=2)
ISLANDS = replace(ALONE, arena="islands")
LAP = ScoreTable("race", "classic", "lap", True, "standard", 3, 1)
THREE = replace(PAIR, people=3)


def opened(arcade: Arcade, at: ScoreTable, *filled: ScoreTable) -> HighScores:
    for table in filled:
        arcade.context.scores.add(table, "ABC", 9_000)
    best = arcade.open(HighScores(arcade.context, replace(at, achievement="", timed=False)))
    arcade.wait(HighScores.lockout + 0.1, draw=True)
    return best


def shown(best: HighScores, *tables: ScoreTable) -> bool:
    return best.contest in {replace(table, achievement="", timed=False) for table in tables}


def test_it_opens_at_the_table_of_the_match_that_was_played(arcade: Arcade) -> None:
    assert shown(opened(arcade, PAIR, ALONE, PAIR), PAIR)


@pytest.mark.parametrize(
    ("filled", "found"),
    [((), PAIR), ((LAP,), LAP), ((LAP, ISLANDS), ISLANDS), ((LAP, ISLANDS, ALONE), ALONE), ((LAP, THREE), THREE)],
)
def test_an_empty_table_gives_way_to_the_nearest_one_with_rows(
    arcade: Arcade, filled: tuple[ScoreTable], found: ScoreTable
) -> None:
    assert shown(opened(arcade, PAIR, *filled), found)


def test_left_and_right_lead_round_the_tables_of_an_arena_and_up_and_down_round_the_arenas(arcade: Arcade) -> None:
    best = opened(arcade, ALONE, ALONE, PAIR, THREE, ISLANDS, LAP)
    for button, table in (
        (Button.RIGHT, PAIR),
        (Button.RIGHT, THREE),
        (Button.RIGHT, ALONE),
        (Button.LEFT, THREE),
        (Button.DOWN, ISLANDS),
        (Button.DOWN, LAP),
        (Button.LEFT, LAP),
        (Button.DOWN, ALONE),
        (Button.UP, LAP),
    ):
        arcade.press(button)
        arcade.frame(draw=True)
        assert shown(best, table), button
    assert arcade.stack.top is best


def test_every_table_with_rows_can_be_reached(arcade: Arcade) -> None:
    tables = [replace(ALONE, length=minutes, people=people) for minutes in (1, 2, 5) for people in (1, 2, 3, 4)]
    best = opened(arcade, ALONE, *tables, ISLANDS, LAP)
    seen = set()
    for _ in range(3):
        for _ in tables:
            seen.add(best.contest)
            arcade.press(Button.RIGHT)
        arcade.press(Button.DOWN)
    assert seen == set(contests(arcade.context.scores))


def test_a_click_on_an_arrow_goes_its_way_and_a_click_elsewhere_leads_on(arcade: Arcade) -> None:
    best = opened(arcade, ALONE, ALONE, PAIR, ISLANDS)
    assert set(best.arrows) == {Button.LEFT, Button.RIGHT, Button.UP, Button.DOWN}
    arcade.click(*best.arrows[Button.RIGHT])
    assert shown(best, PAIR)
    arcade.click(*best.arrows[Button.DOWN])
    assert shown(best, ISLANDS)
    arcade.click(960, 600)
    assert arcade.stack.top is not best


def test_it_leaves_when_nobody_presses_any_more(arcade: Arcade) -> None:
    best = opened(arcade, ALONE, ALONE, PAIR)
    arcade.wait(HighScores.idle - 2.0)
    arcade.press(Button.RIGHT)
    arcade.wait(HighScores.idle - 1.0)
    assert arcade.stack.top is best
    arcade.wait(2.0)
    assert arcade.stack.top is not best


def test_an_arena_that_has_gone_is_not_shown(arcade: Arcade) -> None:
    gone = replace(ALONE, arena="../../etc\n")
    assert shown(opened(arcade, ALONE, gone, PAIR), PAIR)
    assert shown(opened(arcade, gone), PAIR)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_heading_fits_and_nothing_runs_over_the_edge(arcade: Arcade, language: str) -> None:
    words = Words(language)
    tables = [
        replace(table, rules=rules, length=length, people=people, side=side)
        for table, length, variants in ((ALONE, 5, ("pickups", "plain", "classic")), (LAP, 9, ("standard",)))
        for rules in variants
        for people in range(1, 5)
        for side in range(people + 1)
    ]
    for table in [*tables, THREE, ScoreTable("race", "classic", "race", True, "standard", 9)]:
        assert text_width(conditions(words, table), 52, "head") < 1500, "between the arrows"
    best = opened(arcade, tables[0], *tables)
    for _ in tables[:8]:
        arcade.press(Button.RIGHT)
        arcade.wait(1.0, fps=10, draw=True)
        assert not [box for box in lit_boxes(arcade.screen) if box.left < 20 or box.right > 1900]
    assert arcade.stack.top is best


FREE, PAIRS = (0, 1, 2, 3), (0, 1, 0, 1)


def match(brains, teams=FREE, game="pitanks", minutes=2.0, goal=0):
    return setup_of(game, brains, "classic", minutes, goal=goal, teams=teams)


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
