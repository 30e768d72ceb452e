"""Background training: it does not wait for the compiler, switches to compiled play, and its thread ends."""

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from pigaming_app.ai.learning.compiler import Compiler
from pigaming_app.ai.learning.training import TableTraining
from pigaming_app.ai.qlearning.recipe import RECIPES, Recipe
from pigaming_app.scenes.lab import trainer as trainer_module
from pigaming_app.scenes.lab.progress import TrainingProgress
from pigaming_app.scenes.lab.trainer import CHUNK, FASTEST, TURN, Trainer, next_chunk
from pigaming_app.sim.kernel import can_compile

needs_numba = pytest.mark.skipif(not can_compile(), reason="numba is not installed")


@pytest.fixture
def trainer(monkeypatch: pytest.MonkeyPatch) -> Iterator[Trainer]:
    monkeypatch.setattr("pigaming_app.storage.background.PATIENCE", 0)  # other tests keep all cores busy
    compiler = Compiler()
    trainer = Trainer(RECIPES[1], 5, compiler=compiler)
    yield trainer
    trainer.close()
    assert trainer.join(10.0)
    compiler.end()


def feed(trainer: Trainer, condition: Callable[[], bool], timeout: float = 300.0) -> None:
    """Feed the trainer frame by frame until a condition holds."""
    end = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < end, "timeout"
        trainer.feed(1 / 60)
        time.sleep(1 / 60)


def threads() -> list[str]:
    return [thread.name for thread in threading.enumerate() if thread.name == "lab"]


def test_without_numba_there_is_no_thread_and_it_learns_in_slices() -> None:
    trainer = Trainer(RECIPES[1], 5, fast=False)
    feed(trainer, lambda: trainer.training.experiences > 0)
    assert threads() == []
    assert not trainer.fast


def test_a_slice_ends_in_time_whatever_is_going_on() -> None:
    trainer = Trainer(RECIPES[1], 5, fast=False)
    trainer.speed = FASTEST
    ticks = []
    for _ in range(30):
        before = trainer.training.match.tick
        trainer.feed(1 / 60)
        ticks.append(trainer.training.match.tick - before)
    assert max(ticks) < 6000, "no slice is a whole match"


@pytest.mark.long(first=True)
@pytest.mark.again
@needs_numba
def test_it_trains_while_it_compiles_then_goes_on_with_the_same_table_compiled(trainer: Trainer) -> None:
    trainer.speed = FASTEST
    feed(trainer, lambda: trainer.training.experiences > 10)
    assert not trainer.fast
    feed(trainer, lambda: trainer.fast)
    assert trainer.training.experiences > 10, "the table was lost"
    feed(trainer, lambda: trainer.training.matches >= 12 and len(trainer.progress.measures) >= 2)
    assert {0, 10} <= set(trainer.checkpoints())
    assert trainer.checkpoints()[10].matches == 10
    number = trainer.snapshot.number
    feed(trainer, lambda: trainer.snapshot.number > number + 3)
    trainer.close()
    assert trainer.join(10.0)
    assert threads() == []
    experiences = trainer.training.experiences
    time.sleep(0.1)
    assert trainer.training.experiences == experiences
    feed(trainer, lambda: trainer.training.experiences > experiences)


ENDLESS = (sys.executable, "-c", "import sys; sys.stdin.read()")  # ends with the process that started it


@pytest.fixture
def endless() -> Iterator[Compiler]:
    compiler = Compiler(ENDLESS)
    yield compiler
    compiler.end()


def test_a_checkpoint_is_of_its_very_match_however_many_are_played_at_once() -> None:
    progress = TrainingProgress(TableTraining(Recipe(), 1, fast=False, minutes=0.004))  # matches of 12 ticks
    for ticks in (7, 60 * 12 - 4):
        progress.train(ticks)
    found = {wanted: (one.matches, one.experiences) for wanted, one in progress.checkpoints.items()}
    assert found == {0: (0, 0), 10: (10, 60), 50: (50, 300)}  # three of each robot in a match
    assert (progress.training.matches, progress.training.tick) == (60, 3)


def test_a_batch_is_a_match_where_they_are_slow_and_grows_to_its_time_where_they_are_fast() -> None:
    assert next_chunk(CHUNK, 10 * TURN) == next_chunk(8 * CHUNK, 10 * TURN) == CHUNK
    assert [next_chunk(ticks * CHUNK, ticks * TURN / 9.5) // CHUNK for ticks in (1, 2, 4, 8, 9)] == [2, 4, 8, 9, 9]


@needs_numba
@pytest.mark.parametrize("closed", [True, False], ids=["closed", "forgotten"])
def test_the_thread_ends_when_the_page_is_left_and_also_when_nobody_says_so(endless: Compiler, closed: bool) -> None:
    trainer = Trainer(RECIPES[1], 5, fast=True, compiler=endless)
    feed(trainer, lambda: bool(threads()))
    feed(trainer, lambda: trainer.compiling)
    if closed:
        trainer.close()
    assert trainer.join(10.0)
    assert not trainer.compiling


@needs_numba
@pytest.mark.parametrize("code", [0, 1], ids=["while loading", "in its process"])
def test_where_compiling_fails_plain_training_goes_on(monkeypatch: pytest.MonkeyPatch, code: int) -> None:
    def broken() -> None:
        raise ImportError("no LLVM")

    monkeypatch.setattr(trainer_module, "compile_all", broken)
    compiler = Compiler((sys.executable, "-c", f"exit({code})"))
    trainer = Trainer(RECIPES[1], 5, fast=True, compiler=compiler)
    feed(trainer, lambda: not trainer.may_compile)
    before = trainer.training.experiences
    feed(trainer, lambda: trainer.training.experiences > before)
    assert not trainer.fast
    trainer.close()
    assert trainer.join(10.0)
    compiler.end()


@needs_numba
def test_where_compiled_training_breaks_plain_training_goes_on_with_the_same_table(
    trainer: Trainer, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(self: Trainer) -> None:
        raise MemoryError("no more")

    trainer._switch_to(fast=True)
    table = trainer.training.experiences
    monkeypatch.setattr(Trainer, "_run", broken)
    trainer.may_compile = True
    feed(trainer, lambda: not trainer.may_compile)
    assert trainer.join(10.0)
    assert not trainer.fast
    feed(trainer, lambda: trainer.training.experiences > table)


@needs_numba
def test_leaving_and_returning_waits_for_the_same_process(endless: Compiler) -> None:
    trainer = Trainer(RECIPES[1], 5, compiler=endless)
    feed(trainer, lambda: trainer.compiling)
    process = endless._process
    assert process
    for _ in range(2):
        trainer.close()
        assert trainer.join(10.0)
        assert process.poll() is None, "compiling continues after leaving the Lab"
        feed(trainer, lambda: trainer.compiling)
        assert endless._process is process
    trainer.close()
    assert trainer.join(10.0)


@pytest.mark.again  # copies that load what the first compiled: sim/test_kernel.py
@pytest.mark.long
@needs_numba
def test_a_second_training_in_the_same_arcade_is_compiled_at_once(trainer: Trainer) -> None:
    feed(trainer, lambda: trainer.fast)
    process = trainer._compiler._process
    again = Trainer(RECIPES[1], 6, compiler=trainer._compiler)
    feed(again, lambda: again.fast, 10.0)
    assert again.training.loop is trainer.training.loop
    assert again._compiler._process is process
    again.close()
    assert again.join(10.0)


@needs_numba
def test_the_process_ends_with_the_arcade_and_is_not_started_again() -> None:
    compiler = Compiler(ENDLESS)
    compiler.start()
    process = compiler._process
    compiler.start()
    assert process
    assert compiler._process is process
    compiler.end()
    assert process.poll() is not None
    compiler.start()
    assert compiler._process is process


def test_without_numba_no_process_is_started(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pigaming_app.ai.learning.compiler.can_compile", lambda: False)
    compiler = Compiler(ENDLESS)
    compiler.start()
    assert compiler._process is None


CRASHING = """
import sys, time
from pigaming_app.ai.learning.compiler import Compiler
compiler = Compiler((sys.executable, "-c",
                     "from pigaming_app.storage.background import exit_with_parent; import time; "
                     "exit_with_parent(); time.sleep(60)"))
compiler.start()
print(compiler._process.pid, flush=True)
time.sleep(60)
"""


@needs_numba
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="/proc says whether a process is there")
def test_when_the_arcade_is_killed_the_process_ends_by_itself() -> None:
    arcade = subprocess.Popen([sys.executable, "-c", CRASHING], stdout=subprocess.PIPE, text=True)
    assert arcade.stdout
    with arcade, arcade.stdout:
        compiling = int(arcade.stdout.readline())
        os.kill(arcade.pid, signal.SIGKILL)
    end = time.monotonic() + 20.0
    while runs(compiling):
        assert time.monotonic() < end, "the process is still running"
        time.sleep(0.05)


@needs_numba
def test_a_process_that_has_compiled_ends_well_while_the_arcade_goes_on() -> None:
    code = "from pigaming_app.storage.background import exit_with_parent; exit_with_parent()"
    compiler = Compiler((sys.executable, "-c", code))
    compiler.start()
    end = time.monotonic() + 60.0
    while compiler.code is None:
        assert time.monotonic() < end
        time.sleep(0.05)
    assert compiler.code == 0
    compiler.end()


def runs(pid: int) -> bool:
    """True if a process runs; zombies do not count."""
    try:
        return ") Z" not in Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return False
