"""Real arcades under supervision: killed, stopped, caught in an endless loop, crashing twenty times; and no orphans."""

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import cast

import pytest

from pigaming_app.jobs.kiosk.process import ArcadeProcess
from pigaming_app.jobs.kiosk.start import supervise
from pigaming_app.jobs.kiosk.supervisor import Limits
from pigaming_app.storage.restarts import restarts

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="signals of POSIX, processes of /proc"),
]

ROOT = Path(__file__).resolve().parents[3]
LONG = 60.0  # s, for whatever must come: the machine may be busy


@pytest.fixture(autouse=True)
def _ctrl_c_arrives() -> Iterator[None]:
    """`main.py test` blocks Ctrl-C for the processes that it starts, and these for theirs."""
    mask = signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    yield
    signal.pthread_sigmask(signal.SIG_SETMASK, mask)


class Quick:
    """Limits: a second without a frame is a hang only of an arcade that means to hang, as this machine may be busy."""

    poll, start, stable, delays = 0.02, 120.0, 120.0, (0.0, 0.01)

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @property
    def hang(self) -> float:
        return 1.0 if (self.folder / "hangs").exists() else 120.0


ARCADE = """
import os, signal, sys, time
from pathlib import Path

starts = Path(sys.argv[1])
starts.with_name("hangs").unlink(missing_ok=True)
with starts.open("a") as file:
    file.write(f"{os.getpid()}\\n")
plan = sys.argv[2:]
number = len(starts.read_text().split())
if number > 30:
    sys.exit()  # the test has failed
what = plan[min(number, len(plan)) - 1]
if what == "early":
    sys.exit("it crashed before the first frame")

from pigaming_app.jobs.terminal import supervised as child
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.start import run
from pigaming_app.scenes.flow.scene import Quit
from pigaming_app.ui import pulse

pulse.INTERVAL = 0.05

class Scene:
    def __init__(self, context):
        self.until, self.frames = time.monotonic() + 0.2, 0

    def on_enter(self):
        pass

    def on_leave(self):
        pass

    def handle(self, press):
        return None

    def update(self, seconds):
        self.frames += 1
        if time.monotonic() < self.until or self.frames < 10:
            return None
        starts.with_name("begun").touch()
        if what in ("stop", "loop"):
            starts.with_name("hangs").touch()
        if what == "kill":
            os.kill(os.getpid(), signal.SIGKILL)
        if what == "stop":
            os.kill(os.getpid(), signal.SIGSTOP)
        while what == "loop":
            pass
        if what == "abort":
            os.abort()
        return Quit() if what == "quit" else None

    def draw(self, screen):
        screen.fill("red")

sys.exit(run(Options(headless=True, kiosk=True, first_scene=Scene, without_title=True, heartbeat=child.heartbeat())))
"""
SUPERVISOR = """
import sys
import tempfile
from pigaming_app.jobs.kiosk.process import ArcadeProcess
from pigaming_app.jobs.kiosk.start import supervise
sys.exit(supervise(sys.argv[1:]))
"""


@pytest.fixture
def data(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    return tmp_path / "data"


def arcade(folder: Path, *plan: str) -> list[str]:
    """The command of an arcade that does one thing after each start, and the last one again and again."""
    return [sys.executable, "-c", ARCADE, str(folder / "starts"), *plan]


def pids(folder: Path) -> list[int]:
    return [int(pid) for pid in (folder / "starts").read_text().split()] if (folder / "starts").exists() else []


def runs(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def arcades_begun(data: Path) -> int:
    """Starts in the log of the day."""
    return sum(path.read_text().count('"start"') for path in (data / "days").glob("*"))


def supervised(folder: Path, *plan: str) -> int:
    return supervise(arcade(folder, *plan), cast(Limits, Quick(folder)))


def kill_the_arcade(kiosk: "subprocess.Popen[bytes]", data: Path) -> None:
    """Kill the arcade of a kiosk as soon as it has begun, and wait until another one has."""
    children = Path(f"/proc/{kiosk.pid}/task/{kiosk.pid}/children")
    wait(children.read_text)
    before = arcades_begun(data)
    os.kill(int(children.read_text().split()[0]), signal.SIGKILL)
    wait(lambda: arcades_begun(data) > before)


def crashes(data: Path) -> list[str]:
    """The causes of restarts without hangs, since a busy machine may take more than five seconds for a frame."""
    return [one.detail for one in restarts(data) if one.reason == "crash"]


def wait(condition) -> None:
    end = time.monotonic() + LONG
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_it_comes_back_after_a_kill_a_stop_an_endless_loop_and_an_abort(tmp_path: Path, data: Path) -> None:
    assert supervised(tmp_path, "kill", "stop", "loop", "abort", "quit") == 0
    found = restarts(data)
    hang = ("hang", "no frame for 1 s")
    assert [(one.reason, one.detail) for one in found] == [
        ("crash", "ended by SIGKILL"), hang, hang, ("crash", "ended by SIGABRT"),
    ]  # fmt: skip
    assert not any(map(runs, pids(tmp_path)))
    reports = [(data / one.report).read_text() for one in found]
    assert all((data / one.report).with_suffix(".png").is_file() for one in found)
    assert "in update" in reports[2].partition("== stacks")[2]  # the endless loop
    assert "in update" in reports[3].partition("== stacks")[2]
    assert "in update" not in reports[0]
    assert not list(Path(os.environ.get("TMPDIR", "/tmp")).glob(f"pigaming-*{os.getpid()}*"))


def test_twenty_crashes_before_the_first_frame_and_it_still_comes_back(tmp_path: Path, data: Path) -> None:
    assert supervised(tmp_path, *["early"] * 20, "quit") == 0
    found = restarts(data)
    assert [(one.reason, one.detail) for one in found] == [("crash", "exit code 1")] * 20
    assert "it crashed before the first frame" in (data / found[-1].report).read_text()
    assert len(pids(tmp_path)) == 21


@pytest.mark.parametrize(
    ("ending", "what"), [("SIGKILL", "run"), ("SIGKILL", "loop"), ("SIGTERM", "run"), ("SIGINT", "run")]
)
def test_the_arcade_ends_with_its_supervisor(tmp_path: Path, data: Path, ending: str, what: str) -> None:
    supervisor = subprocess.Popen([sys.executable, "-c", SUPERVISOR, *arcade(tmp_path, what)])
    wait(lambda: (tmp_path / "begun").exists())
    (pid,) = pids(tmp_path)
    supervisor.send_signal(getattr(signal, ending))
    code = supervisor.wait(LONG)
    wait(lambda: not runs(pid))
    assert code == (-signal.SIGKILL if ending == "SIGKILL" else 0)
    assert restarts(data) == []
    assert (data.parent / "config" / "settings.toml").exists()  # it closed by itself


def test_an_interrupted_start_leaves_no_heartbeat(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(subprocess, "Popen", interrupted)
    with pytest.raises(KeyboardInterrupt):
        ArcadeProcess(["an arcade"])
    assert list(tmp_path.iterdir()) == []


def test_the_option_kiosk_starts_the_arcade_under_a_supervisor(tmp_path: Path, data: Path) -> None:
    main = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "--kiosk"]
    assert subprocess.run([*main, "--frames", "20"], timeout=2 * LONG).returncode == 0
    before = arcades_begun(data)
    kiosk = subprocess.Popen(main)
    wait(lambda: arcades_begun(data) > before)
    kill_the_arcade(kiosk, data)
    kiosk.terminate()
    assert kiosk.wait(LONG) == 0
    assert crashes(data) == ["ended by SIGKILL"]


def test_what_cannot_start_is_one_line(data: Path) -> None:
    main = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "--kiosk", "--display", "60"]
    ended = subprocess.run([*main, "--emulate", "--plant", "ros"], capture_output=True, text=True, timeout=LONG)
    assert (ended.returncode, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
