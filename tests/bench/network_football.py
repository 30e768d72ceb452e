"""A network of Robot Football against the five levels: on every pitch, in pairs, alone, and alone against two.

    python -m tests.bench.network_football BRAIN [--matches 100] [--variant standard] [--seed 30001]

BRAIN is a registered name or the path of a file. Sides take turns; every cell has that many matches of the default
length. Exit code 1 unless it wins more than half of all matches against `level3`, in pairs and alone.
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.learning.line_ups import OFF, LineUps
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import standings
from pigaming_app.games.registry import games
from pigaming_app.sim.world import ROBOTS
from tests.bench.trial import is_compiled

GAME = "football"
SIZES = {"two against two": (2, 2), "one against one": (1, 1), "one against two": (1, 2)}  # network's team first
EVEN = [title for title, (own, others) in SIZES.items() if own == others]


class Result(NamedTuple):
    """Matches of the network's team; `lead`: mean at the end, points."""

    wins: int
    ties: int
    losses: int
    lead: float


def setups(
    network: str, level: str, size: tuple[int, int], arena: str, variant: str, seeds: range, minutes: float | None
) -> list[Setup]:
    """Matches in which the network's team plays left and right by turns."""
    minutes, made = minutes or games()[GAME].variants[variant].default_minutes, []
    for seed in seeds:
        own = seed % 2
        teams = [(network, size[0]), (level, size[1])]
        names = [[brain] * count + [OFF] * (2 - count) for brain, count in (teams if own == 0 else teams[::-1])]
        one, two, three, four = (Seat(names[k % 2][k // 2], k % 2) for k in range(ROBOTS))
        made.append(Setup(GAME, arena, (one, two, three, four), minutes, seed, variant, 0))
    return made


def results(
    network: str, variant: str, seeds: range, minutes: float | None = None
) -> Iterator[tuple[str, str, list[Result]]]:
    """Size of the teams, level, and the result on every pitch."""
    cells = {
        (title, level): [setups(network, level, size, arena, variant, seeds, minutes) for arena in arenas(GAME)]
        for title, size in SIZES.items()
        for level in LEVELS
    }
    every = [setup for pitches in cells.values() for matches in pitches for setup in matches]
    players = LineUps(GAME, [network, *LEVELS], is_compiled(every))
    for (title, level), pitches in cells.items():
        yield title, level, [result(players, matches) for matches in pitches]


def result(players: LineUps, matches: Sequence[Setup]) -> Result:
    """Play matches of `setups`."""
    wins = losses = lead = 0
    for setup, end in zip(matches, players.played(matches), strict=True):
        own = setup.seed % 2
        winners = standings(games()[GAME], end)[1]
        wins += own in winners
        losses += bool(winners) and own not in winners
        lead += sum(r.score if k % 2 == own else -r.score for k, r in enumerate(end.robots) if r.present)
    return Result(wins, len(matches) - wins - losses, losses, lead / len(matches))


def main() -> int:
    """Play and print; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.network_football", description=__doc__.splitlines()[0])
    parser.add_argument("brain")
    parser.add_argument("--matches", type=int, default=100)
    parser.add_argument("--variant", default=games()[GAME].default.name)
    parser.add_argument("--seed", type=int, default=30001)
    words = parser.parse_args()
    seeds, good = range(words.seed, words.seed + words.matches), True
    for title, level, pitches in results(words.brain, words.variant, seeds):
        total, played = sum(one.wins for one in pitches), len(pitches) * words.matches
        cells = [
            f"{arena} {one.wins}/{one.ties}/{one.losses}, lead {one.lead:+.1f}"
            for arena, one in zip(arenas(GAME), pitches, strict=True)
        ]
        low, high = wilson(total, played)
        print(f"{title}, {level}: {'; '.join(cells)}; wins {100 * low:.0f} to {100 * high:.0f} %", flush=True)
        if level == "level3" and title in EVEN:
            good &= 2 * total > played
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
