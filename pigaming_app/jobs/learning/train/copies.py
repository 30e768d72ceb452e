"""Frozen copies of a network in training, one for each tenth of it, rated by matches against each other.

A win rate against a fixed rival soon stays at 100 %; what a network wins against its former selves goes on. Matches are
those of the task, on its arenas and by its rules, but with seeds that no training plays.
"""

from collections.abc import Iterable
from concurrent.futures import Executor
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import NamedTuple

from pigaming_app.ai.brain.archive import read
from pigaming_app.ai.learning.ratings import Rating, ratings
from pigaming_app.ai.networks.files import MAX_BYTES, TrainedNetwork, brain_of, decode, encode
from pigaming_app.ai.ppo.product import trained_network
from pigaming_app.ai.ppo.training import Training
from pigaming_app.ai.ppo.win_rates import SEED, points_between
from pigaming_app.storage.parsing import describe_error
from pigaming_app.storage.safe_files import NotSaved, write_atomic

COPIES, MATCHES = 10, 20  # after the first one; matches of each pair


class RatedCopy(NamedTuple):
    """A copy and its strength in points, as chess counts them; the mean of all copies is 0."""

    updates: int
    decisions: int
    rating: Rating


class FrozenCopies:
    """The copies of a training, in a folder."""

    def __init__(self, training: Training, folder: Path, name: str) -> None:
        """Continues with those of the same name that are not newer than the training.

        Raises NotSaved or BrainFileError.
        """
        self._training, self._folder, self._name = training, folder, name
        try:
            folder.mkdir(parents=True, exist_ok=True)
            there = sorted(folder.glob(f"{name}_{'[0-9]' * 7}.npz")) if training.updates else []
        except OSError as error:
            raise NotSaved(f"{folder} was not made: {describe_error(error)}.") from None
        files = [file for file in there if int(file.stem[-7:]) <= training.updates]
        networks = [decode(read(file, MAX_BYTES), file.name) for file in files]
        self._networks = {network.updates: network for network in networks}
        self._done = self._tenths() if self._networks else -1
        self._points: dict[tuple[int, int], list[tuple[float, float]]] = {}

    def add(self) -> bool:
        """Write a copy if one is due; returns whether it was. Raises NotSaved."""
        if self._tenths() <= self._done:
            return False
        copy = self._present()
        write_atomic(self._folder / f"{copy.name}.npz", encode(copy))
        self._done = self._tenths()
        self._networks[copy.updates] = copy
        return True

    def rated(self, threads: Executor) -> list[RatedCopy]:
        """All copies with their ratings, the oldest first; the result of the training is one, written or not.

        Plays the pairs that have not met.
        """
        if self._training.finished:
            self._networks.setdefault(self._training.updates, self._present())
        networks = list(self._networks.values())
        if len(networks) < 2:
            return []
        rows, shares = [brain_of(network).weights(True) for network in networks], {}
        for one, other in combinations(range(len(rows)), 2):
            pair = networks[one].updates, networks[other].updates
            if pair not in self._points:
                task = self._training.task
                self._points[pair] = points_between(task, rows[one], rows[other], MATCHES, threads)
            shares[one, other] = self._points[pair]
        rated = zip(networks, ratings(len(rows), shares, SEED), strict=True)
        return [RatedCopy(network.updates, network.decisions, rating) for network, rating in rated]

    def copied(self, chosen: RatedCopy, out: Path) -> None:
        """Write a copy as the result of the training. Raises NotSaved."""
        write_atomic(out, encode(replace(self._networks[chosen.updates], name=out.stem)))

    def _present(self) -> TrainedNetwork:
        return trained_network(self._training, f"{self._name}_{self._training.updates:07}")

    def _tenths(self) -> int:
        return int(COPIES * min(1.0, self._training.share) + 1e-9)


def strongest(copies: Iterable[RatedCopy]) -> RatedCopy:
    """The one of the highest rating; of equals the latest."""
    return max(copies, key=lambda copy: (copy.rating.rating, copy.updates))
