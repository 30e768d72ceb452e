"""Background training of a table for the Lab; it never delays a frame.

With numba it runs in its own thread, which releases the GIL. Without numba, or while numba compiles (in another
process), the page grants it a few milliseconds per frame. The thread ends shortly after the last `feed`, even after
a failure of the page.
"""

import gc
import logging
import threading
from time import monotonic, perf_counter, sleep

from pigaming_app.ai.learning.compiler import Compiler
from pigaming_app.ai.learning.evaluation import compile_all
from pigaming_app.ai.learning.training import Checkpoint, TableTraining, resumed
from pigaming_app.ai.qlearning.recipe import Recipe
from pigaming_app.ai.qlearning.table_files import Trained
from pigaming_app.scenes.lab.progress import EXAMS_PER_CURVE, TrainingProgress, TrainingState
from pigaming_app.scenes.lab.rewarded import Rewarded
from pigaming_app.scenes.lab.saved_robots import RobotFileError, save_robot
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ
from pigaming_app.ui import memory as heap

FASTEST = 2  # index of full speed
FACTORS = (1, 10)  # times real time
CHUNK = 6000  # ticks of a match
TURN = 0.02  # s that a batch takes at most at full speed, of one match or more: between two, drawing may hold Python
MAX_BACKLOG = 4  # frames of ticks to catch up at most; the rest is dropped
FEED_TIMEOUT = 0.7  # s without `feed` after which the thread ends
SLICE = 0.007  # s per frame for interpreted training and evaluation; rendering takes 2 of the 16 ms
TRAINING_SHARE = 0.4  # share of a slice for training at full speed
FIRST_SHARE = 0.1  # the same until the first point of the curve

log = logging.getLogger("pigaming")


class Trainer(Rewarded[Recipe]):
    """Runs one training. `recipe` and `speed` may be set at any time; `snapshot` is the published state."""

    available, trouble = True, ""  # tables are learned on every machine

    def __init__(self, recipe: Recipe, seed: int, fast: bool | None = None, compiler: Compiler | None = None) -> None:
        """`fast`: compiled as soon as `compiler` is done; None: if numba is available."""
        self._compiler = compiler or Compiler()
        self._first = recipe
        self.recipe, self.speed = recipe, 0
        self.share = 1.0  # of SLICE
        self.may_compile = can_compile() if fast is None else fast
        self.training = TableTraining(recipe, seed, fast=False)
        self.progress = TrainingProgress(self.training)
        self.compiling = False
        self._lock = threading.Lock()  # guards the training
        self._thread: threading.Thread | None = None
        self._last_feed = 0.0
        self._open = False
        self._backlog = 0.0  # ticks

    @property
    def snapshot(self) -> TrainingState:
        """The latest snapshot."""
        return self.progress.snapshot

    @property
    def fast(self) -> bool:
        return self.training.fast

    @property
    def arena(self) -> str:
        return self.training.arena

    def feed(self, seconds: float) -> None:
        """Called every frame, `seconds` after the last call: keep the training running."""
        self._last_feed, self._open = monotonic(), True
        if self.may_compile and (self._thread is None or not self._thread.is_alive()):
            self._thread = threading.Thread(target=self._thread_main, name="lab")
            self._thread.start()
        if not self.training.fast and self._lock.acquire(blocking=False):
            try:
                if not self.training.fast:
                    self._slice(seconds)
            finally:
                self._lock.release()

    def close(self) -> None:
        """Pause until the next `feed`; the thread ends shortly after."""
        self._open = False

    def join(self, seconds: float = 1.0) -> bool:
        """Wait for the thread to end; True if it has."""
        if self._thread:
            self._thread.join(seconds)
        return self._thread is None or not self._thread.is_alive()

    def checkpoint(self, name: str) -> Checkpoint:
        """The current policy as a named checkpoint."""
        with self._lock:
            return self.training.checkpoint(name)

    def checkpoints(self) -> dict[int, Checkpoint]:
        """Checkpoints after 0, 10, 50 and 200 matches, as far as reached."""
        with self._lock:
            return dict(self.progress.checkpoints)

    @property
    def first_point(self) -> int | None:
        """s until the first point of the win curve; None if it is there."""
        return self.progress.first_point

    def begin(self, seed: int) -> None:
        """Restart from an empty table."""
        with self._lock:
            self._train(TableTraining(self.recipe, seed, fast=self.training.fast))

    def reset(self, seed: int) -> None:
        """Start again as for the first visitor."""
        self.recipe, self.speed = self._first, 0
        self.begin(seed)

    def save(self, name: str) -> None:
        """Save the robot. Raises RobotFileError."""
        with self._lock:
            self._follow_recipe()
            save_robot(self.training, name)

    def open(self, trained: Trained) -> None:
        """Continue with a saved table. Raises RobotFileError."""
        try:
            training = resumed(trained, self.fast)
        except ArenaError as error:
            log.warning("%s", error)
            raise RobotFileError("lab.broken") from error
        with self._lock:
            self.recipe = training.recipe
            self._train(training)

    # ---- inside

    def _train(self, training: TableTraining) -> None:
        self.training, self._backlog = training, 0.0
        self.progress = TrainingProgress(training)

    @property
    def _active(self) -> bool:
        return self._open and monotonic() - self._last_feed < FEED_TIMEOUT

    def _due(self, seconds: float) -> int:
        """Ticks due after `seconds` of real time at one of the slower speeds."""
        factor = FACTORS[self.speed]
        self._backlog = min(self._backlog + seconds * HZ * factor, MAX_BACKLOG * factor)
        ticks = int(self._backlog)
        self._backlog -= ticks
        return ticks

    def _slice(self, seconds: float) -> None:
        """One frame's slice of interpreted training."""
        slice_ = SLICE * self.share
        end = perf_counter() + slice_
        self._follow_recipe()
        if self.speed < FASTEST:
            self.progress.train(self._due(seconds))
        else:
            share = TRAINING_SHARE if self.progress.measures else FIRST_SHARE
            while perf_counter() < end - (1 - share) * slice_:
                self.progress.train(20)
        self.progress.publish(self.speed == FASTEST)
        exam = self.progress.exam_due(self.speed == FASTEST)
        while exam and not exam.over and perf_counter() < end:
            exam.play(20)
        self.progress.record_exam()

    def _follow_recipe(self) -> None:
        if self.training.recipe != self.recipe:
            self.training.recipe = self.recipe

    def _thread_main(self) -> None:
        """Thread body: compile, then train until no longer fed."""
        try:
            if self.training.fast or self._load_compiled():
                self._run()
        except Exception:
            log.exception("compiled training failed; falling back to interpreted training")
            self.may_compile = False
            self._switch_to(fast=False)

    def _load_compiled(self) -> bool:
        """Wait for the compiler, load its output and take over the training; False if no longer fed."""
        self.compiling = True
        try:
            self._compiler.start()
            while (code := self._compiler.code) is None:
                if not self._active:
                    return False
                sleep(0.05)
            if code:
                raise RuntimeError(f"compiling ended with exit code {code}")
            with heap.gc_paused():  # a collection over numba's objects takes up to 100 ms and would stall a frame
                compile_all()
                gc.freeze()  # they stay loaded
            self._switch_to(fast=True)
            return True
        finally:
            self.compiling = False

    def _switch_to(self, fast: bool) -> None:
        """Continue with the same table, compiled or interpreted."""
        with self._lock:
            old = self.training
            if old.fast != fast:
                self.training = TableTraining(self.recipe, old.seed, old.arena, fast, old.table, old.minutes)
                self.progress.replace_training(self.training)

    def _run(self) -> None:
        last, chunk = perf_counter(), CHUNK
        while self._active:
            now = perf_counter()
            with self._lock:
                self._follow_recipe()
                at_once = CHUNK * max(1, self.training.matches // EXAMS_PER_CURVE)  # evaluations are no farther apart
                ticks = min(chunk, at_once) if self.speed == FASTEST else self._due(now - last)
                exam = self.progress.exam_due(self.speed == FASTEST)
                if not (exam and self.speed == FASTEST):
                    self.progress.train(ticks)
                    if self.speed == FASTEST:
                        chunk = next_chunk(ticks, perf_counter() - now)
                self.progress.publish(self.speed == FASTEST)
                progress = self.progress
            last = now
            if exam and not exam.over:
                exam.play(CHUNK * HZ)
            with self._lock:
                progress.record_exam()
            if self.speed < FASTEST:
                sleep(max(0.0, 1 / HZ - (perf_counter() - now)))


def next_chunk(ticks: int, seconds: float) -> int:
    """Ticks of whole matches to play in a batch, after one of `ticks` took `seconds`: twice as many at most."""
    return CHUNK * max(1, int(min(2.0 * ticks, ticks * TURN / max(seconds, 1e-6)) / CHUNK))
