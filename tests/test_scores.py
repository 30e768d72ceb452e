"""High scores: who is in the table, for how long, and what a broken file costs."""

from datetime import UTC, datetime, timedelta

import pytest

from pigaming_app.keeping import NotSaved
from pigaming_app.scores import DAYS, FILE, LENGTH, Scores

NOON = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
DAY = timedelta(days=1)


def points(scores, days=None, now=NOON):
    return [row.score for row in scores.best("pitanks", "classic", days, now)]


def filled(*scores, when=NOON):
    table = Scores()
    for score in scores:
        table.add("pitanks", "classic", "ABC", score, when)
    return table


def test_the_best_come_first_and_the_earlier_of_equals():
    scores = filled(3, 9, -2)
    scores.add("pitanks", "classic", "OLD", 9, NOON - DAY)
    assert [(row.initials, row.score) for row in scores.best("pitanks", "classic")] == [
        ("OLD", 9),
        ("ABC", 9),
        ("ABC", 3),
        ("ABC", -2),
    ]


def test_every_game_and_arena_has_a_table_of_its_own():
    scores = filled(5)
    assert scores.best("pitanks", "islands") == []
    assert scores.best("race", "classic") == []


def test_a_table_has_ten_rows():
    assert points(filled(*range(30))) == list(range(29, 29 - LENGTH, -1))


def test_of_times_the_shortest_comes_first_and_the_file_says_that_they_are_times(tmp_path):
    scores = Scores()
    for name, ms in (("SLO", 12_340), ("FST", 9_870), ("MID", 9_871)):
        scores.add("race", "classic lap", name, ms, NOON, timed=True)
    scores.save(tmp_path)
    kept, said = Scores.load(tmp_path)
    assert not said
    assert [(row.initials, row.score, row.timed) for row in kept.best("race", "classic lap")] == [
        ("FST", 9_870, True),
        ("MID", 9_871, True),
        ("SLO", 12_340, True),
    ]
    assert kept.place("race", "classic lap", 9_870, timed=True) == 2, "behind its equal"
    assert kept.place("race", "classic lap", 20_000, timed=True) == 4


def test_a_lap_in_no_time_is_no_lap(tmp_path):
    (tmp_path / FILE).write_text(
        '[race]\n"classic lap" = [{initials = "ABC", ms = 0, when = 2026-11-21T12:00:00Z},'
        ' {initials = "ABC", ms = 9000, when = 2026-11-21T12:00:00Z}]\n'
    )
    kept, said = Scores.load(tmp_path)
    assert [row.score for row in kept.best("race", "classic lap")] == [9000]
    assert len(said) == 1


def test_todays_table_begins_empty_and_yesterdays_stars_stay_in_that_of_all_time():
    scores = filled(*range(100, 100 + LENGTH), when=NOON - DAY)
    scores.add("pitanks", "classic", "NEW", 1, NOON)
    assert points(scores, days=1) == [1]
    assert 1 not in points(scores)
    assert points(scores, days=2)[:2] == [109, 108]
    assert points(scores, days=1, now=NOON + DAY) == []


def test_a_year_of_evenings_stays_a_short_file():
    scores = Scores()
    for day in range(365):
        for score in range(30):
            scores.add("pitanks", "classic", "ABC", score, NOON + day * DAY)
    assert sum(map(len, scores._tables.values())) <= (DAYS + 1) * LENGTH


def test_the_place_of_a_new_score_is_behind_its_equals():
    scores = filled(9, 5, 5, 1)
    assert [scores.place("pitanks", "classic", score, now=NOON) for score in (10, 9, 5, 0)] == [1, 2, 4, 5]
    full = filled(*[5] * LENGTH)
    assert full.place("pitanks", "classic", 5, now=NOON) is None
    assert full.place("pitanks", "classic", 6, now=NOON) == 1
    assert full.place("pitanks", "classic", 0, days=1, now=NOON + DAY) == 1


@pytest.mark.parametrize("initials", ["", "AB", "ABCD", "abc", "A C", "ÁBC", "A1B"])
def test_initials_are_three_capitals(initials):
    with pytest.raises(ValueError, match="three of A to Z"):
        Scores().add("pitanks", "classic", initials, 1)


def test_what_is_saved_comes_back(tmp_path):
    scores = filled(3, 9)
    scores.add("pitanks", "two words", "XYZ", 1, NOON)
    scores.save(tmp_path)
    again, said = Scores.load(tmp_path)
    assert said == []
    for arena in ("classic", "two words"):
        assert again.best("pitanks", arena) == scores.best("pitanks", arena)


def test_after_a_reset_every_table_is_empty(tmp_path):
    scores = filled(3)
    scores.save(tmp_path)
    scores.reset()
    scores.save(tmp_path)
    assert Scores.load(tmp_path)[0].best("pitanks", "classic") == []


def test_a_broken_file_gives_back_the_tables_before_it(tmp_path):
    filled(3).save(tmp_path)
    filled(3, 4).save(tmp_path)
    (tmp_path / FILE).write_text('[pitanks]\nclassic = [ { initials = "AB')
    scores, said = Scores.load(tmp_path)
    assert points(scores) == [3]
    assert len(said) == 1
    assert list(tmp_path.glob(f"{FILE}.broken-*"))


@pytest.mark.parametrize(
    "rows",
    [
        '[{ initials = "abc", score = 1, when = 2026-11-21T12:00:00Z }]',
        '[{ initials = "ABC", score = 1.5, when = 2026-11-21T12:00:00Z }]',
        '[{ initials = "ABC", score = true, when = 2026-11-21T12:00:00Z }]',
        '[{ initials = "ABC", score = 1, when = "today" }]',
        '[{ initials = "ABC", score = 1 }]',
        '[{ initials = "ABC", score = 1, when = 2026-11-21T12:00:00Z, photo = "me.png" }]',
        "[1, 2]",
        "7",
    ],
)
def test_a_wrong_row_is_said_and_costs_only_itself(tmp_path, rows):
    good = '[{ initials = "ABC", score = 4, when = 2026-11-21T12:00:00Z }]'
    (tmp_path / FILE).write_text(f"[pitanks]\nclassic = {good}\nislands = {rows}\n")
    scores, said = Scores.load(tmp_path)
    assert points(scores) == [4]
    assert len(said) == 1
    assert "pitanks.islands" in said[0]


def test_a_file_of_something_else_is_said(tmp_path):
    (tmp_path / FILE).write_text("pitanks = 3\n")
    scores, said = Scores.load(tmp_path)
    assert points(scores) == []
    assert len(said) == 1


def test_a_place_that_cannot_be_written_is_said(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(NotSaved, match=r"scores\.toml was not saved"):
        filled(1).save(tmp_path / "file")
