"""The verdict of the soak of presses, over usages with and without a leak."""

import pytest

from tests.bench.presses import Usage, growth

# Files, threads and MB of a soak without a leak: 10,000 presses, measured.
LEVEL = [(9, 1, 170.1), (9, 1, 174.1), (9, 1, 174.6), (9, 1, 176.6), (9, 1, 176.8), (9, 1, 177.2)]


def usages(files: int = 0, threads: int = 0, mb: float = 0.0, cached: float = 72.0) -> list[Usage]:
    """The level ones with so much more in each round."""
    return [Usage(1700 * i, a + i * files, b + i * threads, c + i * mb, cached) for i, (a, b, c) in enumerate(LEVEL, 1)]


def test_what_is_level_is_told_from_what_comes_and_goes() -> None:
    assert growth(usages()) == []


@pytest.mark.parametrize(
    ("found", "verdict"),
    [
        (usages(files=1), "4 more open files"),
        (usages(threads=1), "4 more threads"),
        (usages(mb=1.0), "MB more"),
        (usages(cached=150.0), "150 MB of sprites on the title"),
    ],
)
def test_every_kind_of_leak_is_found(found: list[Usage], verdict: str) -> None:
    (line,) = growth(found)
    assert verdict in line
