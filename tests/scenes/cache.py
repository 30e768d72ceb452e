"""The surface cache between tests."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from pigaming_app.ui.draw.surface_cache import surfaces


@contextmanager
def empty_cache() -> Iterator[None]:
    """An empty surface cache in this scope. Afterwards it holds what it held before, and nothing drawn in the scope."""
    tables = {id(entry.table): entry.table for entry in surfaces._order}
    parts: list[dict[Any, Any]] = [surfaces._order, surfaces._holders, *tables.values()]
    kept, size = [part.copy() for part in parts], surfaces.bytes
    for part in parts:
        part.clear()
    surfaces.bytes = 0
    try:
        yield
    finally:
        surfaces.clear()
        for part, before in zip(parts, kept, strict=True):
            part.update(before)
        surfaces.bytes = size
