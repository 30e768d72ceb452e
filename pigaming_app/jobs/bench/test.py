"""Linter, formatter, type checker and tests, side by side on all cores. Unknown options and files go to pytest."""

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, NamedTuple

from pigaming_app import FROZEN, INSTALLED, ROOT
from pigaming_app.jobs.terminal.options import ONE_OF, Groups, flag, option
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.storage.parsing import quote

RUFF: dict[str, tuple[str, ...]] = {
    "ruff check": ("ruff", "check", "--quiet", "."),
    "ruff format": ("ruff", "format", "--check", "--quiet", "."),
}
MYPY = {"mypy": ("mypy", "--no-error-summary")}
UNITS = tuple(f"tests/{room}" for room in (
    "sim", "games", "ai/brain", "ai/pitanks", "ai/factory", "ai/race", "ai/learning/test_q_learner.py", "storage",
    "test_layers.py",
))  # fmt: skip
WORKERS = (os.cpu_count() or 1) + 1  # one more than cores: tests often wait for a clock or another process
NOTHING = 5  # exit code of pytest without a test
# No window and no sound; bytecode is written even where the caller forbids it, because tests start many processes.
ENVIRONMENT = {
    "SDL_VIDEODRIVER": "dummy",
    "SDL_AUDIODRIVER": "dummy",
    "PYGAME_HIDE_SUPPORT_PROMPT": "1",
    "PYTHONDONTWRITEBYTECODE": "",
    "OPENCV_FOR_THREADS_NUM": "1",  # there are workers for all cores
}


class ToolResult(NamedTuple):
    """The end of a tool's run; `output` holds both of its streams."""

    name: str
    code: int
    seconds: float
    output: str


@dataclass(frozen=True, kw_only=True)
class TestOptions:
    """Which tests; `for_pytest`: all unknown options."""

    GROUPS: ClassVar[Groups] = {ONE_OF: ("quick", "long", "feature")}

    quick: bool = flag(f"ruff and the unit tests: {', '.join(UNITS)}")
    long: bool = flag("the long proofs: only the tests marked `long`")
    feature: str | None = option("all tests of one feature, such as events", metavar="NAME")
    for_pytest: tuple[str, ...] = ()


def run(options: TestOptions) -> int:
    """Run pytest and the other tools in parallel; 0 if all pass. Raises Refusal.

    The summary of pytest comes last on standard output; the other tools report after it on standard error.
    """
    if INSTALLED or FROZEN:
        raise Refusal("an installed program has no tests: run main.py test in a clone")
    tools = {} if options.long or options.feature else RUFF if options.quick else RUFF | MYPY
    marked: tuple[str, ...] = ("-m", "long" if options.long else "not long")
    units = UNITS if options.quick and not any(map(_is_path, options.for_pytest)) else ()
    if options.feature:
        marked, units = (), paths_of(options.feature)
    for_pytest = (*marked, *options.for_pytest, *units)
    with ThreadPoolExecutor(1) as executor:
        results = executor.map(_run, tools.items())
        code = _long_proofs(for_pytest) if options.long else _pytest(WORKERS, for_pytest)
        failed = [_report(result) for result in results]
    return code or int(any(failed))


def _long_proofs(for_pytest: Sequence[str]) -> int:
    """Run the long proofs, those that need the whole computer (`alone`) last and one by one; the exit code."""
    at = len(for_pytest) - for_pytest[::-1].index("-m")  # the last one counts
    beside, alone = (
        (*for_pytest[:at], f"({for_pytest[at]}) and {mark}", *for_pytest[at + 1 :]) for mark in ("not alone", "alone")
    )
    codes = {_pytest(WORKERS, beside), _pytest(0, alone)}
    return max(codes - {NOTHING} or codes)


def _pytest(workers: int, arguments: Sequence[str]) -> int:
    with _python(("pytest", "-n", str(workers), "--dist", "worksteal", *arguments)) as pytest:
        return pytest.wait()


def paths_of(name: str) -> tuple[str, ...]:
    """The folders and files of the tests of a feature, which mirror its rooms. Raises Refusal."""
    from pigaming_app.jobs.features import every_feature

    features = {feature.name: feature for feature in every_feature()}
    if name not in features:
        raise Refusal(f"--feature: no feature {quote(name)}; there are {', '.join(features)}")
    return tuple(path for room in features[name].rooms for path in _mirror(Path("tests", *room.split("."))))


def _mirror(place: Path) -> tuple[str, ...]:
    """The tests of a room: its folder, or files that are named after it."""
    if (ROOT / place).is_dir():
        return (place.as_posix(),)
    files = (ROOT / place.parent).glob(f"test_{place.name}*.py")
    return tuple(sorted(file.relative_to(ROOT).as_posix() for file in files))


def _is_path(word: str) -> bool:
    return Path(ROOT, word.partition("::")[0]).exists()


def _run(tool: tuple[str, Sequence[str]]) -> ToolResult:
    """Run a tool at a lower priority than the tests, which take longer."""
    name, arguments = tool
    start = time.perf_counter()
    with _python(arguments, subprocess.PIPE) as process:
        if sys.platform != "win32":
            os.setpriority(os.PRIO_PROCESS, process.pid, 10)
        output, _ = process.communicate()
    return ToolResult(name, process.returncode, time.perf_counter() - start, output.decode(errors="replace"))


def _python(arguments: Sequence[str], output: int | None = None) -> subprocess.Popen[bytes]:
    """Start a Python module; `output` is the destination of both its streams."""
    command, environment = [sys.executable, "-m", *arguments], {**os.environ, **ENVIRONMENT}
    errors = None if output is None else subprocess.STDOUT
    return subprocess.Popen(command, cwd=ROOT, env=environment, stdout=output, stderr=errors)


def _report(result: ToolResult) -> bool:
    """Print the result of a tool; true if it failed."""
    verdict = "FAILED" if result.code else "passed"
    print(f"{result.output}{result.name}: {verdict} ({result.seconds:.1f} s)", file=sys.stderr)
    return result.code != 0
