"""The job `test`: the linter, the formatter, the type checker and the tests, side by side on all cores."""

import argparse
import os
import subprocess
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

from pigaming_app.jobs.usage import Parser

ROOT = Path(__file__).resolve().parents[2]
RUFF: dict[str, tuple[str, ...]] = {
    "ruff check": ("ruff", "check", "--quiet", "."),
    "ruff format": ("ruff", "format", "--check", "--quiet", "."),
}
MYPY = {"mypy": ("mypy", "--no-error-summary")}
UNITS = tuple(f"tests/{room}" for room in (
    "sim", "games", "ai/brain", "ai/pitanks", "ai/factory", "ai/race", "ai/qlearning", "storage", "test_layers.py",
))  # fmt: skip
WORKERS = ("-n", str(os.cpu_count() or 1), "--dist", "worksteal")
# No window and no sound; bytecode is kept even where the caller forbids it, because tests start many processes.
ENVIRONMENT = {
    "SDL_VIDEODRIVER": "dummy",
    "SDL_AUDIODRIVER": "dummy",
    "PYGAME_HIDE_SUPPORT_PROMPT": "1",
    "PYTHONDONTWRITEBYTECODE": "",
}


class Ended(NamedTuple):
    """A tool that has run."""

    name: str
    code: int
    seconds: float
    output: str


def run(words: Sequence[str] = ()) -> int:
    """Run the tests and, beside them, the other tools; 0 if all of them passed.

    The summary of pytest comes last on standard output; the other tools report after it on standard error.
    """
    chosen, for_pytest = _parser().parse_known_args(words)
    tools = {} if chosen.long else RUFF if chosen.quick else RUFF | MYPY
    marked = ("-m", "long" if chosen.long else "not long")
    units = UNITS if chosen.quick and not any(map(_is_path, for_pytest)) else ()
    with ThreadPoolExecutor(1) as beside:
        ended = beside.map(_run, tools.items())
        with _python(("pytest", *WORKERS, *marked, *for_pytest, *units)) as pytest:
            code = pytest.wait()
        failed = [_report(one) for one in ended]
    return code or int(any(failed))


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog="main.py test",
        description="Lint, format, types and tests: everything but the long proofs.",
        epilog="All other words go to pytest: main.py test -k replay",
        allow_abbrev=False,
    )
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--quick", action="store_true", help=f"only ruff and the unit tests: {', '.join(UNITS)}")
    which.add_argument("--long", action="store_true", help="only the long proofs: the tests marked `long`")
    return parser


def _is_path(word: str) -> bool:
    return Path(ROOT, word.partition("::")[0]).exists()


def _run(tool: tuple[str, Sequence[str]]) -> Ended:
    """Run a tool at a lower priority than the tests, which take longer."""
    name, words = tool
    start = time.perf_counter()
    with _python(words, subprocess.PIPE) as process:
        if sys.platform != "win32":
            os.setpriority(os.PRIO_PROCESS, process.pid, 10)
        output, _ = process.communicate()
    return Ended(name, process.returncode, time.perf_counter() - start, output.decode(errors="replace"))


def _python(words: Sequence[str], output: int | None = None) -> subprocess.Popen[bytes]:
    """Start a module of this Python; `output` is where both its streams go."""
    command, environment = [sys.executable, "-m", *words], {**os.environ, **ENVIRONMENT}
    errors = None if output is None else subprocess.STDOUT
    return subprocess.Popen(command, cwd=ROOT, env=environment, stdout=output, stderr=errors)


def _report(tool: Ended) -> bool:
    """Print how a tool ended; whether it failed."""
    verdict = "FAILED" if tool.code else "passed"
    print(f"{tool.output}{tool.name}: {verdict} ({tool.seconds:.1f} s)", file=sys.stderr)
    return tool.code != 0
