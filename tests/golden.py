"""Golden digests of a thousand ticks of each game, arena and variant.

`tests/golden.json` holds them. A change of the engine that is meant to change how matches play out renews them with

    python -m tests.golden --write

and says why in its commit. Without --write it lists what differs.
"""

import hashlib
import json
import sys
from pathlib import Path

from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.sim.record import hashed, to_bytes

FILE = Path(__file__).with_name("golden.json")
TICKS = 1000
SEED = 2018


def main() -> int:
    """Update the file, or list the differences."""
    now = {key: played(key) for key in keys()}
    if "--write" in sys.argv[1:]:
        FILE.write_text(json.dumps(now, indent=1) + "\n", encoding="utf-8")
        print(f"{len(now)} digests written to {FILE.name}")
        return 0
    kept = golden()
    differ = [key for key in sorted({*now, *kept}) if now.get(key) != kept.get(key)]
    print("\n".join(differ) or "all as they were")
    return 1 if differ else 0


def keys() -> list[str]:
    """Every game/arena/variant."""
    return [
        f"{game}/{arena}/{variant}" for game in games() for arena in arenas(game) for variant in games()[game].variants
    ]


def golden() -> dict[str, str]:
    """The stored digests."""
    kept: dict[str, str] = json.loads(FILE.read_text(encoding="utf-8"))
    return kept


def played(key: str) -> str:
    """The digest of the state after TICKS ticks of random brains, and of every seat's observation.

    Random brains, since the hand-written ones may be tuned without any change of the engine.
    """
    game, arena, variant = key.split("/")
    rules = games()[game]
    offered = rules.variants[variant]
    one, two, three, four = (Seat("random", team) for team in offered.teams)
    match = Match(Setup(game, arena, (one, two, three, four), 1.0, SEED, variant, offered.default_goal))
    for seat in range(4):
        match.sit(seat, make_brain(game, "random", SEED + seat))
    for _ in range(TICKS):
        match.tick()
    sha = hashlib.sha256(hashed(type(match.state), to_bytes(match.state)))
    for seat in range(4):
        view = rules.observation()
        rules.observe(match.state, seat, rules.senses(), view)
        sha.update(to_bytes(view))
    return sha.hexdigest()


if __name__ == "__main__":
    sys.exit(main())
