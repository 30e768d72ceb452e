"""The network of a training as a file's content, with the recipe by which it was trained."""

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from pigaming_app.ai.brain.archive import HEAD, BrainFileError, pack, read, unpack, verify
from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.networks.files import TrainedNetwork, TrainingCurve
from pigaming_app.ai.networks.policy import Handicap
from pigaming_app.ai.ppo.task import LineUp, Task
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
    """Learner, plan, hyper-parameters, constants of the rewards, and matches of a training."""
    task = training.task
    return {
        "learner": "ppo",
        "planned_updates": training.planned if training.minutes is None else None,
        "planned_minutes": training.minutes,
        "start": training.start and training.start.name,
        **asdict(training.hyper),
        **constants(task),
        "arenas": list(task.arenas),
        "variants": list(task.variants),
        "match_minutes": list(task.minutes),
        "line_ups": [described(line_up) for line_up in task.line_ups],
        "population": task.population,
        "cut": task.cut,
        "sharpness": task.sharpness,
    }


def constants(task: Task) -> dict[str, float]:
    """The decimal constants by which a task rewards and varies its matches, such as WIN."""
    functions = (task.gauge, task.result, task.reward, task.habits)
    found = {name: function.__globals__.get(name) for function in functions for name in function.__code__.co_names}
    return {name: value for name, value in sorted(found.items()) if name.isupper() and type(value) is float}


def described(line_up: LineUp) -> str:
    """A line-up in words, such as "4 learner hand3"."""
    teams = f" teams {' '.join(map(str, line_up.teams))}" if line_up.teams else ""
    return (
        " ".join([str(line_up.share), *line_up.seats])
        + teams
        + "".join(f" {name}" for name in (*line_up.variants, *line_up.arenas))
    )


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
