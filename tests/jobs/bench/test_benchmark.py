"""PiGaming-Bench on the command line: `bench tasks`, `bench TASK AGENT …`, `bench verify FILE`."""

import json

import pytest

from pigaming_app.gym.benchmark import results
from pigaming_app.gym.benchmark.protocol import MatchCounts
from pigaming_app.gym.benchmark.tasks import TASKS
from pigaming_app.jobs.cli import main


@pytest.fixture(autouse=True)
def _made_up(monkeypatch):
    ends = MatchCounts(60, 10, 30, "a" * 64)
    monkeypatch.setattr(results, "evaluate", lambda task, *_: dict.fromkeys(task.conditions, ends))


def test_all_tasks_are_listed(capsys):
    assert main(["bench", "tasks", "--json"]) == 0
    assert json.loads(capsys.readouterr().out).keys() == TASKS.keys()
    assert main(["bench", "tasks"]) == 0
    assert "level5       agent level5: 100 matches in classic" in capsys.readouterr().out


def test_results_are_written_and_verified(tmp_path, capsys):
    out = tmp_path / "mine.json"
    assert main(["bench", "pitanks-duel", "level3", "--method", "by hand", "--out", str(out)]) == 0
    printed = capsys.readouterr()
    assert "pitanks-duel, by hand, any number of decisions: 65.0% (95 %: 60.7% to 69.1%), 1 run" in printed.out
    assert main(["bench", "verify", str(out)]) == 0
    assert "mine.json: every number is as it was" in capsys.readouterr().out
    out.write_text(out.read_text().replace("0.65", "0.75"))
    assert main(["bench", "verify", str(out)]) == 2
    assert "mine.json: runs[0].score: 0.75, but it is 0.65" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["pitanks-duels", "level3"], "no task 'pitanks-duels'; there are pitanks-duel, "),
        (["pitanks-duel"], "pitanks-duel: name an agent"),
        (["pitanks-duel", "none.npz"], "none.npz: "),
        (["pitanks-duel", "level3", "--method", "a\nb"], "--method: one line of plain text"),
        (["pitanks-duel", "level3", "--out", "a.json"], "--method: one line of plain text"),
        (["pitanks-duel", "level3", "level3", "--method", "a", "--out", "/nowhere/a.json"], "/nowhere"),
        (["verify"], "verify: name one file"),
        (["verify", "none.json"], "none.json: "),
    ],
)
def test_what_cannot_be_done_is_refused_in_one_line(words, line, capsys):
    assert main(["bench", *words]) == 2
    printed = capsys.readouterr().err
    assert line in printed
    assert printed.count("\n") == 1
