"""A round robin of AIs: ratings and a cross table, at most 100 columns wide."""

import json
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from pigaming_app.ai.learning import league as leagues
from pigaming_app.ai.learning.league import Duel, League, LeagueRow
from pigaming_app.games.setup import ChoiceError
from pigaming_app.jobs.terminal.options import AIS, PairOptions, argument, option, path
from pigaming_app.jobs.terminal.refusal import refused, require_for_brains
from pigaming_app.sim.arena import ArenaError
from pigaming_app.storage.safe_files import NotSaved, require_writable, write_atomic

WIDTH = 100  # columns
NOTES = (
    "Rating: Bradley-Terry, mean 0; a tie is half a win for each. 100 points more are 64 wins in 100.",
    "Every pair is lent one tie that nobody played, so that clean sweeps stay finite.",
    "In brackets: 95 % intervals, of ratings by Bayesian bootstrap over the seeds, of wins by Wilson.",
)


@dataclass(frozen=True, kw_only=True)
class LeagueOptions(PairOptions):
    """The brains, and a file for their league."""

    brains: tuple[str, ...] = argument(AIS, default=(), nargs="*", metavar="AI")
    out: Path | None = option("write the league as JSON, for the page of strengths", path, metavar="FILE")


def run(options: LeagueOptions) -> int:
    """Play the league, print its tables and write it to a file if wanted. Raises Refusal."""
    require_for_brains(options.brains)
    with refused(ChoiceError, ArenaError, NotSaved):
        if options.out:
            require_writable(options.out)
        result = leagues.league(
            options.game,
            options.brains,
            options.matches,
            options.seed,
            options.minutes,
            options.arena,
            options.variant,
            goal=options.goal(options.game),
            progress=_progress if sys.stderr.isatty() else None,
        )
    if sys.stderr.isatty():
        print(end="\r\x1b[K", file=sys.stderr)
    text = json.dumps(plain(result))
    if options.out:
        with refused(NotSaved):
            write_atomic(options.out, text.encode())
    if options.json:
        print(text)
    else:
        print("\n".join(line.rstrip() for line in table(result)))
    return 0


def plain(result: League) -> dict[str, object]:
    """A league as plain values, each rating among the other numbers of its brain."""
    whole = asdict(result)
    for standing in whole["standings"]:
        rating = standing.pop("rating")
        standing.update(rating=rating["rating"], rating95=(rating["low"], rating["high"]))
    return whole


def table(result: League) -> Iterator[str]:
    """The lines of both tables."""
    brains = [standing.brain for standing in result.standings]
    name = max(len(brain) for brain in brains) + 2
    yield f"{result.game}, {result.arena}, {result.minutes:g} min, {result.variant}: {result.matches} matches a pair,"
    yield f"the seeds from {result.seed} on, each from both sides; {result.seconds:.1f} s"
    yield ""
    yield f"{'':4}{'':{name}}{'rating':>7}{'':16}{'W / T / L':>17}{'wins':>8}{'':17}{'mean score':>11}"
    for place, standing in enumerate(result.standings, 1):
        yield f"{place:>3} {standing.brain:{name}}{_row(standing)}"
    yield ""
    yield "W/T/L of each row against each column, and its wins in %"
    yield from _cross(result.duels, brains, name)
    yield ""
    yield from NOTES


def _row(standing: LeagueRow) -> str:
    rating, played = standing.rating, standing.wins + standing.ties + standing.losses
    low, high = (100 * share for share in standing.wilson95)
    around = f"[{round(rating.low):+}, {round(rating.high):+}]"
    results = f"{standing.wins} / {standing.ties} / {standing.losses}"
    between = f"[{low:.1f}, {high:.1f}]"
    wins = f"{100 * standing.wins / played:.1f} %"
    return f"{round(rating.rating):+7} {around:15}{results:>17}{wins:>8} {between:16}{standing.mean_score:z11.2f}"


def _cross(duels: Sequence[Duel], brains: Sequence[str], name: int) -> Iterator[str]:
    """Two lines for each brain, in as many blocks of columns as the width needs."""
    results = {pair: cell for duel in duels for pair, cell in _cells(duel)}
    cell = max(len(text) for pair in results.values() for text in (*pair, *brains)) + 2
    columns = max(1, (WIDTH - name) // cell)
    for first in range(0, len(brains), columns):
        across = brains[first : first + columns]
        yield ""
        yield f"{'':{name}}" + "".join(f"{brain:>{cell}}" for brain in across)
        for brain in brains:
            for line, title in enumerate((brain, "")):
                texts = (results[brain, other][line] if other != brain else "-" * (not line) for other in across)
                yield f"{title:{name}}" + "".join(f"{text:>{cell}}" for text in texts)


def _cells(duel: Duel) -> Iterator[tuple[tuple[str, str], tuple[str, str]]]:
    """A duel from either side: results, and the interval of the wins."""
    for left, right, wins, losses in (
        (duel.left, duel.right, duel.wins, duel.losses),
        (duel.right, duel.left, duel.losses, duel.wins),
    ):
        low, high = leagues.wilson(wins, duel.matches)
        yield (left, right), (f"{wins}/{duel.ties}/{losses}", f"[{100 * low:.0f}, {100 * high:.0f}]")


def _progress(number: int, total: int, left: str, right: str) -> None:
    print(end=f"\r\x1b[Kduel {number + 1} of {total}: {left} and {right}", file=sys.stderr, flush=True)
