"""Corrupt scores files: loading succeeds, reports one sentence, and retains the valid rows."""

from dataclasses import asdict, replace
from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path

import pytest
import tomli_w
from hypothesis import given, settings
from hypothesis import strategies as st

from pigaming_app.scenes.results.high_scores import contests
from pigaming_app.storage.scores import FILE, Scores, ScoreTable

TABLE = ScoreTable("pitanks", "classic", "points", rules="plain", length=2, people=1)
NOON = "2026-11-21T12:00:00Z"


def row(initials: str = '"ABC"', score: str = "4", when: str = NOON) -> str:
    """A row of a table, in TOML."""
    return f"{{ initials = {initials}, score = {score}, when = {when} }}"


def table(*rows: str, arena: str = '"classic"', length: str = "2", people: str = "1") -> str:
    """A table of a file, in TOML."""
    fixed = '[[table]]\ngame = "pitanks"\nachievement = "points"\ntimed = false\nrules = "plain"\nside = 0\n'
    return f"{fixed}arena = {arena}\nlength = {length}\npeople = {people}\nrows = [{', '.join(rows)}]\n"


WHEN = (
    "0001-01-01T00:00:00Z", "0001-01-01T00:00:00", "0001-01-01T00:00:00+23:59", "9999-12-31T23:59:59Z",
    "9999-12-31T23:59:59-23:59", "9999-12-31T23:59:59", "2026-11-21", "12:00:00", '"today"',
)  # fmt: skip
ROWS = [
    *(row(when=when) for when in WHEN),
    *(row(score=score) for score in ("1.5", "nan", "-inf", "true", "9" * 400, f"0x{'f' * 5000}", "1000001")),
    *(row(initials=initials) for initials in ('"abc"', '""', "3")),
    row().replace(f", when = {NOON}", ""),
    row().replace("score = 4, ", ""),
    *("7", "[]", "{}"),
]
CONDITIONS = [
    *({"length": length} for length in ("true", "nan", "-1", "9" * 400)),
    *({"people": people} for people in ("true", "-1", "[]", "0")),
]
NAMES = ["''", '"a.b"', '"a\\nb"', '"Ação"', '"\\u0000"', f'"{"x" * 5000}"']


def loaded(folder: Path, *tables: str) -> tuple[Scores, list[str]]:
    """The scores of a file with these tables; asserts that they can be saved and loaded again without messages."""
    if tables:
        (folder / FILE).write_text("format = 1\n" + "".join(tables))
    scores, messages = Scores.load(folder)
    assert all("\n" not in line and len(line) < 500 for line in messages)
    scores.add(TABLE, "XYZ", 3)
    scores.save(folder)
    assert Scores.load(folder)[1] == []
    return scores, messages


def good(scores: Scores) -> list[int]:
    return [one.score for one in scores.best(TABLE)]


@pytest.mark.parametrize("bad", ROWS)
def test_a_bad_row_costs_only_itself(tmp_path, bad):
    scores, messages = loaded(tmp_path, table(bad, row()))
    assert good(scores) == [4, 3]
    assert messages == [f"{tmp_path / FILE}: 1 entry is not a score (in pitanks.classic); ignored."]


@pytest.mark.parametrize("conditions", CONDITIONS)
def test_a_table_with_bad_conditions_costs_only_itself(tmp_path, conditions):
    scores, messages = loaded(tmp_path, table(row(), arena='"islands"', **conditions), table(row()))
    assert good(scores) == [4, 3]
    assert messages == [f"{tmp_path / FILE}: 1 entry is not a score (in table 1); ignored."]


@pytest.mark.parametrize("name", NAMES)
def test_odd_names_are_names_or_ignored(tmp_path, name):
    scores, messages = loaded(tmp_path, table(row()), table(row(), arena=name))
    assert good(scores) == [4, 3]
    assert len(messages) == (name == NAMES[-1])


def test_thousands_of_tables_and_rows_are_read_and_bounded(tmp_path):
    many = [table(row(), arena=f'"{i}"') for i in range(2000)]
    scores, messages = loaded(tmp_path, table(*(row(score=str(i)) for i in range(2000))), *many)
    assert not messages
    assert len(scores.tables()) == 2001
    assert good(scores) == [*range(1999, 1989, -1)]
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
    whole = {"initials": "ABC", "score": 4, "when": datetime(2026, 11, 21, tzinfo=UTC)}
    head, rows = asdict(TABLE), [{**whole, **one} for one in changes]
    tables = [
        {**head, "arena": "islands", "rows": [whole]},
        {**head, "rows": [*rows, *strangers]},
        *({**head, "rows": [whole], **one} for one in changes),
    ]
    (folder / FILE).write_text(tomli_w.dumps({"format": 1, "table": tables}), encoding="utf-8")
    scores, messages = loaded(folder)
    assert len(messages) <= 1
    assert [one.score for one in scores.best(replace(TABLE, arena="islands"))] == [4]
    assert all(contests(scores)), "the page can sort what there is"
