"""The cache of everything that is painted once and blitted often: one budget in bytes, least recently used goes first.

`@cached` memoises a function whose result holds surfaces, in dataclasses, tuples, lists or dicts. All cached functions
share one budget, so that what a screen needs stays and the memory of the process stays bounded. A surface counts with
its pixels, once for all entries that hold it; a subsurface counts as the whole surface that it keeps alive.
"""

from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator
from dataclasses import fields, is_dataclass
from functools import wraps
from typing import ParamSpec, TypeVar

import pygame

from pigaming_app.scenes.frame_budget import budget

BUDGET = 128 << 20  # bytes

Args = ParamSpec("Args")
Result = TypeVar("Result")


class Entry:
    """One result of a cached function, and the surfaces that it keeps alive."""

    __slots__ = ("key", "surfaces", "table", "value")

    def __init__(self, table: "dict[Hashable, Entry]", key: Hashable, value: object) -> None:
        self.table, self.key, self.value = table, key, value
        self.surfaces = {id(surface): surface for surface in surfaces_in(value)}


class SurfaceCache:
    """Results of functions, `bytes` of pixels in all: never more than `budget`."""

    def __init__(self, budget: int) -> None:
        self.budget = budget
        self.bytes = 0
        self._order: OrderedDict[Entry, None] = OrderedDict()  # least recently used first
        self._holders: dict[int, int] = {}  # by id of a surface: how many entries keep it alive

    def __len__(self) -> int:
        return len(self._order)

    def cached(self, make: Callable[Args, Result]) -> Callable[Args, Result]:
        """Memoise a function of hashable arguments. A result larger than the whole budget is not kept."""
        table: dict[Hashable, Entry] = {}
        use = self._order.move_to_end

        @wraps(make)
        def found_or_made(*args: Args.args, **named: Args.kwargs) -> Result:
            key: Hashable = (args, *named.items()) if named else args
            entry = table.get(key)
            if entry is not None:
                use(entry)
                return entry.value  # type: ignore[return-value]  # it was made by `make`
            budget.claim()
            value = make(*args, **named)
            budget.note()
            self._keep(Entry(table, key, value))
            return value

        return found_or_made

    def clear(self) -> None:
        """Drop everything."""
        while self._order:
            self._drop(next(iter(self._order)))

    def _keep(self, entry: Entry) -> None:
        if sum(map(pixel_bytes, entry.surfaces.values())) > self.budget:
            return
        if entry.key in entry.table:  # another thread was faster
            self._drop(entry.table[entry.key])
        self._order[entry] = None
        entry.table[entry.key] = entry
        for name, surface in entry.surfaces.items():
            holders = self._holders.get(name, 0)
            self._holders[name] = holders + 1
            self.bytes += 0 if holders else pixel_bytes(surface)
        while self.bytes > self.budget:
            self._drop(next(iter(self._order)))

    def _drop(self, entry: Entry) -> None:
        del self._order[entry], entry.table[entry.key]
        for name, surface in entry.surfaces.items():
            self._holders[name] -= 1
            if not self._holders[name]:
                del self._holders[name]
                self.bytes -= pixel_bytes(surface)


def surfaces_in(value: object) -> Iterator[pygame.Surface]:
    """Every surface that a value keeps alive; instead of a subsurface, the surface whose pixels it shares."""
    if isinstance(value, pygame.Surface):
        yield value.get_abs_parent()
    elif isinstance(value, dict):
        yield from surfaces_in(tuple(value.values()))
    elif isinstance(value, tuple | list | set | frozenset):
        for part in value:
            yield from surfaces_in(part)
    elif is_dataclass(value):
        for field in fields(value):
            yield from surfaces_in(getattr(value, field.name))


def pixel_bytes(surface: pygame.Surface) -> int:
    """Bytes of a surface's pixels."""
    return surface.get_pitch() * surface.get_height()


surfaces = SurfaceCache(BUDGET)  # of this process
cached = surfaces.cached
