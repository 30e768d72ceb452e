"""Several instances share a folder: no row is lost or duplicated, resets hold, and none blocks on a dead one."""

import signal
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.scores import FILE, Scores, ScoreTable

ROOT = Path(__file__).parents[3]
TABLES = [ScoreTable("pitanks", arena, "points", rules="plain", length=2, people=1) for arena in "abcdefgh"]
WRITER = """
import sys
from pathlib import Path
from pigaming_app.storage.scores import Scores, ScoreTable
folder, first, count = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
scores, _ = Scores.load(folder)
for number in range(first, first + count):
    table = ScoreTable("pitanks", "abcdefgh"[number % 8], "points", rules="plain", length=2, people=1)
    scores.add(table, "ABC", number)
    scores.save(folder)
    print(number, flush=True)
"""

HOLDER = """
import sys
from pathlib import Path
from pigaming_app.storage.file_lock import locked
with locked(Path(sys.argv[1])):
    print(flush=True)
    input()
"""


def numbers(scores: Scores) -> Counter[int]:
    """Number of rows with each value."""
    return Counter(row.score for table in scores.tables() for row in scores._content.tables[table])


def writer(folder: Path, first: int, count: int) -> "subprocess.Popen[str]":
    """A process that adds and saves `count` scores from `first` on, and prints each after saving."""
    command = [sys.executable, "-c", WRITER, str(folder), str(first), str(count)]
    return subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True)


@settings(max_examples=30, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 2), st.sampled_from(("add", "add", "save", "reset", "restart"))), max_size=30))
def test_copies_in_any_order_lose_and_double_nothing(tmp_path_factory, story):
    folder = tmp_path_factory.mktemp("shared")
    copies = [Scores.load(folder)[0] for _ in range(3)]
    there: set[int] = set()  # in the file
    pending: list[set[int]] = [set(), set(), set()]
    cleared = [False, False, False]
    for number, (copy, act) in enumerate([*story, *((copy, "save") for copy in range(3))]):
        scores = copies[copy]
        if act == "add":
            scores.add(TABLES[number % len(TABLES)], "ABC", number)
            pending[copy].add(number)
        elif act == "reset":
            scores.reset()
            pending[copy], cleared[copy] = set(), True
        elif act == "save":
            scores.save(folder)
            there = (set() if cleared[copy] else there) | pending[copy]
            pending[copy], cleared[copy] = set(), False
            assert set(numbers(scores)) == there, "after saving, a copy knows the rows of all"
        else:
            copies[copy] = Scores.load(folder)[0]
            pending[copy], cleared[copy] = set(), False
    assert numbers(Scores.load(folder)[0]) == Counter(there)


def test_the_log_counts_the_rows_of_another_copy(tmp_path, caplog):
    one, other = Scores(), Scores()
    for number in range(3):
        one.add(TABLES[0], "ABC", number)
    one.save(tmp_path)
    other.add(TABLES[1], "DEF", 7)
    other.save(tmp_path)
    assert [record.message for record in caplog.records] == ["scores of another copy of the arcade merged: 3 rows."]
    one.reset()
    one.save(tmp_path)
    assert caplog.records[-1].message == "scores of another copy of the arcade merged: 1 row."
    other.add(TABLES[1], "DEF", 8)
    other.save(tmp_path)
    assert caplog.records[-1].message == "another copy of the arcade has cleared the scores."
    assert numbers(Scores.load(tmp_path)[0]) == {8: 1}


def test_equal_rows_of_two_copies_are_two_rows(tmp_path):
    one, other = Scores.load(tmp_path)[0], Scores.load(tmp_path)[0]
    row = one.add(TABLES[0], "ABC", 5)
    other.add(TABLES[0], "ABC", 5, row.when)
    one.save(tmp_path)
    other.save(tmp_path)
    assert Scores.load(tmp_path)[0].best(TABLES[0]) == [row, row]


def test_parallel_processes_lose_and_double_nothing(tmp_path):
    writers = [writer(tmp_path, first, 8) for first in (0, 100, 200)]
    for one in writers:
        one.communicate()
        assert one.returncode == 0
    wanted = {first + number: 1 for first in (0, 100, 200) for number in range(8)}
    assert numbers(Scores.load(tmp_path)[0]) == wanted


@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL")
def test_a_copy_killed_while_it_saves_costs_no_row_and_no_lock(tmp_path):
    saved: list[int] = []
    companion = writer(tmp_path, 1000, 10)
    for turn in range(3):
        victim = writer(tmp_path, 100 * turn, 50)
        assert victim.stdout
        for _ in range(3 + turn):
            saved.append(int(victim.stdout.readline()))
        victim.kill()
        saved += map(int, victim.communicate()[0].split())
    saved += map(int, companion.communicate()[0].split())
    found = numbers(Scores.load(tmp_path)[0])
    assert found >= Counter(saved), "what was reported as saved is there"
    assert max(found.values()) == 1
    assert len(found) <= len(saved) + 3, "at most the row that each was saving when it was killed"


@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGSTOP")
def test_a_copy_that_hangs_with_the_lock_delays_a_save_and_loses_none(tmp_path, monkeypatch):
    monkeypatch.setattr("pigaming_app.storage.file_lock.TIMEOUT", 0.05)
    command = [sys.executable, "-c", HOLDER, str(tmp_path / FILE)]
    process = subprocess.Popen(command, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdout
    process.stdout.readline()
    process.send_signal(signal.SIGSTOP)
    scores = Scores()
    scores.add(TABLES[0], "ABC", 5)
    with pytest.raises(NotSaved, match="another copy of the arcade is using it"):
        scores.save(tmp_path)
    assert Scores.load(tmp_path)[1] == [], "reading does not wait for good"
    assert scores.unsaved
    process.kill()
    process.communicate()
    scores.save(tmp_path)
    assert numbers(Scores.load(tmp_path)[0]) == {5: 1}


def test_where_no_lock_file_can_be_written_the_block_runs_all_the_same(tmp_path):
    (tmp_path / "file").write_text("in the way")
    with locked(tmp_path / "file" / FILE):
        pass
