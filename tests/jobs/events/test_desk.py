"""The job `event desk`: it refuses without a PIN, serves until it is ended, and several processes share one file."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from http.client import HTTPConnection
from pathlib import Path
from random import Random
from urllib.parse import urlencode

import pytest

from pigaming_app.events.event_files import load
from pigaming_app.events.journal import Recorded
from pigaming_app.jobs.cli import main
from pigaming_app.storage.pin import PinFile
from pigaming_app.storage.settings import folders

ROOT = Path(__file__).resolve().parents[3]
PIN = "274918"
LONG = 120.0  # s
NEW = ["event", "new", "cup.json", "--format", "roundrobin", "--minutes", "0.05", "--entrants"]


@pytest.fixture(autouse=True)
def _here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_without_a_pin_it_says_how_to_set_one(refused):
    assert main([*NEW, "A,B,C"]) == 0
    told = refused("event", "desk", "cup.json")
    assert "`python3 main.py kiosk pin` sets one" in told


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["no.json"], "no.json: no such event"),
        (["cup.json", "--port", "x"], "'x' is not a whole number"),
        (["cup.json", "--port", "65536"], "'65536' is more than 65535"),
        (["cup.json", "--network", "nowhere"], "nowhere"),
    ],
)
def test_a_wrong_option_is_one_line(words, reason, refused):
    assert main([*NEW, "A,B,C"]) == 0
    PinFile(folders().config).set(PIN)
    assert reason in refused("event", "desk", *words)


class Browser:
    """A browser at the desk of a process."""

    def __init__(self, port: int) -> None:
        self.port, self.cookie, self.key = port, "", ""

    def ask(self, path: str, form: dict[str, str] | None = None) -> tuple[int, str]:
        connection = HTTPConnection("127.0.0.1", self.port, timeout=LONG)
        headers = {"Cookie": self.cookie, "Origin": f"http://127.0.0.1:{self.port}"}
        if form is None:
            connection.request("GET", path, headers=headers)
        else:
            body = urlencode(form | {"key": self.key})
            connection.request("POST", path, body, headers | {"Content-Type": "application/x-www-form-urlencoded"})
        answer = connection.getresponse()
        self.cookie = (answer.headers["Set-Cookie"] or self.cookie).partition(";")[0]
        text = answer.read().decode()
        connection.close()
        return answer.status, text

    def log_in(self) -> None:
        assert self.ask("/desk/login", {"pin": PIN})[0] == 303
        found = re.search(r'name="key" value="([\w-]+)"', self.ask("/desk")[1])
        assert found
        self.key = found[1]

    @property
    def table(self) -> list[str]:
        """The rows of the table, as everybody sees them."""
        return re.findall(r"<tr.*?</tr>", self.ask("/")[1])


@contextmanager
def desk() -> Iterator[tuple["subprocess.Popen[str]", Browser]]:
    """A process with a desk, killed at the end, and a browser at it that is logged in."""
    command = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "event", "desk", "cup.json", "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout
            found = re.search(r":(\d+)/", process.stdout.readline())
            assert found
            browser = Browser(int(found[1]))
            browser.log_in()
            yield process, browser
        finally:
            process.kill()


@pytest.mark.long
def test_it_serves_until_it_is_interrupted():
    assert main([*NEW, "A,B,C"]) == 0
    PinFile(folders().config).set(PIN)
    with desk() as (process, browser):
        assert browser.ask("/desk/match/1", {"do": "result", "extra": "0", "score0": "2", "score1": "1"})[0] == 303
        process.send_signal(signal.SIGINT)
        assert process.wait(LONG) in (0, 130)


@pytest.mark.long
@pytest.mark.skipif(os.name != "posix", reason="SIGKILL")
@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.again)])
def test_desks_and_arcades_that_are_killed_share_one_journal(seed):
    """Two desks enter results at random, also the same one at once, while an arcade without a window plays; each is
    killed and comes back. Nothing is lost that was confirmed, nothing counts twice, and both show one table."""
    random = Random(seed)
    assert main([*NEW, "A=random,B=idle,C=random,D=idle,E=random,F=idle", "--rounds", "4"]) == 0
    PinFile(folders().config).set(PIN)
    play = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "event", "run", "cup.json", "--headless"]
    confirmed: dict[int, tuple[str, ...]] = {}
    for _ in range(3):
        with desk() as (_, left), desk() as (right_process, right):
            arcade = subprocess.Popen([*play, "--speed", "3"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            for i in range(8):
                event = load(Path("cup.json"))[0]
                assert event
                if not event.open:
                    break
                fixture = random.choice(event.open)
                form = {"do": "result", "extra": "0", "score0": str(random.randint(0, 3)), "score1": "1.5"}
                for browser in random.sample((left, right), 2 if i % 2 else 1):
                    try:
                        status, _ = browser.ask(f"/desk/match/{fixture.number}", form)
                    except OSError:
                        continue  # it was killed
                    if status == 303:
                        assert fixture.number not in confirmed
                        confirmed[fixture.number] = fixture.entrants
                if i == 5:
                    right_process.send_signal(signal.SIGKILL)
            arcade.send_signal(signal.SIGKILL)
            arcade.wait()
            event, problems = load(Path("cup.json"))
            assert event
            assert not problems
            assert {*confirmed} <= {*event.outcomes}
            counted = [entry.outcome.fixture for entry in event.journal if isinstance(entry, Recorded)]
            assert len(counted) == len({*counted})
        with desk() as (_, left), desk() as (_, right):  # both came back
            assert left.table == right.table
            assert len(left.table) == 7
    assert len(confirmed) > 8


@pytest.mark.long
def test_a_result_at_one_desk_is_in_the_table_of_the_other_at_its_next_look():
    """A page looks every 1.5 s, so that it is there within 2 s: no desk keeps an older one."""
    assert main([*NEW, "A,B,C,D"]) == 0
    PinFile(folders().config).set(PIN)
    with desk() as (_, left), desk() as (_, right):
        for number in range(1, 7):
            form = {"do": "result", "extra": "0", "score0": "2", "score1": "1"}
            assert left.ask(f"/desk/match/{number}", form)[0] == 303
            assert left.table == right.table
            left, right = right, left
