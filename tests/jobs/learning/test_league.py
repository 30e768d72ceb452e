"""The job `league` prints tables that fit a terminal and agree with each other, or one JSON object."""

import json
import re

import pytest

from pigaming_app.ai.learning.league import Duel, League, LeagueRow, wilson
from pigaming_app.ai.learning.ratings import Rating
from pigaming_app.events.league_files import ratings_of
from pigaming_app.jobs.cli import main
from pigaming_app.jobs.learning.league import table

NAMES = ["level1", "level3", "level5", "classic", "q1", "q2", "fsm", "random", "idle"]


def run(words: str) -> int:
    return main(["league", *words.split()])


def made_up(brains: list[str], matches: int) -> League:
    """A league in which the first AI of each pair wins all its matches."""

    def duel(left: str, right: str) -> Duel:
        return Duel("pitanks", left, right, matches, matches, 0, 0, wilson(matches, matches), 3.0, -3.0, 1.0, 1.0)

    def standing(i: int, brain: str) -> LeagueRow:
        wins = (len(brains) - 1 - i) * matches
        interval = wilson(wins, (len(brains) - 1) * matches)
        return LeagueRow(brain, Rating(900.4 - i, 100.4, 1800.4), wins, 0, i * matches, interval, -12.25)

    duels = tuple(duel(a, b) for i, a in enumerate(brains) for b in brains[i + 1 :])
    standings = tuple(standing(i, brain) for i, brain in enumerate(brains))
    return League("pitanks", "classic", 2.0, "pickups", matches, 1, standings, duels, 1.0)


@pytest.mark.parametrize("count", [2, 5, 9])
@pytest.mark.parametrize("matches", [1, 100, 100_000])
def test_tables_are_not_wider_than_a_hundred_columns(count, matches):
    lines = list(table(made_up(NAMES[:count], matches)))
    assert max(len(line.rstrip()) for line in lines) <= 100
    cells = [cell for line in lines for cell in re.findall(r"\S+/\S+/\S+", line) if cell[0].isdigit()]
    assert len(cells) == count * (count - 1), "every pair from both sides"


def test_a_cell_says_how_the_row_fared_against_the_column():
    lines = list(table(made_up(["level5", "idle"], 100)))
    head = next(i for i, line in enumerate(lines) if line.split() == ["level5", "idle"])
    assert [line.split() for line in lines[head + 1 : head + 5]] == [
        ["level5", "-", "100/0/0"],
        ["[96,", "100]"],
        ["idle", "0/0/100", "-"],
        ["[0,", "4]"],
    ]


def test_a_league_prints_the_best_first(capsys):
    assert run("pitanks idle random level5 --matches 2 --minutes 0.4 --variant plain") == 0
    out = capsys.readouterr().out
    assert re.search(r"^  1 level5 +\+\d+ \[[+-]\d+, \+\d+\]", out, re.MULTILINE)
    assert "a tie is half a win" in out
    assert not any(line.endswith(" ") for line in out.splitlines())


def test_json_is_one_object_and_nothing_else(capsys):
    assert run("race idle level1 level5 --matches 2 --minutes 0.3 --arena kidney --seed 4 --json") == 0
    captured = capsys.readouterr()
    found = json.loads(captured.out)
    assert captured.err == ""
    assert (found["game"], found["arena"], found["matches"], found["seed"]) == ("race", "kidney", 2, 4)
    assert [row["brain"] for row in found["standings"]] == ["level5", "level1", "idle"]
    best = found["standings"][0]
    assert best["rating95"][0] < best["rating"] < best["rating95"][1]
    assert len(found["duels"]) == 3
    assert all(duel["wins"] + duel["ties"] + duel["losses"] == 2 for duel in found["duels"])


@pytest.mark.parametrize(
    "words",
    [
        "",
        "chess a b",
        "pitanks",
        "pitanks fsm",
        "pitanks fsm fsm",
        "pitanks fsm wizard",
        "pitanks fsm human",
        "pitanks fsm level1 --matches 0",
        "pitanks fsm level1 --matches many",
        "pitanks fsm level1 --seed x",
        "pitanks fsm level1 --minutes -1",
        "pitanks fsm level1 --arena nowhere",
        "pitanks fsm level1 --variant odd",
        "pitanks fsm level1 --laps 3",
        "race level1 level5 --pallets 2",
        "race level1 level5 --laps 99",
        "race level1 level5 --loud",
    ],
)
def test_wrong_words_are_one_line_and_exit_code_2(words, refused):
    refused("league", *words.split())


def test_a_league_is_written_for_the_page_of_strengths(tmp_path, capsys, refused):
    path = tmp_path / "league_pitanks.json"
    assert run(f"pitanks idle random --matches 2 --minutes 0.05 --out {path}") == 0
    assert "rating" in capsys.readouterr().out, "the tables are still printed"
    ratings, problems = ratings_of("pitanks", [tmp_path])
    assert ratings
    assert problems == []
    assert {one.brain for one in ratings.strengths} == {"idle", "random"}
    refused("league", "pitanks", "idle", "random", "--out", str(tmp_path))
