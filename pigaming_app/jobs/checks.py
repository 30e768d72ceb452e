"""The job `test`: the linter, the formatter, the type checker and the tests, which share all cores."""

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TOOLS: dict[str, tuple[str, ...]] = {
    "ruff check": ("ruff", "check", "--quiet", "."),
    "ruff format": ("ruff", "format", "--check", "--quiet", "."),
    "mypy": ("mypy", "--no-error-summary"),
}
WORKERS = ("-n", str(os.cpu_count() or 1), "--dist", "loadfile", "--no-loadscope-reorder")
UNSEEN = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PYGAME_HIDE_SUPPORT_PROMPT": "1"}


def run(for_pytest: Sequence[str] = ()) -> int:
    """Run every tool, also after one has failed; 0 if all are content. The arguments go to pytest.

    The summary of pytest comes last on standard output; what failed besides is said after it on standard error.
    """
    failed = [name for name, tool in TOOLS.items() if not _passes(name, tool)]
    code = _code(("pytest", *WORKERS, *for_pytest))
    if failed:
        print(f"FAILED before the tests: {', '.join(failed)}", file=sys.stderr)
    return code or int(bool(failed))


def _passes(name: str, tool: Sequence[str]) -> bool:
    start = time.perf_counter()
    code = _code(tool)
    print(f"{name}: {'failed' if code else 'passed'} ({time.perf_counter() - start:.1f} s)", flush=True)
    return code == 0


def _code(tool: Sequence[str]) -> int:
    command = [sys.executable, "-m", *tool]
    return subprocess.run(command, cwd=ROOT, env={**os.environ, **UNSEEN}, check=False).returncode
