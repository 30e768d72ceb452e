"""The surface cache: never more bytes than its budget; least recently used results are evicted first."""

from dataclasses import dataclass

import pygame
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.sprites import Sprite
from pigaming_app.ui.draw.surface_cache import SurfaceCache, pixel_bytes

KB = 1024


def square(kilobytes: int) -> pygame.Surface:
    """A 32-bit surface, one row of 256 pixels per kilobyte."""
    return pygame.Surface((256, kilobytes), depth=32)


@given(
    budget=st.integers(1, 12),
    sizes=st.lists(st.integers(1, 8), min_size=6, max_size=6),
    calls=st.lists(st.integers(0, 5), max_size=60),
)
def test_the_budget_holds_and_what_was_not_used_for_longest_goes_first(
    budget: int, sizes: list[int], calls: list[int]
) -> None:
    cache = SurfaceCache(budget * KB)
    made: list[int] = []

    @cache.cached
    def painted(which: int) -> LitImage:
        made.append(which)
        return LitImage(square(sizes[which]), (0, 0))

    used: dict[int, int] = {}  # insertion counter at the last use of each entry, oldest first
    kept = 0
    for which in calls:
        fresh, before = which not in used, len(made)
        assert painted(which).image.get_height() == sizes[which]
        assert (len(made) > before) == fresh
        if sizes[which] <= budget:
            kept += fresh
            if used.get(which) != kept:
                used.pop(which, None)
                used[which] = kept
        while sum(sizes[one] for one in used) > budget:
            oldest = next(iter(used))
            assert used.pop(oldest) <= min(used.values())
        assert cache.bytes == sum(sizes[one] for one in used) * KB <= budget * KB
        assert len(cache) == len(used)


def test_one_budget_holds_for_all_functions() -> None:
    cache = SurfaceCache(3 * KB)
    first, second = cache.cached(square), cache.cached(lambda kilobytes: square(kilobytes))
    old = first(1)
    second(1)
    first(1)
    assert first(1) is old
    second(2)  # evicts second(1), which was used before first(1)
    assert first(1) is old
    assert (len(cache), cache.bytes) == (2, 3 * KB)


@dataclass(frozen=True)
class Book:
    """Surfaces at any depth."""

    cover: pygame.Surface
    pages: dict[str, list[Sprite]]
    title: str = "a book"


def test_surfaces_are_found_at_any_depth_and_counted_once() -> None:
    cache = SurfaceCache(100 * KB)
    whole = square(8)
    part = whole.subsurface(0, 2, 256, 4)

    @cache.cached
    def book() -> Book:
        return Book(square(1), {"one": [Sprite(whole, 0, 0), Sprite(part, 0, 0)], "two": [Sprite(square(2), 0, 0)]})

    @cache.cached
    def strip() -> tuple[pygame.Surface, ...]:
        return part, part.subsurface(0, 0, 10, 1)

    book()
    assert cache.bytes == 11 * KB
    strip()
    assert cache.bytes == 11 * KB, "the strips lie in the book's page"
    cache.clear()
    assert (len(cache), cache.bytes) == (0, 0)
    strip()
    assert cache.bytes == 8 * KB, "a strip keeps the whole page alive"


@pytest.mark.parametrize(("kilobytes", "kept"), [(10, True), (11, False)])
def test_a_result_larger_than_the_budget_is_made_each_time_and_evicts_nothing(kilobytes: int, kept: bool) -> None:
    cache = SurfaceCache(10 * KB)
    paint = cache.cached(square)
    small = paint(1) if not kept else None
    large = paint(kilobytes)
    assert (paint(kilobytes) is large) == kept
    assert large.get_height() == kilobytes
    assert kept or paint(1) is small


def test_named_arguments_and_defaults_tell_results_apart() -> None:
    cache = SurfaceCache(KB * KB)

    @cache.cached
    def paint(w: int, h: int = 1, *, deep: bool = False) -> pygame.Surface:
        return pygame.Surface((w, h + deep), depth=32)

    assert paint(2, 3) is paint(2, 3)
    assert paint(2, h=3).get_height() == 3
    assert paint(2, 3, deep=True).get_height() == 4
    assert paint(2) is not paint(2, 3)


def test_a_result_without_surfaces_costs_nothing() -> None:
    cache = SurfaceCache(KB)
    empty = cache.cached(list[pygame.Surface])
    assert empty() is empty()
    assert cache.bytes == 0


def test_a_function_that_raises_is_called_again() -> None:
    cache = SurfaceCache(KB)
    tries: list[int] = []

    @cache.cached
    def paint() -> pygame.Surface:
        tries.append(1)
        if len(tries) == 1:
            raise ValueError("no ink")
        return square(1)

    with pytest.raises(ValueError, match="no ink"):
        paint()
    assert pixel_bytes(paint()) == KB
    assert len(tries) == 2
