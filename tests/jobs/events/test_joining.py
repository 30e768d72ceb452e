"""An arcade on another computer, over a network that breaks off: processes are killed, and nothing counts twice."""

import io
import json
import os
import re
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from contextlib import ExitStack
from html import unescape
from http.client import HTTPConnection
from pathlib import Path
from random import Random
from typing import Any

import pytest

from pigaming_app.events.network import mirror
from pigaming_app.events.network.mirror import host_at
from pigaming_app.jobs.cli import main
from pigaming_app.jobs.events.joining import joined
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.storage.pin import PinFile
from pigaming_app.storage.settings import folders
from tests.jobs.events.proxy import Proxy
from tests.scenes.events.desk.examples import PIN, desk_on, new_event
from tests.ui.web.client import serving

ROOT = Path(__file__).resolve().parents[3]
LONG = 180.0  # s
NAMES = ("Ana", "Bia", "Caio", "Duda", "Eva", "Fee", "Gil")
ROW = r'<tr[^>]*><td>(\d+)</td><th scope="row">([^<]*)</th><td>([^<]*)</td><td>([^<]*)</td><td>([^<]*)</td>'


@pytest.fixture(autouse=True)
def _here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


class Process:
    """A process that can be killed and begun again."""

    def __init__(self, *words: str, home: str = "", typed: str = "") -> None:
        self.words, self.typed = words, typed
        self.environment = {**os.environ, "PYTHONPATH": str(ROOT)} | ({"PIGAMING_HOME": home} if home else {})
        self.process: subprocess.Popen[str] | None = None

    def start(self) -> str:
        """Begin, and wait for its first line."""
        process = self.begin()
        assert process.stdout
        return process.stdout.readline()

    def begin(self) -> "subprocess.Popen[str]":
        """Begin."""
        self.process = subprocess.Popen(
            [sys.executable, "-X", "pigaming", *self.words],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=self.environment,
        )
        assert self.process.stdin
        self.process.stdin.write(f"{self.typed}\n")
        self.process.stdin.close()
        return self.process

    def kill(self) -> None:
        if self.process:
            self.process.kill()
            self.process.wait()
            if self.process.stdout:
                self.process.stdout.close()
            self.process = None


def until(reached: Callable[[], Any]) -> None:
    end = time.monotonic() + LONG
    while not reached():
        assert time.monotonic() < end
        time.sleep(0.05)


def journal(path: Path) -> list[dict[str, Any]]:
    """The journal, read without the code of events."""
    entries: list[dict[str, Any]] = json.loads(path.read_text())["journal"]
    return entries


def results(path: Path) -> list[dict[str, Any]]:
    return [entry["outcome"] for entry in journal(path) if entry["entry"] == "result"]


def page(port: int) -> str:
    connection = HTTPConnection("127.0.0.1", port, timeout=LONG)
    connection.request("GET", "/?language=en")
    text = connection.getresponse().read().decode()
    connection.close()
    return text


def table(port: int) -> dict[str, tuple[float, int, int]]:
    """Points, wins and matches of everybody, as the page has them."""
    rows = re.findall(ROW, page(port))
    return {unescape(name): (float(points), int(wins), int(played)) for _, name, points, wins, played in rows}


def reckoned(outcomes: list[dict[str, Any]]) -> dict[str, tuple[float, int, int]]:
    """The same by hand: a win is a point, a tie half of one."""
    points, wins, played = dict.fromkeys(NAMES, 0.0), Counter[str](), Counter[str]()
    for outcome in outcomes:
        scores = outcome["scores"]
        best = max(scores.values())
        first = [name for name, score in scores.items() if score == best]
        for name in scores:
            played[name] += 1
            if name in first:
                points[name] += 1.0 / len(first)
                wins[name] += len(first) == 1
    return {name: (points[name], wins[name], played[name]) for name in NAMES}


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["http://127.0.0.1:1", "--arcade", "right"], "http://127.0.0.1:1/ cannot be reached"),
        (["http://127.0.0.1:1"], "an address needs --arcade"),
        (["http://127.0.0.1:1", "--arcade", "right", "--headless"], "goes without --headless"),
        (["http://x:y", "--arcade", "right"], "'http://x:y' is not the address of a desk, as http://192.168.1.5:8788"),
        (["http://127.0.0.1:1", "--arcade", "x" * 30], "1 to 24 printable characters"),
    ],
)
def test_what_is_no_desk_is_refused_in_one_line(words, reason, refused):
    assert reason in refused("event", "run", *words)


def test_the_pin_is_asked_once_and_without_a_connection_the_copy_serves(tmp_path, monkeypatch, capsys):
    path = new_event(tmp_path)
    monkeypatch.setattr(sys, "stdin", io.StringIO("000000\n"))
    with serving(desk_on(path)) as server:
        host = host_at(server.url, 0)
        with pytest.raises(Refusal, match="that is not the PIN"):
            joined(host, "right")
        assert not [*folders().data.glob("joined/*")]
        monkeypatch.setattr(sys, "stdin", io.StringIO(f"{PIN}\n"))
        copy = joined(host, "right")
        assert copy.read_text() == path.read_text()
        monkeypatch.setattr(sys, "stdin", None)
        assert joined(host, "right") == copy
        PinFile(tmp_path).set("135790")
        monkeypatch.setattr(sys, "stdin", io.StringIO(""))  # as in a kiosk
        assert joined(host, "right") == copy
        assert "needs the PIN of its operator; the arcade goes on with its copy" in capsys.readouterr().err
    capsys.readouterr()
    assert joined(host, "right") == copy
    assert "the arcade goes on with its copy" in capsys.readouterr().err


@pytest.mark.long
@pytest.mark.skipif(os.name != "posix", reason="SIGKILL")
@pytest.mark.parametrize("seed", [1, *(pytest.param(seed, marks=pytest.mark.again) for seed in range(2, 5))])
def test_two_computers_one_journal_whatever_is_killed_or_cut(tmp_path: Path, seed: int) -> None:
    """The desk, an arcade beside it and one behind a bad network are killed and cut off at random. In the end both
    files have one journal, each match once as an arcade has seen it, and the table is what the results add up to."""
    random, path = Random(seed), tmp_path / "cup.json"
    new = ["event", "new", "cup.json", "--format", "roundrobin", "--rounds", "2", "--entrants", ",".join(NAMES)]
    assert main(new) == 0
    PinFile(folders().config).set(PIN)
    with ExitStack() as stack:
        desk = Process(str(ROOT / "main.py"), "event", "desk", "cup.json", "--port", "0")
        found = re.search(r":(\d+)/", desk.start())
        assert found
        desk.words = (*desk.words[:-1], found[1])
        proxy = Proxy(int(found[1]), share=0.3, seed=seed)
        stack.callback(proxy.close)
        play = ("-m", "tests.jobs.events.arcade_alone")
        left = Process(*play, str(path), "left", "left.log")
        right = Process(*play, f"http://127.0.0.1:{proxy.port}", "right", "right.log", home="there", typed=PIN)
        processes = (desk, left, right)
        for process in processes:
            stack.callback(process.kill)
        proxy.share = 0.0  # the PIN is asked once
        right.start()
        until(lambda: results(path))
        left.start()
        proxy.share = 0.3
        there = mirror.latest(tmp_path / "there/data/joined", host_at(f"http://127.0.0.1:{proxy.port}", 0))
        assert there
        for _ in range(10):
            time.sleep(random.uniform(0.2, 1.0))
            match random.randrange(4):
                case 0:
                    proxy.pull()
                    time.sleep(random.uniform(0.2, 2.0))
                    proxy.plug()
                case number:
                    processes[number - 1].kill()
                    time.sleep(random.uniform(0.0, 1.0))
                    processes[number - 1].start()
        until(lambda: len(results(path)) == 42)
        until(lambda: proxy.broken > 5)
        proxy.share = 0.0
        until(lambda: journal(there) == journal(path))
        port = int(found[1])
        until(lambda: sum(row[2] for row in table(port).values()) == 84)
        shown = table(port)
        for process in processes:
            process.kill()
    seen = [json.loads(line) for log in ("left.log", "right.log") for line in (tmp_path / log).read_text().splitlines()]
    saved = Counter((note.split()[0], number) for word, number, note, _ in seen if word == "saved")
    assert {*saved.values()} == {1}, "no arcade had to play a match again that it had saved"
    counted = results(path)
    assert sorted(one["fixture"] for one in counted) == list(range(1, 43))
    for one in counted:
        assert ["played", one["fixture"], one["note"], one["scores"]] in seen
    assert {one["note"].split()[0] for one in counted} == {"left", "right"}
    assert shown == reckoned(counted)


@pytest.mark.long
@pytest.mark.again  # with screens
def test_the_arcade_itself_plays_a_whole_event_of_another_computer(tmp_path: Path) -> None:
    new = ["event", "new", "cup.json", "--format", "roundrobin", "--minutes", "0.05", "--entrants"]
    assert main([*new, "A=random,B=random,C=random"]) == 0
    PinFile(folders().config).set(PIN)
    path = tmp_path / "cup.json"
    with ExitStack() as stack:
        desk = Process(str(ROOT / "main.py"), "event", "desk", "cup.json", "--port", "0")
        stack.callback(desk.kill)
        found = re.search(r":(\d+)/", desk.start())
        assert found
        words = ("event", "run", f"http://127.0.0.1:{found[1]}", "--arcade", "right")
        arcade = Process(str(ROOT / "main.py"), *words, home="there", typed=PIN)
        arcade.begin()
        stack.callback(arcade.kill)
        until(lambda: '"clock": "' in "".join(one.read_text() for one in tmp_path.glob(".cup.json.live-*")))
        until(lambda: len(results(path)) == 3)
    assert [entry["arcade"] for entry in journal(path) if entry["entry"] == "call"] == ["right"] * 3
