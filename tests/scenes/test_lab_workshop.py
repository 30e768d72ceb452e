"""The training beside the frames: it never waits for compiling, goes over to compiled play, and its thread ends."""

import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from pigaming_app.ai.rewards import RECIPES
from pigaming_app.scenes.lab import workshop
from pigaming_app.scenes.lab.workshop import FASTEST, Workshop
from pigaming_app.sim.kernel import can_compile

needs_numba = pytest.mark.skipif(not can_compile(), reason="numba is not installed")


@pytest.fixture
def shop() -> Iterator[Workshop]:
    shop = Workshop(RECIPES[1], 5)
    yield shop
    shop.close()
    assert shop.join(10.0)


def feed(shop: Workshop, so: Callable[[], bool], most: float = 300.0) -> None:
    """Frame after frame until something is so."""
    end = time.monotonic() + most
    while not so():
        assert time.monotonic() < end, "it never comes"
        shop.feed(1 / 60)
        time.sleep(1 / 60)


def threads() -> list[str]:
    return [thread.name for thread in threading.enumerate() if thread.name == "lab"]


def test_without_numba_there_is_no_thread_and_it_learns_in_slices() -> None:
    shop = Workshop(RECIPES[1], 5, fast=False)
    feed(shop, lambda: shop.training.experiences > 0)
    assert threads() == []
    assert not shop.fast


def test_a_slice_ends_in_time_whatever_is_going_on() -> None:
    shop = Workshop(RECIPES[1], 5, fast=False)
    shop.speed = FASTEST
    ticks = []
    for _ in range(30):
        before = shop.training.match.tick
        shop.feed(1 / 60)
        ticks.append(shop.training.match.tick - before)
    assert max(ticks) < 6000, "no slice is a whole match"


@needs_numba
def test_it_trains_while_it_compiles_then_goes_on_with_the_same_table_compiled(shop: Workshop) -> None:
    shop.speed = FASTEST
    feed(shop, lambda: shop.training.experiences > 10)
    assert not shop.fast
    feed(shop, lambda: shop.fast)
    assert shop.training.experiences > 10, "what it had learned is not lost"
    feed(shop, lambda: shop.training.matches >= 12 and len(shop.progress.measures) >= 2)
    assert {0, 10} <= set(shop.checkpoints())
    assert shop.checkpoints()[10].matches == 10
    number = shop.moment.number
    feed(shop, lambda: shop.moment.number > number + 3)
    shop.close()
    assert shop.join(10.0)
    assert threads() == []
    experiences = shop.training.experiences
    time.sleep(0.1)
    assert shop.training.experiences == experiences
    feed(shop, lambda: shop.training.experiences > experiences)


class Endless:
    """A compiler that never comes to an end."""

    def __init__(self, *_: Any, **__: Any) -> None:
        self.killed = False

    def __enter__(self) -> "Endless":
        return self

    def __exit__(self, *_: Any) -> None:
        assert self.killed, "the process is not left behind"

    def poll(self) -> int | None:
        return None

    def kill(self) -> None:
        self.killed = True


@pytest.mark.parametrize("closed", [True, False], ids=["closed", "forgotten"])
def test_the_thread_ends_when_the_page_is_left_and_also_when_nobody_says_so(
    shop: Workshop, monkeypatch: pytest.MonkeyPatch, closed: bool
) -> None:
    monkeypatch.setattr(workshop, "compiler", Endless)
    shop.may_compile = True
    feed(shop, lambda: bool(threads()))
    feed(shop, lambda: shop.compiling)
    if closed:
        shop.close()
    assert shop.join(10.0)
    assert not shop.compiling


@pytest.mark.parametrize("code", [0, 1], ids=["while loading", "in its process"])
def test_where_compiling_fails_plain_training_goes_on(
    shop: Workshop, monkeypatch: pytest.MonkeyPatch, code: int
) -> None:
    def broken() -> None:
        raise ImportError("no LLVM")

    class Done(Endless):
        def poll(self) -> int | None:
            return code

        def __exit__(self, *_: Any) -> None:
            pass

    monkeypatch.setattr(workshop, "compiler", Done)
    monkeypatch.setattr(workshop, "compile_all", broken)
    shop.may_compile = True
    feed(shop, lambda: not shop.may_compile)
    before = shop.training.experiences
    feed(shop, lambda: shop.training.experiences > before)
    assert not shop.fast


@needs_numba
def test_where_compiled_training_breaks_plain_training_goes_on_with_the_same_table(
    shop: Workshop, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(self: Workshop) -> None:
        raise MemoryError("no more")

    shop._hand_over(fast=True)
    table = shop.training.experiences
    monkeypatch.setattr(Workshop, "_run", broken)
    shop.may_compile = True
    feed(shop, lambda: not shop.may_compile)
    assert shop.join(10.0)
    assert not shop.fast
    feed(shop, lambda: shop.training.experiences > table)
