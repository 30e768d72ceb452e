"""Fixtures for jobs: each test has folders of its own, and words that a job refuses."""

from collections.abc import Callable
from pathlib import Path

import pytest

from pigaming_app.jobs.cli import main


@pytest.fixture(autouse=True)
def _own_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path / "home"))


@pytest.fixture
def refused(capsys: pytest.CaptureFixture[str]) -> Callable[..., str]:
    """A function that returns the line in which a job refuses these words, the only one that it prints."""

    def line(*words: str) -> str:
        capsys.readouterr()
        assert main([*words]) == 2
        told = capsys.readouterr()
        assert told.out == ""
        assert told.err.startswith("PiGaming: ")
        assert told.err.count("\n") == 1
        assert told.err[:-1].isprintable()
        return told.err

    return line
