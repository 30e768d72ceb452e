"""Building of a bundle that fails: one line, and what was there before stays."""

import errno
import os
import subprocess
import tempfile
from pathlib import Path

import pytest

from pigaming_app.jobs import cli
from pigaming_app.jobs.bundle import build, bundle
from pigaming_app.jobs.terminal import refusal


def test_a_folder_that_is_no_bundle_is_never_replaced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "pigaming").mkdir()
    (tmp_path / "pigaming" / "thesis.txt").write_text("all my work")
    with pytest.raises(build.BuildFailed, match="choose another folder"):
        build.build(tmp_path)
    assert (tmp_path / "pigaming" / "thesis.txt").read_text() == "all my work"


def test_a_folder_that_cannot_be_written_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(build.BuildFailed):
        build.build(tmp_path / "file" / "out")


def test_a_failure_of_the_builder_is_its_last_line_and_the_older_bundle_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "pigaming" / build.program_name()
    (tmp_path / "pigaming" / "_internal").mkdir(parents=True)
    program.touch()
    broken = tmp_path / "broken.spec"
    broken.write_text("raise SystemExit('no library')")
    monkeypatch.setattr(build, "SPEC", broken)
    with pytest.raises(build.BuildFailed, match="PyInstaller"):
        build.build(tmp_path)
    assert program.is_file()
    assert not list(tmp_path.glob(".pigaming-*"))


@pytest.mark.parametrize(
    ("last_line", "says"),
    [
        ("OSError: [Errno 28] No space left on device: '/mnt/a'", "the disk is full"),
        ("PermissionError: [Errno 13] Permission denied: '/mnt/a'", "PyInstaller failed: PermissionError"),
    ],
)
def test_a_disk_that_fills_up_under_the_builder_is_one_line(
    last_line: str, says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def full(command: list[str], **_: object) -> "subprocess.CompletedProcess[str]":
        Path(command[command.index("--distpath") + 1]).mkdir()
        return subprocess.CompletedProcess(command, 1, "", f"Traceback (most recent call last):\n  x\n{last_line}\n")

    monkeypatch.setattr(bundle, "require", lambda extra: None)
    monkeypatch.setattr(subprocess, "run", full)
    assert says in refused_build(tmp_path, capsys)
    assert not list(tmp_path.iterdir()), "what was begun is gone"


@pytest.mark.parametrize(
    ("code", "says"), [(errno.ENOSPC, "the disk is full"), (errno.EROFS, "no permission"), (errno.EIO, "error")]
)
@pytest.mark.parametrize("at", ["begin", "picture", "end"])
def test_a_disk_that_refuses_is_one_line_and_the_older_bundle_stays(
    at: str, code: int, says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    older = tmp_path / "pigaming"
    (older / "_internal").mkdir(parents=True)
    (older / build.program_name()).write_text("older")

    def refuse(*_: object, **__: object) -> None:
        raise OSError(code, os.strerror(code), str(tmp_path / "a"))

    def built(scratch: Path) -> None:
        (scratch / "dist" / "pigaming" / "_internal").mkdir(parents=True)
        (scratch / "dist" / "pigaming" / build.program_name()).write_text("newer")

    monkeypatch.setattr(bundle, "require", lambda extra: None)
    monkeypatch.setattr(build, "_run_pyinstaller", built)
    if at == "begin":
        monkeypatch.setattr(tempfile, "TemporaryDirectory", refuse)
    elif at == "picture":
        monkeypatch.setattr(build, "png", lambda size: refuse())
    else:
        rename = os.rename
        monkeypatch.setattr(os, "rename", lambda a, b: refuse() if Path(a).parent.name == "dist" else rename(a, b))
    assert says in refused_build(tmp_path, capsys)
    assert (older / build.program_name()).read_text() == "older"
    assert [path.name for path in tmp_path.iterdir()] == ["pigaming"]


def test_without_the_builder_and_a_network_it_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(refusal, "find_spec", lambda name: None)
    assert "PyInstaller is missing" in refused_build(tmp_path, capsys)


def refused_build(out: Path, capsys: pytest.CaptureFixture[str]) -> str:
    """The one line with which `main.py bundle` ends."""
    assert cli.main(["bundle", "--out", str(out)]) == 2
    shown = capsys.readouterr()
    *progress, line = shown.err.splitlines()
    assert shown.out == ""
    assert all(told.startswith("PiGaming: ") for told in progress)
    assert "Traceback" not in line
    return line
