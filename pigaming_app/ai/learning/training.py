"""Training of a Q-table in self-play: two robots act by one shared table and both update it.

Matches run one after the other in the same loop, compiled over NumPy records or interpreted over plain ones. Table and
training progress are a single record, so training can stop anywhere and resume bit-identically.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.learning.batch import initial_states
from pigaming_app.ai.learning.q_learner import learn, learn_last, temperature
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.qlearning.recipe import RECIPES, Recipe
from pigaming_app.ai.qlearning.table import Learned, LearnerMind, QTable, player, set_recipe
from pigaming_app.ai.qlearning.table_files import Trained
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.engine_hash import engine_hash
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.sim.contact import drive
from pigaming_app.sim.kernel import can_compile, compiled, compiled_before
from pigaming_app.sim.record import copy, packed, unpack
from pigaming_app.sim.rng import seeded, training_seed
from pigaming_app.sim.world import HZ

GAME, VARIANT, ARENA, MINUTES = "pitanks", "classic", "classic", 2.0
MOST_AT_ONCE = 64  # matches in a call of the loop
Loop = Callable[[Any, Any, Any, Any, int], None]


def make_training(judge: Callable[[Any], None]) -> Loop:
    """A loop that plays matches, one after the other, for `ticks` ticks, with learners on their first two seats."""

    def practise(matches: Any, ones: Any, twos: Any, tables: Any, ticks: int) -> None:
        table = tables[0]
        for i in range(len(matches)):
            match, one, two = matches[i], ones[i], twos[i]
            while ticks > 0 and not match.over:
                if match.tick % table.knobs.period == 0:
                    learn(match, 0, one, table)
                    learn(match, 1, two, table)
                judge(match)
                drive(match)
                ticks -= 1
                if match.over:
                    learn_last(match, 0, one, table)
                    learn_last(match, 1, two, table)
                    table.matches += 1

    return practise


@cache
def plain_training() -> Loop:
    """Training loop over plain records, cached."""
    return make_training(games()[GAME].judge)


@cache
def compiled_training() -> Loop:
    """Training loop over NumPy records, cached. Raises ImportError without numba."""
    return compiled(make_training(games()[GAME].judge))


def is_compiled() -> bool:
    """True if numba's on-disk cache holds the compiled loop, so that it loads at once."""
    return can_compile() and compiled_before(make_training(games()[GAME].judge))


@dataclass(frozen=True)
class Checkpoint:
    """A frozen copy of the table as a brain, with the matches and experiences behind it."""

    kind: BrainKind
    matches: int
    experiences: int


class TableTraining:
    """A table in training. `run` may be called from one worker thread while other threads only read."""

    def __init__(
        self,
        recipe: Recipe,
        seed: int,
        arena: str = ARENA,
        fast: bool | None = None,
        table: Any = None,
        minutes: float = MINUTES,
    ) -> None:
        """`fast`: compiled; None: compiled if numba is installed. `table`: resume from this plain or NumPy record.

        A resumed table keeps its random generator. Raises ArenaError; ImportError for `fast` without numba.
        """
        self.fast = can_compile() if fast is None else fast
        self.arena, self.minutes, self.seed = arena, minutes, seed
        self.loop = compiled_training() if self.fast else plain_training()
        self._tables = self._row(fresh_table(seed) if table is None else to_plain(table))
        self.recipe = recipe
        self._fresh, self._mind = self._row(initial_states([self._setup()])[0]), self._row(LearnerMind())
        self._matches: Any  # rows of the match in progress and of its learners' minds
        self._ones: Any
        self._twos: Any
        self._begin()

    def run(self, ticks: int) -> None:
        """Play and learn for `ticks` ticks, across matches."""
        while ticks > 0:
            if number(self._matches, "over"):
                self._begin()
            ticks -= self._play(ticks)
        self._seen = _copy(self._matches) if self.fast else self._matches

    def warm(self) -> None:
        """Compile the loop now rather than on the first tick."""
        self.loop(self._matches, self._ones, self._twos, self._tables, 0)

    def snapshot(self) -> Any:
        """Snapshot of the match after the last `run`, read-only (in plain training: the match itself)."""
        return unpack(games()[GAME].state, self._seen[0]) if self.fast else self._seen[0]

    @property
    def recipe(self) -> Recipe:
        """Rewards and parameters of learning; may be replaced between two runs, and the table is kept."""
        return self._recipe

    @recipe.setter
    def recipe(self, recipe: Recipe) -> None:
        self._recipe = recipe
        set_recipe(self._tables[0], recipe)

    @property
    def match(self) -> Any:
        """The match in progress, a plain or NumPy record."""
        return as_record(self._matches)

    @property
    def tick(self) -> int:
        """Ticks played of the match in progress."""
        return number(self._matches, "tick")

    @property
    def table(self) -> Any:
        """The live table, a plain or NumPy record; it changes during `run`."""
        return as_record(self._tables)

    @property
    def matches(self) -> int:
        """Matches played to the end."""
        return number(self._tables, "matches")

    @property
    def experiences(self) -> int:
        """Updates of the table, of both robots together."""
        return number(self._tables, "experiences")

    @property
    def temperature(self) -> float:
        """Present temperature of exploration."""
        return float(temperature(self.table))

    @property
    def visited(self) -> int:
        """States visited at least once."""
        return number(self._tables, "states")

    def checkpoint(self, name: str = "q") -> Checkpoint:
        """A frozen copy of the table as a brain."""
        frozen = _copy(self._tables)
        return Checkpoint(player(name, Learned(frozen if self.fast else frozen[0])), self.matches, self.experiences)

    def trained(self, name: str) -> Trained:
        """A copy of the table with the parameters of its training, ready for a file."""
        reward = next((number for number, recipe in RECIPES.items() if recipe == self.recipe), 0)
        rows = self._tables.copy() if self.fast else packed(self._tables)
        return Trained(name, reward, self.recipe, self.seed, self.arena, self.minutes, rows, engine_hash())

    def measure(self, opponent: "str | Checkpoint" = "classic", matches: int = 100) -> tuple[int, int, int]:
        """Wins, ties and losses of the present table against `opponent`, by the training rules."""
        other = opponent.kind if isinstance(opponent, Checkpoint) else BRAINS[GAME][opponent]
        return contest(self.checkpoint().kind, other, matches, self.seed, self.minutes, self.arena, self.fast)

    def _setup(self) -> Setup:
        return training_setup(training_seed(self.seed), self.minutes, self.arena)

    def _row(self, state: Any) -> Any:
        """A row of one record, NumPy if compiled, else plain."""
        return packed([state]) if self.fast else [state]

    def _play(self, ticks: int) -> int:
        """Play at most `ticks` ticks of this match and of a few more, in one call of the loop; returns how many."""
        more = min(MOST_AT_ONCE - 1, ticks // round(self.minutes * 60 * HZ))
        matches = _followed_by(self._matches, self._fresh, more)
        ones, twos = (_followed_by(minds, self._mind, more) for minds in (self._ones, self._twos))
        before = self.tick
        self.loop(matches, ones, twos, self._tables, ticks)
        played = [number(matches[i : i + 1], "tick") for i in range(more + 1)]
        last = max(i for i in range(more + 1) if i == 0 or played[i])
        here = slice(last, last + 1)
        self._matches, self._ones, self._twos = matches[here], ones[here], twos[here]
        return sum(played) - before

    def _begin(self) -> None:
        """Begin the next match with fresh minds."""
        self._matches = _copy(self._fresh)
        self._ones, self._twos = _copy(self._mind), _copy(self._mind)
        self._seen = self._matches


def resumed(saved: Trained, fast: bool | None = None) -> TableTraining:
    """Resume a saved training with a fresh match. Raises ArenaError."""
    return TableTraining(saved.recipe, saved.seed, saved.arena, fast, saved.rows[0], saved.minutes)


def fresh_table(seed: int) -> QTable:
    """An empty plain table."""
    table = QTable()
    table.random = seeded(seed)
    return table


def as_record(row: Any) -> Any:
    """The only record of a row, plain or NumPy, with its fields as attributes."""
    if isinstance(row, list):
        return row[0]
    import numpy as np

    return row.view(np.recarray)[0]


def number(row: Any, name: str) -> int:
    """A whole number of the only record of a row, plain or NumPy; in a hundredth of the time of `as_record`."""
    return int(getattr(row[0], name) if isinstance(row, list) else row[name][0])


def _copy(row: Any) -> Any:
    """A copy of a row of one record, plain or NumPy."""
    return _followed_by(row[:0], row, 1)


def _followed_by(row: Any, other: Any, count: int) -> Any:
    """A row of records, plain or NumPy, and `count` copies of the only one of another; as bytes, since NumPy copies
    records field by field."""
    if isinstance(row, list):
        return [*row, *(copy(other[0]) for _ in range(count))]
    if not count:
        return row
    import numpy as np

    return np.frombuffer(bytearray(row.tobytes() + count * other.tobytes()), row.dtype)


def to_plain(table: Any) -> QTable:
    """A plain copy of a table, plain or NumPy."""
    return copy(table) if isinstance(table, QTable) else unpack(QTable, table)


def training_setup(seed: int, minutes: float = MINUTES, arena: str = ARENA) -> Setup:
    """A match of two learners by the rules of the measured results."""
    one, two, three, four = Seat("learner", 0), Seat("learner", 1), Seat("off", 2), Seat("off", 3)
    return Setup(GAME, arena, (one, two, three, four), minutes, seed, VARIANT)


def contest(
    one: BrainKind,
    other: BrainKind,
    matches: int,
    seed: int,
    minutes: float = MINUTES,
    arena: str = ARENA,
    fast: bool | None = None,
) -> tuple[int, int, int]:
    """Wins, ties and losses of `one` against `other`, two matches per seed with the sides swapped."""
    fast = can_compile() if fast is None else fast
    setups = [training_setup(seed + i // 2, minutes, arena) for i in range(matches)]
    leads = []
    for half, kinds, sign in ((setups[::2], (one, other), 1), (setups[1::2], (other, one), -1)):
        if half:
            batch = Batch(half, kinds, fast)
            batch.play(round(minutes * 60 * HZ))
            leads += [sign * (scores[0] - scores[1]) for scores in batch.scores()]
    return sum(lead > 0 for lead in leads), sum(lead == 0 for lead in leads), sum(lead < 0 for lead in leads)
