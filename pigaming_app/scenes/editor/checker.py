"""Checks of a drawing in threads: its problems at once, then the plans of AIs. Only the latest drawing counts."""

import logging
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

from pigaming_app.games.arenas import parse
from pigaming_app.games.drawing.values import Drawing
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor.model.problems import Problem, problems
from pigaming_app.scenes.editor.model.shapes import Routes, Tools
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.sim.world import HEIGHT, WIDTH

log = logging.getLogger("pigaming")
Task = TypeVar("Task")


@dataclass(frozen=True)
class CheckResult:
    """What is known about a drawing. `arena`: None until it is parsed, or if something blocks; `done`: that is all."""

    drawing: Drawing
    problems: Sequence[Problem]
    arena: Arena | None = None
    routes: Routes = ()
    done: bool = False

    @property
    def blocked(self) -> bool:
        """True if it cannot be played."""
        return any(problem.blocks for problem in self.problems)


class LatestTask(Generic[Task]):
    """A thread that does the latest of the tasks that it was given meanwhile."""

    def __init__(self, name: str, work: Callable[[Task], None]) -> None:
        self.name, self.work = name, work
        self._task: Task | None = None
        self._ended, self._wake = False, threading.Condition()
        self._thread: threading.Thread | None = None

    def give(self, task: Task) -> None:
        """Do this task next, in place of any other one."""
        with self._wake:
            self._task = task
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name=self.name, daemon=True)
                self._thread.start()
            self._wake.notify()

    def end(self) -> None:
        """Stop after the current task."""
        with self._wake:
            self._ended = True
            self._wake.notify()

    def _run(self) -> None:
        while (task := self._next()) is not None:
            try:
                self.work(task)
            except Exception:
                log.exception("the %s failed", self.name)

    def _next(self) -> Task | None:
        with self._wake:
            self._wake.wait_for(lambda: self._ended or self._task is not None)
            task, self._task = self._task, None
            return None if self._ended else task


class Checker:
    """The checks of one editor. `verdict`: of a drawing, not always of the latest one."""

    def __init__(self, tools: Tools, name: str) -> None:
        self.tools, self.name = tools, name
        self.verdict: CheckResult | None = None
        self._asked: Drawing | None = None
        self._finder = LatestTask("arena checker", self._find)
        self._planner = LatestTask("arena planner", self._plan)

    def check(self, drawing: Drawing, plan: bool = True) -> None:
        """Check a drawing, in place of any other; `plan`: how AIs will drive there, too."""
        if (drawing, plan) != (self._asked, False):
            self._asked = drawing
            self._finder.give((drawing, plan))

    def of(self, drawing: Drawing) -> CheckResult | None:
        """The verdict on a drawing, as far as it is known."""
        verdict = self.verdict
        return verdict if verdict and verdict.drawing == drawing else None

    def end(self) -> None:
        """Stop after the current checks."""
        self._finder.end()
        self._planner.end()

    def _find(self, task: tuple[Drawing, bool]) -> None:
        """Publish the problems of a drawing."""
        drawing, plan = task
        found = CheckResult(drawing, problems(games()[self.tools.game], drawing))
        self.verdict = replace(found, done=found.blocked)
        if plan and not found.blocked:
            self._planner.give(found)

    def _plan(self, found: CheckResult) -> None:
        """Publish the arena, then the plans of AIs, unless there is another drawing by then."""
        try:
            arena = parse(self.tools.game, found.drawing.text(), self.name)
            self._publish(replace(found, arena=arena))
            self._publish(replace(found, arena=arena, routes=self.tools.routes(arena), done=True))
        except (ArenaError, FieldError) as error:
            log.warning("%s", error)
            self._publish(replace(found, problems=[*found.problems, unknown(str(error))], done=True))

    def _publish(self, verdict: CheckResult) -> None:
        if self._asked == verdict.drawing:
            self.verdict = verdict


def unknown(reason: str) -> Problem:
    """A problem that only the reader of files has found."""
    return Problem("arena", WIDTH / 2, HEIGHT / 2, WIDTH / 4, reason, True, "arena")
