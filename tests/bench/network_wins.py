"""Win rates of a PiTanks network against every other machine, on every arena, by every rule set.

    python -m tests.bench.network_wins BRAIN [--matches 400] [--seed 10001] [--rivals A,B] [--arenas A] [--variants V]

BRAIN is a registered name or the path of a file. Duels are played on the arenas of the arcade and on two on which no
network is trained; pairs of two against pairs of `hand3`, and one against three `hand3`, over all of them. The limits
are lower ends of Wilson's 95 % interval.
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.experiments.cast import Cast
from pigaming_app.ai.experiments.league import wilson
from pigaming_app.ai.experiments.rollout import Batch
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
DUELS, PAIRS, FOUR = 0.97, 0.95, 0.90  # least shares of wins
MINUTES = 2.0


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


def wins(network: BrainKind, rival: BrainKind, kind: str, setups: Sequence[tuple[str, str, int]], cast: Cast) -> int:
    """Matches won by the network. `setups`: arena, variant and seed of each."""
    ways, won = [*line_ups(network, rival, kind)], 0
    for way, (brains, teams) in enumerate(ways):
        seats = [Seat("ai" if seat < len(brains) else "off", teams[seat]) for seat in range(4)]
        one, two, three, four = seats
        mine = [
            Setup(GAME, arena, (one, two, three, four), MINUTES, seed, variant)
            for arena, variant, seed in setups[way :: len(ways)]
        ]
        if not mine:
            continue
        batch = Batch(mine, brains, cast.fast, cast)
        overtime = max(variant.overtime for variant in games()[GAME].variants.values())
        batch.play(round((MINUTES * 60 + overtime) * HZ))
        own = {seat for seat, brain in enumerate(brains) if brain is network}
        won += sum(
            bool(winners) and {*winners} <= own
            for winners in (standings(games()[GAME], end)[1] for end in batch.ended())
        )
    return won


def main() -> int:
    """Play and print; returns the exit code: 1 where a limit was missed."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.network_wins", description=__doc__.splitlines()[0])
    parser.add_argument("brain")
    parser.add_argument("--matches", type=int, default=400)
    parser.add_argument("--seed", type=int, default=10001)
    parser.add_argument("--rivals", default=",".join(RIVALS))
    parser.add_argument("--arenas", default=",".join((*arenas(GAME), *UNSEEN)))
    parser.add_argument("--variants", default=",".join(games()[GAME].variants))
    words = parser.parse_args()
    network = find_brain(GAME, words.brain)
    rivals, places, variants = words.rivals.split(","), words.arenas.split(","), words.variants.split(",")
    known = BRAINS[GAME]
    cast = Cast([network, *(known[name] for name in (*rivals, "hand3", "idle"))], can_compile())
    seeds, missed = range(words.seed, words.seed + words.matches), 0

    def report(title: str, kind: str, rival: str, chosen: list[tuple[str, str, int]], least: float) -> int:
        won = wins(network, known[rival], kind, chosen, cast)
        low, high = wilson(won, len(chosen))
        sign = "" if low >= least else "  < " + f"{100 * least:.0f} %"
        print(f"{title:58}{won:4} of {len(chosen)}  {100 * low:5.1f} to {100 * high:5.1f} %{sign}", flush=True)
        return low < least

    for variant in variants:
        for arena in places:
            for rival in rivals:
                chosen = [(arena, variant, seed) for seed in seeds]
                missed += report(f"{variant:10}{Path(arena).stem:12}duel against {rival}", "duel", rival, chosen, DUELS)
        mixed = [(places[i % len(places)], variant, seed) for i, seed in enumerate(seeds)]
        missed += report(f"{variant:10}all arenas  pairs against hand3", "pairs", "hand3", mixed, PAIRS)
        missed += report(f"{variant:10}all arenas  one against three hand3", "four", "hand3", mixed, FOUR)
    print(f"{missed} of {len(variants) * (len(places) * len(rivals) + 2)} limits missed")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
