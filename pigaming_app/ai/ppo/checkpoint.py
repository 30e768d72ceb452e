"""Checkpoints: a training as a file, from which it continues bit for bit.

They are protected against damage and mix-ups, not against malice: a checkpoint is read by whoever wrote it.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pigaming_app.ai.brain.archive import HEAD, BrainFileError, pack, read, unpack, verify
from pigaming_app.ai.ppo.product import recipe
from pigaming_app.ai.ppo.training import POOL, Training
from pigaming_app.games.engine_hash import engine_hash

FORMAT = "pigaming-checkpoint-1"
MAX_HEAD = 20_000_000  # limit of the unpacked head, bytes
MARGIN = 20_000  # bytes of the head of an array


def encode(training: Training) -> bytes:
    """Content of a checkpoint."""
    numbers, arrays = training.state()
    return pack({"format": FORMAT, "plan": _plan(training), "state": numbers}, arrays)


def restore(training: Training, path: Path) -> None:
    """Continue a fresh training from a file. Raises BrainFileError, whose message begins with the file's name."""
    fresh = training.state()[1]
    limits = {part: array.nbytes + MARGIN for part, array in fresh.items()}
    limits |= {part: POOL * fresh[part].nbytes + MARGIN for part in _pools(fresh)}
    limits = {HEAD: MAX_HEAD, **limits}
    raw = read(path, sum(limits.values()))
    try:
        _restore(training, raw, limits, fresh)
    except BrainFileError as error:
        raise BrainFileError(f"{path.name}: {error}") from None


def _restore(training: Training, raw: bytes, limits: Mapping[str, int], fresh: Mapping[str, Any]) -> None:
    head, arrays = unpack(raw, "checkpoint of such a training", FORMAT, limits)
    verify(head, arrays)
    plan, saved = _plan(training), head.get("plan")
    if not isinstance(saved, dict):
        raise BrainFileError("its head is not complete")
    for key, value in plan.items():
        if saved.get(key) != value:
            raise BrainFileError(f"it is from a training with another {key.replace('_', ' ')}")
    for part, array in fresh.items():
        rows = slice(1, None) if part in _pools(fresh) else slice(None)
        if arrays[part].dtype != array.dtype or arrays[part].shape[rows] != array.shape[rows]:
            raise BrainFileError("it is from another version of this program")
    try:
        training.restore(head["state"], arrays)
    except (KeyError, TypeError, ValueError, OverflowError):
        raise BrainFileError("its head is not complete") from None


def _pools(arrays: Mapping[str, Any]) -> list[str]:
    """The parts of a state that grow."""
    return [part for part in arrays if part.startswith("pool")]


def _plan(training: Training) -> dict[str, Any]:
    """What determines the course of a training."""
    game = training.task.game
    return {"engine": engine_hash(game), "game": game, "seed": training.seed, **recipe(training)}
