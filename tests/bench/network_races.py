"""A network of Robot Race against `hand3`: flying laps alone on every track, and races against three of them.

    python -m tests.bench.network_races BRAIN [--races 400] [--seed 20001]

BRAIN is a registered name or the path of a file. The seat of the network, the tracks and, with the seeds, the starts
take turns. Exit code 1 unless its mean flying lap is at most that of `hand3` on three of four tracks, and it wins 60 %
of the races by every rule set.
"""

import argparse
import sys

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.experiments.cast import Cast
from pigaming_app.ai.experiments.league import wilson
from pigaming_app.ai.experiments.rollout import Batch
from pigaming_app.ai.registry import BRAINS, find_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.race.start import VARIANTS
from pigaming_app.games.race.state import MAX_LAPS
from pigaming_app.sim.world import DT, HZ, ROBOTS

SOLO = 8  # races of a driver alone
MINUTES = 10.0
WINS, FASTER = 0.60, 3  # least share of wins; tracks on which it must be as fast


def played(cast: Cast, brains: list[BrainKind], track: str, variant: str, laps: int, seeds: range) -> Batch:
    """Races to their end."""
    one, two, three, four = (Seat("ai" if seat < len(brains) else "off", seat) for seat in range(ROBOTS))
    setups = [Setup("race", track, (one, two, three, four), MINUTES, seed, variant, laps) for seed in seeds]
    batch = Batch(setups, brains, True, cast)
    batch.play(round(MINUTES * 60 * HZ))
    return batch


def flying_lap(cast: Cast, brain: BrainKind, track: str) -> float:
    """Mean flying lap of a driver alone, s."""
    racers = played(cast, [brain], track, "standard", MAX_LAPS, range(1, SOLO + 1)).matches["racers"]
    return float(racers["laps"][:, 0, 1:].mean()) * DT if racers["finished"][:, 0].all() else float("inf")


def main() -> int:
    """Play and print; returns the exit code."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.network_races", description=__doc__.splitlines()[0])
    parser.add_argument("brain")
    parser.add_argument("--races", type=int, default=400)
    parser.add_argument("--seed", type=int, default=20001)
    words = parser.parse_args()
    rival, brain = BRAINS["race"]["hand3"], find_brain("race", words.brain)
    cast, tracks = Cast([rival, brain, BRAINS["race"]["idle"]], True), arenas("race")
    faster, good = 0, True
    for track in tracks:
        own, other = (flying_lap(cast, kind, track) for kind in (brain, rival))
        faster += own <= other
        print(f"{track:10} flying lap {own:6.2f} s, hand3 {other:6.2f} s", flush=True)
    for variant, rules in VARIANTS.items():
        ways, won, finished = [(track, seat) for track in tracks for seat in range(ROBOTS)], 0, 0
        for way, (track, seat) in enumerate(ways):
            brains = [brain if k == seat else rival for k in range(ROBOTS)]
            seeds = range(words.seed + way, words.seed + words.races, len(ways))
            racers = played(cast, brains, track, variant, rules.default_goal, seeds).matches["racers"][:, seat]
            won, finished = won + int((racers["rank"] == 1).sum()), finished + int(racers["finished"].sum())
        low, high = wilson(won, words.races)
        good &= won >= WINS * words.races
        ends = f"{won} of {words.races} won, {100 * low:.1f} to {100 * high:.1f} %, {finished} finished"
        print(f"{variant:10} against three hand3: {ends}", flush=True)
    return 0 if good and faster >= FASTER else 1


if __name__ == "__main__":
    sys.exit(main())
