"""A match of AIs in a process of its own, at full speed: it delays no frame, and ends with the arcade.

    python -m pigaming_app.scenes.events.quick_match    takes an event and a fixture from standard input as a pickle,
                                                        and leaves the outcome on standard output
"""

import pickle
import sys
from threading import Thread
from typing import TYPE_CHECKING

from pigaming_app.ai.experiments.compiler import launch
from pigaming_app.ai.experiments.evaluation import exit_with_parent

if TYPE_CHECKING:
    from subprocess import Popen

    from pigaming_app.events.event import Event
    from pigaming_app.events.spec import Fixture, Outcome

COMMAND = (sys.executable, "-m", "pigaming_app.scenes.events.quick_match")


class QuickMatch:
    """A running match. Raises OSError if its process cannot be started."""

    def __init__(self, event: "Event", fixture: "Fixture") -> None:
        self.fixture = fixture
        self.outcome: Outcome | None = None
        self._process: Popen[bytes] = launch(COMMAND, answers=True)
        self._thread = Thread(target=self._talk, args=(pickle.dumps((event, fixture)),), daemon=True)
        self._thread.start()

    @property
    def over(self) -> bool:
        """True when the process has ended; without an outcome, it has failed."""
        return not self._thread.is_alive()

    def end(self) -> None:
        """Kill the process."""
        self._process.kill()
        self._thread.join()

    def _talk(self, order: bytes) -> None:
        process = self._process
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            process.stdin.write(order)
            process.stdin.flush()
            self.outcome = pickle.load(process.stdout)
        except (OSError, EOFError, pickle.UnpicklingError):
            pass
        finally:
            process.kill()
            process.communicate()
