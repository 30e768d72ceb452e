"""`kiosk pin`: typed at a terminal, or one line on standard input; refusals in one line."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from pigaming_app.storage.pin import PinFile

ROOT = Path(__file__).resolve().parents[3]
PIN = "274918"


def run(home: Path, *words: str, typed: str = "") -> subprocess.CompletedProcess[str]:
    variables = {**os.environ, "PIGAMING_HOME": str(home), "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "pigaming_app", "kiosk", "pin", *words]
    return subprocess.run(command, env=variables, input=typed, capture_output=True, text=True, check=False, timeout=60)


def test_it_is_set_shown_and_removed(tmp_path: Path) -> None:
    file = PinFile(tmp_path / "config")
    assert json.loads(run(tmp_path, "--show", "--json").stdout)["set"] is False
    done = run(tmp_path, "--json", typed=f"{PIN}\n")
    assert (done.returncode, json.loads(done.stdout)) == (0, {"set": True, "file": str(file.path)})
    assert file.check(PIN)
    assert "a PIN is set" in run(tmp_path, "--show").stdout
    assert "easy to guess" in run(tmp_path, typed="1234\n").stderr
    assert file.check("1234")
    assert run(tmp_path, "--remove").stdout == "no PIN is set\n"
    assert not file.is_set


@pytest.mark.parametrize(
    ("words", "typed", "line"),
    [
        ((), "", "a PIN has 4 to 12 digits"),
        ((), "12\n", "a PIN has 4 to 12 digits"),
        ((), "abcd\n", "a PIN has 4 to 12 digits"),
        (("--remove", "--show"), "", "not both"),
    ],
)
def test_a_refusal_is_one_line_and_changes_nothing(
    tmp_path: Path, words: tuple[str, ...], typed: str, line: str
) -> None:
    PinFile(tmp_path / "config").set(PIN)
    done = run(tmp_path, *words, typed=typed)
    assert done.returncode == 2
    assert line in done.stderr
    assert done.stderr.count("\n") == 1
    assert PinFile(tmp_path / "config").check(PIN)


@pytest.mark.skipif(sys.platform == "win32", reason="a terminal of POSIX")
@pytest.mark.parametrize(("second", "code"), [(PIN, 0), ("274919", 2)])
def test_at_a_terminal_it_is_typed_twice_and_unseen(tmp_path: Path, second: str, code: int) -> None:
    import pty

    variables = {"PIGAMING_HOME": str(tmp_path), "PYTHONPATH": str(ROOT)}
    pid, terminal = pty.fork()
    if pid == 0:
        os.environ.update(variables)
        os.execv(sys.executable, [sys.executable, "-m", "pigaming_app", "kiosk", "pin"])
    seen = b""
    for prompt, typed in ((b"digits: ", PIN), (b"more: ", second)):
        while not seen.endswith(prompt):
            seen += os.read(terminal, 1000)
        os.write(terminal, f"{typed}\n".encode())
    try:
        while block := os.read(terminal, 1000):
            seen += block
    except OSError:
        pass  # Linux: the other end is closed
    assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == code
    os.close(terminal)
    assert PIN.encode() not in seen
    assert PinFile(tmp_path / "config").is_set == (code == 0)
