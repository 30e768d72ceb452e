"""The traits of the people in replays, and of groups of them; the model that is nearest."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from pigaming_app.ai.brain.kind import Traits
from pigaming_app.ai.game_ai import POINT, TURN
from pigaming_app.ai.people.fit.calibration import FitCalibration, FittedTrait, calibration, estimate, is_told, raw_of
from pigaming_app.ai.people.fit.statistics import statistics
from pigaming_app.ai.people.fit.wishes import Array, Watched, watch
from pigaming_app.ai.people.models import PEOPLE
from pigaming_app.games.replay import BYTES_PER_TICK, Replay, to_match
from pigaming_app.sim.action import STEPS
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import HZ, ROBOTS

LEAST, PRESSES = 0.5, 30  # minutes of play; changes of the stick in them
KEYS_SHARE = 0.97  # of the ticks of somebody who steers with keys, in which the stick is at a limit or at rest


class NotFitted(ValueError):
    """Why no traits follow from somebody's play, in one line."""


@dataclass(frozen=True)
class FittedPerson:
    """A seat of a replay, or the same seat of several. `raws`: logarithms or shares of all traits."""

    game: str
    driving: str
    minutes: float
    raws: Mapping[str, float]

    def estimates(self) -> dict[str, FittedTrait | None]:
        """Of every trait; None: not enough play to tell."""
        errors = self.errors()
        return {
            name: estimate(name, raw, errors[name]) if is_told(name, errors[name]) else None
            for name, raw in self.raws.items()
        }

    def errors(self) -> dict[str, float]:
        """Standard deviations of `raws`."""
        known = _calibration(self.game, self.driving)
        return {name: known.error(name, self.minutes) for name in self.raws}

    @property
    def nearest(self) -> str:
        """The model that differs least, by the errors."""
        errors = self.errors()

        def distance(name: str) -> float:
            traits = PEOPLE[name].traits
            return sum(((raw - _known(trait, traits)) / (0.2 + errors[trait])) ** 2 for trait, raw in self.raws.items())

        return min(PEOPLE, key=distance)


@dataclass(frozen=True)
class GroupMean:
    """The mean of a trait in a group, with its interval of 95 %; None: not enough play."""

    people: int
    minutes: float
    traits: Mapping[str, FittedTrait | None]


def play_of(replay: Replay, seat: int) -> Watched:
    """What a seat did. Raises NotFitted if the match plays out differently now, or its game has no models."""
    match = to_match(replay)
    watched = watch(replay.setup.game, match.state, recorded(replay), seat)
    if replay.setup.sudden_death:
        watched.end.over = 1  # by `Match`, not by the rules
    if digest(watched.end) != replay.digest:
        raise NotFitted("plays out differently in this version")
    return watched


def recorded(replay: Replay) -> Array:
    """The actions of a replay, (ticks, 4 seats, 5)."""
    ticks = np.frombuffer(replay.ticks, np.uint8).reshape(-1, ROBOTS, BYTES_PER_TICK // ROBOTS).astype(float)
    buttons = ticks[:, :, 2].astype(int)
    sticks = ticks[:, :, :2] / STEPS - 1.0
    return np.concatenate([sticks, np.stack([buttons & 1, buttons >> 1 & 1, buttons >> 2], axis=2)], axis=2)


def driving_of(play: Watched) -> str:
    """The driving style that the actions of a person show."""
    sticks = np.abs(play.actions[:, :2])
    return TURN if np.mean(((sticks == 0.0) | (sticks == 1.0)).all(axis=1)) > KEYS_SHARE else POINT


def fitted(game: str, plays: Sequence[Watched], driving: str | None = None) -> FittedPerson:
    """The traits of one person. Raises NotFitted."""
    minutes = sum(len(play.actions) for play in plays) / (60.0 * HZ)
    driving = driving or driving_of(plays[0])
    if minutes < LEAST or sum(map(presses, plays)) < PRESSES:
        raise NotFitted("not enough play")
    known = _calibration(game, driving)
    return FittedPerson(game, driving, minutes, known.raw(statistics(plays, driving == POINT)))


def presses(play: Watched) -> int:
    """How often the stick or the keys of the stick have changed."""
    return int(np.sum(np.any(np.diff(play.actions[:, :2], axis=0) != 0.0, axis=1)))


def mean_of(people: Sequence[FittedPerson]) -> GroupMean:
    """Of people of one device and age band. Their own errors and the differences between them make the interval."""
    traits = {name: _mean(name, people) for name in people[0].raws}
    return GroupMean(len(people), sum(one.minutes for one in people), traits)


def _mean(trait: str, people: Sequence[FittedPerson]) -> FittedTrait | None:
    if not all(_calibration(one.game, one.driving).shows(trait) for one in people):
        return None
    raws = np.array([one.raws[trait] for one in people])
    own = np.array([one.errors()[trait] for one in people])
    apart = float(raws.std(ddof=1)) if len(people) > 1 else 0.0
    error = max(float(np.sqrt(np.sum(own**2))) / len(people), apart / len(people) ** 0.5)
    return estimate(trait, float(raws.mean()), error) if is_told(trait, error) else None


def _known(trait: str, traits: Traits) -> float:
    return raw_of(trait, max(0.02, getattr(traits, trait)))


def _calibration(game: str, driving: str) -> FitCalibration:
    known = calibration(game, driving)
    if known is None:
        raise NotFitted(f"no calibration for {game}, {driving}")
    return known
