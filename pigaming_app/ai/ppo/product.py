"""The network of a training as a file's content, with the recipe by which it was trained."""

import json
from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from pigaming_app.ai.brain.archive import HEAD, BrainFileError, pack, read, unpack, verify
from pigaming_app.ai.brain_files import bare_name
from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.networks.files import MAX_BYTES, TrainedNetwork, TrainingCurve, decode
from pigaming_app.ai.networks.policy import Handicap
from pigaming_app.ai.ppo.task import Length
from pigaming_app.ai.ppo.task_file import PPO, TaskFile, file_of, recipe_of, text_of, with_brains
from pigaming_app.ai.ppo.training import POOL, Training, columns
from pigaming_app.games.engine_hash import engine_hash

POINTS = 250  # of a curve, at most


def trained_network(training: Training, name: str) -> TrainedNetwork:
    """The present network of a training."""
    layers, points = training.layers(), training.points
    return TrainedNetwork(
        name=name,
        game=training.task.game,
        matrices=[matrix.astype("<i2") for matrix in layers.matrices],
        biases=[(bias / UNIT).astype("<i2") for bias in layers.biases],
        recipe=recipe(training),
        seed=training.seed,
        updates=training.updates,
        decisions=training.decisions,
        handicap=Handicap(sharpness=training.task.sharpness),
        curve=TrainingCurve(columns(training.task), tuple(points[:: -(-len(points) // POINTS) or 1])),
    )


def recipe(training: Training) -> dict[str, Any]:
    """By what it was trained: the task file that makes the same network, and the one from which it was continued."""
    start = recipe_of(training.start.name, training.start.history) if training.start else {"start": None}
    return {"learner": PPO, **start, "task": text_of(task_file(training))}


def recorded_task(path: Path) -> str:
    """The task file by which a network was trained. Raises BrainFileError."""
    trained = decode(read(path, MAX_BYTES), path.name)
    task = trained.recipe.get("task")
    if not isinstance(task, str):
        raise BrainFileError(f"{path.name}: it does not tell by which task file it was trained")
    return task


def task_file(training: Training) -> TaskFile:
    """The task of a training as a file, with its seed and length. Brains that are files lie beside it."""
    updates = training.planned if training.minutes is None else None
    length = Length(training.seed, updates=updates, minutes=training.minutes)
    return with_brains(file_of(replace(training.task, hyper=training.filed, length=length)), bare_name)


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
    start = training.start and training.start.name
    return {"engine": engine_hash(game), "start": start, **json.loads(json.dumps(asdict(task_file(training))))}
