"""A network of Robot Race against `hand3`: flying laps alone on every track, and races against three of them.

    python -m tests.bench.network_races BRAIN [--races 100] [--seed 20001]

BRAIN is a registered name or the path of a file. Races are those of a track and a rule set; the seat of the network
and, with the seeds, the starts take turns. Exit code 1 unless its mean flying lap is at most that of `hand3` on three
of four tracks, and it wins 60 % of the races by every rule set.
"""

import argparse
import sys
from collections.abc import Sequence
from typing import Any

import numpy as np

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.learning.cast import Cast
from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import BRAINS, find_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.race.start import VARIANTS
from pigaming_app.games.race.state import MAX_LAPS
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import DT, HZ, ROBOTS

RIVAL = BRAINS["race"]["hand3"]
FEW = 4  # races, up to which compiling takes longer than interpreted play
SOLO = 8  # races of a driver alone
MINUTES = 10.0
WINS, FASTER = 0.60, 3  # least share of wins; tracks on which it must be as fast


def cast_of(brain: BrainKind, races: int) -> Cast:
    """The network, its rival and an idle robot; compiled if that repays."""
    fast = can_compile() and races > FEW
    return Cast([RIVAL, brain, BRAINS["race"]["idle"]], fast)


def played(
    cast: Cast, brains: Sequence[BrainKind], track: str, variant: str, laps: int, seeds: range, minutes: float
) -> list[Any]:
    """The final states of races."""
    one, two, three, four = (Seat("ai" if seat < len(brains) else "off", seat) for seat in range(ROBOTS))
    setups = [Setup("race", track, (one, two, three, four), minutes, seed, variant, laps) for seed in seeds]
    batch = Batch(setups, brains, cast.fast, cast)
    batch.play(round(minutes * 60 * HZ))
    return batch.ended()


def flying_lap(cast: Cast, brain: BrainKind, track: str, minutes: float = MINUTES) -> float:
    """Mean flying lap of a driver alone, s; infinite if a race was not finished."""
    drivers = [end.racers[0] for end in played(cast, [brain], track, "standard", MAX_LAPS, range(1, SOLO + 1), minutes)]
    if not all(driver.finished for driver in drivers):
        return float("inf")
    return float(np.mean([driver.laps[1:] for driver in drivers])) * DT


def wins(
    cast: Cast, brain: BrainKind, track: str, variant: str, races: int, seed: int, minutes: float = MINUTES
) -> tuple[int, int]:
    """Races that it wins and that it finishes, against three rivals on a track, on every seat in turn."""
    laps, won, finished = VARIANTS[variant].default_goal, 0, 0
    for seat in range(ROBOTS):
        brains = [brain if k == seat else RIVAL for k in range(ROBOTS)]
        for end in played(cast, brains, track, variant, laps, range(seed + seat, seed + races, ROBOTS), minutes):
            won, finished = won + (end.racers[seat].rank == 1), finished + end.racers[seat].finished
    return won, finished


def main() -> int:
    """Play and print; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.network_races", description=__doc__.splitlines()[0])
    parser.add_argument("brain")
    parser.add_argument("--races", type=int, default=100, help="a track and rule set")
    parser.add_argument("--seed", type=int, default=20001)
    words = parser.parse_args()
    brain, tracks = find_brain("race", words.brain), arenas("race")
    cast, faster, good = cast_of(brain, words.races), 0, True
    for track in tracks:
        own, other = (flying_lap(cast, kind, track) for kind in (brain, RIVAL))
        faster += own <= other
        print(f"{track:10} flying lap {own:6.2f} s, hand3 {other:6.2f} s", flush=True)
    for variant in VARIANTS:
        found = [wins(cast, brain, track, variant, words.races, words.seed) for track in tracks]
        won, finished, races = sum(one for one, _ in found), sum(one for _, one in found), words.races * len(tracks)
        low, high = wilson(won, races)
        good &= won >= WINS * races
        each = ", ".join(f"{one} on {track}" for track, (one, _) in zip(tracks, found, strict=True))
        ends = f"{won} of {races} won, {100 * low:.1f} to {100 * high:.1f} %, {finished} finished; {each}"
        print(f"{variant:10} against three hand3: {ends}", flush=True)
    return 0 if good and faster >= FASTER else 1


if __name__ == "__main__":
    sys.exit(main())
