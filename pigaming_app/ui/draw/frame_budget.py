"""How much of a frame may go into making pieces that a picture lacks, so that no frame becomes long.

A picture is drawn from cached pieces. When many are missing, such as on the first picture of a page, drawing is broken
off once the budget of the frame is spent; the pieces made so far stay in the cache, and the next frame goes on. Until
the picture is complete, the last complete one stays on the screen.
"""

import math
from collections import OrderedDict
from collections.abc import Callable, Generator, Hashable, Iterable, Iterator
from contextlib import contextmanager
from functools import wraps
from itertools import chain
from time import get_clock_info, perf_counter, thread_time
from typing import ParamSpec, TypeVar

# Other programs do not shorten a frame's share, where the system measures the time of a thread finely enough.
clock = thread_time if get_clock_info("thread_time").resolution < 1e-4 else perf_counter
PAUSED = 4  # interrupted works of a function that are kept

Args = ParamSpec("Args")
Result = TypeVar("Result")
Steps = Generator[None, None, Result]  # work that may be interrupted wherever it yields; it returns what it has made
Job = Callable[[], object]


class Unfinished(Exception):
    """The budget is spent and a piece is missing; what has been made is kept, so calling again goes on from there."""


class FrameBudget:
    """The time in which work may begin. In each frame, or under each limit outside of one, one piece is always made."""

    def __init__(self) -> None:
        self._end = math.inf
        self._made = self._in_frame = False
        self.behind = False  # this frame has no time for anything but its picture

    @contextmanager
    def frame(self, behind: bool) -> Iterator[None]:
        """One frame of the arcade."""
        self._in_frame, self._made, self.behind = True, False, behind
        try:
            yield
        finally:
            self._in_frame = self.behind = False

    @contextmanager
    def until(self, end: float) -> Iterator[None]:
        """Begin no more work after this time of `clock`."""
        before = self._end
        self._end = min(before, end)
        self._made = self._made and self._in_frame
        try:
            yield
        finally:
            self._end = before

    def claim(self) -> None:
        """Before a piece is made. Raises Unfinished where none may be begun any more."""
        if self._made and clock() >= self._end:
            raise Unfinished

    def note(self) -> None:
        """A piece was made."""
        self._made = True

    def pause(self) -> None:
        """Between two pieces. Raises Unfinished where the second one may not be begun any more."""
        self.note()
        self.claim()


budget = FrameBudget()  # of the frame's thread


class PrewarmQueue:
    """Jobs done ahead of the time when a picture needs what they make, a few in each frame."""

    def __init__(self, jobs: Iterable[Job] = ()) -> None:
        self._jobs = iter(jobs)
        self._next: Job | None = next(self._jobs, None)

    def then(self, jobs: Iterable[Job]) -> None:
        """More jobs, after all others."""
        self._jobs = chain(self._jobs, jobs)
        self._next = self._next or next(self._jobs, None)

    def work(self, milliseconds: float) -> bool:
        """Work for so long, unless the picture of this frame needs all the time; true when all is done."""
        if budget.behind:
            return self._next is None
        end = clock() + milliseconds / 1000.0
        with budget.until(end):
            while self._next:
                try:
                    self._next()
                except Unfinished:
                    return False
                self._next = next(self._jobs, None)
                if clock() >= end:
                    break
        return self._next is None


def run_to_end(steps: Steps[Result]) -> Result:
    """What uninterrupted work returns."""
    while True:
        try:
            next(steps)
        except StopIteration as end:
            made: Result = end.value
            return made


def resumable(work: Callable[Args, Steps[Result]]) -> Callable[Args, Result]:
    """A function that may be interrupted wherever `work` yields; called again with the same arguments, it goes on.

    Raises Unfinished where the budget of the frame is spent. Arguments must be hashable.
    """
    paused: OrderedDict[Hashable, Steps[Result]] = OrderedDict()

    @wraps(work)
    def result(*args: Args.args, **named: Args.kwargs) -> Result:
        key: Hashable = (args, *named.items())
        steps = paused.pop(key, None) or work(*args, **named)
        while True:
            try:
                next(steps)
            except StopIteration as end:
                run_to_end: Result = end.value
                return run_to_end
            try:
                budget.pause()
            except Unfinished:
                paused[key] = steps
                while len(paused) > PAUSED:
                    paused.popitem(last=False)
                raise

    return result
