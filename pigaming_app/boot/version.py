"""Version and commit of this program. Standard library only: it answers before any package is installed."""

import sys
from collections.abc import Sequence
from pathlib import Path

from pigaming_app import ROOT, __version__

WORDS = {"-V", "--version"}
RECORD = Path(__file__).resolve().parents[1] / "commit.txt"  # written into wheels and bundles, which have no .git
UNKNOWN = "unknown"
LENGTH = 8  # digits of a commit that are shown


def is_asked(words: Sequence[str]) -> bool:
    """Whether the words before any job ask for the version."""
    job = next((k for k, word in enumerate(words) if not word.startswith("-")), len(words))
    return bool(WORDS & {*words[:job]})


def print_version() -> int:
    """Print the version and the commit. Returns the exit code."""
    try:
        print(f"PiGaming {__version__}, commit {commit()}", flush=True)
    except OSError as error:
        sys.stdout = None  # its buffer cannot be written at exit either
        print(f"PiGaming: the output cannot be written: {error.strerror}", file=sys.stderr)
        return 2
    return 0


def commit() -> str:
    """The first digits of the commit that a clone is at, or that a wheel or a bundle was made from; or UNKNOWN."""
    return (_recorded() or _of_clone(ROOT) or UNKNOWN)[:LENGTH]


def _recorded() -> str:
    return _text(RECORD)


def _of_clone(folder: Path) -> str:
    """The commit in the git files of a folder; git itself may be missing, or refuse a folder of another user."""
    git = folder / ".git"
    if pointer := _text(git).partition("gitdir:")[2]:  # a worktree or a submodule
        git = folder / pointer.strip()
    head = _text(git / "HEAD")
    name = head.partition("ref:")[2].strip()
    if not name:
        return head
    shared = git / (_text(git / "commondir") or ".")
    packed = (line.split() for line in _text(shared / "packed-refs").splitlines())
    return _text(shared / name) or next((line[0] for line in packed if line[1:] == [name]), "")


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8").strip()
    except (OSError, ValueError):
        return ""
