"""The command line: jobs succeed, errors take one clear line."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from pigaming_app.games.replay import decode, pack
from pigaming_app.jobs.cli import main
from pigaming_app.jobs.registry import jobs
from pigaming_app.jobs.terminal import refusal
from pigaming_app.storage.settings import Settings, folders

ROOT = Path(__file__).resolve().parents[1]
SHORT = ["--headless", "--speed", "max", "--minutes", "0.1", "--variant", "pickups", "--seats", "fsm,level1,off,off"]


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path / "home"))


def test_a_match_without_a_window_tells_its_result(capsys):
    assert main(["play", *SHORT, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert [row["seat"] for row in told["rows"]] == [1, 2] or [row["seat"] for row in told["rows"]] == [2, 1]
    assert told["match_seconds"] == pytest.approx(6.0)


def test_rounds_are_played_until_one_side_has_won_most(capsys):
    words = "play pitanks --variant pickups --rounds 3 --minutes 0.05 --headless --speed max --seats level5,idle --json"
    assert main(words.split()) == 0
    result = json.loads(capsys.readouterr().out)
    assert 2 <= len(result["rounds"]) <= 3
    wins = {row["seat"]: row["wins"] for row in result["rows"]}
    assert wins == {seat: sum(seat in one["winners"] for one in result["rounds"]) for seat in (1, 2)}
    assert result["match_seconds"] == pytest.approx(3.0 * len(result["rounds"]))


def test_a_round_lasts_a_minute(capsys):
    words = "play pitanks --variant pickups --rounds 3 --headless --speed max --seats random,idle --json"
    assert main(words.split()) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["match_seconds"] == pytest.approx(60.0 * len(result["rounds"]))


def test_a_recorded_match_is_proven(tmp_path, capsys):
    file = tmp_path / "a.replay"
    assert main(["play", *SHORT, "--record", str(file)]) == 0
    assert main(["replay", str(file), "--verify"]) == 0
    assert "the same" in capsys.readouterr().out


@pytest.mark.parametrize(("change", "code", "word"), [({}, 0, "the same"), ({"digest": "0"}, 1, "DIFFERENTLY")])
def test_a_replay_of_another_engine_is_compared_with_a_warning(change, code, word, tmp_path, capsys):
    file = tmp_path / "pitanks.replay"
    assert main(["play", *SHORT, "--record", str(file)]) == 0
    replay = decode(file.read_bytes(), "")
    capsys.readouterr()
    file.write_bytes(pack(replace(replay, engine="another", **change)))
    assert main(["replay", str(file), "--verify"]) == code
    told = capsys.readouterr()
    assert word in told.out
    assert told.err == f"{file.name}: recorded with another version of the engine; it may play out differently\n"


def test_a_picture_is_taken(tmp_path):
    picture = tmp_path / "a.png"
    assert main(["play", *SHORT, "--screenshot", str(picture), "--at", "3"]) == 0
    assert picture.stat().st_size > 10_000


@pytest.mark.parametrize("emulated", [[], ["--emulate"], ["--emulate", "--headless"]])
@pytest.mark.parametrize("where", ["option", "settings"])
def test_robots_without_a_deadman_are_refused_for_matches(where, emulated, capsys):
    radio = ["--radio", "stock"]
    if where == "settings":
        Settings(radio="stock").save(folders().config)
        radio = []
    assert main(["play", "--seats", "fsm,level1,off,off", "--real", "1", *radio, *emulated]) == 2
    told = capsys.readouterr().err.strip()
    assert "no deadman" in told
    assert "\n" not in told


@pytest.mark.parametrize("job", [[], ["play"]])
def test_things_are_put_on_the_emulated_mat_only(job, capsys):
    assert main([*job, "--things", "3"]) == 2
    told = capsys.readouterr().err.strip()
    assert "add --emulate" in told
    assert "\n" not in told


def test_robots_without_a_deadman_do_not_dance_either(tmp_path, capsys):
    Settings(radio="stock").save(folders().config)
    assert main(["fidelity", "record", str(tmp_path / "run.jsonl")]) == 2
    assert "no deadman" in capsys.readouterr().err


def test_a_duel_prints_one_object(capsys):
    duel = ["duel", "pitanks", "level5", "idle", "--matches", "4", "--seed", "1", "--minutes", "0.2", "--json"]
    assert main(duel) == 0
    told = json.loads(capsys.readouterr().out)
    wanted = {"game", "left", "right", "matches", "wins", "ties", "losses", "wilson95"}
    wanted |= {"mean_score_left", "mean_score_right", "seconds", "ticks_per_second"}
    assert set(told) == wanted
    assert told["wins"] + told["ties"] + told["losses"] == 4


@pytest.mark.parametrize(
    "arguments",
    [
        ["nonsense"],
        ["play", "--seats", "fsm,wizard"],
        ["play", "--seats", "fsm,off", "--real", "2"],
        ["play", "--real", "one"],
        ["play", "--real", "1", "--headless"],
        ["play", "--real", "1", "--speed", "3"],
        ["play", "--baud", "7"],
        ["play", "--radio", "morse"],
        ["--camera", "-1"],
        ["play", "--seats", "fsm"],
        ["play", "--seats", "fsm,fsm,fsm,fsm,fsm"],
        ["play", "chess"],
        ["play", "--game", "chess"],
        ["play", "pitanks", "race"],
        ["train", "qlearning", "race", "--out", "a.npz"],
        ["train", "qlearning", "chess", "--out", "a.npz"],
        ["train", "ppo", "chess", "--out", "a.npz"],
        ["play", "--arena", "nowhere", "--headless"],
        ["play", "--minutes", "-1"],
        ["play", "--minutes", "nan"],
        ["play", "--speed", "slow", "--headless"],
        ["play", "--teams", "1,1,1,1"],
        ["play", "--teams", "a,b"],
        ["play", "--record", "/nowhere/at/all.replay", "--headless"],
        ["play", "race", "--rounds", "3", "--headless"],
        ["play", "--rounds", "2", "--headless"],
        ["play", "--rounds", "3", "--record", "a.replay", "--headless"],
        ["replay", "/nowhere"],
        ["duel", "pitanks", "fsm", "wizard"],
        ["duel", "pitanks", "fsm", "level1", "--matches", "0"],
        ["duel", "chess", "fsm", "level1"],
        ["bench", "chess"],
    ],
    ids=" ".join,
)
def test_what_is_wrong_is_one_line_and_exit_code_2(arguments, capsys):
    assert main(arguments) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert len(captured.err.strip().splitlines()) == 1


def test_every_job_describes_its_options_without_numpy():
    code = (
        "import sys\nsys.modules['numpy'] = None\nfrom pigaming_app.jobs.cli import main\n"
        "from pigaming_app.jobs.registry import jobs\nfor job in jobs(): assert main([job, '--help']) == 0\n"
        "assert 'pygame' not in sys.modules"
    )
    told = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert told.count("usage: ") == len(jobs())
    modules = ROOT.glob("pigaming_app/jobs/*.py")
    declaring = {path.stem for path in modules if "\ndef run(options:" in path.read_text(encoding="utf-8")}
    assert declaring == {job.module for job in jobs().values() if not job.package}


@pytest.mark.parametrize(
    ("words", "extra"),
    [
        (["--emulate"], "hardware"),
        (["play", "--emulate"], "hardware"),
        (["calibrate", "--sheet", "a.pdf"], "hardware"),
        (["robots", "--pair"], "hardware"),
        (["fidelity", "record", "a.jsonl", "--emulate"], "hardware"),
        (["fidelity", "identify", "a.jsonl", "--plots", "a"], "plots"),
        (["bench", "robots"], "hardware"),
        (["train", "qlearning", "--out", "a.npz", "--curve", "a.png"], "plots"),
        (["train", "ppo", "--out", "a.npz", "--curve", "a.png"], "plots"),
    ],
    ids=lambda words: " ".join(words) if isinstance(words, list) else words,
)
@pytest.mark.parametrize("installed", [False, True])
def test_a_missing_extra_is_one_line_with_the_way_to_install_it(words, extra, installed, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(refusal, "INSTALLED", installed)
    for module in ("cv2", "serial", "matplotlib"):
        monkeypatch.setitem(sys.modules, module, None)
    assert main(words) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert f"extra `{extra}`" in said
    assert (f"pip install '.[{extra}]'" in said) is installed
    assert ("main.py" in said) is not installed


def test_no_display_is_said_with_the_way_out(monkeypatch, capsys):
    for name in ("SDL_VIDEODRIVER", "DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    if os.name == "posix":
        assert main([]) == 2
        assert "--headless" in capsys.readouterr().err
