"""Brains from files: the path of a trained network or table stands for its brain wherever a brain is named.

A process reads a file once: a league never mixes two versions of it, and a rematch goes on if it has vanished since.
"""

import os
from dataclasses import replace
from functools import cache
from pathlib import Path, PureWindowsPath

from pigaming_app.ai.brain.archive import BrainFileError, names, read
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.networks import files as network_files
from pigaming_app.ai.qlearning import table_files
from pigaming_app.storage.optional import optional

ONNX = ".onnx"
SUFFIXES = (".npz", ONNX)
SHOWN = 16  # characters of a file's name on screens
TABLE_GAME = "pitanks"  # the only game that has tables


def is_path(name: str) -> bool:
    """True for the path of a file: it has a separator, also that of Windows, or the suffix of a brain's file."""
    return name.lower().endswith(SUFFIXES) or "/" in name or "\\" in name


def display_name(name: str) -> str:
    """Name of a brain for screens and tables: of a path the file's, without suffix, and shortened; without `bot:`."""
    if not is_path(name):
        return name.rpartition(":")[2]
    stem = stem_of(name)
    return stem if len(stem) <= SHOWN else f"{stem[: SHOWN - 1]}…"


def stem_of(name: str) -> str:
    """Name of a file without folders and suffix, in one line; both kinds of separators count on every system."""
    return "".join(char if char.isprintable() else "?" for char in PureWindowsPath(name).stem) or "?"


def bare_name(name: str) -> str:
    """Name of a brain; of a path the file's, without folders."""
    return PureWindowsPath(name).name if is_path(name) else name


def read_brain(game: str, path: str) -> BrainKind:
    """The brain of a file, as it was when this process first read it. Raises BrainFileError."""
    try:
        return _read(game, os.path.realpath(path))
    except ValueError as error:
        if isinstance(error, BrainFileError):
            raise
        raise BrainFileError(f"{stem_of(path)}: not the name of a file") from None  # it has a null character


def _read_model(file: Path, game: str) -> BrainKind:
    """The brain of an ONNX model. Raises BrainFileError, also where the feature that reads it is missing."""
    models = optional("ai.networks.onnx.files")
    if models is None:
        raise BrainFileError(f"{file.name}: ONNX models are not part of this installation")
    kind: BrainKind = models.read_model(file, game)
    return kind


@cache
def _read(game: str, path: str) -> BrainKind:
    file = Path(path)
    if file.suffix.lower() == ONNX:
        return _read_model(file, game)
    raw = read(file, table_files.MAX_BYTES)
    parts = names(raw)
    if parts == network_files.PARTS.keys():
        network = network_files.decode(raw, file.name)
        played, kind = network.game, replace(network_files.brain_of(network), file=file)
    elif parts == table_files.PARTS.keys():
        played, kind = TABLE_GAME, table_files.brain_of(table_files.decode(raw, file.name))
    else:
        raise BrainFileError(f"{file.name}: {'neither a network nor a trained table' if raw else 'the file is empty'}")
    if played != game:
        raise BrainFileError(f"{file.name}: it plays {played}, not {game}")
    return kind
