"""Command line: dispatch to the job's module. A Refusal is one line on standard error, with exit code 2."""

import argparse
import os
import sys
import textwrap
from collections.abc import Sequence
from typing import NoReturn

from pigaming_app import FROZEN, INSTALLED
from pigaming_app.boot.version import is_asked, print_version
from pigaming_app.jobs import files
from pigaming_app.jobs.registry import jobs
from pigaming_app.jobs.terminal import console, interrupt
from pigaming_app.jobs.terminal.options import declare_job
from pigaming_app.jobs.terminal.refusal import Refusal, is_of_plugin, module_of, names_failed_plugin
from pigaming_app.storage.background import BLAS

PROGRAM = "pigaming" if INSTALLED or FROZEN else "main.py"


class Parser(argparse.ArgumentParser):
    """An ArgumentParser that raises Refusal instead of printing the usage and exiting."""

    def error(self, message: str) -> NoReturn:
        raise Refusal(message)


def main(argv: Sequence[str] | None = None) -> int:
    """Run a job with these arguments, by default those of this process. Returns the exit code."""
    words = list(sys.argv[1:] if argv is None else argv)
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")  # standard output belongs to the job
    for variable in BLAS:  # our matrices are small; whoever has much to do divides it among threads of its own
        os.environ.setdefault(variable, "1")  # read when NumPy is imported
    console.prepare()
    if is_asked(words):
        return print_version()
    with interrupt.watched() as interrupts:
        try:
            interrupts.allow(True)
            code = _refused_in_one_line(words)
            interrupts.allow(False)
        except BaseException as error:
            code = interrupt.CODE if interrupts.cut else _code_of(error)
        if interrupts.cut:
            console.flushed(code)
            interrupts.end()
    return console.flushed(code)


def _code_of(error: BaseException) -> int:
    """The exit code after an exception. Raises it again where it is a mistake of the program."""
    match error:
        case SystemExit():  # argparse, after --help
            return int(error.code or 0)
        case BrokenPipeError():
            return 1
        case KeyboardInterrupt() if os.name == "nt":
            console.print_error("stopped.")
            return interrupt.CODE
        case KeyboardInterrupt():  # by SIGTERM
            return 0
    raise error


def _refused_in_one_line(words: list[str]) -> int:
    name, rest = ("arcade", words) if not words or words[0].startswith("-") else (words[0], words[1:])
    try:
        return _run(name, rest)
    except BrokenPipeError:
        raise
    except Refusal as refusal:
        line = str(refusal)
    except OSError as error:  # NotSaved, or a full standard output
        line = console.sentence(error)
    except Exception as error:
        if not is_of_plugin(error):
            raise
        return 1
    console.print_error(line)
    if name in jobs() and jobs()[name].logs_refusals:
        files.log(line)
    return 2


def _listing() -> str:
    return "\n".join(["jobs:", *(f"  {job.name:17} {job.text}" for job in jobs().values())])


def _run(name: str, words: list[str]) -> int:
    if name not in jobs():
        raise Refusal(f"no job '{name}' in this installation; there are {', '.join(jobs())}")
    job = module_of(jobs()[name].module, name)
    parser = Parser(
        prog=PROGRAM if name == "arcade" else f"{PROGRAM} {name}",
        description=textwrap.fill((job.__doc__ or "").partition("\n\n")[0], 80),
        epilog=_listing() if name == "arcade" else None,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,  # boot matches whole words, and `test` passes unknown options to pytest
    )
    declare_job(parser, job)
    arguments, unknown = parser.parse_known_args(words)
    if "for_pytest" in arguments:
        arguments.for_pytest = unknown
    elif unknown:
        raise Refusal(f"unrecognized arguments: {' '.join(unknown)}")
    arguments.words = [name, *words]  # for a job that starts this program again
    if name != "doctor":  # it changes no files
        files.sweep()
    wanted = "" if name == "games" else getattr(arguments, "game", "") or ""
    if names_failed_plugin(wanted):
        return 1
    try:
        return int(arguments.start(arguments))
    except BaseException as error:
        if isinstance(error, Refusal) and names_failed_plugin(wanted):
            return 1
        if isinstance(error, Exception) or not is_of_plugin(error):  # plug-ins also raise SystemExit, KeyboardInterrupt
            raise
        return 1
