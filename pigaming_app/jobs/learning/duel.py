"""Many matches between two AIs; each seed is played from both sides."""

import json
from dataclasses import asdict, dataclass

from pigaming_app.ai.learning import league
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.setup import ChoiceError, require_game
from pigaming_app.jobs.terminal.options import AIS, PairOptions, argument
from pigaming_app.jobs.terminal.refusal import refused, require_for_brains
from pigaming_app.sim.arena import ArenaError


@dataclass(frozen=True, kw_only=True)
class DuelOptions(PairOptions):
    """The pair."""

    left: str = argument(AIS, metavar="AI")
    right: str = argument("its opponent", metavar="AI")


def run(options: DuelOptions) -> int:
    """Play the duel and print its result. Raises Refusal."""
    require_for_brains((options.left, options.right))
    with refused(ChoiceError, ArenaError):
        result = _play(options)
    if options.json:
        print(json.dumps(asdict(result)))
    else:
        _print(result)
    return 0


def _play(options: DuelOptions) -> league.Duel:
    require_game(options.game)
    for brain in (options.left, options.right):
        find_brain(options.game, brain)
    return league.duel(
        options.game,
        options.left,
        options.right,
        options.matches,
        options.seed,
        options.minutes,
        options.arena,
        options.variant,
        goal=options.goal(options.game),
    )


def _print(result: league.Duel) -> None:
    low, high = result.wilson95
    shown = league.names((result.left, result.right))
    left, right = shown[result.left], shown[result.right]
    width = max(10, len(left) + 1, len(right) + 1)
    print(f"{'':{width}}{'wins':>7}{'ties':>7}{'losses':>7}{'mean score':>12}")
    print(f"{left:{width}}{result.wins:7}{result.ties:7}{result.losses:7}{result.mean_score_left:z12.2f}")
    print(f"{right:{width}}{result.losses:7}{result.ties:7}{result.wins:7}{result.mean_score_right:z12.2f}")
    print(f"{left} wins {100 * result.wins / result.matches:.1f} % of {result.matches} matches", end=" ")
    print(f"(Wilson 95 %: {100 * low:.1f} to {100 * high:.1f} %), {result.ticks_per_second:,.0f} ticks/s")
