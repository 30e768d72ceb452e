"""Processes for tests, forked from one that has imported the program: each starts in a twentieth of the time.

Like `subprocess.run([sys.executable, "-c", code, *words])`, and the same on systems without fork. The process that
forks has read no file of a user and made no game, so that a new one finds everything as after a start.
"""

import atexit
import contextlib
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import traceback
from collections.abc import Sequence
from functools import cache
from importlib import import_module, reload
from pathlib import Path
from types import ModuleType
from typing import Any

from pigaming_app.storage.plugins import user
from pigaming_app.storage.plugins.parts import plugins

ROOT = Path(__file__).resolve().parents[1]
PROGRAM = f"import runpy; runpy.run_path({str(ROOT / 'main.py')!r}, run_name='__main__')"  # with an option -X pigaming
QUIET = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PYGAME_HIDE_SUPPORT_PROMPT": "1"}
IMPORTED = (
    "numpy",
    "pygame",
    "networkx",
    "jobs.cli",
    "games.match",
    "games.registry",
    "ui.draw",
    "ui.i18n",
    "ui.window",
)
Ended = subprocess.CompletedProcess[str]


def program(*words: str, cwd: Path = ROOT, timeout: float = 120.0) -> Ended:
    """The program in a process of its own, with this test's folders."""
    return python(PROGRAM, *words, cwd=cwd, timeout=timeout)


def python(code: str, *words: str, cwd: Path = ROOT, timeout: float = 120.0) -> Ended:
    """Code in a process of its own, with the environment of this test and `words` as sys.argv[1:]."""
    if not hasattr(os, "fork"):
        command = [sys.executable, "-X", "pigaming", "-c", code, *words]
        return subprocess.run(
            command, capture_output=True, text=True, cwd=cwd, env=os.environ | QUIET, timeout=timeout, check=False
        )
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
        task = {"code": code, "words": words, "cwd": str(cwd), "environment": os.environ | QUIET, "timeout": timeout}
        socket.send_fds(_parent(), [json.dumps(task).encode() + b"\n"], [out.fileno(), errors.fileno()])
        status = int(_parent().makefile().readline())
        printed = []
        for file in (out, errors):
            file.seek(0)
            printed.append(file.read().decode())
    if status == TIMEOUT:
        raise subprocess.TimeoutExpired(code, timeout, *printed)
    return subprocess.CompletedProcess([code, *words], status, *printed)


TIMEOUT = 1000  # in place of an exit code


@cache
def _parent() -> socket.socket:
    """The connection to the process that forks; it ends with ours."""
    ours, its = socket.socketpair()
    environment = {
        **os.environ,
        **QUIET,
        "PYTHONPATH": str(ROOT),
        "HOME": "/nonexistent",
        "PIGAMING_HOME": "/nonexistent",
    }
    command = [sys.executable, "-X", "pigaming", "-m", "tests.processes", str(its.fileno())]
    process = subprocess.Popen(command, cwd=ROOT, env=environment, pass_fds=[its.fileno()])
    its.close()
    atexit.register(process.wait)
    atexit.register(ours.close)
    return ours


def serve(connection: socket.socket) -> None:
    """Fork a process for each task until the connection ends."""
    for name in IMPORTED:
        import_module(f"pigaming_app.{name}" if "." in name else name)
    assert not plugins.cache_info().currsize
    while True:
        message, files, _, _ = socket.recv_fds(connection, 1 << 20, 2)
        if not message:
            return
        while not message.endswith(b"\n"):
            message += connection.recv(1 << 20)
        task = json.loads(message)
        child = os.fork()
        if child == 0:
            connection.close()
            _become(task, files)
        for file in files:
            os.close(file)
        connection.sendall(b"%d\n" % _ended(child, task["timeout"]))


def _ended(child: int, timeout: float) -> int:
    """The exit code of a process, as subprocess reports it; it is killed after `timeout` s."""
    end = time.monotonic() + timeout
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.003)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return TIMEOUT


def _become(task: dict[str, Any], files: Sequence[int]) -> None:
    """Run the code as a Python that has just started; does not return."""
    for target, file in zip((1, 2), files, strict=True):
        os.dup2(file, target)
        os.close(file)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.environ.clear()
    os.environ.update(task["environment"])
    os.chdir(task["cwd"])
    reload(user)  # whose path is the user's folder
    sys.argv, sys.path[0] = ["-c", *task["words"]], ""
    sys.path[1:1] = [path for path in task["environment"].get("PYTHONPATH", "").split(os.pathsep) if path]
    main = sys.modules["__main__"] = ModuleType("__main__")
    code = 1
    try:
        exec(compile(task["code"], "<string>", "exec"), main.__dict__)
        code = 0
    except SystemExit as end:
        if isinstance(end.code, int) or end.code is None:
            code = end.code or 0
        else:
            print(end.code, file=sys.stderr)
    except BaseException:
        traceback.print_exc()
    finally:
        threading._shutdown()  # type: ignore[attr-defined]
        atexit._run_exitfuncs()
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(OSError, ValueError):
                stream.flush()
        os._exit(code)


if __name__ == "__main__":
    serve(socket.socket(fileno=int(sys.argv[1])))
