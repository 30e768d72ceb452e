"""A population: earlier selves and exploiters, met the more often the more they win.

Prioritised fictitious self-play (O. Vinyals et al., "Grandmaster level in StarCraft II using multi-agent reinforcement
learning", Nature 575, 2019): the chance of a member grows with (1 - p)², where p is the network's share of wins against
it. An exploiter starts from the network's present weights, learns duels against it alone, and joins when it wins or
after a while; then the next one starts.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

EXPLOITED = -1  # in place of a member: the exploiter
MEMORY = 0.97  # of a result, from one match to the next: about 30 matches count
SELF_EVERY = 60  # updates between two copies of the network that join
WON, ENOUGH = 0.7, 20.0  # share of wins with which an exploiter is done, and matches that count for it, about
PATIENCE = 400  # updates after which an exploiter is done in any case


class Pool(NamedTuple):
    """Networks for the seats of a pool: a row of weights, and the chance of each; None: the same for all."""

    rows: Any
    chances: Any = None


@dataclass
class Record:
    """What the network has lately won against somebody, of how many matches; older ones count less."""

    wins: float = 0.0
    matches: float = 0.0

    def note(self, score: float) -> None:
        """Add a match: 1 for a win, 1/2 for a tie."""
        self.wins = MEMORY * self.wins + score
        self.matches = MEMORY * self.matches + 1.0

    @property
    def share(self) -> float:
        """The expected share of wins; a half before the first match."""
        return (self.wins + 1.0) / (self.matches + 2.0)


@dataclass
class Population:
    """The records of the members, by their place in the pool, and that of the present exploiter."""

    members: list[Record] = field(default_factory=lambda: [Record()])  # the first: the network as it began
    joined: list[list[int]] = field(default_factory=lambda: [[0, 0]])  # of each: learner, and update
    exploiter: Record = field(default_factory=Record)
    since: int = 0  # update at which the exploiter started

    @property
    def chances(self) -> Any:
        """The chance of each member to be met."""
        weights = np.array([(1.0 - record.share) ** 2 for record in self.members])
        return weights / weights.sum()

    def note(self, outcomes: Iterable[Sequence[float]]) -> None:
        """Add matches: the place of the opponent, and the network's score."""
        for place, score in outcomes:
            (self.exploiter if place == EXPLOITED else self.members[int(place)]).note(float(score))

    def exploiter_is_done(self, updates: int) -> bool:
        """True if it has found a weakness, or has had its time."""
        wins = self.exploiter.matches >= ENOUGH and 1.0 - self.exploiter.share >= WON
        return wins or updates - self.since >= PATIENCE

    def place_of(self, learner: int, updates: int, most: int) -> int:
        """A place for a new member; in a full pool that of the one least often met."""
        if len(self.members) < most:
            self.members.append(Record())
            self.joined.append([learner, updates])
            return len(self.members) - 1
        place = int(self.chances.argmin())
        self.members[place], self.joined[place] = Record(), [learner, updates]
        return place

    def next_exploiter(self, updates: int) -> None:
        """The next one starts."""
        self.exploiter, self.since = Record(), updates

    def state(self) -> dict[str, Any]:
        """Everything, for `restored`."""
        return {
            "members": [[record.wins, record.matches] for record in (*self.members, self.exploiter)],
            "joined": [list(one) for one in self.joined],
            "since": self.since,
        }


def restored(state: dict[str, Any]) -> Population:
    """The population of a `state`. Raises KeyError, TypeError or ValueError."""
    *members, exploiter = (Record(float(wins), float(matches)) for wins, matches in state["members"])
    joined = [[int(number) for number in one] for one in state["joined"]]
    return Population(members, joined, exploiter, int(state["since"]))
