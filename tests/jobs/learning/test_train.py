"""The job `train`: training, resuming from a file, and refusals in one line."""

import csv
import json
import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from pigaming_app.ai.learning.training import TableTraining
from pigaming_app.ai.qlearning import table_files as tables
from pigaming_app.ai.qlearning.recipe import RECIPES
from pigaming_app.jobs.cli import main
from pigaming_app.sim.record import digest
from pigaming_app.ui.i18n import Words
from tests.disks import content, failing_at, room_for

ROOT = Path(__file__).resolve().parents[3]


def read(path):
    """Load a trained table."""
    return tables.decode(path.read_bytes(), path.name)


def train(out, *more):
    return main(["train", "qlearning", "--plain", "--minutes", "0.1", "--matches", "4", "--out", str(out), *more])


def test_the_job_trains_and_prints_its_result(tmp_path, capsys):
    out, log = tmp_path / "a.npz", tmp_path / "a.csv"
    assert train(out, "--reward", "2", "--seed", "5", "--csv", str(log), "--json") == 0
    output = capsys.readouterr()
    result = json.loads(output.out)
    assert (result["matches"], result["experiences"], result["finished"]) == (4, 480, True)
    assert result["wins"] + result["ties"] + result["losses"] == result["measured"]
    assert "4/4 matches" in output.err
    assert "480 experiences" in output.err
    assert f"{Words('en')('lobby.classic').lower()} " in output.err
    rows = list(csv.DictReader(log.read_text().splitlines()))
    assert [row["matches"] for row in rows] == ["0", "1", "2", "3", "4"]
    learner = TableTraining(RECIPES[2], 5, fast=False, minutes=0.1)
    learner.run(1200)
    assert digest(read(out).rows[0]) == digest(learner._tables[0])


def test_the_job_goes_on_from_a_file(tmp_path, capsys):
    assert train(tmp_path / "whole.npz") == 0
    assert train(tmp_path / "part.npz", "--matches", "1") == 0
    assert train(tmp_path / "part.npz", "--resume") == 0
    whole, part = (read(tmp_path / f"{name}.npz") for name in ("whole", "part"))
    assert digest(whole.rows[0]) == digest(part.rows[0])


def test_the_job_goes_on_from_a_table_of_another_engine_with_a_warning(tmp_path, capsys):
    out = tmp_path / "a.npz"
    assert train(out, "--matches", "1") == 0
    out.write_bytes(tables.encode(replace(read(out), engine="0" * 64)))
    capsys.readouterr()
    assert train(out, "--resume") == 0
    assert "a.npz: trained with another version of the engine" in capsys.readouterr().err
    assert not read(out).other_engine


def test_a_file_that_cannot_be_resumed_is_refused_in_one_line(tmp_path, capsys):
    out = tmp_path / "a.npz"
    assert train(out, "--resume") == 2
    assert train(out, "--matches", "1") == 0
    capsys.readouterr()
    for word, more in (("reward", ["--reward", "2"]), ("seed", ["--seed", "9"]), ("reward", ["--set", "gamma=0.5"])):
        assert train(out, "--resume", *more) == 2
        output = capsys.readouterr()
        assert (output.out, output.err.count("\n")) == ("", 1)
        assert f"another {word}" in output.err


@pytest.mark.parametrize(
    ("more", "word"),
    [
        (["--reward", "3"], "--reward"),
        (["--matches", "0"], "--matches"),
        (["--minutes", "0"], "--minutes"),
        (["--minutes", "nan"], "--minutes"),
        (["--arena", "nowhere"], "nowhere"),
        (["--set", "gamma=2"], "gamma"),
        (["--set", "gamma=much"], "much"),
        (["--set", "speed=2"], "speed"),
        (["--out", "/nowhere/a.npz"], "--out"),
        (["--out", "a.txt"], ".npz"),
        (["--csv", "/nowhere/a.csv"], "--csv"),
        (["--csv", "./same.npz", "--out", "same.npz"], "another file"),
        (["--curve", "a.xyz"], ".png"),
    ],
)
def test_a_wrong_option_is_one_line_and_exit_code_2(tmp_path, capsys, more, word):
    assert train(tmp_path / "a.npz", *more) == 2
    output = capsys.readouterr()
    assert (output.out, output.err.count("\n")) == ("", 1)
    assert word in output.err
    assert not (tmp_path / "a.npz").exists()


def test_a_disk_that_is_full_from_the_start_is_refused_before_the_training(tmp_path, capsys):
    with failing_at(0):
        assert train(tmp_path / "a.npz") == 2
    assert capsys.readouterr().err == f"PiGaming: {tmp_path / 'a.npz'} cannot be written: the disk is full.\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no such device here")
def test_a_device_is_refused_before_the_training(tmp_path, capsys):
    (tmp_path / "a.csv").symlink_to("/dev/full")
    assert train(tmp_path / "a.npz", "--csv", str(tmp_path / "a.csv")) == 2
    assert f"{tmp_path / 'a.csv'} cannot be written: it is not a file" in capsys.readouterr().err
    assert not (tmp_path / "a.npz").exists()


@pytest.mark.skipif(os.name != "posix", reason="limits of POSIX")
@pytest.mark.parametrize("size", [0, 1000])
def test_a_disk_that_is_full_after_the_training_leaves_the_table_before(tmp_path, capsys, size):
    assert train(tmp_path / "a.npz") == 0
    before = content(tmp_path)
    with room_for(size):
        assert train(tmp_path / "a.npz", "--seed", "2") == 2
    assert "a.npz was not saved: File too large." in capsys.readouterr().err
    assert content(tmp_path) == before


def test_a_curve_without_matplotlib_is_refused_before_the_training(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert train(tmp_path / "a.npz", "--curve", str(tmp_path / "a.png")) == 2
    assert "matplotlib" in capsys.readouterr().err
    assert not (tmp_path / "a.npz").exists()


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to another process there")
def test_ctrl_c_keeps_what_has_been_learned(tmp_path):
    out = tmp_path / "a.npz"
    job = [sys.executable, "main.py", "train", "qlearning", "--plain", "--minutes", "0.1", "--out", str(out)]
    running = subprocess.Popen([*job, "--matches", "400"], cwd=ROOT, stderr=subprocess.PIPE, stdout=subprocess.PIPE)
    assert running.stderr is not None
    assert b"Ctrl-C" in running.stderr.readline()
    assert b"/400 matches" in running.stderr.readline()
    running.send_signal(signal.SIGINT)
    _, errors = running.communicate(timeout=60)
    assert running.returncode == 130
    assert errors.endswith(b"PiGaming: stopped before the end; continue with --resume\n")
    trained = read(out)
    assert trained.matches > 0
    assert int(trained.rows["experiences"][0]) == 120 * trained.matches
