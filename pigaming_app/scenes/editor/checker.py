"""Checks of a drawing in a thread: its problems at once, then the plans of AIs. Only the latest drawing counts."""

import logging
import sys
import threading
from collections.abc import Sequence
from dataclasses import dataclass

from pigaming_app.games.arenas import parse
from pigaming_app.games.drawing.problems import Problem, problems
from pigaming_app.games.drawing.values import Drawing, text_of
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor.model.shapes import Routes, Tools
from pigaming_app.scenes.flow.preload import SWITCH_INTERVAL
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.sim.world import HEIGHT, WIDTH

log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class Verdict:
    """What is known about a drawing. `arena`: None until it is parsed, or if something blocks."""

    drawing: Drawing
    problems: Sequence[Problem]
    arena: Arena | None = None
    routes: Routes = ()
    done: bool = False

    @property
    def blocked(self) -> bool:
        """True if it cannot be played."""
        return any(problem.blocks for problem in self.problems)


class Checker:
    """The checker of one editor. `verdict`: of a drawing, not always the latest one."""

    def __init__(self, tools: Tools, name: str) -> None:
        self.tools, self.name = tools, name
        self.verdict: Verdict | None = None
        self._asked: Drawing | None = None
        self._ended, self._wake = False, threading.Condition()
        self._thread: threading.Thread | None = None

    def check(self, drawing: Drawing) -> None:
        """Check a drawing, in place of any other."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._work, name="arena checker", daemon=True)
            self._thread.start()
        with self._wake:
            self._asked = drawing
            self._wake.notify()

    def of(self, drawing: Drawing) -> Verdict | None:
        """The verdict on a drawing, as far as it is known."""
        verdict = self.verdict
        return verdict if verdict and verdict.drawing == drawing else None

    def end(self) -> None:
        """Stop after the current check."""
        with self._wake:
            self._ended = True
            self._wake.notify()

    def _work(self) -> None:
        before = sys.getswitchinterval()
        sys.setswitchinterval(SWITCH_INTERVAL)  # so that the thread that draws need not wait
        try:
            while drawing := self._next():
                self._judge(drawing)
        except Exception:
            log.exception("the arena checker failed")
        finally:
            sys.setswitchinterval(before)

    def _next(self) -> Drawing | None:
        with self._wake:
            self._wake.wait_for(lambda: self._ended or self._asked is not None)
            asked, self._asked = self._asked, None
            return None if self._ended else asked

    @property
    def _outdated(self) -> bool:
        return self._ended or self._asked is not None

    def _judge(self, drawing: Drawing) -> None:
        """Publish verdicts, each more complete than the one before."""
        found = problems(games()[self.tools.game], drawing)
        blocked = any(problem.blocks for problem in found)
        self.verdict = Verdict(drawing, found, done=blocked)
        if blocked or self._outdated:
            return
        try:
            arena = parse(self.tools.game, text_of(drawing), self.name)
            self.verdict = Verdict(drawing, found, arena)
            self.verdict = Verdict(drawing, found, arena, self.tools.routes(arena), done=True)
        except (ArenaError, FieldError) as error:
            log.warning("%s", error)
            self.verdict = Verdict(drawing, [*found, unknown(str(error))], done=True)


def unknown(reason: str) -> Problem:
    """A problem that only the reader of files has found."""
    return Problem("arena", WIDTH / 2, HEIGHT / 2, WIDTH / 4, reason, True)
