"""A kiosk killed by SIGKILL during a match of an event comes back to that event, with every result."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.event_files import load, save
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.jobs.kiosk.start import supervise
from pigaming_app.jobs.kiosk.supervisor import Limits
from pigaming_app.storage import resume
from pigaming_app.storage.restarts import restarts

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="signals of POSIX, processes of /proc"),
]

ROOT = Path(__file__).resolve().parents[3]
QUICK = Limits(poll=0.02, start=60.0, hang=30.0, delays=(0.0,))
ARCADE = """
import os, signal, sys
from pathlib import Path

from pigaming_app.jobs.kiosk import child
from pigaming_app.scenes.app import Options, opened

diary = Path(sys.argv[1])
kills = int(sys.argv[2])
before = diary.read_text().split() if diary.exists() else []
last = ""

def note(word):
    global last
    if word != last:
        last = word
        with diary.open("a") as file:
            file.write(word + " ")

with opened(Options(headless=True, kiosk=True, step=0.05, heartbeat=child.heartbeat())) as app:
    compose = app.compose
    def watched(seconds):
        top = app.stack.top
        note(type(top).__name__)
        if last == "MatchScene" and top.match.state.tick > 40 and before.count("KILL") < kills:
            note("KILL")
            os.kill(os.getpid(), signal.SIGKILL)
        if last == "PodiumPage":
            app.stack.clear()
            return False
        return compose(seconds)
    app.compose = watched
    sys.exit(app.loop())
"""


@pytest.fixture
def data(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    return tmp_path / "data"


def an_event(file: Path, brain: str = "level1") -> Path:
    file.parent.mkdir(parents=True, exist_ok=True)
    entrants = tuple(Entrant(name, brain) for name in ("ANA", "BEA", "EVA"))
    save(file, Event(EventSpec("Cup", Format.ROUND_ROBIN, ("pitanks",), entrants, minutes={"pitanks": 0.05})))
    return file


def test_a_kiosk_killed_in_a_match_comes_back_to_the_event_and_plays_it_to_its_podium(
    tmp_path: Path, data: Path
) -> None:
    """Three kills, each in the first match after a start; AIs play one match after the other without any press."""
    file = an_event(data / "events" / "cup.json")
    resume.mark(data, file)
    diary = tmp_path / "diary"
    assert supervise([sys.executable, "-c", ARCADE, str(diary), "3"], QUICK) == 0
    assert [one.detail for one in restarts(data)] == ["ended by SIGKILL"] * 3
    runs = [words.split() for words in diary.read_text().split("KILL")]
    assert runs[:3] == [["NextMatch", "MatchScene"]] * 3
    assert runs[3] == ["NextMatch", "MatchScene", "WinnersMoment"] * 3 + ["NextMatch", "PodiumPage"]
    event, problems = load(file)
    assert event
    assert event.over
    assert not problems
    assert [entry.outcome.fixture for entry in event.journal] == [1, 2, 3]


def test_event_run_in_a_kiosk_is_supervised_and_returns_to_its_event(data: Path, tmp_path: Path) -> None:
    file = an_event(tmp_path / "cup.json", "")
    main = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "event", "run", str(file), "--kiosk"]
    kiosk = subprocess.Popen(main)
    children = Path(f"/proc/{kiosk.pid}/task/{kiosk.pid}/children")

    def starts() -> int:
        log = data / "days"
        return sum(path.read_text().count('"start"') for path in log.iterdir()) if log.exists() else 0

    def wait(condition) -> None:
        end = time.monotonic() + 60.0
        while not condition():
            assert time.monotonic() < end
            time.sleep(0.05)

    wait(lambda: starts() == 1 and children.read_text())
    assert resume.marked(data) == file
    time.sleep(2.0)  # into the main loop, which would clear the mark on the title
    assert resume.marked(data) == file
    os.kill(int(children.read_text()), signal.SIGKILL)
    wait(lambda: starts() == 2)
    time.sleep(2.0)
    assert resume.marked(data) == file
    kiosk.terminate()
    assert kiosk.wait(20) == 0
    assert [one.detail for one in restarts(data)] == ["ended by SIGKILL"]
