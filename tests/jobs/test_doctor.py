"""The doctor reports missing parts with advice, never raises, and does not wait for hanging drivers."""

import json
import shutil
import subprocess
import sys
import tempfile
from types import SimpleNamespace

import pytest

from pigaming_app import __version__
from pigaming_app.boot import version
from pigaming_app.boot.interpreter import StartError
from pigaming_app.hardware.vision import discovery
from pigaming_app.jobs import doctor
from pigaming_app.jobs.cli import main
from pigaming_app.storage.pin import PinFile
from pigaming_app.storage.restarts import Restart, append_restart
from pigaming_app.storage.settings import Settings, folders
from tests.hardware.vision.test_stream import CameraServer

WELL = [
    ["pygame", "pygame-ce 2.5.8", ""],
    ["displays", "1920 × 1080", ""],
    ["sound", "a card", ""],
    ["fonts", "all", ""],
]


@pytest.fixture(autouse=True)
def _probed(monkeypatch, home):
    answer(monkeypatch, *WELL, ["pads", "Xbox pad", ""])


def answer(monkeypatch, *lines):
    """Make the probe print this."""
    output = "".join(json.dumps(line) + "\n" for line in lines).encode()
    monkeypatch.setattr(subprocess, "run", lambda *_, **__: SimpleNamespace(stdout=output))


def line(what):
    (found,) = (one for one in doctor.report() if one.what == what)
    return found


def test_restarts_of_a_kiosk_are_a_note(home):
    assert "kiosk restarts" not in [one.what for one in doctor.report()]
    for detail in ("exit code 1", "ended by SIGSEGV"):
        append_restart(home / "data", Restart("2026-05-09T14:30:00+01:00", "crash", detail, 12.5, "crashes/a.txt"))
    found = line("kiosk restarts")
    assert found.state == "note"
    assert found.found == "2, the last one at 2026-05-09T14:30:00+01:00 (crash: ended by SIGSEGV)"
    assert "crashes" in found.advice


def test_where_all_is_well_the_exit_code_is_zero(capsys):
    assert main(["doctor"]) == 0
    assert capsys.readouterr().out.endswith("All is well.\n")
    assert main(["doctor", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["ok"]
    assert {"what": "pads", "state": "ok", "found": "Xbox pad", "advice": ""} in report["lines"]
    assert all(one["advice"] for one in report["lines"] if one["state"] != "ok")
    (version_line,) = [one for one in report["lines"] if one["what"] == "PiGaming"]
    assert version_line["found"] == f"{__version__}, commit {version.commit()}"


def test_without_a_display_one_can_still_play_headless(monkeypatch):
    answer(monkeypatch, *WELL, ["displays", "", "no screen is connected"])
    assert line("displays").state == "note"
    assert "--headless" in line("displays").advice


def test_a_driver_that_hangs_costs_only_its_own_lines(monkeypatch):
    def hang(*_, timeout, **__):
        raise subprocess.TimeoutExpired(
            "probe", timeout, output=b'["pygame", "pygame-ce 2.5.8", ""]\n["displays", "one'
        )

    monkeypatch.setattr(subprocess, "run", hang)
    assert line("pygame").state == "ok"
    assert line("displays").found == "its driver did not answer"


def test_a_pygame_that_cannot_be_imported_is_a_problem(monkeypatch, capsys):
    answer(monkeypatch)
    assert main(["doctor"]) == 1
    assert "problem  pygame" in capsys.readouterr().out


NEEDED = {"pygame-ce": "2.5.8", "platformdirs": "4.3", "tomli-w": "1.2", "msgspec": "0.20"}


@pytest.mark.parametrize(
    ("packages", "what", "state", "found"),
    [
        (NEEDED | {"numpy": "2.3.0", "pygame": "2.6.1"}, "pygame", "problem", ""),
        (NEEDED | {"numpy": "2.3.0", "pygame": "2.6.1"}, "numba", "note", ""),
        (NEEDED, "numpy", "problem", ""),
        ({"numpy": "1.26"}, "numpy", "problem", "1.26, but numpy>="),
    ],
)
def test_packages_that_are_missing_too_old_or_in_the_way_are_named(monkeypatch, packages, what, state, found):
    monkeypatch.setattr(doctor, "packages", lambda _: packages)
    lines = [one for one in doctor.report() if one.what == what]
    assert state in [one.state for one in lines]
    assert any(one.found.startswith(found) for one in lines)


def test_a_project_file_that_cannot_be_read_is_a_line(monkeypatch):
    def refuse(_):
        raise StartError("pyproject.toml cannot be read")

    monkeypatch.setattr(doctor, "requirements", refuse)
    assert line("packages").state == "problem"


def test_folders_that_cannot_be_written_are_named_and_none_is_made(monkeypatch, home):
    assert line("settings").found == str(home / "config")
    assert not home.exists()

    def refuse(dir):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(tempfile, "TemporaryFile", refuse)
    assert line("scores").state == "note"
    assert "nothing will be kept" in line("scores").advice


@pytest.mark.parametrize(("free", "state"), [(199_999_999, "note"), (2_000_000_000, "ok")])
def test_free_space_is_named_and_below_200_mb_a_finding(free, state, monkeypatch):
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=free))
    found = line("free space")
    assert (found.state, found.found.partition(" for ")[0]) == (state, f"{free // 1_000_000:,} MB")
    assert bool(found.advice) == (state == "note")


def test_a_broken_engine_is_a_problem(monkeypatch):
    monkeypatch.setitem(sys.modules, "pigaming_app.games.setup", None)
    assert line("engine").state == "problem"


def test_a_broken_arena_is_named(monkeypatch):
    from pigaming_app.games import arenas
    from pigaming_app.sim.arena import ArenaError

    def broken(_game, name):
        raise ArenaError(f"{name}.toml: walls[0].ax: not a number")

    monkeypatch.setattr(arenas, "load", broken)
    lines = [one for one in doctor.report() if one.what == "arena"]
    assert lines
    assert "walls[0].ax" in lines[0].found


@pytest.mark.parametrize(
    ("platform", "desktop", "pin", "state", "words"),
    [
        ("linux", "", True, "ok", []),
        ("linux", "", False, "note", ["no PIN"]),
        ("linux", "GNOME", True, "note", ["Ctrl+Alt+F2", "GNOME"]),
        ("win32", "", True, "note", ["Ctrl+Alt+Del"]),
        ("darwin", "", False, "note", ["no PIN", "Command+Option+Escape"]),
    ],
)
def test_it_warns_when_visitors_can_leave_a_kiosk(monkeypatch, home, platform, desktop, pin, state, words):
    for name in ("XDG_CURRENT_DESKTOP", "DESKTOP_SESSION"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("XDG_CURRENT_DESKTOP", desktop)
    if pin:
        PinFile(home / "config").set("274918")
    monkeypatch.setattr(sys, "platform", platform)
    found = doctor._kiosk(home / "config")
    assert found.state == state
    assert all(word in found.found for word in words)
    assert bool(found.advice) == (state != "ok")


@pytest.mark.parametrize(
    ("system", "state", "words", "formats"),
    [
        ("linux", "ok", "2 (Eye of the mat), 3 (Ear)", {"2": "ok", "3": "note", "4": "note"}),
        ("darwin", "note", "no exposure can be set", {"2": "ok"}),
        ("win32", "ok", "powers of two", {"2": "ok"}),
        ("freebsd", "ok", "names and other sizes are not told", {"2": "ok"}),
    ],
)
def test_cameras_have_formats_and_what_a_system_does_not_tell_of_them_is_said(
    monkeypatch, tmp_path, system, state, words, formats
):
    """Outside Linux, a number without a camera is no finding. The third camera's driver crashes."""
    for number, name in ((2, "Eye of the mat"), (3, "Ear"), (4, "Nose")):
        camera = tmp_path / f"video{number}"
        camera.mkdir()
        (camera / "name").write_text(f"{name}\n")
        (camera / "index").write_text("0\n")
    monkeypatch.setattr(discovery, "DEVICES", tmp_path)
    monkeypatch.setattr(sys, "platform", system)
    others = [["0", ""], ["1", ""]] if system != "linux" else []
    answer(monkeypatch, *others, ["2", "1280 × 720, 30 Hz"], *([["3", ""]] if system == "linux" else []))
    first, *rest = doctor._cameras()
    assert (first.what, first.state) == ("cameras", state)
    assert words in first.found
    assert {line.what.removeprefix("camera "): line.state for line in rest} == formats
    assert rest[0].found == "1280 × 720, 30 Hz"
    assert all(line.advice for line in (first, *rest) if line.state != "ok")


@pytest.fixture
def chosen_camera(monkeypatch, tmp_path):
    """A function that chooses a camera in the settings of a computer without any, and returns the doctor's lines."""
    monkeypatch.undo()
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path / "home"))
    monkeypatch.setattr(discovery, "DEVICES", tmp_path / "none")
    monkeypatch.setattr(sys, "platform", "linux")

    def lines(camera):
        Settings(camera=camera).save(folders().config)
        return [*doctor._cameras()]

    return lines


def test_the_camera_of_the_settings_is_opened_at_its_address_and_its_password_stays_there(chosen_camera, capsys):
    pytest.importorskip("cv2")
    server = CameraServer()
    none, there = chosen_camera(server.url.replace("://", "://kid:secret@"))
    server.close()
    assert (none.found, there.what, there.state) == ("none", "camera of settings", "ok")
    assert there.found.startswith("127.0.0.1: 640 × 360, ")
    _, gone = chosen_camera("http://kid:secret@127.0.0.1:9/video")
    assert (gone.state, gone.found) == ("note", "127.0.0.1: it does not open")
    assert "password" in gone.advice
    assert "secret" not in f"{there} {gone} {capsys.readouterr()}"


def test_a_phone_as_the_camera_is_named(chosen_camera):
    none, phone = chosen_camera("phone")
    assert (none.found, phone.state) == ("none", "ok")
    assert "phone" in phone.found


def test_without_cameras_none_is_opened(monkeypatch, tmp_path):
    monkeypatch.setattr(discovery, "DEVICES", tmp_path)
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(subprocess, "run", None)
    (only,) = doctor._cameras()
    assert only.found.startswith("none")
