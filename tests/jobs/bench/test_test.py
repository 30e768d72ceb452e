"""The job `test`: selection of tools and tests by its options, and its exit code."""

import os
import subprocess
from dataclasses import dataclass, field
from unittest.mock import MagicMock

import pytest

from pigaming_app import ROOT
from pigaming_app.jobs.bench import test as checks
from pigaming_app.jobs.cli import main

EVERYTHING = {"pytest", "ruff", "mypy"}


@dataclass
class Started:
    """The arguments of every started process; a process named in `failing` fails."""

    failing: tuple[str, ...] = ()
    seen: list[tuple[str, ...]] = field(default_factory=list)

    def __call__(self, words, output=None):
        assert output == (None if words[0] == "pytest" else subprocess.PIPE)
        self.seen.append(tuple(words))
        process = MagicMock(pid=0, returncode=int(words[0] in self.failing))
        process.__enter__.return_value = process
        process.wait.return_value = process.returncode
        process.communicate.return_value = b"line 7 is too long\n" * process.returncode, None
        return process


@pytest.fixture
def started(monkeypatch):
    start = Started()
    monkeypatch.setattr(checks, "_python", start)
    monkeypatch.setattr(os, "setpriority", lambda *_: None, raising=False)
    return start


def words_of(tool, started):
    return next(words for words in started.seen if words[0] == tool)


@pytest.mark.parametrize(
    ("options", "tools", "marked"),
    [
        ([], EVERYTHING, "not long"),
        (["--quick"], {"pytest", "ruff"}, "not long"),
        (["--long"], {"pytest"}, "(long) and not alone"),
        (["--long", "-m", "long and not again"], {"pytest"}, "(long and not again) and not alone"),
    ],
)
def test_the_options_choose_tools_and_tests(started, options, tools, marked):
    assert main(["test", *options, "-k", "replay"]) == 0
    assert {words[0] for words in started.seen} == tools
    words = words_of("pytest", started)
    assert words[len(words) - words[::-1].index("-m")] == marked
    assert words[words.index("-k") + 1] == "replay"
    assert ("tests/sim" in words) == ("--quick" in options)


def test_what_needs_the_whole_computer_comes_last_and_one_by_one(tmp_path, monkeypatch):
    """With pytest itself: those alone fail beside another test."""
    (tmp_path / "test_some.py").write_text(
        "import time\nfrom pathlib import Path\nimport pytest\n"
        "def noted(name):\n    here = Path(name)\n    here.touch()\n    time.sleep(0.5)\n"
        "    here.unlink()\n    Path('log').open('a').write(name + '\\n')\n"
        "@pytest.mark.long\n@pytest.mark.alone\n@pytest.mark.parametrize('i', range(2))\n"
        "def test_alone(i):\n    assert not [*Path().glob('one*')]\n    noted(f'one alone {i}')\n"
        "@pytest.mark.long\n@pytest.mark.parametrize('i', range(3))\ndef test_beside(i):\n"
        "    noted(f'one beside {i}')\n"
    )
    (tmp_path / "pytest.ini").write_text("[pytest]\nmarkers =\n    long\n    alone\n")
    monkeypatch.setattr(checks, "ROOT", tmp_path)
    assert main(["test", "--long"]) == 0
    assert [line.split()[1] for line in (tmp_path / "log").read_text().splitlines()] == ["beside"] * 3 + ["alone"] * 2
    assert main(["test", "--long", "-k", "alone"]) == 0
    assert main(["test", "--long", "-k", "nothing"]) == checks.NOTHING


def test_named_files_are_tried_instead_of_all_unit_tests(started):
    assert main(["test", "--quick", "tests/test_cli.py::test_a_picture_is_taken"]) == 0
    assert "tests/sim" not in words_of("pytest", started)


def test_all_unit_tests_that_are_named_are_there():
    assert all((ROOT / unit).exists() for unit in checks.UNITS)


@pytest.mark.parametrize("tool", ["pytest", "ruff", "mypy"])
def test_whatever_fails_fails_the_job_and_is_named(started, capfd, tool):
    started.failing = (tool,)
    assert main(["test"]) == 1
    out, err = capfd.readouterr()
    assert out == ""
    assert err.count("FAILED") == {"pytest": 0, "ruff": 2, "mypy": 1}[tool]
    assert err.count("line 7 is too long") == err.count("FAILED")


def test_two_choices_at_once_are_refused_in_one_line(started, refused):
    refused("test", "--quick", "--long")
    assert started.seen == []
