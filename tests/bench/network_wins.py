"""Win rates of a PiTanks network against every other machine, on every arena, by every rule set.

    python -m tests.bench.network_wins BRAIN [--matches 400] [--seed 10001] [--minutes 2] [--rivals A,B] [--arenas A]
        [--variants V]

BRAIN is a registered name or the path of a file. Duels are played on the arenas of the arcade and on two on which no
network is trained; pairs of two against pairs of `hand3`, and one against three `hand3`, over all of them. The limits
are lower ends of Wilson's 95 % interval.
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.learning.cast import Cast
from pigaming_app.ai.learning.league import MIN_COMPILED_MATCHES, wilson
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import BRAINS, find_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import standings
from pigaming_app.games.registry import games
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ

GAME = "pitanks"
RIVALS = ("hand1", "hand2", "hand3", "classic", "q1", "q2")
UNSEEN = tuple(str(path) for path in sorted(Path(__file__).parent.parent.joinpath("data", "arenas").glob("*.toml")))
PLACES, VARIANTS = (*arenas(GAME), *UNSEEN), tuple(games()[GAME].variants)
LEAST = {"duel": 0.97, "pairs": 0.95, "four": 0.90}  # share of wins
WORDS = {"duel": "duel against", "pairs": "pairs against", "four": "one against three"}
MINUTES = 2.0


class Result(NamedTuple):
    """Matches of one kind; `arena`: its name or path, "" for all."""

    variant: str
    kind: str
    arena: str
    rival: str
    won: int
    matches: int

    @property
    def reached(self) -> bool:
        """True if the lower end of the interval reaches the limit."""
        return wilson(self.won, self.matches)[0] >= LEAST[self.kind]


def line_ups(network: BrainKind, rival: BrainKind, kind: str) -> Iterator[tuple[list[BrainKind], tuple[int, ...]]]:
    """Brains by seat and teams, once with every seating."""
    if kind == "duel":
        yield [network, rival], (0, 1, 2, 3)
        yield [rival, network], (0, 1, 2, 3)
    elif kind == "pairs":
        yield [network, rival, network, rival], (0, 1, 0, 1)
        yield [rival, network, rival, network], (0, 1, 0, 1)
    else:
        for seat in range(4):
            yield [network if k == seat else rival for k in range(4)], (0, 1, 2, 3)


def wins(
    network: BrainKind,
    rival: BrainKind,
    kind: str,
    setups: Sequence[tuple[str, str, int]],
    cast: Cast,
    minutes: float = MINUTES,
) -> int:
    """Matches won by the network. `setups`: arena, variant and seed of each."""
    ways, won = [*line_ups(network, rival, kind)], 0
    for way, (brains, teams) in enumerate(ways):
        seats = [Seat("ai" if seat < len(brains) else "off", teams[seat]) for seat in range(4)]
        one, two, three, four = seats
        mine = [
            Setup(GAME, arena, (one, two, three, four), minutes, seed, variant)
            for arena, variant, seed in setups[way :: len(ways)]
        ]
        if not mine:
            continue
        batch = Batch(mine, brains, cast.fast, cast)
        overtime = max(variant.overtime for variant in games()[GAME].variants.values())
        batch.play(round((minutes * 60 + overtime) * HZ))
        own = {seat for seat, brain in enumerate(brains) if brain is network}
        won += sum(
            bool(winners) and {*winners} <= own
            for winners in (standings(games()[GAME], end)[1] for end in batch.ended())
        )
    return won


def results(
    network: BrainKind,
    seeds: range,
    rivals: Sequence[str] = RIVALS,
    places: Sequence[str] = PLACES,
    variants: Sequence[str] = VARIANTS,
    minutes: float = MINUTES,
) -> Iterator[Result]:
    """Every result, by rule set, kind of match, arena and rival."""
    known = BRAINS[GAME]
    cells = [(v, kind, place, rival) for v in variants for kind, place, rival in meetings(rivals, places)]
    ticks = len(cells) * len(seeds) * minutes * 60 * HZ
    kinds = [network, *(known[name] for name in (*rivals, "hand3", "idle"))]
    cast = Cast(kinds, can_compile() and ticks > MIN_COMPILED_MATCHES)
    for variant, kind, place, rival in cells:
        mixed = [place] if place else places
        setups = [(mixed[i % len(mixed)], variant, seed) for i, seed in enumerate(seeds)]
        won = wins(network, known[rival], kind, setups, cast, minutes)
        yield Result(variant, kind, place, rival, won, len(setups))


def meetings(rivals: Sequence[str], places: Sequence[str]) -> Iterator[tuple[str, str, str]]:
    """Kind of match, arena and rival; "" for all arenas."""
    yield from (("duel", place, rival) for place in places for rival in rivals)
    yield "pairs", "", "hand3"
    yield "four", "", "hand3"


def main() -> int:
    """Play and print; returns the exit code: 1 where a limit was missed."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.network_wins", description=__doc__.splitlines()[0])
    parser.add_argument("brain")
    parser.add_argument("--matches", type=int, default=400)
    parser.add_argument("--seed", type=int, default=10001)
    parser.add_argument("--minutes", type=float, default=MINUTES)
    parser.add_argument("--rivals", default=",".join(RIVALS))
    parser.add_argument("--arenas", default=",".join(PLACES))
    parser.add_argument("--variants", default=",".join(VARIANTS))
    words = parser.parse_args()
    rivals, places, variants = (text.split(",") for text in (words.rivals, words.arenas, words.variants))
    seeds, found = range(words.seed, words.seed + words.matches), list[Result]()
    for one in results(find_brain(GAME, words.brain), seeds, rivals, places, variants, words.minutes):
        found.append(one)
        low, high = wilson(one.won, one.matches)
        title = f"{one.variant:10}{Path(one.arena).stem or 'all arenas':12}{WORDS[one.kind]} {one.rival}"
        sign = "" if one.reached else f"  < {100 * LEAST[one.kind]:.0f} %"
        print(f"{title:58}{one.won:4} of {one.matches}  {100 * low:5.1f} to {100 * high:5.1f} %{sign}", flush=True)
    missed = sum(not one.reached for one in found)
    print(f"{missed} of {len(found)} limits missed")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
