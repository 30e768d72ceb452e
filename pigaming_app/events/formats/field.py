"""What the draw of a round may look at, and what it decides."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations

from pigaming_app.events.spec import EventSpec, Result, Round

Pair = frozenset[str]


@dataclass(frozen=True)
class EntrantField:
    """The event so far. `entrants`: all by their seeding, late ones last; `outcomes`: by fixture, with walkovers."""

    spec: EventSpec
    entrants: tuple[str, ...]
    late: frozenset[str]  # entrants since the first round
    withdrawn: frozenset[str]
    rounds: tuple[Round, ...]
    outcomes: Mapping[int, Result]

    @property
    def present(self) -> tuple[str, ...]:
        """Everybody who has not withdrawn."""
        return tuple(name for name in self.entrants if name not in self.withdrawn)

    def meetings(self) -> dict[Pair, int]:
        """How often each two have met, or were drawn to meet."""
        return meetings(group for drawn in self.rounds for group in (one.entrants for one in drawn.fixtures))

    def byes(self) -> dict[str, int]:
        """The byes of each entrant."""
        found = dict.fromkeys(self.entrants, 0)
        for drawn in self.rounds:
            for name in drawn.byes:
                found[name] += 1
        return found


@dataclass(frozen=True)
class MatchUp:
    """A match that is drawn: its entrants, in the order of the seats if `seated`."""

    entrants: tuple[str, ...]
    stage: str = ""
    seated: bool = False


@dataclass(frozen=True)
class Draw:
    """The matches of one round, in order of play, and the byes."""

    matches: tuple[MatchUp, ...]
    byes: tuple[str, ...] = ()


def meetings(groups: Iterator[tuple[str, ...]]) -> dict[Pair, int]:
    """How often each two are in one group."""
    found: dict[Pair, int] = {}
    for group in groups:
        for pair in combinations(group, 2):
            found[frozenset(pair)] = found.get(frozenset(pair), 0) + 1
    return found
