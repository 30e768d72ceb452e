"""The tasks of PiGaming-Bench as data: who plays what in an evaluation. docs/benchmark.md has the protocol.

An agent is a brain: the file of one, or an AI by its name. A change here begins a new FORMAT of results.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.ppo.task_file import HELD_BACK

FORMAT = 1  # of results
AGENT, RIVAL = "agent", "rival"  # on a seat: who is evaluated, and the best response to it
BUDGETS = 1_000_000, 10_000_000, 100_000_000  # decisions of a training, at most
RIVAL_DECISIONS, RIVAL_SEED = 1_000_000, 1  # of the training of a best response
SEED = 5_000_000  # of the first match; `duel` counts from 1, trainings below 0
MATCHES = 100  # of a condition, in pairs of one seed with the sides swapped
PARTNERS = ("hand3", "classic", "fsm", "q2")  # with whom no agent may have trained
MADE = tuple(f"surprise-{HELD_BACK + number}" for number in range(1, 11))  # on which no agent can have trained
SHIPPED = {
    "pitanks": ("classic", "courtyard", "islands", "labyrinth", "trenches"),
    "race": ("classic", "hairpin", "kidney", "technical"),
}


@dataclass(frozen=True)
class Condition:
    """Matches of one kind."""

    seats: tuple[str, ...]  # AGENT, RIVAL or brains; the other side sits on the odd ones
    arenas: tuple[str, ...]  # which take turns
    teams: tuple[int, ...] | None = None
    measured: bool = False  # robots drawn within the range of measured ones, by the seed
    counts: bool = True  # for the score; others are there for comparison


@dataclass(frozen=True)
class BenchmarkTask:
    """What an agent is evaluated by. The score is the share of wins over all conditions that count, ties for half."""

    game: str
    variant: str
    minutes: float  # of a match
    text: str
    conditions: Mapping[str, Condition]  # by name


def _duels(arenas: Sequence[str], opponents: Sequence[str] = LEVELS) -> dict[str, Condition]:
    return {opponent: Condition((AGENT, opponent), tuple(arenas)) for opponent in opponents}


def _unseen(game: str) -> dict[str, Condition]:
    return {
        "made": Condition((AGENT, "level3"), MADE),
        "shipped": Condition((AGENT, "level3"), SHIPPED[game], counts=False),
    }


def _with(partner: str, counts: bool = True) -> Condition:
    return Condition((AGENT, "level3", partner, "level3"), SHIPPED["pitanks"], (0, 1, 0, 1), counts=counts)


TASKS: Mapping[str, BenchmarkTask] = {
    "pitanks-duel": BenchmarkTask(
        "pitanks", "party", 2.0, "against each of the five levels", _duels(SHIPPED["pitanks"])
    ),
    "pitanks-arenas": BenchmarkTask("pitanks", "party", 2.0, "in arenas that no training uses", _unseen("pitanks")),
    "pitanks-partner": BenchmarkTask(
        "pitanks",
        "party",
        2.0,
        "two against two, with partners that no training uses",
        {**{name: _with(name) for name in PARTNERS}, "level3": _with("level3", counts=False)},
    ),
    "pitanks-robots": BenchmarkTask(
        "pitanks",
        "party",
        2.0,
        "on measured robots, after a training on ideal ones",
        {
            "measured": Condition((AGENT, "level3"), SHIPPED["pitanks"], measured=True),
            "ideal": Condition((AGENT, "level3"), SHIPPED["pitanks"], counts=False),
        },
    ),
    "pitanks-exploit": BenchmarkTask(
        "pitanks",
        "party",
        2.0,
        "against a best response to it",
        {RIVAL: Condition((AGENT, RIVAL), SHIPPED["pitanks"])},
    ),
    "race-duel": BenchmarkTask("race", "standard", 10.0, "against each of the five levels", _duels(SHIPPED["race"])),
    "race-arenas": BenchmarkTask("race", "standard", 10.0, "on tracks that no training uses", _unseen("race")),
}  # by name
