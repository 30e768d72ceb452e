"""Corrupt scores files: loading succeeds, reports one sentence, and retains the valid rows."""

import os
from dataclasses import asdict, replace
from datetime import UTC, datetime, timedelta, timezone

import pytest
import tomli_w
from hypothesis import given, settings
from hypothesis import strategies as st

from pigaming_app.scenes.results.high_score_tables import contests
from pigaming_app.storage.scores import FILE, Scores, ScoreTable

GOOD = '{ initials = "ABC", score = 4, when = 2026-11-21T12:00:00Z }'
TABLE = ScoreTable("pitanks", "classic", "points", rules="plain", length=2, people=1)
HEAD = """format = 1
[[table]]
game = "pitanks"
arena = "{arena}"
achievement = "points"
timed = false
rules = "plain"
"""
ROWS = [
    '{ initials = "ABC", score = 1, when = 0001-01-01T00:00:00Z }',
    '{ initials = "ABC", score = 1, when = 0001-01-01T00:00:00 }',
    '{ initials = "ABC", score = 1, when = 0001-01-01T00:00:00+23:59 }',
    '{ initials = "ABC", score = 1, when = 9999-12-31T23:59:59Z }',
    '{ initials = "ABC", score = 1, when = 9999-12-31T23:59:59-23:59 }',
    '{ initials = "ABC", score = 1, when = 9999-12-31T23:59:59 }',
    '{ initials = "ABC", score = 1, when = 2026-11-21 }',
    '{ initials = "ABC", score = 1, when = 12:00:00 }',
    '{ initials = "ABC", score = 1, when = "today" }',
    '{ initials = "ABC", score = 1 }',
    '{ initials = "ABC", score = 1.5, when = 2026-11-21T12:00:00Z }',
    '{ initials = "ABC", score = nan, when = 2026-11-21T12:00:00Z }',
    '{ initials = "ABC", score = -inf, when = 2026-11-21T12:00:00Z }',
    '{ initials = "ABC", score = true, when = 2026-11-21T12:00:00Z }',
    f'{{ initials = "ABC", score = {"9" * 400}, when = 2026-11-21T12:00:00Z }}',
    f'{{ initials = "ABC", score = 0x{"f" * 5000}, when = 2026-11-21T12:00:00Z }}',
    '{ initials = "ABC", score = 1000001, when = 2026-11-21T12:00:00Z }',
    '{ initials = "ABC", when = 2026-11-21T12:00:00Z }',
    '{ initials = "abc", score = 1, when = 2026-11-21T12:00:00Z }',
    '{ initials = "", score = 1, when = 2026-11-21T12:00:00Z }',
    "{ initials = 3, score = 1, when = 2026-11-21T12:00:00Z }",
    "7",
    "[]",
    "{}",
]
NAMES = ["''", '"a.b"', '"a\\nb"', '"Ação"', '"\\u0000"', f'"{"x" * 5000}"']


def good(scores):
    return [row.score for row in scores.best(TABLE)]


def loaded(folder):
    """Load the scores of a folder; asserts that they can be saved and loaded again without further messages."""
    scores, messages = Scores.load(folder)
    assert all("\n" not in line and len(line) < 500 for line in messages)
    scores.add(TABLE, "XYZ", 3)
    scores.save(folder)
    assert Scores.load(folder)[1] == []
    return scores, messages


@pytest.mark.parametrize("row", ROWS)
def test_a_bad_row_costs_only_itself(tmp_path, row):
    head = HEAD.format(arena="classic") + "length = 2\npeople = 1\nside = 0\n"
    (tmp_path / FILE).write_text(f"{head}rows = [{row}, {GOOD}]\n")
    scores, messages = loaded(tmp_path)
    assert good(scores) == [4, 3]
    assert messages == [f"{tmp_path / FILE}: 1 entry is not a score (in pitanks.classic); ignored."]


@pytest.mark.parametrize(
    "lines",
    [
        "length = true\npeople = 1\nside = 0",
        "length = nan\npeople = 1\nside = 0",
        "length = -1\npeople = 1\nside = 0",
        f"length = {'9' * 400}\npeople = 1\nside = 0",
        "length = 2\npeople = true\nside = 0",
        "length = 2\npeople = -1\nside = 0",
        "length = 2\npeople = []\nside = 0",
        "length = 2\npeople = 0\nside = 0",
    ],
)
def test_a_table_with_bad_conditions_costs_only_itself(tmp_path, lines):
    first = HEAD.format(arena="islands") + f"{lines}\nrows = [{GOOD}]\n"
    second = HEAD.format(arena="classic").partition("\n")[2] + f"length = 2\npeople = 1\nside = 0\nrows = [{GOOD}]\n"
    (tmp_path / FILE).write_text(first + second)
    scores, messages = loaded(tmp_path)
    assert good(scores) == [4, 3]
    assert len(messages) == 1


@pytest.mark.parametrize("name", NAMES)
def test_odd_names_are_names_or_ignored(tmp_path, name):
    rest = f"length = 2\npeople = 1\nside = 0\nrows = [{GOOD}]\n"
    odd = HEAD.replace('"{arena}"', name).partition("\n")[2]
    (tmp_path / FILE).write_text(f"{HEAD.format(arena='classic')}{rest}{odd}{rest}")
    scores, messages = loaded(tmp_path)
    assert good(scores) == [4, 3]
    assert len(messages) == (name == NAMES[-1])


@pytest.mark.parametrize(
    "text",
    [
        "x = " + "[" * 2000 + "]" * 2000,
        "[" + ".".join("a" * 2000) + "]\n",
        "x = " + "{a=" * 2000 + "1" + "}" * 2000,
        f"format = {'9' * 5000}\n",
        "format = 2\n",
        "format = true\n",
        "[pitanks]\n",
        "format = 1\nformat = 1\n",
        "\x00\x01",
    ],
)
def test_an_unreadable_file_is_put_aside_and_the_one_before_serves(tmp_path, text):
    before = Scores()
    before.add(TABLE, "ABC", 4)
    before.save(tmp_path)
    before.add(TABLE, "ABC", 5)
    before.save(tmp_path)
    (tmp_path / FILE).write_text(text)
    scores, messages = loaded(tmp_path)
    assert good(scores) == [4, 3]
    assert len(messages) == 1
    assert len(list(tmp_path.glob(f"{FILE}.broken-*"))) == 1


def test_a_file_of_100_mb_is_put_aside_unread(tmp_path):
    with (tmp_path / FILE).open("wb") as file:
        file.truncate(100_000_000)
    scores, messages = loaded(tmp_path)
    assert good(scores) == [3]
    assert len(messages) == 1
    assert "larger than" in messages[0]


@pytest.mark.parametrize("make", [os.mkdir, getattr(os, "mkfifo", os.mkdir)])
def test_a_folder_or_a_pipe_in_its_place_is_put_aside(tmp_path, make):
    make(tmp_path / FILE)
    scores, messages = loaded(tmp_path)
    assert good(scores) == [3]
    assert len(messages) == 1


def test_thousands_of_tables_and_rows_are_read_and_bounded(tmp_path):
    rest = "length = 2\npeople = 1\nside = 0\nrows = "
    many = "".join(f"{HEAD.format(arena=i).partition(chr(10))[2]}{rest}[{GOOD}]\n" for i in range(2000))
    long = ",".join(GOOD.replace("4", str(i)) for i in range(2000))
    (tmp_path / FILE).write_text(f"{HEAD.format(arena='classic')}{rest}[{long}]\n{many}")
    scores, messages = loaded(tmp_path)
    assert not messages
    assert len(scores.tables()) == 2001
    assert [row.score for row in scores.best(TABLE)] == [*range(1999, 1989, -1)]
    assert (tmp_path / FILE).stat().st_size < 1_000_000


STRANGE = st.one_of(
    st.booleans(),
    st.integers(-(10**400), 10**400),
    st.floats(),
    st.text(st.characters(exclude_categories=["Cs"]), max_size=8),
    st.datetimes(),
    st.datetimes(timezones=st.sampled_from([UTC, timezone(timedelta(hours=-23))])),
    st.dates(),
    st.lists(st.integers(), max_size=3),
    st.dictionaries(st.sampled_from(["", "a.b", "rows", "when"]), st.integers(), max_size=2),
)
KEYS = st.sampled_from([*asdict(TABLE), "initials", "score", "when", "rows"])


@settings(max_examples=40, deadline=None)
@given(st.lists(st.dictionaries(KEYS, STRANGE, max_size=2), max_size=4), st.lists(STRANGE, max_size=2))
def test_whatever_a_file_holds_it_is_read_and_written_again(tmp_path_factory, changes, strangers):
    folder = tmp_path_factory.mktemp("strange")
    row = {"initials": "ABC", "score": 4, "when": datetime(2026, 11, 21, tzinfo=UTC)}
    table, rows = asdict(TABLE), [{**row, **one} for one in changes]
    islands = {**table, "arena": "islands", "rows": [row]}
    new = {
        "format": 1,
        "table": [
            islands,
            {**table, "rows": [*rows, *strangers]},
            *({**table, "rows": [row], **one} for one in changes),
        ],
    }
    (folder / FILE).write_text(tomli_w.dumps(new), encoding="utf-8")
    scores, messages = loaded(folder)
    assert len(messages) <= 1
    assert [one.score for one in scores.best(replace(TABLE, arena="islands"))] == [4]
    assert all(contests(scores)), "the page can sort what there is"
