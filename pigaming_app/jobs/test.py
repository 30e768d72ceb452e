"""Linter, formatter, type checker and tests, on all cores. Unknown options and files go to pytest."""

import os
import subprocess
import sys
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence

from pigaming_app import INSTALLED, ROOT
from pigaming_app.jobs.refusal import Refusal

TOOLS: dict[str, tuple[str, ...]] = {
    "ruff check": ("ruff", "check", "--quiet", "."),
    "ruff format": ("ruff", "format", "--check", "--quiet", "."),
    "mypy": ("mypy", "--no-error-summary"),
}
WORKERS = ("-n", str(os.cpu_count() or 1), "--dist", "loadfile", "--no-loadscope-reorder")
UNSEEN = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PYGAME_HIDE_SUPPORT_PROMPT": "1"}


def options(parser: ArgumentParser) -> None:
    """Declare the options; `for_pytest` collects the unknown ones."""
    parser.set_defaults(for_pytest=[])


def run(arguments: Namespace) -> int:
    """Run every tool, also after one has failed; 0 if all pass. Raises Refusal.

    The summary of pytest comes last on standard output; failures before it are named after it on standard error.
    """
    if INSTALLED:
        raise Refusal("an installed package has no tests: run main.py test in a clone")
    failed = [name for name, tool in TOOLS.items() if not _passes(name, tool)]
    code = _code(("pytest", *WORKERS, *arguments.for_pytest))
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
