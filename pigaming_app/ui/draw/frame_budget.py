"""Frame budget: cap the time a frame spends building missing sprites, so that no frame runs long.

A picture is drawn from cached sprites. When many are missing, as on the first picture of a page, drawing stops once
the budget of the frame is spent; sprites built so far stay in the cache, and the next frame continues. Until the
picture is complete, the last complete one stays on the screen.
"""

import math
from collections import OrderedDict
from collections.abc import Callable, Generator, Hashable, Iterable, Iterator
from contextlib import contextmanager
from functools import wraps
from itertools import chain
from time import get_clock_info, perf_counter, thread_time
from typing import Any, ParamSpec, TypeVar

# Thread time where its resolution allows: other processes then do not use up a frame's budget.
clock = thread_time if get_clock_info("thread_time").resolution < 1e-4 else perf_counter
MAX_PAUSED = 4  # interrupted generators kept: one of the picture, others of what is made ahead; each holds up to 30 MB

Args = ParamSpec("Args")
Result = TypeVar("Result")
Steps = Generator[None, None, Result]  # interruptible work: may stop at each yield; returns its result
Job = Callable[[], object]


class Unfinished(Exception):
    """The frame budget is spent and a sprite is missing. Finished sprites stay cached: call again to continue."""


class FrameBudget:
    """Time limit for building sprites. Each frame, or each limit outside a frame, always allows one."""

    def __init__(self) -> None:
        self._end = self.prewarm_end = math.inf  # times of `clock`; `prewarm_end`: no prewarming begins after it
        self._built = self._in_frame = False
        self.behind = False  # the frame is late: draw the picture only, prewarm nothing

    @contextmanager
    def frame(self, behind: bool, prewarm_end: float = math.inf) -> Iterator[None]:
        """Scope of one frame; `behind`: it is late; `prewarm_end`: time of `clock` after which nothing is prewarmed."""
        self._in_frame, self._built, self.behind, self.prewarm_end = True, False, behind, prewarm_end
        try:
            yield
        finally:
            self._in_frame = self.behind = False
            self.prewarm_end = math.inf

    def end_of_prewarming(self, milliseconds: float) -> float:
        """The time at which prewarming of so many ms ends; it is past if the frame has no time for any."""
        return -math.inf if self.behind else min(clock() + milliseconds / 1000.0, self.prewarm_end)

    @contextmanager
    def until(self, end: float) -> Iterator[None]:
        """Start no new work after `end`, a time of `clock`."""
        before = self._end
        self._end = min(before, end)
        self._built = self._built and self._in_frame
        try:
            yield
        finally:
            self._end = before

    def claim(self) -> None:
        """Call before building a sprite. Raises Unfinished if the budget is spent."""
        if self._built and clock() >= self._end:
            raise Unfinished

    def note(self) -> None:
        """Record that a sprite was built."""
        self._built = True

    def pause(self) -> None:
        """Call between two sprites. Raises Unfinished if the budget is spent."""
        self.note()
        self.claim()


budget = FrameBudget()  # shared by everything that runs in the frame thread


class PrewarmQueue:
    """Jobs that build sprites before a picture needs them, a few per frame."""

    def __init__(self, jobs: Iterable[Job] = ()) -> None:
        self._jobs = iter(jobs)
        self._next: Job | None = next(self._jobs, None)

    def append(self, jobs: Iterable[Job]) -> None:
        """Append jobs."""
        self._jobs = chain(self._jobs, jobs)
        self._next = self._next or next(self._jobs, None)

    def work(self, milliseconds: float) -> bool:
        """Run jobs for up to `milliseconds`, or none if the frame is late; true when the queue is empty."""
        end = budget.end_of_prewarming(milliseconds)
        if clock() >= end:
            return self._next is None
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
    """Run interruptible work to the end and return its result."""
    while True:
        try:
            next(steps)
        except StopIteration as end:
            value: Result = end.value
            return value


_paused: OrderedDict[Hashable, Steps[Any]] = OrderedDict()  # of all functions, by function and arguments


def resumable(work: Callable[Args, Steps[Result]]) -> Callable[Args, Result]:
    """Decorator: make a generator function interruptible at each yield and resumable with the same arguments.

    The result raises Unfinished when the frame budget is spent. Arguments must be hashable.
    """

    @wraps(work)
    def run(*args: Args.args, **named: Args.kwargs) -> Result:
        key: Hashable = (work, args, *named.items())
        steps: Steps[Result] = _paused.pop(key) if key in _paused else work(*args, **named)
        while True:
            try:
                next(steps)
            except StopIteration as end:
                value: Result = end.value
                return value
            try:
                budget.pause()
            except Unfinished:
                _paused[key] = steps
                while len(_paused) > MAX_PAUSED:
                    _paused.popitem(last=False)
                raise

    return run


def drop_paused() -> None:
    """Drop all interrupted work; it begins anew when it is needed again."""
    _paused.clear()


def finished_within(work: Callable[[], None], milliseconds: float) -> bool:
    """Do resumable work for at most this many milliseconds; true when it is complete."""
    end = budget.end_of_prewarming(milliseconds)
    if clock() >= end:
        return False
    with budget.until(end):
        try:
            work()
        except Unfinished:
            return False
    return True
