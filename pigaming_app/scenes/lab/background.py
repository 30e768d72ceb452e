"""What works for the Lab while it is not shown: the compiler, and a process that fetches an extra of the program.

The process goes on if the arcade ends: the next start then has the extra.
"""

import importlib
import logging
import sys
from subprocess import Popen
from threading import Thread

from pigaming_app.ai.learning.compiler import Compiler
from pigaming_app.scenes.features.feature import Service
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.storage.background import launch

NONE, FETCHING, DONE, BUILT, FAILED = "none", "fetching", "done", "built", "failed"
FOREIGN, RESTART = "foreign", "restart"  # of the process, see boot/fetch.py

log = logging.getLogger("pigaming")
COMPILE_NETWORKS = (sys.executable, "-m", "pigaming_app.ai.ppo.lab.process", "compile")


class LabBackground(Service):
    """What works for the Lab while it is not shown, and the Lab as it was left: its robot is kept."""

    def __init__(self, context: Context) -> None:
        self.compiler = Compiler()  # for tables
        self.network_compiler = Compiler(COMPILE_NETWORKS)
        self.network_fetch = ExtraFetch()  # of what networks need
        self.lab: Scene | None = None

    def preloaded(self) -> None:
        """Compile what the Lab needs. Raises OSError."""
        self.compiler.start()
        self.network_compiler.start()

    def close(self) -> None:
        self.compiler.end()
        self.network_compiler.end()


class ExtraFetch:
    """Fetches one extra. `state`: NONE, FETCHING or DONE, or why it failed: BUILT (a bundle without it), FAILED, or a
    reason of the process; `share`: fetched, 0 to 1.
    """

    def __init__(self, command: tuple[str, ...] = ()) -> None:
        """`command`: of the process; empty: nothing can be fetched."""
        self._command = command
        self.state, self.share = NONE, 0.0

    def start(self) -> None:
        """Start it, again if it has failed."""
        if self.state in (FETCHING, DONE):
            return
        self.state, self.share = FETCHING, 0.0
        if getattr(sys, "frozen", False):
            self.state = BUILT
            return
        if not self._command:
            self.state = FOREIGN
            return
        try:
            process = launch(self._command, answers=True)
        except OSError as error:
            log.warning("%s", error)
            self.state = FAILED
            return
        Thread(target=self._follow, args=(process,), daemon=True).start()

    def _follow(self, process: "Popen[bytes]") -> None:
        """Read its lines: shares, then its result."""
        last = FAILED
        with process:
            for line in process.stdout or []:
                last = line.decode(errors="replace").strip()
                if last.replace(".", "").isdigit():
                    self.share = float(last)
        importlib.invalidate_caches()
        self.state = last if last.isalpha() else FAILED
        log.info("fetched: %s", self.state)
