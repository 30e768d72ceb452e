"""Migration of the file of version 1.3.0: backed up before anything is written, imported once, left unchanged."""

from datetime import UTC, datetime

import pytest

from pigaming_app.storage import safe_files as keeping
from pigaming_app.storage.scores import FILE, Scores, ScoreTable, migrations

OLD = """
[pitanks]
classic = [
    { initials = "ANA", score = 9, when = 2026-11-20T12:00:00Z },
    { initials = "BEN", score = -3, when = 2026-11-20T12:00:00Z },
]

[race]
"classic lap" = [{ initials = "CEM", ms = 9870, when = 2026-11-20T12:00:00Z }]
"classic race 3" = [{ initials = "DEA", ms = 30120, when = 2026-11-20T12:00:00Z }]
"two words race 5" = [{ initials = "EVA", ms = 50120, when = 2026-11-20T12:00:00Z }]

[factory]
"hall time 4" = [{ initials = "FIN", ms = 90120, when = 2026-11-20T12:00:00Z }]
"""
MORE = OLD.replace(
    "[pitanks]\nclassic = [", '[pitanks]\nclassic = [{ initials = "NEW", score = 5, when = 2026-11-21T12:00:00Z },'
)
POINTS = ScoreTable("pitanks", "classic", "points")
FOUND = {
    POINTS: [("ANA", 9), ("BEN", -3)],
    ScoreTable("race", "classic", "lap", True): [("CEM", 9870)],
    ScoreTable("race", "classic", "race", True, length=3): [("DEA", 30120)],
    ScoreTable("race", "two words", "race", True, length=5): [("EVA", 50120)],
    ScoreTable("factory", "hall", "time", True, length=4): [("FIN", 90120)],
}


def rows(scores):
    return {table: [(row.initials, row.score) for row in scores.best(table)] for table in scores.tables()}


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "scores.toml").write_text(OLD)
    return tmp_path


def test_every_row_is_carried_over_to_a_table_whose_conditions_are_unknown(folder):
    scores, messages = Scores.load(folder)
    assert messages == []
    assert rows(scores) == FOUND
    assert all(table.older for table in scores.tables())
    assert rows(Scores.load(folder)[0]) == FOUND, "once, not at every start"


def test_the_old_file_is_backed_up_and_left_as_it_was(folder):
    Scores.load(folder)
    assert (folder / "scores-1.3.0.toml").read_text() == OLD
    assert (folder / "scores.toml").read_text() == OLD
    Scores.load(folder)
    assert sorted(path.name for path in folder.iterdir()) == [f".{FILE}.lock", "scores-1.3.0.toml", "scores.toml", FILE]


def test_an_earlier_backup_is_never_overwritten(folder):
    (folder / "scores-1.3.0.toml").write_text("somebody's own")
    Scores.load(folder)
    assert (folder / "scores-1.3.0.toml").read_text() == "somebody's own"
    assert (folder / "scores-1.3.0-2.toml").read_text() == OLD


def test_rows_that_version_130_adds_after_a_downgrade_are_migrated_too(folder):
    Scores.load(folder)
    (folder / "scores.toml").write_text(MORE)
    scores, messages = Scores.load(folder)
    assert messages == []
    assert rows(scores) == {**FOUND, POINTS: [("ANA", 9), ("NEW", 5), ("BEN", -3)]}
    assert (folder / "scores-1.3.0-2.toml").read_text() == MORE
    assert [one.rows for one in migrations(folder)[0]] == [{"pitanks": 2, "race": 3, "factory": 1}, {"pitanks": 1}]


def test_cleared_scores_do_not_come_back_from_the_old_file(folder):
    scores, _ = Scores.load(folder)
    scores.reset()
    scores.save(folder)
    assert Scores.load(folder)[0].tables() == []
    (folder / "scores.toml").write_text(MORE)
    assert rows(Scores.load(folder)[0]) == {POINTS: [("NEW", 5)]}


def test_copies_that_start_together_carry_over_once(folder):
    one, other = Scores.load(folder)[0], Scores.load(folder)[0]
    one.add(POINTS, "ABC", 1, datetime(2026, 11, 22, tzinfo=UTC))
    one.save(folder)
    other.save(folder)
    assert rows(other)[POINTS] == [("ANA", 9), ("ABC", 1), ("BEN", -3)]


def test_a_pulled_plug_after_the_backup_loses_nothing(folder, monkeypatch):
    kept = keeping.write_with_backup

    def pulled(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("pigaming_app.storage.scores.book.write_with_backup", pulled)
    with pytest.raises(KeyboardInterrupt):
        Scores.load(folder)
    monkeypatch.setattr("pigaming_app.storage.scores.book.write_with_backup", kept)
    assert rows(Scores.load(folder)[0]) == FOUND
    assert not (folder / "scores-1.3.0-2.toml").exists()


def test_on_a_full_disk_the_rows_are_shown_and_the_next_save_carries_them_over(folder, monkeypatch):
    def full(*_):
        raise keeping.NotSaved("the disk is full")

    monkeypatch.setattr("pigaming_app.storage.scores.migration.write_atomic", full)
    scores, messages = Scores.load(folder)
    assert messages == ["the disk is full"]
    assert rows(scores) == FOUND
    assert not (folder / FILE).exists(), "nothing is written before the backup"
    monkeypatch.undo()
    scores.save(folder)
    assert rows(scores) == rows(Scores.load(folder)[0]) == FOUND
    assert (folder / "scores-1.3.0.toml").read_text() == OLD


def test_invalid_rows_in_the_old_file_are_reported_once_and_affect_no_others(folder):
    (folder / "scores.toml").write_text(
        OLD + 'lines = [{ initials = "abc", score = 1, when = 2026-11-21T12:00:00Z }, 7]\n'
    )
    scores, messages = Scores.load(folder)
    assert rows(scores) == FOUND
    assert messages == [f"{folder / 'scores.toml'}: 2 entries are not scores (first in factory.lines); ignored."]
    assert Scores.load(folder)[1] == []


def test_a_broken_old_file_gives_way_to_its_own_backup(folder):
    (folder / "scores.toml.bak").write_text(OLD)
    (folder / "scores.toml").write_text("[pitanks")
    scores, messages = Scores.load(folder)
    assert rows(scores) == FOUND
    assert len(messages) == 1


def test_looking_for_migrations_changes_nothing(folder):
    assert migrations(folder) == ([], True)
    assert [path.name for path in folder.iterdir()] == ["scores.toml"]
    Scores.load(folder)
    done, waits = migrations(folder)
    assert [one.backup for one in done] == ["scores-1.3.0.toml"]
    assert not waits
