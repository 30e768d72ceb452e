"""The double-click entry: an old Python, a first start without a network, a bare Python."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from main import too_old

ROOT = Path(__file__).resolve().parent.parent


def copied(tmp_path):
    """A clone without its environment."""
    for name in ("main.py", "pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, tmp_path / name)
    for name in ("pigaming_app", "assets"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path


def started(folder, *arguments, **environment):
    command = [sys._base_executable, str(folder / "main.py"), *arguments]
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("PIP_", "VIRTUAL_ENV"))}
    return subprocess.run(
        command, cwd=folder, env={**clean, **environment}, capture_output=True, text=True, timeout=300, check=False
    )


def test_an_old_python_is_told_what_is_needed():
    assert too_old((3, 9)) == "PiGaming needs Python 3.11 or newer; this is 3.9"
    assert too_old((3, 11)) is None
    assert too_old((4, 0)) is None


def test_without_a_network_one_line_says_what_to_do(tmp_path):
    offline = {"PIP_NO_INDEX": "1", "PIP_CONFIG_FILE": os.devnull, "PIP_NO_CACHE_DIR": "1"}
    ended = started(copied(tmp_path), "doctor", **offline)
    assert ended.returncode == 2
    assert "Traceback" not in ended.stderr
    assert ended.stdout == ""
