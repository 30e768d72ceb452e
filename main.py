"""Double-click to play. The first start creates .venv and installs the packages of pyproject.toml.

Old Python versions must be able to parse this file, to report that they are too old; the rest is in pigaming_app/boot.
"""

from __future__ import annotations

import os
import signal
import sys

NEEDS = (3, 11)


def too_old(version: tuple[int, ...]) -> str | None:
    """The error message for this Python version (major, minor), or None if it is new enough."""
    if version >= NEEDS:
        return None
    return "PiGaming needs Python {}.{} or newer; this is {}.{}".format(*(NEEDS + version))


def main() -> int:
    """Run the job of the command line. Returns its exit code, or 2 if it cannot start."""
    refusal = too_old(tuple(sys.version_info[:2]))
    if refusal:
        print(refusal, file=sys.stderr)
        return 2
    if hasattr(signal, "pthread_sigmask"):  # Ctrl-C waits until somebody can answer it
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    folder = os.path.dirname(os.path.abspath(__file__))
    if folder not in sys.path:
        sys.path.insert(0, folder)
    from pigaming_app.boot.version import is_asked, print_version

    if is_asked(sys.argv[1:]):
        return print_version()
    if getattr(sys, "frozen", False):  # a bundle needs no environment
        from pigaming_app.boot.bundled import run_module

        if run_module(sys.argv[1:]):
            return 0
    elif "pigaming" not in sys._xoptions:  # set by boot for the Python that it has chosen
        from pigaming_app.boot.start import start

        code = start(sys.argv[1:])
        if code is not None:
            return code
    from pigaming_app.jobs import cli

    return cli.main(sys.argv[1:])


if __name__ == "__main__":
    code = main()
    opened_by_double_click = sys.platform == "win32" and len(sys.argv) == 1 and "PROMPT" not in os.environ
    opened_by_double_click &= not getattr(sys, "frozen", False)  # a bundle hides its console then
    if code and opened_by_double_click and sys.stdin and sys.stdin.isatty():
        input("Press Enter to close this window.")
    sys.exit(code)
