"""Bots in jobs without a window: matches wait for their decisions, and begin when all are connected."""

import atexit
import sys
import time
from collections.abc import Sequence

from pigaming_app.ai.bots import brains
from pigaming_app.ai.bots.book import PREFIX
from pigaming_app.ai.bots.line import Serving
from pigaming_app.jobs.terminal.refusal import Refusal, require
from pigaming_app.scenes.bots.host import PORT, BotHost
from pigaming_app.ui.i18n import english

ADDRESS = "127.0.0.1"
PATIENCE = 60.0  # s for a bot to connect
RATE = 100_000  # texts in a second: as fast as a match can be played


def require_open(names: Sequence[str]) -> None:
    """Raises Refusal where what lets bots connect is missing."""
    require("phones")


def connect(names: Sequence[str]) -> None:
    """Listen, and wait for these bots. Raises Refusal."""
    require_open(names)
    known = brains.book().keys
    wanted = sorted({name.removeprefix(PREFIX) for name in names} & known.keys())
    if not wanted:
        return  # the job refuses names that it does not know
    brains.serve(Serving.PATIENT)
    host = BotHost(RATE)
    host.follow(True, False, ADDRESS, PORT)
    if host.trouble:
        raise Refusal(english()(f"phones.{host.trouble.key}", **host.trouble.values))
    atexit.register(host.close)
    print(f"PiGaming: waiting for {', '.join(wanted)} at {host.url}", file=sys.stderr, flush=True)
    end = time.monotonic() + PATIENCE
    for name in wanted:
        if not brains.line_of(name).wait(max(0.0, end - time.monotonic())):
            raise Refusal(f"{PREFIX}{name} has not connected to {host.url}")
