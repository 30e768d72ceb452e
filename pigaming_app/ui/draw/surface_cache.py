"""The surface cache: LRU with one budget in bytes for everything that is painted once and blitted often.

`@cached` memoises a function whose result holds surfaces, in dataclasses, tuples, lists or dicts. All cached functions
share one budget, so the memory of the process stays bounded. A surface counts with its pixels, once for all entries
that hold it; a subsurface counts as the whole surface it keeps alive.
"""

from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from dataclasses import fields, is_dataclass
from functools import wraps
from typing import ParamSpec, TypeVar

import pygame

from pigaming_app.ui.draw.frame_budget import budget

BUDGET = 150 << 20  # bytes; a match needs 140 MB, and sprites used only at its start are evicted first
RESTING = 72 << 20  # bytes that stay on the title, while nobody plays; title and a lobby have 67 MB

Args = ParamSpec("Args")
Result = TypeVar("Result")


class CacheEntry:
    """A cached result, the surfaces it keeps alive, and the game it was built for.

    `used`: value of the insertion counter at the last use.
    """

    __slots__ = ("game", "key", "surfaces", "table", "used", "value")

    def __init__(self, table: "dict[Hashable, CacheEntry]", key: Hashable, value: object, game: str | None) -> None:
        self.table, self.key, self.value, self.game = table, key, value, game
        self.used = 0
        self.surfaces = tuple({id(surface): surface for surface in surfaces_in(value)}.values())


class SurfaceCache:
    """Function results with at most `budget` bytes of pixels in all; `bytes` is the current total.

    Uses between two insertions are not ordered among each other: a frame that builds nothing costs one lookup per
    sprite, as with functools.cache.
    """

    def __init__(self, budget: int) -> None:
        self.budget = budget
        self.bytes = 0
        self._insertions = 0  # insertion counter
        self._order: OrderedDict[CacheEntry, None] = OrderedDict()  # least recently used first
        self._holders: dict[int, int] = {}  # entries that keep a surface alive, by id of the surface
        self._game: str | None = None  # game tag of new entries

    def __len__(self) -> int:
        return len(self._order)

    def cached(self, make: Callable[Args, Result]) -> Callable[Args, Result]:
        """Memoise a function of hashable arguments. A result larger than the whole budget is not cached."""
        table: dict[Hashable, CacheEntry] = {}
        use = self._order.move_to_end

        @wraps(make)
        def lookup(*args: Args.args, **named: Args.kwargs) -> Result:
            key: Hashable = (args, *named.items()) if named else args
            entry = table.get(key)
            if entry is not None:
                if entry.used != self._insertions:
                    entry.used = self._insertions
                    use(entry)
                return entry.value  # type: ignore[return-value]  # it was made by `make`
            budget.claim()
            value = make(*args, **named)
            budget.note()
            self._insert(CacheEntry(table, key, value, self._game))
            return value

        return lookup

    @contextmanager
    def made_for(self, game: str) -> Iterator[None]:
        """Tag results built in this scope with a game."""
        before, self._game = self._game, game
        try:
            yield
        finally:
            self._game = before

    def release_matches(self) -> None:
        """Evict everything built for a match, of any game."""
        for entry in [entry for entry in self._order if entry.game is not None]:
            self._drop(entry)

    def release_pages(self) -> None:
        """Evict what was not used for longest, until at most RESTING bytes are left."""
        self._shrink(RESTING)

    def clear(self) -> None:
        """Evict everything."""
        for entry in list(self._order):
            self._drop(entry)

    def _insert(self, entry: CacheEntry) -> None:
        if sum(map(pixel_bytes, entry.surfaces)) > self.budget:
            return
        if entry.key in entry.table:  # another thread was first
            self._drop(entry.table[entry.key])
        self._insertions += 1
        entry.used = self._insertions
        self._order[entry] = None
        entry.table[entry.key] = entry
        for surface in entry.surfaces:
            holders = self._holders.get(id(surface), 0)
            self._holders[id(surface)] = holders + 1
            self.bytes += 0 if holders else pixel_bytes(surface)
        self._shrink(self.budget)

    def _shrink(self, size: int) -> None:
        while self.bytes > size:
            self._drop(next(iter(self._order)))

    def _drop(self, entry: CacheEntry) -> None:
        del self._order[entry], entry.table[entry.key]
        for surface in entry.surfaces:
            self._holders[id(surface)] -= 1
            if not self._holders[id(surface)]:
                del self._holders[id(surface)]
                self.bytes -= pixel_bytes(surface)


def surfaces_in(value: object) -> Iterator[pygame.Surface]:
    """All surfaces a value keeps alive; for a subsurface, its root surface."""
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
    """Size of a surface's pixels in bytes."""
    return surface.get_pitch() * surface.get_height()


surfaces = SurfaceCache(BUDGET)  # shared by the whole process
cached = surfaces.cached
