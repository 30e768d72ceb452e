"""The surface cache between tests."""

from collections.abc import Iterator
from contextlib import contextmanager

from pigaming_app.ui.draw.surface_cache import surfaces


@contextmanager
def empty_cache() -> Iterator[None]:
    """An empty surface cache in this scope. Afterwards it holds what it held before, and nothing drawn in the scope."""
    kept = list(surfaces._order)
    surfaces.clear()
    try:
        yield
    finally:
        surfaces.clear()
        for entry in kept:
            surfaces._insert(entry)
