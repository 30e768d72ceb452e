"""Frozen copies of a network in training, one for each tenth of it, and a league among them.

A win rate against a fixed rival soon stays at 100 %; what a network wins against its former selves goes on. The matches
of the league have seeds that no training plays.
"""

from pathlib import Path

from pigaming_app.ai.learning import league as leagues
from pigaming_app.ai.learning.league import League
from pigaming_app.ai.networks.files import encode
from pigaming_app.ai.ppo.product import trained_network
from pigaming_app.ai.ppo.training import Training
from pigaming_app.storage.parsing import describe_error
from pigaming_app.storage.safe_files import NotSaved, write_atomic

COPIES, MATCHES = 10, 10  # after the first one; matches of each pair
SEED = 1_000_000  # of the first match


class FrozenCopies:
    """The copies of a training, in a folder."""

    def __init__(self, training: Training, folder: Path, name: str) -> None:
        """Continues with those of the same name that are not newer than the training. Raises NotSaved."""
        self._training, self._folder, self._name = training, folder, name
        try:
            folder.mkdir(parents=True, exist_ok=True)
            there = sorted(folder.glob(f"{name}_{'[0-9]' * 7}.npz")) if training.updates else []
        except OSError as error:
            raise NotSaved(f"{folder} was not made: {describe_error(error)}.") from None
        self._files = [file for file in there if int(file.stem[-7:]) <= training.updates]
        self._done = self._tenths() if self._files else -1

    def add(self) -> None:
        """Write a copy if one is due. Raises NotSaved."""
        if self._tenths() > self._done:
            self._done = self._tenths()
            name = f"{self._name}_{self._training.updates:07}"
            file = self._folder / f"{name}.npz"
            write_atomic(file, encode(trained_network(self._training, name)))
            self._files = [*(other for other in self._files if other != file), file]

    def league(self) -> League | None:
        """The ratings of all copies; None for fewer than two."""
        if len(self._files) < 2:
            return None
        game = self._training.task.game
        minutes = self._training.task.minutes[0]
        return leagues.league(game, [str(file) for file in self._files], MATCHES, SEED, minutes)

    def _tenths(self) -> int:
        return int(COPIES * min(1.0, self._training.share) + 1e-9)
