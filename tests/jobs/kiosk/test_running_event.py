"""A kiosk killed by SIGKILL during a match of an event comes back to that event, with every result."""

import json
import subprocess
import sys
import time
from pathlib import Path
from typing import cast

import pytest

from pigaming_app.events import resume
from pigaming_app.events.event import Event
from pigaming_app.events.event_files import load, save
from pigaming_app.events.journal import Recorded
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.jobs.kiosk.start import supervise
from pigaming_app.jobs.kiosk.supervisor import Limits
from pigaming_app.storage.restarts import restarts
from tests.cases import repeated
from tests.jobs.kiosk.test_real_arcade import LONG, arcades_begun, crashes, kill_the_arcade, wait

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="signals of POSIX, processes of /proc"),
]

ROOT = Path(__file__).resolve().parents[3]
QUICK = Limits(poll=0.02, start=60.0, hang=30.0, delays=(0.0,))
ARCADE = """
import os, signal, sys
from pathlib import Path

from pigaming_app.jobs.terminal import supervised as child
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.start import opened
from pigaming_app.scenes.app import App

App._paint = lambda app, began: True  # drawing takes most of the time
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

with opened(Options(headless=True, kiosk=True, step=0.1, heartbeat=child.heartbeat())) as app:
    compose = app.compose
    def watched(seconds):
        top = app.stack.top
        note(type(top).__name__)
        if last == "MatchScene" and top.match.state.tick > 40 and before.count("KILL") < kills:
            note("KILL")
            os.kill(os.getpid(), signal.SIGKILL)
        if last == "EventPodiumPage":
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
    save(
        file,
        Event(
            EventSpec(
                "Cup",
                Format.ROUND_ROBIN,
                ("pitanks",),
                entrants,
                minutes={"pitanks": 0.05},
                variants={"pitanks": "pickups"},
            )
        ),
    )
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
    assert runs[3] == ["NextMatch", "MatchScene", "WinnersMoment"] * 3 + ["NextMatch", "EventPodiumPage"]
    event, problems = load(file)
    assert event
    assert event.over
    assert not problems
    assert [cast(Recorded, entry).outcome.fixture for entry in event.journal] == [1, 2, 3]


def test_event_run_in_a_kiosk_is_supervised_and_returns_to_its_event(data: Path, tmp_path: Path) -> None:
    file = an_event(tmp_path / "cup.json", "")
    main = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "event", "run", str(file), "--kiosk"]
    kiosk = subprocess.Popen(main)
    wait(lambda: arcades_begun(data))
    assert resume.marked(data) == file
    time.sleep(2.0)  # into the main loop, which would clear the mark on the title
    assert resume.marked(data) == file
    kill_the_arcade(kiosk, data)
    time.sleep(2.0)
    assert resume.marked(data) == file
    kiosk.terminate()
    assert kiosk.wait(LONG) == 0
    assert crashes(data) == ["ended by SIGKILL"]


KILLS = 25  # of each of eight arcades
KILLED = """
import json, os, random, signal, sys, time
from importlib import import_module
from pathlib import Path

from pigaming_app.ai.registry import new_match
from pigaming_app.events.event import Event
from pigaming_app.events.event_files import load, save
from pigaming_app.events.match_setup import setup_of
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.games.engine_hash import engine_hash
from pigaming_app.scenes.app import App
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.start import opened
from pigaming_app.scenes.events import choice, next_page
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.preloaded import modules
from pigaming_app.scenes.results import winner
from pigaming_app.events import resume

App._paint = lambda app, began: True  # drawing saves nothing, and takes longer than everything else
MatchRunner.prewarm = lambda runner, milliseconds: True

file, kills = Path(sys.argv[1]), int(sys.argv[2])
entrants = tuple(Entrant(name, "random") for name in ("ANA", "BEA", "EVA", "IDA", "LIA"))
rules, minutes = {"pitanks": "pickups"}, {"pitanks": 0.1}
new = Event(EventSpec("Cup", Format.ROUND_ROBIN, ("pitanks",), entrants, rounds=2, variants=rules, minutes=minutes))
chance = random.Random(int(sys.argv[3]))
FRAMES = 80  # about as many as a match takes, with what follows it

def arcade(pipe, beats):
    with opened(Options(headless=True, kiosk=True, step=0.1)) as app:
        shown, results = None, 0
        while True:
            app.compose(0.1)
            os.write(beats, b".")
            top = app.stack.top
            name = type(top).__name__
            if name != shown:
                shown = name
                if name in ("NextMatch", "EventPodiumPage"):
                    results = len(top.running.event.outcomes)
                elif name == "WinnersMoment":
                    results += 1
                os.write(pipe, f"{name} {results}\\n".encode())
            if name == "NextMatch":
                top.clock = max(top.clock, next_page.SHOW_AFTER)
            if name == "MatchScene":  # without its countdown, a second long
                top.opening.countdown.seconds_left = min(top.opening.countdown.seconds_left, 0.05)
                top.match.state.rules.ticks = min(top.match.state.rules.ticks, 15)

engine_hash()  # what every arcade needs is loaded once
for module in modules():
    import_module(module)
match = new_match(setup_of(new, new.open[0]))
for _ in range(15):
    match.tick()
save(file, new)
resume.mark(file.parent.parent, file)
before, counted, moments = [], 0, {}
for _ in range(kills):
    reading, writing = os.pipe()
    beating, beats = os.pipe()
    pid = os.fork()
    if not pid:
        os.close(reading)
        try:
            arcade(writing, beats)
        finally:
            os._exit(1)
    os.close(writing)
    os.close(beats)
    lived, lives = 0, chance.randrange(1, FRAMES)
    while lived < lives:
        beat = os.read(beating, lives - lived)
        assert beat
        lived += len(beat)
    os.close(beating)
    time.sleep(chance.uniform(0.0, 0.005))
    os.kill(pid, signal.SIGKILL)
    assert os.WTERMSIG(os.waitpid(pid, 0)[1]) == signal.SIGKILL
    with open(reading, "rb") as pipe:
        lines = pipe.read().decode().splitlines()
    assert lines[0] == f"NextMatch {len(before)}", (lines, len(before))  # back to the event, with every result
    event, problems = load(file)
    assert event and not problems, problems
    acknowledged = max(int(line.split()[1]) for line in lines)
    assert acknowledged <= len(event.outcomes) <= acknowledged + 1, (lines, len(event.outcomes))
    assert list(event.journal[: len(before)]) == before
    numbers = [entry.outcome.fixture for entry in event.journal]
    assert len(numbers) == len({*numbers})
    counted += len(event.outcomes) - len(before)
    moment = lines[-1].split()[0]
    moments[moment] = moments.get(moment, 0) + 1
    before = list(event.journal)
    assert resume.marked(file.parent.parent) == file
    if event.over:
        save(file, new)
        before = []
print(json.dumps({"results": counted, "moments": moments}))
"""


@pytest.mark.parametrize("seed", repeated(range(1, 9)))
def test_two_hundred_kills_of_a_real_arcade_at_any_moment_lose_no_result(data: Path, seed: int) -> None:
    """Each arcade, which does all but draw, is back in the event, with each result that a screen had followed."""
    file = data / "events" / "cup.json"
    file.parent.mkdir(parents=True)
    ended = subprocess.run(
        [sys.executable, "-c", KILLED, str(file), str(KILLS), str(seed)],
        stdout=subprocess.PIPE,
        text=True,
        timeout=3000,
    )
    assert ended.returncode == 0
    told = json.loads(ended.stdout.splitlines()[-1])
    assert told["results"] > KILLS / 4
    assert {*told["moments"]} >= {"NextMatch", "MatchScene", "WinnersMoment"}
    assert sum(told["moments"].values()) == KILLS
