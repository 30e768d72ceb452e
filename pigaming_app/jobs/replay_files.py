"""Replays as files."""

from pathlib import Path

from pigaming_app.games.match import Match
from pigaming_app.games.replay import MOST_BYTES, Replay, ReplayError, decode, encode
from pigaming_app.storage.parsing import describe_error, read
from pigaming_app.storage.safe_files import write_atomic


def save(match: Match, path: Path) -> None:
    """Write the replay of a match as far as it has been played, whole or not at all. Raises NotSaved."""
    write_atomic(path, encode(match))


def load(path: Path) -> Replay:
    """Read and check a replay. Raises ReplayError."""
    try:
        raw = read(path, MOST_BYTES)
    except OSError as error:
        raise ReplayError(f"{path.name}: cannot be read ({describe_error(error)})") from None
    return decode(raw, path.name)
