"""A task: a game as PPO learns it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from pigaming_app.ai.networks.encoding import Encoding
from pigaming_app.ai.ppo.learner import STANDARD, Hyper
from pigaming_app.games.arenas import shipped_arenas
from pigaming_app.games.registry import games
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.kernel import kernel

SHARDS = 4  # independent parts of a training's matches
LEARNER, EXPLOITER, POOL, OFF = "learner", "exploiter", "pool", "off"  # on a seat
LEARNERS = (LEARNER, EXPLOITER)  # the network in training, and one that seeks its weaknesses; POOL: copies of both


@kernel
def no_result(match: MatchState, seat: int) -> float:
    """No reward at the end of a match."""
    return 0.0


def no_habits(random: Any) -> Mapping[str, float]:
    """None."""
    return {}


class LineUp(NamedTuple):
    """Who plays a kind of match, by seat, and in which teams; the players are moved on by a random number of seats."""

    share: int  # of the matches, relative to the other line-ups
    seats: tuple[str, ...]  # `learner`, its `exploiter`, `pool` (copies of both), `off`, or a brain
    teams: tuple[int, ...] | None = None  # None: those of the variant
    variants: tuple[str, ...] = ()  # empty: those of the task
    arenas: tuple[str, ...] = ()  # empty: those of the task


@dataclass(frozen=True, eq=False)
class Task:
    """What is played, what is rewarded, and against whom progress is measured.

    Gauges are running totals of a seat, such as hits; a decision is rewarded by what they gain until the next one.
    `gauge(match, seat, inputs, gauges)` and `result(match, seat)` are kernels.
    """

    encoding: Encoding
    arenas: tuple[str, ...]
    variants: tuple[str, ...]  # drawn at random; those named more often are played more often
    minutes: tuple[float, ...]
    line_ups: Sequence[LineUp]
    gauges: tuple[str, ...]
    gauge: Callable[[Any, int, Any, Any], None]
    reward: Callable[[Any, Any, Any, float], Any]  # reward(gains (..., gauges), inputs, choices, share of training)
    rivals: tuple[str, ...]  # brains against which win rates are measured
    result: Callable[[Any, int], float] = no_result  # reward of the end of a match
    habits: Callable[[Any], Mapping[str, float]] = (
        no_habits  # habits(generator): fields of a network's senses, for a whole match
    )
    cut: float = 0.0  # probability that a match is replaced by a fresh one after each update
    hyper: Hyper = STANDARD
    sharpness: float = 1.0  # of the trained network as a brain; see Handicap
    pairs: bool = False  # rivals are measured two against two

    @property
    def game(self) -> str:
        return self.encoding.game

    @property
    def learners(self) -> tuple[str, ...]:
        """Those of the LEARNERS that play."""
        return tuple(name for name in LEARNERS if any(name in line_up.seats for line_up in self.line_ups))

    def against(self, rival: str, variant: str) -> "Task":
        """The same task against one brain only, by one set of rules: what it takes to beat that one.

        Two against two where there are two teams, else duels, on the arenas of the game.
        """
        teams = games()[self.game].variants[variant].teams
        pairs = len({*teams}) == 2
        seats = tuple(LEARNER if team == teams[0] else rival for team in teams) if pairs else (LEARNER, rival, OFF, OFF)
        return replace(
            self,
            arenas=tuple(shipped_arenas(self.game)),
            variants=(variant,),
            line_ups=(LineUp(1, seats),),
            rivals=(rival,),
            habits=no_habits,
            pairs=pairs,
        )
