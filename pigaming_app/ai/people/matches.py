"""Matches of people against AIs: how often a person wins against three AIs, or with a mate against two."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.learning.line_ups import LineUps
from pigaming_app.ai.registry import known_brains
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Setup
from pigaming_app.games.match import standings
from pigaming_app.games.registry import games
from pigaming_app.games.setup import make_setup
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import ROBOTS


@dataclass(frozen=True)
class Place:
    """Result of a person's matches. `wins`: matches that they or their team won; a tie of n winners counts 1/n."""

    person: str
    level: str
    matches: int
    wins: float
    median_score: float

    @property
    def share(self) -> float:
        return self.wins / self.matches

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's interval, 95 %."""
        return wilson(round(self.wins), self.matches)


def setups(
    game: str, person: str, level: str, matches: int, seed: int, variant: str | None = None, goal: int | None = None
) -> Iterator[tuple[Setup, int]]:
    """Setups over all arenas and seats in turn, and the person's seat. A mate is of the same kind as the person."""
    rules, names = games()[game], arenas(game)
    teams = (rules.variants[variant] if variant else rules.default).teams
    known = known_brains(game, [person, level])
    for i in range(matches):
        seat = i % ROBOTS
        brains = [person if teams[j] == teams[seat] else level for j in range(ROBOTS)]
        arena = names[i // ROBOTS % len(names)]
        yield make_setup(game, brains, arena, None, seed + i, variant, None, known, goal), seat


def places(
    game: str,
    people: Sequence[str],
    levels: Sequence[str],
    matches: int,
    seed: int = 0,
    variant: str | None = None,
    fast: bool | None = None,
) -> list[Place]:
    """The place of each of these people against each of these levels. Raises ChoiceError or ArenaError."""
    line_ups = LineUps(game, [*people, *levels], can_compile() if fast is None else fast)
    return [
        _place(person, level, [*setups(game, person, level, matches, seed, variant)], line_ups)
        for person in people
        for level in levels
    ]


def _place(person: str, level: str, trial: Sequence[tuple[Setup, int]], line_ups: LineUps) -> Place:
    ends = line_ups.played([setup for setup, _ in trial])
    game, wins, scores = games()[line_ups.game], 0.0, []
    for (_, seat), end in zip(trial, ends, strict=True):
        wins += win(game, end, seat)
        scores.append(end.robots[seat].score)
    return Place(person, level, len(trial), wins, sorted(scores)[len(scores) // 2])


def win(game: Any, end: Any, seat: int) -> float:
    """The seat's share of the victory: 1 / n among n winners' teams, 0 for others."""
    _, winners = standings(game, end)
    if seat in winners:
        return 1.0
    keys = [game.ranking_key(end, i) for i in range(ROBOTS) if end.robots[i].present]
    best = [i for i in range(ROBOTS) if end.robots[i].present and game.ranking_key(end, i) == max(keys)]
    teams = {end.robots[i].team for i in best}
    return 1.0 / len(teams) if not winners and end.robots[seat].team in teams else 0.0
