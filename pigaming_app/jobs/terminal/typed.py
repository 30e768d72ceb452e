"""What is typed unseen: a PIN."""

import sys
from getpass import getpass

from pigaming_app.jobs.terminal.refusal import Refusal


def typed(prompt: str, job: str) -> str:
    """A line that is typed unseen, or read from standard input. Raises Refusal, in the name of a job, without one."""
    try:
        return getpass(prompt) if sys.stdin.isatty() else sys.stdin.readline().strip()
    except EOFError:
        raise Refusal(f"{job}: nothing was typed") from None
