"""The wins of trained tables over many seeds, as a histogram."""

from collections.abc import Sequence

from pigaming_app.ai.qlearning.rewards import RECIPES
from pigaming_app.sim.kernel import can_compile
from tests.bench import reproduce_table

FIRST, LAST = 25, 64  # of the seeds to which nothing was fitted
BINS = ((0, 0), (1, 20), (21, 40), (41, 60), (61, 80), (81, 99), (100, 100))  # wins of 100


def histogram(share: float) -> list[list[str]]:
    """Seeds by their wins of 100 matches against `classic`, for each reward."""
    seeds = range(FIRST, FIRST + max(2, round(share * (LAST - FIRST + 1))))
    found = [*reproduce_table.rows(RECIPES, seeds, can_compile())]
    return counted([row.one.wins for row in found], [row.two.wins for row in found])


def counted(one: Sequence[int], two: Sequence[int]) -> list[list[str]]:
    """The table of the wins of both rewards."""
    rows = [["wins of 100", "seeds with reward 1", "", "seeds with reward 2", ""]]
    for low, high in BINS:
        name = str(low) if low == high else f"{low} to {high}"
        counts = [sum(low <= wins <= high for wins in column) for column in (one, two)]
        rows.append([name, *(cell for n in counts for cell in (str(n), bar(n, len(one))))])
    return rows


def bar(count: int, seeds: int) -> str:
    """A bar with a block for each 2 % of the seeds."""
    return "█" * round(50 * count / seeds)
