"""`--version`: the commit as git itself tells it, before anything is installed; and the record of a package."""

import subprocess
import sys
from pathlib import Path

import pytest

from pigaming_app import __version__
from pigaming_app.boot import version
from pigaming_app.boot.version import _of_clone, is_asked

ROOT = Path(__file__).resolve().parents[2]
WHO = ("-c", "user.name=A", "-c", "user.email=a@b")


def git(*words: object) -> str:
    command = ["git", *WHO, *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    clone = tmp_path / "clone"
    git("init", "-q", clone)
    git("-C", clone, "commit", "-q", "--allow-empty", "-m", "one")
    return clone


def test_the_commit_of_a_clone_is_that_of_git(clone: Path, tmp_path: Path) -> None:
    head = git("-C", clone, "rev-parse", "HEAD")
    assert _of_clone(clone) == head
    git("-C", clone, "pack-refs", "--all")
    assert _of_clone(clone) == head
    git("-C", clone, "worktree", "add", "-q", "-b", "side", tmp_path / "tree")
    git("-C", tmp_path / "tree", "commit", "-q", "--allow-empty", "-m", "two")
    assert _of_clone(tmp_path / "tree") == git("-C", tmp_path / "tree", "rev-parse", "HEAD") != head
    git("-C", clone, "checkout", "-q", "--detach")
    assert _of_clone(clone) == head


def test_without_git_it_is_the_record_or_unknown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(version, "ROOT", tmp_path)
    monkeypatch.setattr(version, "RECORD", tmp_path / "commit.txt")
    assert version.commit() == "unknown"
    (tmp_path / "commit.txt").write_text("0123456789abcdef\n")
    assert version.commit() == "01234567"


@pytest.mark.parametrize("word", ["-V", "--version"])
def test_a_bare_python_prints_it_and_installs_nothing(word: str) -> None:
    command = [sys._base_executable, "-I", "-S", "-X", "importtime", str(ROOT / "main.py"), word]  # type: ignore[attr-defined]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert (ended.returncode, ended.stdout) == (0, f"PiGaming {__version__}, commit {version.commit()}\n")
    assert {"subprocess", "tomllib", "numpy", "platformdirs"}.isdisjoint(ended.stderr.split())


def test_a_job_keeps_the_word_for_itself() -> None:
    assert is_asked(["--kiosk", "-V"])
    assert not is_asked(["test", "--long", "--version"])
