"""A task: a game as PPO learns it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from pigaming_app.ai.networks.encoding import Encoding
from pigaming_app.ai.networks.policy import HIDDEN
from pigaming_app.ai.ppo.learner import STANDARD, Hyper
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.arenas import shipped_arenas
from pigaming_app.games.registry import games
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.kernel import kernel

SHARDS = 4  # independent parts of a training's matches
LEARNER, EXPLOITER, POOL, OFF = "learner", "exploiter", "pool", "off"  # on a seat
LEARNERS = (LEARNER, EXPLOITER)  # the network in training, and one that seeks its weaknesses; POOL: copies of both

Reward = Callable[[Any, Any, Any, float], Any] | type[Any]
Habits = Callable[[Any], Mapping[str, float]] | type[Any]


@kernel
def no_result(match: MatchState, seat: int) -> float:
    """No reward at the end of a match."""
    return 0.0


def no_habits(random: Any) -> Mapping[str, float]:
    """None."""
    return {}


class Length(NamedTuple):
    """Of a training, with its seed; one of the three numbers, or none."""

    seed: int = 1
    updates: int | None = None
    decisions: int | None = None
    minutes: float | None = None


NO_LENGTH = Length()


class LineUp(NamedTuple):
    """Who plays a kind of match, by seat, and in which teams; the players are moved on by a random number of seats."""

    share: int  # of the matches, relative to the other line-ups
    seats: tuple[str, ...]  # `learner`, its `exploiter`, `pool` (copies of both), `off`, or a brain
    teams: tuple[int, ...] | None = None  # None: those of the variant
    variants: tuple[str, ...] = ()  # empty: those of the task
    arenas: tuple[str, ...] = ()  # empty: those of the task


@dataclass(frozen=True, eq=False, kw_only=True)
class Task:
    """What is played, what is rewarded, and against whom progress is measured.

    Gauges are running totals of a seat, such as hits; a decision is rewarded by what they gain until the next one.
    `gauge(match, seat, inputs, gauges)` and `result(match, seat)` are kernels. A task file, `brains/GAME.task.toml`,
    has all that has a default here but `result`. `reward` and `habits` are functions, or frozen dataclasses of numbers
    that can be called: the file then has their fields, as [rewards] and [habits].
    """

    encoding: Encoding
    gauges: tuple[str, ...]
    gauge: Callable[[Any, int, Any, Any], None]
    reward: Reward  # reward(gains (..., gauges), inputs, choices, share of training)
    result: Callable[[Any, int], float] = no_result  # reward of the end of a match
    habits: Habits = no_habits  # habits(generator): fields of a network's senses, for a whole match
    arenas: tuple[str, ...] = ()
    variants: tuple[str, ...] = ()  # drawn at random; those named more often are played more often
    minutes: tuple[float, ...] = ()
    line_ups: Sequence[LineUp] = ()
    rivals: tuple[str, ...] = ()  # brains against which win rates are measured
    units: int = HIDDEN  # of each hidden layer of the network
    cut: float = 0.0  # probability that a match is replaced by a fresh one after each update
    hyper: Hyper = STANDARD
    sharpness: float = 1.0  # of the trained network as a brain; see Handicap
    pairs: bool = False  # rivals are measured two against two
    team_critic: bool = False  # the value function also sees what the mates see; see `team_critic`
    population: bool = False  # exploiters start from the network in training, and the pool is met by chances
    length: Length = NO_LENGTH  # of a training, unless the command names another

    @property
    def game(self) -> str:
        return self.encoding.game

    @property
    def sizes(self) -> tuple[tuple[int, int], ...]:
        """Inputs and units of each layer of the network."""
        return (self.encoding.size, self.units), (self.units, self.units), (self.units, self.encoding.outputs)

    @property
    def learners(self) -> tuple[str, ...]:
        """Those of the LEARNERS that play."""
        return tuple(name for name in LEARNERS if any(name in line_up.seats for line_up in self.line_ups))

    def against(self, rival: str, variant: str) -> "Task":
        """The same task against one brain only, by one set of rules: what it takes to beat that one.

        Two against two where there are two teams, else duels, on the arenas of the game. Measured as sharp as a network
        that is the rival. Raises ChoiceError.
        """
        line_up, game, kind = versus(self.game, rival, variant), self.game, find_brain(self.game, rival)
        kind.begin(mind := kind.mind(), 0)
        return replace(
            self,
            arenas=tuple(shipped_arenas(game)),
            variants=(variant,),
            line_ups=(line_up,),
            rivals=(rival,),
            habits=no_habits,
            pairs=OFF not in line_up.seats,
            sharpness=getattr(mind, "sharpness", self.sharpness),
        )

    def populated(self) -> "Task":
        """The same task in a population: a quarter of the matches against its exploiter, and one against the pool."""
        replaced = {LEARNER, EXPLOITER}, {LEARNER, POOL}
        kept = [line_up for line_up in self.line_ups if {*line_up.seats} - {OFF} not in replaced]
        total = sum(line_up.share for line_up in kept)
        variant = games()[self.game].default.name
        against = [versus(self.game, other, variant)._replace(share=total) for other in (EXPLOITER, POOL)]
        return replace(self, line_ups=(*(one._replace(share=2 * one.share) for one in kept), *against), population=True)


def versus(game: str, other: str, variant: str) -> LineUp:
    """The learner against somebody: two against two where there are two teams, else a duel."""
    teams = games()[game].variants[variant].teams
    if len({*teams}) == 2:
        return LineUp(1, tuple(LEARNER if team == teams[0] else other for team in teams))
    return LineUp(1, (LEARNER, other, OFF, OFF))
