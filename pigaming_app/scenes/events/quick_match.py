"""Matches of AIs in a process of their own, at full speed: they delay no frame, and end with the arcade.

python -m pigaming_app.scenes.events.quick_match    takes an event and fixtures from standard input as a pickle, and
                                                    leaves their outcomes on standard output, one after the other
"""

import logging
import os
import pickle
import sys
from collections.abc import Sequence
from queue import Empty, SimpleQueue
from threading import Thread
from typing import TYPE_CHECKING

from pigaming_app.storage.background import exit_with_parent, launch

if TYPE_CHECKING:
    from subprocess import Popen

    from pigaming_app.events.event import Event
    from pigaming_app.events.spec import Fixture, Result

COMMAND = (sys.executable, "-m", "pigaming_app.scenes.events.quick_match")

log = logging.getLogger("pigaming")


class QuickMatches:
    """Matches that are being played, in this order. Raises OSError if the process cannot be started."""

    def __init__(self, event: "Event", fixtures: "Sequence[Fixture]") -> None:
        self.left = len(fixtures)
        self._ended = False  # by hand
        self._outcomes: SimpleQueue[Result] = SimpleQueue()
        self._process: Popen[bytes] = launch(COMMAND, answers=True)
        self._thread = Thread(target=self._talk, args=(pickle.dumps((event, tuple(fixtures))),), daemon=True)
        self._thread.start()

    @property
    def over(self) -> bool:
        """True when there is no outcome to come; `left` is then 0, unless the process has failed."""
        return not self._thread.is_alive() and self._outcomes.empty()

    def next_outcome(self) -> "Result | None":
        """The next outcome, once; None if it is not there yet."""
        try:
            outcome = self._outcomes.get_nowait()
        except Empty:
            return None
        self.left -= 1
        return outcome

    def end(self) -> None:
        """Kill the process."""
        self._ended = True
        self._process.kill()
        self._thread.join()

    def _talk(self, order: bytes) -> None:
        process = self._process
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            process.stdin.write(order)
            process.stdin.flush()
            for _ in range(self.left):
                self._outcomes.put(pickle.load(process.stdout))
        except (OSError, EOFError, pickle.UnpicklingError) as error:
            if not self._ended:
                log.warning("matches in the background: %s", error)
        finally:
            process.kill()
            process.communicate()


def serve() -> None:
    """Play what standard input orders."""
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever prints must not print into the outcomes
    event, fixtures = pickle.load(sys.stdin.buffer)
    exit_with_parent()
    for fixture in fixtures:
        pickle.dump(play(event, fixture), output)
        output.flush()


def play(event: "Event", fixture: "Fixture", person: str = "human") -> "Result":
    """Play a match of AIs to its end; `person` drives for people. Raises ValueError if a brain or arena is missing."""
    from pigaming_app.ai.registry import new_match
    from pigaming_app.events.match_setup import outcome_of, setup_of

    match = new_match(setup_of(event, fixture, person))
    while not match.over:
        match.tick()
    return outcome_of(event.spec, fixture, match.outcome().rows)


if __name__ == "__main__":
    serve()
