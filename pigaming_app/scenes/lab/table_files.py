"""Trained Q-tables as files."""

from pathlib import Path

from pigaming_app.ai.qlearning.table_files import MOST_BYTES, TableError, Trained, decode, encode
from pigaming_app.storage.parsing import describe_error, read
from pigaming_app.storage.safe_files import write_atomic


def save(trained: Trained, path: Path) -> None:
    """Write a trained table, whole or not at all. Raises NotSaved."""
    write_atomic(path, encode(trained))


def load(path: Path) -> Trained:
    """Read and check a trained table. Raises TableError, which begins with the name of the file."""
    try:
        raw = read(path, MOST_BYTES)
    except OSError as error:
        raise TableError(f"{path.name}: cannot be read ({describe_error(error)})") from None
    return decode(raw, path.name)
