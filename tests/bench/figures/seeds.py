"""Tables of trained tables: many seeds, and the two that ship, against the published result."""

from collections.abc import Sequence
from functools import cache

from pigaming_app import ASSETS
from pigaming_app.ai.learning.training import MINUTES, contest, resumed
from pigaming_app.ai.qlearning.recipe import RECIPES
from pigaming_app.ai.qlearning.table_files import decode
from pigaming_app.ai.registry import BRAINS
from pigaming_app.jobs.learning.train.options import changed
from pigaming_app.sim.kernel import can_compile
from tests.bench import reproduce_table
from tests.bench.figures.duels import LEAST
from tests.bench.reproduce_table import MEASURE_SEED, MEASURED, NAMED, PUBLISHED, Result, Row, bar, histogram

FIRST, LAST = 25, 224  # of the seeds to which nothing was fitted
READINGS = {"": (), ", thesis's reading": ("in_sight=0", "exposure=0")}  # settings


@cache
def trained(settings: tuple[str, ...], share: float) -> list[Row]:
    """Results of robots of both rewards with every seed."""
    recipes = {reward: changed(recipe, settings) for reward, recipe in RECIPES.items()}
    seeds = range(FIRST, FIRST + max(2, round(share * (LAST - FIRST + 1))))
    return [*reproduce_table.rows(recipes, seeds, can_compile())]


def table(share: float) -> list[list[str]]:
    """Seeds by their wins of 100 matches against `classic`, for each reward."""
    return counted(trained((), share))


def counted(found: Sequence[Row]) -> list[list[str]]:
    """The table of the wins of both rewards."""
    one, two = histogram([row.one.wins for row in found]), histogram([row.two.wins for row in found])
    rows = [["wins of 100", "seeds with reward 1", "", "seeds with reward 2", ""]]
    for name in one:
        rows.append([name, *(cell for n in (one[name], two[name]) for cell in (str(n), bar(n, len(found))))])
    return rows


def verdict(share: float) -> list[list[str]]:
    """What the seeds of both rewards show by our reading of the thesis and by its own."""
    return compared({name: trained(settings, share) for name, settings in READINGS.items()})


def compared(readings: dict[str, Sequence[Row]]) -> list[list[str]]:
    """The table of `verdict`: a column for each reward of each reading."""
    columns = {f"reward {n}{name}": judged(n, found) for name, found in readings.items() for n in RECIPES}
    titles = next(iter(columns.values()))
    return [["", *columns], *([title, *(column[title] for column in columns.values())] for title in titles)]


def judged(reward: int, found: Sequence[Row]) -> dict[str, str]:
    """A column of `verdict`; seeds with as many wins as published count half in the first line."""
    one = [row.one if reward == 1 else row.two for row in found]
    summary, sides = reproduce_table.summary(reward, one), reproduce_table.verdict(found)
    better, ahead = (side["ahead" if reward == 1 else "behind"] for side in sides.values())
    low, high = (100 * end for end in summary.never_95)
    return {
        "win fewer matches than published": f"{100 * summary.percentile:.1f} %",
        "never win a match": f"{100 * summary.never:.1f} % (95 %: {low:.1f} to {high:.1f})",
        "tie all matches": f"{100 * sum(result.ties == MEASURED for result in one) / len(one):.1f} %",
        "lie inside every published interval": f"{100 * summary.reproduced:.1f} %",
        "win more against `classic` than the other reward": f"{100 * better / len(found):.1f} %",
        "beat the other reward head to head": f"{100 * ahead / len(found):.1f} %",
    }


def shipped(share: float) -> list[list[str]]:
    """Wins, ties and losses against `classic`: published, and of the shipped tables."""
    matches, minutes = (MEASURED, MINUTES) if share == 1.0 else (2, LEAST)
    here = []
    for reward in NAMED:
        file = ASSETS / "brains" / f"q{reward}.npz"
        learner = resumed(decode(file.read_bytes(), file.name)).checkpoint().kind
        fast, classic = can_compile() and share == 1.0, BRAINS["pitanks"]["classic"]
        here.append(Result(*contest(learner, classic, matches, MEASURE_SEED, minutes, fast=fast)))
    names = (f"`q{reward}` (seed {seed})" for reward, seed in NAMED.items())
    return [
        ["", "agent 1, stillness unpunished", "agent 2, stillness punished"],
        ["thesis, table 5.3", *map(printed, PUBLISHED.values())],
        [f"here, {', '.join(names)}", *map(printed, here)],
    ]


def printed(result: Result) -> str:
    """Wins / ties / losses."""
    return " / ".join(map(str, result))
