"""Start with the session: the files of the three systems, switched on and off."""

import configparser
import json
import plistlib
import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from pigaming_app import ROOT
from pigaming_app.jobs.cli import main
from pigaming_app.jobs.kiosk import autostart

COMMAND = ["/opt/my 100%/py", '/home/a b/$HOME/`x`/q"uote\\/main.py', "--kiosk"]


def exec_words(text: str) -> list[str]:
    """The words of a key Exec, as a desktop reads them."""
    value = re.findall(r"^Exec=(.*)$", text, re.M)[0]
    value = value.replace("\\\\", "\\").replace("%%", "%")
    return [re.sub(r"\\(.)", r"\1", word) for word in re.findall(r'"((?:[^"\\]|\\.)*)"', value)]


def test_linux_has_a_desktop_entry_whose_words_are_escaped(tmp_path: Path) -> None:
    entry = autostart.start_entry("linux", tmp_path, {}, COMMAND)
    assert entry.path == tmp_path / ".config" / "autostart" / "pigaming.desktop"
    assert exec_words(entry.content.decode()) == COMMAND
    parser = configparser.RawConfigParser()
    parser.read_string(entry.content.decode())
    assert parser["Desktop Entry"]["type"] == "Application"
    elsewhere = autostart.start_entry("linux", tmp_path, {"XDG_CONFIG_HOME": "/x"}, COMMAND)
    assert elsewhere.path == Path("/x/autostart/pigaming.desktop")
    for invalid in ("", "relative"):  # XDG Base Directory Specification: to be ignored
        assert autostart.start_entry("linux", tmp_path, {"XDG_CONFIG_HOME": invalid}, COMMAND).path == entry.path


def test_windows_has_a_batch_file_in_the_start_up_folder(tmp_path: Path) -> None:
    words = ["C:\\Útil 100%\\python.exe", "C:\\a b\\main.py", "--kiosk"]
    entry = autostart.start_entry("win32", tmp_path, {"APPDATA": str(tmp_path / "Roaming")}, words)
    assert entry.path == tmp_path / "Roaming/Microsoft/Windows/Start Menu/Programs/Startup/PiGaming.bat"
    first, codepage, start, end = entry.content.decode().split("\r\n")
    assert (first, codepage, end) == ("@echo off", "chcp 65001 >nul", "")
    assert start == 'start "PiGaming" /min "C:\\Útil 100%%\\python.exe" "C:\\a b\\main.py" "--kiosk"'
    assert autostart.start_entry("win32", tmp_path, {}, words).path.is_relative_to(tmp_path / "AppData" / "Roaming")


def test_macos_has_a_launch_agent(tmp_path: Path) -> None:
    entry = autostart.start_entry("darwin", tmp_path, {}, COMMAND)
    assert entry.path.parent == tmp_path / "Library" / "LaunchAgents"
    agent = plistlib.loads(entry.content)
    assert (agent["ProgramArguments"], agent["RunAtLoad"]) == (COMMAND, True)
    assert entry.path.name == f"{agent['Label']}.plist"


HOME = "/data/my 100% $HOME `x`"


def test_every_system_sets_the_folder_of_the_users_files(tmp_path: Path) -> None:
    variables = {"PIGAMING_HOME": HOME}
    linux = autostart.start_entry("linux", tmp_path, variables, COMMAND).content.decode()
    assert exec_words(linux) == ["/usr/bin/env", f"PIGAMING_HOME={HOME}", *COMMAND]
    agent = plistlib.loads(autostart.start_entry("darwin", tmp_path, variables, COMMAND).content)
    assert agent["EnvironmentVariables"] == variables
    batch = autostart.start_entry("win32", tmp_path, variables, ["py.exe"]).content.decode().split("\r\n")
    assert batch[2:4] == ['set "PIGAMING_HOME=/data/my 100%% $HOME `x`"', 'start "PiGaming" /min "py.exe"']


@pytest.mark.parametrize("platform", ["linux", "darwin", "win32"])
def test_a_relative_folder_is_made_absolute_and_an_empty_one_is_none(tmp_path: Path, platform: str) -> None:
    relative = autostart.start_entry(platform, tmp_path, {"PIGAMING_HOME": "here"}, COMMAND).content.decode()
    assert str(Path.cwd() / "here") in relative
    assert b"PIGAMING_HOME" not in autostart.start_entry(platform, tmp_path, {"PIGAMING_HOME": ""}, COMMAND).content
    with pytest.raises(ValueError, match="PIGAMING_HOME"):
        autostart.start_entry(platform, tmp_path, {"PIGAMING_HOME": "/a\nb"}, COMMAND)


@pytest.mark.long
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="starts the entry of Linux")
def test_the_started_arcade_uses_that_folder(
    user: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path / "my 100% $HOME"))
    assert main(["autostart", "on", "--", "--frames", "3"]) == 0
    monkeypatch.delenv("PIGAMING_HOME")
    monkeypatch.setenv("HOME", str(tmp_path / "elsewhere"))
    assert subprocess.run(exec_words(user.read_text()), timeout=120, check=False).returncode == 0
    assert (tmp_path / "my 100% $HOME" / "config" / "settings.toml").is_file()
    assert not (tmp_path / "elsewhere").exists()


def test_a_folder_with_a_line_end_in_its_name_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="unprintable"):
        autostart.start_entry("linux", tmp_path, {}, ["/a\nb/main.py"])


@pytest.fixture
def user(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    return tmp_path / "autostart" / "pigaming.desktop"


def test_on_and_off_may_be_repeated(user: Path, capsys: pytest.CaptureFixture[str]) -> None:
    said = []
    for what in ("show", "on", "on", "show", "off", "off", "show"):
        assert main(["autostart", what, "--json"]) == 0
        said.append(json.loads(capsys.readouterr().out)["on"])
        assert user.is_file() == said[-1]
        assert len(list(user.parent.glob("*"))) == said[-1] if user.parent.is_dir() else not said[-1]
    assert said == [False, True, True, True, False, False, False]


def test_the_entry_starts_a_kiosk_with_these_options(user: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["autostart", "on", "--", "--display", "2"]) == 0
    assert capsys.readouterr().out == f"on, by {user}\n"
    words = exec_words(user.read_text())
    assert words[0] == "/usr/bin/env", "PIGAMING_HOME of all tests"
    words = words[2:]
    assert words[-4:] == [str(ROOT / "main.py"), "--kiosk", "--display", "2"]
    assert subprocess.run([*words[:-4], "-c", "pass"], check=False).returncode == 0
    assert shlex.join(words).count("-X") == 0  # boot creates .venv again if it has gone


@pytest.mark.parametrize(
    "words", [["on", "--", "--colour"], ["on", "--", "--display", "x"], ["off", "--", "--display", "2"], ["perhaps"]]
)
def test_what_it_does_not_know_is_one_line(user: Path, words: list[str], refused: Callable[..., str]) -> None:
    refused("autostart", *words)
    assert not user.exists()


def test_a_folder_that_cannot_be_written_is_one_line(user: Path, refused: Callable[..., str]) -> None:
    user.parent.write_text("a file")
    refused("autostart", "on")
