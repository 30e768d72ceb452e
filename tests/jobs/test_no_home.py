"""A user without HOME and without an entry in the list of users: one sentence, and nothing is written."""

from pathlib import Path

import pytest

from pigaming_app import ROOT
from pigaming_app.boot import interpreter
from tests.processes import python

pwd = pytest.importorskip("pwd")
NOBODY = """
import pwd, sys
def getpwuid(uid):
    raise KeyError(uid)
pwd.getpwuid = getpwuid
from pigaming_app.jobs import cli
sys.exit(cli.main(sys.argv[1:]))
"""


@pytest.fixture(autouse=True)
def _nobody(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("HOME", "PIGAMING_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)


@pytest.mark.parametrize("words", ["--frames 1", "--kiosk", "games list", "robots", "play pitanks --headless"])
def test_a_job_ends_in_one_sentence(words: str, tmp_path: Path) -> None:
    ended = python(NOBODY, *words.split(), cwd=tmp_path)
    assert (ended.returncode, ended.stdout) == (2, "")
    assert ended.stderr.splitlines() == [
        "PiGaming: this user has no home folder: set HOME or PIGAMING_HOME to a folder that can be written."
    ]
    assert not list(tmp_path.iterdir())


def test_the_doctor_names_it_and_goes_on(tmp_path: Path) -> None:
    ended = python(NOBODY, "doctor", cwd=tmp_path)
    assert (ended.returncode, ended.stderr) == (1, "")
    (line,) = [line for line in ended.stdout.splitlines() if line.startswith("problem")]
    assert "no home folder" in line
    assert "a second of a match was played" in ended.stdout
    assert not list(tmp_path.iterdir())


def test_the_packages_go_beside_the_program(monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(uid: int) -> object:
        raise KeyError(uid)

    monkeypatch.setattr(pwd, "getpwuid", unknown)
    assert interpreter.environment_folders() == [ROOT / ".venv"]
    monkeypatch.setenv("PIGAMING_HOME", "/srv/arcade")
    assert [place.parent for place in interpreter.environment_folders()] == [ROOT, Path("/srv/arcade")]
