"""Ratings for the screen: the user's file comes first, a damaged one is named in one line, shipped ones are whole."""

import json

import pytest

from pigaming_app import ASSETS
from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import BRAINS
from pigaming_app.events.league_files import file_name, ratings_of
from pigaming_app.games.registry import OURS


def league(**changes):
    standings = [{"brain": "level2", "rating": -50.0, "rating95": [-80, -20.5], "wins": 1}]
    standings.append({"brain": "level5", "rating": 50.0, "rating95": [20.5, 80], "wins": 9})
    return {"game": "race", "variant": "party", "matches": 200, "standings": standings, "seed": 1} | changes


@pytest.mark.parametrize("game", OURS)
def test_the_shipped_ratings_name_all_levels(game):
    ratings, problems = ratings_of(game, [ASSETS / "brains"])
    assert ratings
    assert problems == []
    assert {*LEVELS} <= {one.brain for one in ratings.strengths} <= {*BRAINS[game]}


def test_the_best_stands_first_and_the_first_folder_counts(tmp_path):
    for folder, matches in (("own", 40), ("shipped", 200)):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / file_name("race")).write_text(json.dumps(league(matches=matches)), encoding="utf-8")
    folders = [tmp_path / "none", tmp_path / "own", tmp_path / "shipped"]
    ratings, problems = ratings_of("race", folders)
    assert ratings
    assert (ratings.matches, [one.brain for one in ratings.strengths]) == (40, ["level5", "level2"])
    assert ratings.strengths[1].low == -80.0
    (tmp_path / "own" / file_name("race")).write_bytes(b'{"game": ')
    ratings, problems = ratings_of("race", folders)
    assert ratings
    assert ratings.matches == 200
    assert len(problems) == 1
    assert "\n" not in problems[0]
    assert ratings_of("factory", folders) == (None, [])


WRONG = [
    [],
    league(game="pitanks"),
    league(variant="chess"),
    league(matches=0),
    league(matches=True),
    league(standings=[]),
    league(standings=league()["standings"][:1] * 2),
    *(
        league(standings=[league()["standings"][0], {"brain": "level5", "rating": 50.0, "rating95": [20, 80]} | wrong])
        for wrong in (
            {"rating": "50"},
            {"rating": None},
            {"rating": True},
            {"rating": float("nan")},
            {"rating": 1e9, "rating95": [0, 1e9]},
            {"rating": 90.0},
            {"rating95": [20]},
            {"brain": "a\nb"},
            {"brain": "x" * 99},
        )
    ),
]


@pytest.mark.parametrize("content", WRONG)
def test_what_is_no_league_of_the_game_is_refused(tmp_path, content):
    (tmp_path / file_name("race")).write_text(json.dumps(content), encoding="utf-8")
    ratings, problems = ratings_of("race", [tmp_path])
    assert ratings is None
    assert len(problems) == 1
