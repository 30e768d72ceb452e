"""Hostile option values: each is accepted, or refused in one line with exit code 2."""

import contextlib
import io
import json
import os
import random
import subprocess
import sys
from pathlib import Path

import pygame
import pytest

from pigaming_app import ASSETS
from pigaming_app.jobs import cli
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.start import run
from pigaming_app.storage.parsing import MESSAGE_LENGTH
from tests.ai.ppo.plain import SET
from tests.cases import one_in
from tests.disks import content, room_for

ROOT = Path(__file__).resolve().parents[2]
POSIX = pytest.mark.skipif(os.name != "posix", reason="devices and pipes are files on POSIX only")

WORDS = ("", " ", "a" * 256, "a" * 5000, "a\nb", "\x1b[2J", "\udcff\udcfe", "ÄÖ", "-", "--", "a,b,c,d,e,f", ",,,", "\0")
NUMBERS = (
    "nan", "inf", "-inf", "1e308", "-1e308", "1e400", "5e-324", "-1", "0", "-0", "0.5", "1.5", "9" * 20, "-" + "9" * 20,
    "9" * 400, "9" * 5000, "0x10", "1_0", "١", "1e5", "+1", "1,1",
)  # fmt: skip
FILES = (
    "/dev/full", "/dev/null", "/dev/zero", "/", ".", "..", "/proc/self/mem", "/nowhere/a", "x" * 256 + ".toml",
    "a\n.toml", "\udcff.toml", "PIPE", "FOLDER", "FILE", "FILE/a", "LOOP", "BINARY.toml",
    "DEEP.toml", "x.txt", "x.png/", "x.npz",
)  # fmt: skip
ANY = WORDS + NUMBERS + FILES
SHORT = ["--headless", "--speed", "max", "--minutes", "0.05", "--seats", "fsm,level1"]
PLAY = ["play", *SHORT]
DUEL = ["duel", "pitanks", "level1", "idle", "--matches", "1", "--minutes", "0.05"]
LEAGUE = ["league", "pitanks", "level1", "idle", "--matches", "1", "--minutes", "0.05"]
TRAIN = ["train", "qlearning", "--matches", "1", "--minutes", "0.05", "--plain", "--out", "a.npz"]
PPO = ["train", "ppo", *SET, "--out", "foreign.npz", "--resume"]  # refused at the latest for its foreign checkpoint
OPTIONS = {
    (): ("--display", "--frames", "--camera", "--port", "--baud", "--radio", "--emulate", ""),
    tuple(PLAY): (
        "--seats", "--teams", "--arena", "--minutes", "--variant", "--laps", "--pallets", "--seed", "--speed",
        "--rounds", "--record", "--screenshot", "--at", "--robots", "--real", "--camera", "--port", "--baud", "--radio",
        "--display", "",
    ),
    (*PLAY, "--screenshot", "a.png"): ("--at",),
    tuple(DUEL): ("--matches", "--seed", "--minutes", "--arena", "--variant", "--laps", "--pallets", ""),
    tuple(LEAGUE): ("--matches", "--seed", "--minutes", "--arena", "--variant", "--laps", "--pallets", ""),
    tuple(TRAIN): ("--reward", "--matches", "--minutes", "--seed", "--arena", "--out", "--set", "--curve", "--csv", ""),
    tuple(PPO): (
        "--updates", "--decisions", "--minutes", "--from", "--task", "--seed", "--out", "--set",
        "--curve", "--csv", "--population", "--tensorboard", "--copies", "--ray", "--workers", "",
    ),
    ("exploit", *SET, "--out", "foreign.npz", "--resume"): (
        "--game", "--variant", "--decisions", "--seed", "--set", "--out", "--curve", "--csv", "",
    ),
    ("train", "task"): ("",),
    ("replay", "--verify"): ("",),
    ("bench",): ("",),
    ("train", "qlearning", "--out", "a.npz"): ("",),
    ("duel", "pitanks", "level1"): ("",),
    ("calibrate", "--sheet", "a.pdf"): ("--edge", "--camera", "--display", "--emulate", "--sheet", ""),
    ("robots", "--nonsense"): ("--camera", "--port", "--emulate", ""),
    ("fidelity", "replay"): ("",),
    ("fidelity", "identify"): ("",),
    ("fidelity",): ("",),
    ("fidelity", "replay", "no-such-run"): (
        "--seconds", "--out", "--plots", "--robots", "--camera", "--port", "--emulate",
    ),
    ("doctor", "--nonsense"): ("",),
}  # fmt: skip
SLOW = {  # valid values that make a job run for a long time
    "--minutes": ("0.5", "1.5", "+1", "1_0"),
    "--matches": ("1e5", "1_0", "9" * 20),
    "--speed": ("0.5", "1.5", "1_0"),
    "--seed": (),
}


def cases():
    """Every value for every option of every job, as a command line."""
    for job, options in OPTIONS.items():
        for option in options:
            for value in ANY:
                if value in SLOW.get(option, ()) or (job == () and (value in ("", "-", "--"))):
                    continue
                yield [*job, *([option] if option else []), value]


def furnish(here):
    """Create odd files in a folder."""
    (here / "FOLDER").mkdir()
    (here / "FILE").write_text("text")
    (here / "BINARY.toml").write_bytes(bytes(range(256)))
    (here / "DEEP.toml").write_text("a = " + "[" * 5000)
    (here / "foreign.checkpoint.npz").write_text("text")
    (here / "LOOP").symlink_to("LOOP")
    if hasattr(os, "mkfifo"):
        os.mkfifo(here / "PIPE")


def fault(arguments):
    """The fault in the answer to a command line, or None."""
    out, err = io.StringIO(), io.StringIO()
    pygame.display.quit()
    os.environ["SDL_VIDEODRIVER"] = "nonexistent"  # no window, so that nothing waits for input
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            code = cli.main(arguments)
        except BaseException as error:
            return f"{type(error).__name__}: {error}"
    lines = err.getvalue().splitlines()
    if code == 2:
        good = not out.getvalue() and len(lines) == 1 and lines[0].isprintable() and len(lines[0]) <= 2 * MESSAGE_LENGTH
        return None if good else f"code 2 with {lines} and {out.getvalue()!r}"
    return None if code == 0 else f"code {code} with {lines}"


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Change to a folder with odd files."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setenv("SDL_AUDIODRIVER", "dummy")
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    furnish(tmp_path / "here")
    return tmp_path / "here"


@POSIX
@pytest.mark.parametrize("seed", one_in(4, range(4)))
def test_every_value_is_used_or_refused_in_one_line(here, seed):
    faults = {repr(case): wrong for case in random.Random(seed).sample(list(cases()), 60) if (wrong := fault(case))}
    assert not faults


RACE = ["play", "race", "--headless", "--speed", "max", "--laps", "1", "--minutes", "2", "--seats", "level5,level5"]


@pytest.mark.parametrize(("match", "at"), [*((PLAY, at) for at in ("0", "0.5", "3", "3600")), (RACE, "3600")])
def test_a_picture_is_there_whenever_it_was_asked_for(here, match, at):
    """Of a match that ends before, it shows the end."""
    assert cli.main([*match, "--screenshot", "a.png", "--at", at]) == 0
    assert pygame.image.load(here / "a.png").get_size() == (1920, 1080)


def test_every_match_that_can_be_asked_for_has_a_replay_that_is_proven(here, capsys):
    (here / "é\n.toml").write_text((ASSETS / "arenas/pitanks/classic.toml").read_text() + "# é\n" * 15_000)
    for more in (
        ["--teams", "3,1,0,2"],
        ["--seed", str(-(2**60))],
        ["--seed", str(2**60 - 1)],
        ["--arena", "é\n.toml"],
        ["--minutes", "0.0501"],
    ):
        assert cli.main([*PLAY, *more, "--record", "a.replay"]) == 0
        assert cli.main(["replay", "a.replay", "--verify"]) == 0
    assert cli.main([*PLAY, "--teams", "0,1,99999999999999999999,2", "--record", "b.replay"]) == 2
    assert "teams are numbers from 0 to 3" in capsys.readouterr().err
    assert not (here / "b.replay").exists()


@POSIX
def test_a_full_disk_after_the_match_costs_the_files_and_not_the_result(here, capsys):
    job = [*PLAY, "--json", "--record", "a.replay", "--screenshot", "a.png", "--at", "1"]
    assert cli.main(job) == 0
    before, _ = content(here), capsys.readouterr()
    with room_for(500):
        assert cli.main([*job, "--seed", "2"]) == 2
    output = capsys.readouterr()
    assert json.loads(output.out)["game"] == "pitanks"
    assert output.err.splitlines() == ["PiGaming: a.replay was not saved: File too large."]
    assert content(here) == before


@POSIX
def test_a_full_disk_leaves_no_piece_of_a_page_of_markers(here, capsys):
    with room_for(1000):
        assert cli.main(["calibrate", "--sheet", "a.pdf"]) == 2
    assert capsys.readouterr().err == "PiGaming: a.pdf was not saved: File too large.\n"
    assert not (here / "a.pdf").exists()


def subprocess_of(arguments, here, **extra):
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **extra}
    environment.pop("PYTHONUNBUFFERED", None)
    command = [sys.executable, "-X", "pigaming", ROOT / "main.py", *arguments]
    return subprocess.Popen(command, cwd=here, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


@POSIX
def test_bytes_that_are_no_text_and_a_narrow_encoding_are_no_trouble(here):
    for arguments in ([b"replay", b"\xff\xfe\n"], [*map(os.fsencode, PLAY), b"--arena", b"\xc3\xa9\xff"]):
        with subprocess_of(arguments, here, PYTHONIOENCODING="ascii", LC_ALL="C") as process:
            out, err = process.communicate(timeout=60)
        assert (process.returncode, out, len(err.splitlines())) == (2, b"", 1)
    with subprocess_of(["calibrate", "--sheet", b"\xff\xc3\xa9.pdf"], here, PYTHONIOENCODING="ascii") as process:
        assert process.wait(timeout=60) == 0


@POSIX
@pytest.mark.parametrize("arguments", one_in(3, [["--help"], ["doctor"], DUEL]), ids=" ".join)
def test_a_reader_that_leaves_a_full_disk_and_closed_streams_are_no_trouble(here, arguments):
    with subprocess_of(arguments, here) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
        assert process.wait(timeout=60) in (0, 1)
    command = [sys.executable, "-X", "pigaming", ROOT / "main.py", *arguments]
    for streams, codes in ((">/dev/full", (0, 2)), ("2>/dev/full", (0,)), (">&- 2>&- <&-", (0,))):
        shell = ["sh", "-c", f'"$@" {streams}', "sh", *command]
        done = subprocess.run(shell, cwd=here, capture_output=True, timeout=60, check=False)
        assert done.returncode in codes
        assert b"Traceback" not in done.stderr
        assert len(done.stderr.splitlines()) <= 1


@POSIX
@pytest.mark.parametrize(
    "home", one_in(4, ["FILE", "FILE/below", "/dev/null", "/proc/nowhere", "x" * 300, "\n", "\udcff", "LOOP"])
)
def test_an_odd_home_is_no_trouble(here, monkeypatch, capsys, home):
    monkeypatch.setenv("PIGAMING_HOME", home)
    for arguments in (DUEL, [*PLAY, "--record", "a.replay"], ["doctor", "--json"]):
        assert cli.main(arguments) in (0, 1)
        assert "Traceback" not in capsys.readouterr().err
    assert run(Options(headless=True, frames=2, step=0.02)) == 0
    assert "Traceback" not in capsys.readouterr().err


def test_what_a_killed_process_left_is_swept_at_the_next_start_or_recording(here, home):
    places = [home / name for name in ("config", "data", "data/ghosts", "data/robots")]
    for folders, job in ((places, ["--frames", "1"]), ([here], [*PLAY, "--record", "a.replay"])):
        for folder in folders:
            folder.mkdir(parents=True, exist_ok=True)
            (folder / ".pigaming-0123abcd.tmp").write_text("half")
        assert cli.main(job) == 0
        assert not any((folder / ".pigaming-0123abcd.tmp").exists() for folder in folders)
