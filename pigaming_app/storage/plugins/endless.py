"""An end for a job in which the code of a plug-in does not return, in plain Python, in a blocking call, or compiled.

A thread looks at the stacks now and then. One call of plain code that lasts too long gets TookTooLong; where that does
not help, as in compiled code that makes no tick, the program ends with one line and exit code 1.
"""

import os
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Any

from pigaming_app.storage.parsing import one_line
from pigaming_app.storage.plugins.found import Plugin
from pigaming_app.storage.plugins.time_limit import raise_in

LIMIT = 10.0  # s, for one call of a plug-in's code, and for one tick of compiled code
GRACE = 2.0  # s for the exception to arrive


@dataclass
class _Running:
    """Something that has not returned: a call of plain code, or compiled matches at so many ticks."""

    what: object
    since: float
    raised: bool = False


class Overseer:
    """Ends endless code of some plug-ins. It starts with the first one that may run."""

    def __init__(self) -> None:
        self._plugins: dict[str, Plugin] = {}
        self._calls: dict[int, tuple[Plugin, Callable[[], int]]] = {}  # compiled, by thread
        self._running: dict[int, _Running] = {}  # by thread

    def oversee(self, plugins: Iterable[Plugin]) -> None:
        """Add plug-ins."""
        new = {plugin.name: plugin for plugin in plugins}
        if new and not self._plugins:
            threading.Thread(target=self._work, name="overseer", daemon=True).start()
        self._plugins |= new

    def run(self, game: str, ticks: Callable[[], int], loop: Callable[..., None], *arguments: Any) -> None:
        """Run a compiled loop; `ticks` counts the ticks of its matches so far, in any thread."""
        thread = threading.get_ident()
        if game in self._plugins:
            self._calls[thread] = self._plugins[game], ticks
        try:
            loop(*arguments)
        finally:
            self._calls.pop(thread, None)

    def is_overseen(self, game: str) -> bool:
        """Whether a game is a plug-in's that is not of this program."""
        return game in self._plugins

    def _work(self) -> None:
        while True:
            time.sleep(LIMIT / 20)
            self._look_round()

    def _look_round(self) -> None:
        """Look at all threads. No frame is kept: its variables, such as views that lock a surface, would live on."""
        frames = sys._current_frames()
        for thread in self._running.keys() - frames.keys():
            del self._running[thread]
        for thread, frame in frames.items():
            self._look(thread, frame)

    def _look(self, thread: int, frame: FrameType) -> None:
        """Note what a thread runs; end it if it is still the same after LIMIT."""
        compiled = self._calls.get(thread) if frame.f_code is Overseer.run.__code__ else None
        plugin, what = (compiled[0], compiled[1]()) if compiled else self._call(frame)
        if plugin is None:
            self._running.pop(thread, None)
            return
        known = self._running.get(thread)
        if known is None or (known.what is not what and known.what != what):
            self._running[thread] = _Running(what, time.monotonic())
            return
        took = time.monotonic() - known.since
        if took > LIMIT and not compiled and not known.raised:
            known.raised = True
            raise_in(thread)
        elif took > LIMIT + GRACE:
            self._end(plugin, "its compiled code made no tick" if compiled else f"{place(plugin, frame)}it did not end")

    def _call(self, frame: FrameType) -> tuple[Plugin | None, object]:
        """The outermost call of a plug-in's code on a stack, but for imports, which have a limit of their own."""
        for caller in reversed([one for one, _ in traceback.walk_stack(frame)]):
            file = Path(caller.f_code.co_filename)
            for plugin in self._plugins.values():
                if plugin.folder in file.parents:
                    return (None, None) if caller.f_code.co_name == "<module>" else (plugin, caller)
        return None, None

    @staticmethod
    def _end(plugin: Plugin, reason: str) -> None:
        line = f"The game {plugin.name} in {plugin.folder} is left out: {reason}."
        os.write(2, f"PiGaming: {one_line(line)}\n".encode(errors="replace"))
        os._exit(1)


def place(plugin: Plugin, frame: FrameType) -> str:
    """File and line within a plug-in where a stack is."""
    for caller, line in traceback.walk_stack(frame):
        file = Path(caller.f_code.co_filename)
        if plugin.folder in file.parents:
            return f"{file.relative_to(plugin.folder)}, line {line}: "
    return ""


overseer = Overseer()
