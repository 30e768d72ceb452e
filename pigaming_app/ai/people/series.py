"""Series of matches of people against Auto, which learns from each: how soon it suits them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from statistics import mean
from typing import Any

from pigaming_app.ai.auto import Estimate
from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.learning.line_ups import LineUps
from pigaming_app.ai.people.matches import Trial, changed
from pigaming_app.ai.registry import AIS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Setup
from pigaming_app.games.match import victory
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, make_setup
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import ROBOTS

FIRSTS = (0, 4, 8)  # strengths at which series begin
LENGTH = 8  # matches of a series
LEARNING = 3  # of them, after which the strength should suit


@dataclass(frozen=True)
class Series:
    """Series of one kind of person from a first strength. `wins`, `strengths`: means by number of the match."""

    person: str
    first: int
    runs: int
    wins: tuple[float, ...]
    strengths: tuple[float, ...]

    @property
    def share(self) -> float:
        """Share of wins after the LEARNING matches."""
        return mean(self.wins[LEARNING:])

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's interval of that share, 95 %."""
        played = self.runs * (LENGTH - LEARNING)
        return wilson(round(self.share * played), played)


def series(
    trial: Trial,
    persons: Sequence[str],
    firsts: Sequence[int] = FIRSTS,
    scale: str | None = None,
    driving: str | None = None,
) -> Iterator[Series]:
    """As many series of each person from each first strength as make up the trial's matches. Raises ChoiceError.

    `scale` and `driving` as in `places`.
    """
    if not AIS[trial.game].auto:
        raise ChoiceError(f"{trial.game} has no Auto")
    line_ups = LineUps(trial.game, [*persons, *AUTO], can_compile(), changed(trial.game, scale, driving))
    for person in persons:
        for first in firsts:
            yield played(trial, person, first, line_ups)


def played(trial: Trial, person: str, first: int, line_ups: LineUps) -> Series:
    """The series of one person from a first strength; the line-ups have it and AUTO."""
    runs = max(1, trial.matches // LENGTH)
    estimates, wins, strengths = [Estimate(first) for _ in range(runs)], [], []
    for number in range(LENGTH):
        chosen = [_setup(trial, person, AUTO[one.strength], run, number) for run, one in enumerate(estimates)]
        strengths.append(mean(one.strength for one in estimates))
        ends, efforts = line_ups.played_with_efforts([setup for setup, _ in chosen])
        won = [victory(games()[trial.game], end, seat) for end, (_, seat) in zip(ends, chosen, strict=True)]
        for one, share, end, (_, seat), seats in zip(estimates, won, ends, chosen, efforts, strict=True):
            one.update(_of_others(end, seat, seats), share)
        wins.append(mean(won))
    return Series(person, first, runs, tuple(wins), tuple(strengths))


def _setup(trial: Trial, person: str, brain: str, run: int, number: int) -> tuple[Setup, int]:
    """A match of a run, and the person's seat: seats, arenas and seeds take turns."""
    names, teams, seat = arenas(trial.game), trial.rules.teams, (run + number) % ROBOTS
    brains = [person if team == teams[seat] else brain for team in teams]
    chosen = names[(run // ROBOTS + number) % len(names)], trial.minutes, trial.seed + LENGTH * run + number
    return make_setup(trial.game, brains, *chosen, trial.rules.name, None, [person, brain]), seat


def _of_others(end: Any, seat: int, efforts: Sequence[float]) -> float:
    team = end.robots[seat].team
    return mean(effort for robot, effort in zip(end.robots, efforts, strict=True) if robot.team != team)
