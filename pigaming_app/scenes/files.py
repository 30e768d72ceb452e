"""Replays and trained brains as files: formats are defined by `games` and `ai`, file access by `storage`."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from pigaming_app.ai.brain import archive
from pigaming_app.ai.networks import files as network_files
from pigaming_app.ai.networks.files import NetworkError, TrainedNetwork
from pigaming_app.ai.qlearning import table_files
from pigaming_app.ai.qlearning.table_files import TableError, Trained
from pigaming_app.games.match import Match
from pigaming_app.games.replay import Replay, ReplayError
from pigaming_app.storage.parsing import describe_error, read
from pigaming_app.storage.safe_files import write_atomic

T = TypeVar("T")


def save_replay(match: Match, path: Path) -> None:
    """Write the replay of a match up to now, atomically. Raises NotSaved, and ValueError if there can be none."""
    from pigaming_app.scenes.features import replays  # late: jobs describe their options without pygame

    replay = replays.replay_of(match)
    if replay is None:
        raise ValueError("a match of measured robots cannot be played again")
    write_atomic(path, replays.pack(replay))


def load_replay(path: Path) -> Replay:
    """Read and check a replay. Raises ReplayError, whose text begins with the file name."""
    from pigaming_app.scenes.features import replays  # late, as above

    return _load(path, replays.MAX_BYTES, replays.decode, ReplayError)


def save_table(trained: Trained, path: Path) -> None:
    """Write a trained table atomically. Raises NotSaved."""
    write_atomic(path, table_files.encode(trained))


def load_table(path: Path) -> Trained:
    """Read and check a trained table. Raises TableError, whose text begins with the file name."""
    return _load(path, table_files.MAX_BYTES, table_files.decode, TableError)


def save_network(trained: TrainedNetwork, path: Path) -> None:
    """Write a trained network atomically. Raises NotSaved, NetworkError."""
    write_atomic(path, network_files.encode(trained))


def load_network(path: Path) -> TrainedNetwork:
    """Read and check a trained network. Raises NetworkError, whose text begins with the file name."""
    return _load(path, network_files.MAX_BYTES, network_files.decode, NetworkError)


def is_network(path: Path) -> bool:
    """True for the file of a network, damaged or not. False for what cannot be read."""
    try:
        return archive.names(read(path, network_files.MAX_BYTES)) == network_files.PARTS.keys()
    except OSError:
        return False


def _load(path: Path, limit: int, decode: Callable[[bytes, str], T], error: type[ValueError]) -> T:
    """Read at most `limit` bytes and decode them. Raises `error`."""
    try:
        raw = read(path, limit)
    except OSError as trouble:
        raise error(f"{path.name}: cannot be read ({describe_error(trouble)})") from None
    return decode(raw, path.name)
