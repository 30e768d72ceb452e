"""The job `train ppo`: files, progress, resuming after Ctrl-C, and refusals in one line."""

import csv
import json
import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from pigaming_app.ai.networks.files import BRAINS, decode
from pigaming_app.ai.ppo.learner import Hyper
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.task_file import file_of, parse_task_file, text_of
from pigaming_app.ai.ppo.training import Training
from pigaming_app.jobs.cli import main
from tests.ai.ppo.plain import SET, play_plain
from tests.disks import content, failing_at, room_for

ROOT = Path(__file__).resolve().parents[3]


def train(out, *more, updates="4"):
    return main(["train", "ppo", "pitanks", "--updates", updates, "--seed", "5", *SET, "--out", str(out), *more])


@pytest.fixture
def _plain(monkeypatch):
    play_plain(monkeypatch)
    monkeypatch.setattr("pigaming_app.jobs.learning.train.ppo_training.MEASURED", 1)
    monkeypatch.setattr("pigaming_app.jobs.learning.train.ppo_training.MEASURED_AT_END", 2)


def weights(path):
    network = decode(path.read_bytes(), path.name)
    return [array.tobytes() for array in (*network.matrices, *network.biases)]


@pytest.mark.usefixtures("_plain")
def test_the_job_trains_and_prints_its_result(tmp_path, capsys):
    out, log = tmp_path / "a.npz", tmp_path / "a.csv"
    assert train(out, "--csv", str(log), "--json", updates="2") == 0
    result = json.loads(capsys.readouterr().out)
    assert (result["updates"], result["finished"]) == (2, True)
    assert sum(result["rivals"]["idle"][end] for end in ("wins", "ties", "losses")) == 2
    assert [point["decisions"] for point in result["curve"]] == [0, result["decisions"]]
    assert result["curve"][-1]["idle"] == result["rivals"]["idle"]
    rows = list(csv.DictReader(log.read_text().splitlines()))
    assert [row["updates"] for row in rows] == ["0", "1", "2"]
    assert [row["pool"] for row in rows] == ["", "2", "2"]
    assert rows[1]["idle_wins"] == ""
    assert sum(int(rows[2][f"idle_{end}"]) for end in ("wins", "ties", "losses")) == 2
    for figure in ("mean_return", "kl", "clipped", "entropy", "value_loss", "explained"):
        assert rows[0][figure] == ""
        assert rows[1][figure] != rows[2][figure]
        assert float(rows[2][f"exploiter_{figure}"]) >= 0.0 or figure in ("mean_return", "explained")
    assert rows[2]["exploiter_entropy"] != rows[2]["entropy"]
    assert float(rows[2]["decisions_per_second"]) > 0
    network = decode(out.read_bytes(), out.name)
    assert (network.name, network.seed, network.decisions) == ("a", 5, result["decisions"])
    assert len(network.curve.rows) == 2


@pytest.mark.usefixtures("_plain")
def test_a_best_response_begins_with_the_weights_of_the_network_and_its_curve_is_printed(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("pigaming_app.jobs.learning.train.ppo_training.MEASURED_AGAINST", 2)
    out, log = tmp_path / "rival.npz", tmp_path / "a.csv"
    job = ["exploit", "net", *SET, "--out", str(out), "--csv", str(log)]
    assert main([*job, "--decisions", "60", "--variant", "pickups"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == ["2", "trained", "0.00", "against"], "60 of 8 × 4 an update"
    assert lines[2].split()[2] in ("0-2-0,", "1-0-1,"), "at first it is its equal"
    rows = list(csv.DictReader(log.read_text().splitlines()))
    assert [row["updates"] for row in rows] == ["0", "1", "2"]
    assert rows[0]["net_share"] == "0.5000"
    assert float(rows[0]["net_low"]) < 0.5 < float(rows[0]["net_high"])
    rival = decode(out.read_bytes(), out.name)
    task = parse_task_file(str(rival.recipe["task"]))
    assert (rival.recipe["start"], task.variants, task.rivals) == ("net", ("pickups",), ("net",))
    assert [line_up.seats for line_up in task.line_ups] == [("learner", "net", "off", "off")]
    monkeypatch.chdir(tmp_path)
    assert main(["exploit", "rival.npz", *SET, "--decisions", "30"]) == 0, "a file, which says what it plays"
    assert decode(Path("rival_rival.npz").read_bytes(), "").recipe["start"] == "rival"


@pytest.mark.parametrize(
    ("more", "word"),
    [
        (["nobody"], "no brain 'nobody'"),
        (["net", "--variant", "chess"], "no variant 'chess'"),
        (["net", "--game", "chess"], "no game 'chess'"),
        (["none.npz"], "none.npz: cannot be read"),
        (["FILE.npz"], "FILE.npz: neither a network nor"),
        (["net", "--decisions", "0"], "less than 1"),
        ([str(BRAINS / "race.npz"), "--game", "pitanks"], "race.npz: it plays race, not pitanks"),
    ],
)
def test_who_cannot_be_exploited_is_refused_in_one_line(tmp_path, refused, monkeypatch, more, word):
    monkeypatch.chdir(tmp_path)
    Path("FILE.npz").write_text("text")
    assert word in refused("exploit", *more)
    assert not [*tmp_path.glob("rival*")]


@pytest.mark.usefixtures("_plain")
def test_ctrl_c_keeps_the_training_and_it_goes_on_bit_for_bit(tmp_path, capsys, monkeypatch):
    update = Training.update

    def interrupted(training, *more):
        if training.updates == 0:
            signal.raise_signal(signal.SIGTERM)  # noted like Ctrl-C, and in this thread
        update(training, *more)

    whole, part, tables = tmp_path / "whole.npz", tmp_path / "part.npz", [tmp_path / "whole.csv", tmp_path / "part.csv"]
    assert train(whole, "--population", "--csv", str(tables[0]), updates="2") == 0
    with monkeypatch.context() as patch:
        patch.setattr(Training, "update", interrupted)
        assert train(part, "--population", "--csv", str(tables[1]), updates="2") == 130
    assert "continue with --resume" in capsys.readouterr().err
    assert decode(part.read_bytes(), part.name).updates == 1
    assert weights(part) != weights(whole)
    assert train(part, "--population", "--resume", "--csv", str(tables[1]), updates="2") == 0
    assert weights(part) == weights(whole)
    for row, again in zip(*(csv.DictReader(table.read_text().splitlines()) for table in tables), strict=True):
        timed = {"seconds", "decisions_per_second"}
        measured = {name for name in row if name.startswith("idle_")}  # also where it was interrupted
        assert {name: row[name] for name in row.keys() - timed - measured} == {
            name: again[name] for name in row.keys() - timed - measured
        }
    assert again["pool"].startswith("learner@0:")
    assert train(part, "--population", "--resume", "--seed", "6") == 2
    assert capsys.readouterr().err.splitlines()[-1].endswith("it is from a training with another seed")


@pytest.mark.usefixtures("_plain")
@pytest.mark.skipif(os.name != "posix", reason="limits of POSIX")
def test_a_full_disk_leaves_the_network_and_the_checkpoint_before(tmp_path, capsys):
    assert train(tmp_path / "a.npz", updates="1") == 0
    before = content(tmp_path)
    with room_for(30_000):  # enough for the network alone
        assert train(tmp_path / "a.npz", "--seed", "6", updates="1") == 2
    assert "a.checkpoint.npz was not saved: File too large." in capsys.readouterr().err
    assert content(tmp_path) == before
    with failing_at(0):
        assert train(tmp_path / "b.npz") == 2
    assert content(tmp_path) == before


@pytest.mark.parametrize(
    ("more", "word"),
    [
        (["--minutes", "1"], "--updates"),
        (["--minutes", "nan"], "--minutes"),
        (["--set", "rate=2"], "rate is 2; possible are 0 to 1"),
        (["--set", "matches=4"], "too few"),
        (["--set", "speed=2"], "speed"),
        (["--out", "a.txt"], ".npz"),
        (["--out", "a.npz", "--csv", "a.checkpoint.npz"], "another file"),
        (["--set", "rate=nan"], "rate is nan"),
        (["--set", "=1"], "NAME=NUMBER is needed"),
        (["--updates", "0"], "less than 1"),
        (["--updates", "-1"], "less than 1"),
        (["--workers", "0"], "less than 1"),
        (["--workers", "2"], "only with --ray"),
        (["--task", "none.toml"], "none.toml: "),
        (["--task", "wrong.toml"], "wrong.toml: speed is not a key here"),
        (["--task", "few.toml"], "few.toml: training.matches: 2 are too few for these line-ups; possible are "),
        (["--task", "."], ".: it is not a file"),
        (["--from", "nobody"], "no brain 'nobody'"),
        (["--from", "hand3"], "hand3 is not a network"),
        (["--from", str(BRAINS / "race.npz")], "race.npz: it plays race, not pitanks"),
        (["--decisions", "1000"], "--decisions"),
        (["--out", "nowhere/a.npz"], "no such folder"),
        (["nonsense"], "no game 'nonsense'"),
        (["--resume"], "a.checkpoint.npz: cannot be read"),
        ([*SET, "--resume", "--out", "foreign.npz"], "foreign.checkpoint.npz: not a checkpoint"),
    ],
)
def test_a_wrong_option_is_one_line_and_exit_code_2(tmp_path, refused, monkeypatch, more, word):
    monkeypatch.chdir(tmp_path)
    Path("foreign.checkpoint.npz").write_text("text")
    Path("wrong.toml").write_text("speed = 1")
    Path("few.toml").write_text(text_of(file_of(replace(TASKS["pitanks"], hyper=Hyper(matches=2)))))
    length = [] if "--minutes" in more and "nan" in more else ["--updates", "1"]
    assert word in refused("train", "ppo", *length, "--out", "a.npz", *more)
    assert not (tmp_path / "a.npz").exists()


def test_a_game_that_has_no_encoding_is_refused_with_those_that_learn(tmp_path, refused, monkeypatch):
    monkeypatch.delitem(TASKS, "race")
    for job in (["train", "ppo", "race"], ["exploit", "hand3", "--game", "race"]):
        assert "learns pitanks, factory, football only, not race" in refused(*job, "--out", str(tmp_path / "a.npz"))


def test_without_numba_it_names_the_extra(tmp_path, refused, monkeypatch):
    monkeypatch.setitem(sys.modules, "numba", None)
    assert "numba is missing (extra `train`)" in refused("train", "ppo", "--out", str(tmp_path / "a.npz"))


@pytest.mark.usefixtures("_plain")
def test_the_number_of_threads_changes_no_bit(tmp_path, monkeypatch):
    for name, processors in (("a.npz", 1), ("b.npz", 3)):
        monkeypatch.setattr(os, "cpu_count", lambda count=processors: count)
        assert train(tmp_path / name, updates="1") == 0
    assert weights(tmp_path / "a.npz") == weights(tmp_path / "b.npz")


@pytest.mark.again  # in the Lab: tests/ai/ppo/test_lab.py
@pytest.mark.long(first=True)
def test_a_short_training_beats_a_driver_by_hand_whatever_the_threads(tmp_path):
    """The real task, compiled, in processes of their own: 60 updates, and the same bits with one processor."""
    job = [sys.executable, "-X", "pigaming", "main.py", "train", "ppo", "pitanks", "--updates", "60", "--json", "--out"]
    many = subprocess.run([*job, str(tmp_path / "a.npz")], cwd=ROOT, check=True, capture_output=True, text=True)
    one = [
        sys.executable,
        "-c",
        f"import os, runpy, sys; os.cpu_count = lambda: 1; sys.argv = {['main.py', *job[4:]]!r}",
    ]
    one[-1] += f" + [{str(tmp_path / 'b.npz')!r}]; runpy.run_path('main.py', run_name='__main__')"
    subprocess.run([one[0], "-X", "pigaming", *one[1:]], cwd=ROOT, check=True, capture_output=True)
    assert weights(tmp_path / "a.npz") == weights(tmp_path / "b.npz")
    assert json.loads(many.stdout)["rivals"]["hand3"]["wins"] > 20
