"""The job `train`: training, resuming from a file, and refusals in one line."""

import csv
import json
import os
import signal
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

TRAIN = ["train", "qlearning", "--plain", "--minutes", "0.1", "--matches", "4", "--out"]


def read(path):
    """Load a trained table."""
    return tables.decode(path.read_bytes(), path.name)


def train(out, *more):
    return main([*TRAIN, str(out), *more])


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


def test_a_file_that_cannot_be_resumed_is_refused_in_one_line(tmp_path, refused):
    out = tmp_path / "a.npz"
    refused(*TRAIN, str(out), "--resume")
    assert train(out, "--matches", "1") == 0
    for word, more in (("reward", ["--reward", "2"]), ("seed", ["--seed", "9"]), ("reward", ["--set", "gamma=0.5"])):
        assert f"another {word}" in refused(*TRAIN, str(out), "--resume", *more)


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
def test_a_wrong_option_is_one_line_and_exit_code_2(tmp_path, refused, more, word):
    assert word in refused(*TRAIN, str(tmp_path / "a.npz"), *more)
    assert not (tmp_path / "a.npz").exists()


def test_a_disk_that_is_full_from_the_start_is_refused_before_the_training(tmp_path, refused):
    with failing_at(0):
        line = refused(*TRAIN, str(tmp_path / "a.npz"))
    assert line == f"PiGaming: {tmp_path / 'a.npz'} cannot be written: the disk is full.\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no such device here")
def test_a_device_is_refused_before_the_training(tmp_path, refused):
    (tmp_path / "a.csv").symlink_to("/dev/full")
    line = refused(*TRAIN, str(tmp_path / "a.npz"), "--csv", str(tmp_path / "a.csv"))
    assert f"{tmp_path / 'a.csv'} cannot be written: it is not a file" in line
    assert not (tmp_path / "a.npz").exists()


@pytest.mark.skipif(os.name != "posix", reason="limits of POSIX")
def test_a_disk_that_is_full_after_the_training_leaves_the_table_before(tmp_path, capsys):
    assert train(tmp_path / "a.npz") == 0
    before = content(tmp_path)
    with room_for(1000):
        assert train(tmp_path / "a.npz", "--seed", "2") == 2
    assert "a.npz was not saved: File too large." in capsys.readouterr().err
    assert content(tmp_path) == before


def test_a_curve_without_matplotlib_is_refused_before_the_training(tmp_path, refused, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert "matplotlib" in refused(*TRAIN, str(tmp_path / "a.npz"), "--curve", str(tmp_path / "a.png"))
    assert not (tmp_path / "a.npz").exists()


def test_ctrl_c_keeps_what_has_been_learned(tmp_path, capsys, monkeypatch):
    run, presses = TableTraining.run, iter([signal.SIGINT])

    def interrupted(training, ticks):
        run(training, ticks)
        for press in presses:
            os.kill(os.getpid(), press)

    monkeypatch.setattr(TableTraining, "run", interrupted)
    out = tmp_path / "a.npz"
    assert train(out, "--matches", "400") == 130
    errors = capsys.readouterr().err
    assert "Ctrl-C" in errors
    assert errors.endswith("PiGaming: stopped before the end; continue with --resume\n")
    trained = read(out)
    assert 0 < trained.matches < 400
    assert int(trained.rows["experiences"][0]) == 120 * trained.matches
