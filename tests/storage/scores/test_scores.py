"""High scores: order and retention of rows, saving, and recovery from a broken file."""

import time
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest

from pigaming_app.storage.scores import DAYS, LENGTH, Scores, ScoreTable

NOON = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
DAY = timedelta(days=1)
TANKS = ScoreTable("pitanks", "classic", "points", rules="pickups", length=2, people=1)
LAP = ScoreTable("race", "classic", "lap", True, "standard", 3, 2)


def points(scores, days=None, now=NOON):
    return [row.score for row in scores.best(TANKS, days, now)]


def filled(*scores, when=NOON):
    table = Scores()
    for score in scores:
        table.add(TANKS, "ABC", score, when)
    return table


def test_the_best_come_first_and_the_earlier_of_equals():
    scores = filled(3, 9, -2)
    scores.add(TANKS, "OLD", 9, NOON - DAY)
    assert [(row.initials, row.score) for row in scores.best(TANKS)] == [
        ("OLD", 9),
        ("ABC", 9),
        ("ABC", 3),
        ("ABC", -2),
    ]


@pytest.mark.parametrize(
    "other", [{"game": "race"}, {"arena": "islands"}, {"rules": "plain"}, {"length": 1}, {"people": 2}, {"side": 1}]
)
def test_scores_under_other_conditions_stand_in_another_table(other):
    assert filled(5).best(replace(TANKS, **other)) == []


def test_a_table_has_ten_rows():
    assert points(filled(*range(30))) == list(range(29, 29 - LENGTH, -1))


def test_of_times_the_shortest_comes_first(tmp_path):
    scores = Scores()
    for name, ms in (("SLO", 12_340), ("FST", 9_870), ("MID", 9_871)):
        scores.add(LAP, name, ms, NOON)
    scores.save(tmp_path)
    kept, messages = Scores.load(tmp_path)
    assert not messages
    assert [(row.initials, row.score) for row in kept.best(LAP)] == [("FST", 9_870), ("MID", 9_871), ("SLO", 12_340)]
    assert kept.place(LAP, 9_870) == 2, "behind its equal"
    assert kept.place(LAP, 20_000) == 4


def test_todays_table_begins_empty_and_yesterdays_stars_stay_in_that_of_all_time():
    scores = filled(*range(100, 100 + LENGTH), when=NOON - DAY)
    scores.add(TANKS, "NEW", 1, NOON)
    assert points(scores, days=1) == [1]
    assert 1 not in points(scores)
    assert points(scores, days=2)[:2] == [109, 108]
    assert points(scores, days=1, now=NOON + DAY) == []


def test_a_year_of_evenings_stays_a_short_file():
    scores = Scores()
    for day in range(0, 365, 5):
        for score in range(20):
            scores.add(TANKS, "ABC", score, NOON + day * DAY)
    assert len(scores._content.tables[TANKS]) <= (2 * DAYS + 1) * LENGTH, "before and after today"


def test_the_place_of_a_new_score_is_behind_its_equals():
    scores = filled(9, 5, 5, 1)
    assert [scores.place(TANKS, score, now=NOON) for score in (10, 9, 5, 0)] == [1, 2, 4, 5]
    full = filled(*[5] * LENGTH)
    assert full.place(TANKS, 5, now=NOON) is None
    assert full.place(TANKS, 6, now=NOON) == 1
    assert full.place(TANKS, 0, days=1, now=NOON + DAY) == 1


@pytest.mark.parametrize("initials", ["", "AB", "ABCD", "abc", "A C", "ÁBC", "A1B"])
def test_initials_are_three_capitals(initials):
    with pytest.raises(ValueError, match="three of A to Z"):
        Scores().add(TANKS, initials, 1)


@pytest.mark.parametrize("arena", ["classic", "two words", "", "a.b", "a\nb", "Ação", "“]'#"])
def test_saved_scores_are_loaded_again(tmp_path, arena):
    scores, table = filled(3, 9), replace(TANKS, arena=arena, length=0.5)
    scores.add(table, "XYZ", 1, NOON)
    scores.save(tmp_path)
    again, messages = Scores.load(tmp_path)
    assert messages == []
    assert again.tables() == scores.tables()
    assert [again.best(one) for one in again.tables()] == [scores.best(one) for one in scores.tables()]


def test_after_a_reset_every_table_is_empty(tmp_path):
    scores = filled(3)
    scores.save(tmp_path)
    scores.reset()
    scores.save(tmp_path)
    assert Scores.load(tmp_path)[0].tables() == []


def test_rows_of_a_wrong_clock_displace_none_of_today(tmp_path):
    scores, now = Scores(), datetime.now().astimezone()
    for year in range(1, 20):
        for score in range(100, 100 + LENGTH):
            scores.add(TANKS, "FUT", score, now + 365 * year * DAY)
            scores.add(TANKS, "OLD", score, now - 365 * year * DAY)
    scores.add(TANKS, "NOW", 1, now)
    scores.save(tmp_path)
    kept, _ = Scores.load(tmp_path)
    assert [row.initials for row in kept.best(TANKS, days=1)] == ["NOW"]
    assert kept.place(TANKS, 2, days=1) == 1


def test_a_row_from_a_clock_without_a_battery_is_kept(tmp_path):
    scores = Scores()
    scores.add(TANKS, "PIE", 5, datetime(1970, 1, 2, tzinfo=UTC))
    scores.save(tmp_path)
    assert [row.initials for row in Scores.load(tmp_path)[0].best(TANKS)] == ["PIE"]


@pytest.mark.skipif(not hasattr(time, "tzset"), reason="the zone of a process cannot be set")
def test_a_zone_that_is_off_by_seconds_spoils_no_file(tmp_path, monkeypatch):
    monkeypatch.setenv("TZ", "XXX0:44:30")
    time.tzset()
    try:
        scores = Scores()
        row = scores.add(TANKS, "ABC", 5)
        scores.save(tmp_path)
        assert Scores.load(tmp_path)[0].best(TANKS) == [row]
        assert Scores.load(tmp_path)[0].best(TANKS, days=1) == [row]
    finally:
        monkeypatch.undo()
        time.tzset()
