"""Ctrl-C, as a terminal sends it to all processes of a command: one line, exit code 130, nothing left."""

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.plugins.packages import ROOT

pytestmark = pytest.mark.skipif(not Path("/proc/self/environ").exists(), reason="looks for processes in /proc")

LONG = 60.0  # s
JOB = """
import subprocess, sys, time
from pigaming_app.jobs import cli
def begin():
    print("begun", flush=True)
cli._run = lambda name, words: exec(sys.argv[1], globals())
sys.exit(cli.main(["games"]))
"""
BODIES = {  # what keeps a job busy when Ctrl-C comes, once it has begun
    "python": "begin()\nwhile True: pass",
    "a system call": "begin()\ntime.sleep(99)",
    "compiled code": "import numba, numpy\n@numba.njit(nogil=True)\ndef loop(numbers):\n"
    "    while numbers[0] >= 0: numbers[0] = (numbers[0] + 3) % 7\n"
    "numbers = numpy.ones(1, numpy.int64)\nloop(-numbers)\nbegin()\nloop(numbers)",
    "a thread": "from concurrent.futures import ThreadPoolExecutor as Pool\n"
    "command = [sys.executable, '-c', 'import time; time.sleep(99)']\n"
    "begin()\nwith Pool() as threads: threads.submit(subprocess.run, command).result()",
    "a destructor": "class A:\n    def __del__(self):\n        time.sleep(99)\nbegin()\na = A()\ndel a\ntime.sleep(99)",
    "a file of a library": "import io, pygame\nfrom pigaming_app.ui.draw.theme import _file\nclass File(io.BytesIO):\n"
    "    def close(self): time.sleep(99)\n"
    "pygame.font.init()\nbegin()\npygame.font.Font(File(_file('head')), 20)\ntime.sleep(99)",
    "a handler": "begin()\ntry: time.sleep(99)\nexcept BaseException: time.sleep(99)",
    "a library": "begin()\ntry: time.sleep(99)\nexcept BaseException: raise ValueError from None",
    "a child": "begin()\nsubprocess.run([sys.executable, '-c', 'import time; time.sleep(99)'])",
}
JOBS = [  # quick ones first; then those whose processes and threads are many
    ("play race --headless --seats level5,level5", 2.0),
    ("--kiosk", 3.0),
    *(pytest.param(words, seconds, marks=pytest.mark.long) for words, seconds in [
        ("", 3.0),
        ("doctor", 1.0),
        ("duel pitanks level5 level1 --matches 90000", 4.0),
        ("train ppo race --minutes 9 --out a.npz", 5.0),
        ("train qlearning --plain --matches 9000 --out a.npz", 4.0),
        ("bench phones", 3.0),
        ("bench race", 6.0),
        ("bench robots", 6.0),
        ("play --emulate --seats level5,level5", 5.0),
        ("test --quick tests/sim", 3.0),
    ]),
]  # fmt: skip


def tagged(tag: str) -> list[str]:
    """The command lines of running processes with this tag in their environment."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            zombie = folder.joinpath("stat").read_text().rpartition(")")[2].split()[0] == "Z"
            if not zombie and f"TAG={tag}".encode() in folder.joinpath("environ").read_bytes():
                found.append(folder.joinpath("cmdline").read_text().replace("\0", " "))
        except OSError:
            pass
    return found


def interrupted(command: list[str], home: Path, after: float | None) -> tuple[int, str]:
    """Send SIGINT to a command's processes `after` s; None: once it prints. Returns its exit code and errors."""
    quiet = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PIGAMING_HOME": str(home), "TAG": str(home)}
    process = subprocess.Popen(
        command,
        cwd=home,
        env={**os.environ, "PYTHONPATH": str(ROOT), **quiet},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        process_group=0,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # in the background, shells ignore it
    )
    if after is None:
        assert process.stdout
        process.stdout.readline()
        time.sleep(0.3)
    else:
        time.sleep(after)
    os.killpg(process.pid, signal.SIGINT)
    try:
        _, errors = process.communicate(timeout=LONG)
    finally:
        process.kill()
    return process.returncode, errors


@pytest.mark.parametrize("body", BODIES)
def test_a_job_ends_wherever_it_is(body: str, tmp_path: Path) -> None:
    assert interrupted([sys.executable, "-c", JOB, BODIES[body]], tmp_path, None) == (130, "PiGaming: stopped.\n")
    assert tagged(str(tmp_path)) == []


@pytest.mark.parametrize(("words", "seconds"), JOBS)
def test_every_job_ends_in_one_line_at_any_moment(words: str, seconds: float, tmp_path: Path) -> None:
    command = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), *words.split()]
    ended, errors = interrupted(command, tmp_path, random.uniform(0.3, seconds))
    last = "PiGaming: stopped before the end; continue with --resume\n"
    assert ended == 130, errors
    assert errors.endswith(("PiGaming: stopped.\n", last))
    assert errors.count("PiGaming: stopped") == 1
    assert "Traceback" not in errors
    assert tagged(str(tmp_path)) == []
