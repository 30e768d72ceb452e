"""One decision of every learner in many matches: act, play some ticks with the opponents, reward, observe.

The closure is compiled by numba into a single loop over NumPy records, and also runs uncompiled over plain ones.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

from pigaming_app.ai.learning.cast import Family, Think, dispatcher
from pigaming_app.ai.networks.encoding import UNIT, Encoding
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.tallies import Tallies
from pigaming_app.games.registry import games
from pigaming_app.gym.rewards import TALLIES
from pigaming_app.sim.action import set_action
from pigaming_app.sim.contact import drive
from pigaming_app.sim.kernel import compiled, kernel

Loop = Callable[..., None]
SCALE = 1.0 / UNIT


@kernel
def act_continuously(match: Any, seat: int, action: Any) -> None:
    """Set a seat's action from linear and angular stick in [-1, 1], and fire and turbo, which are on above 0.5."""
    set_action(match.actions[seat], float(action[0]), float(action[1]), int(action[2] > 0.5), int(action[3] > 0.5))


def make_loop(judge: Any, think: Think, act: Any, encoding: Encoding, tallies: Tallies) -> Loop:
    """The loop over matches of a game.

    Of each match (n) and learner (a): `actions` (n, a, choices), `senses` (n, a), `observations` (n, a, inputs),
    `totals` (n, a, tallies), `rewards` (n, a). `minds` (n, opponents) and `weights` are those of the cast, `worth`
    (tallies) the weights of the reward. Learners sit on the first seats, opponents on those after them. A match that is
    `fresh` (n) is only observed. `over` (n) receives 1 if the match is over, or nothing is at stake for learners.
    """
    encode, size = encoding.encode, encoding.size
    tally, is_done, count = tallies.tally, tallies.is_done, len(tallies.names)

    def play(
        matches: Any,
        minds: Any,
        weights: Any,
        senses: Any,
        actions: Any,
        fresh: Any,
        totals: Any,
        worth: Any,
        observations: Any,
        rewards: Any,
        over: Any,
        ticks: int,
    ) -> None:
        learners = rewards.shape[1]
        for i in range(len(matches)):
            match, seated = matches[i], minds[i]
            if not fresh[i]:
                for seat in range(learners):
                    act(match, seat, actions[i, seat])
                for _ in range(ticks):
                    if match.over:
                        break
                    for k in range(len(seated)):
                        think(match, learners + k, seated[k], weights)
                    judge(match)
                    drive(match)
            done = 1
            for seat in range(learners):
                row = observations[i, seat]
                encode(match, seat, senses[i][seat], row)
                for k in range(size):
                    row[k] *= SCALE
                total, reward = totals[i, seat], 0.0
                for k in range(count):
                    reward -= worth[k] * total[k]
                tally(match, seat, senses[i][seat], total)
                for k in range(count):
                    reward += worth[k] * total[k]
                rewards[i, seat] = 0.0 if fresh[i] else reward
                done &= is_done(match, seat)
            over[i] = done

    return play


@cache
def loop_of(game: str, families: tuple[Family, ...], continuous: bool, fast: bool) -> Loop:
    """The loop of a game for a cast, cached; `fast`: compiled. Raises ImportError without numba."""
    encoding = ENCODINGS[game]
    act = act_continuously if continuous else encoding.act
    loop = make_loop(games()[game].judge, dispatcher(families), act, encoding, TALLIES[game])
    return compiled(loop) if fast else loop
