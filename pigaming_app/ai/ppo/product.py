"""The network of a training as a file's content, with the recipe by which it was trained."""

from dataclasses import asdict
from typing import Any

from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.networks.files import TrainedNetwork, TrainingCurve
from pigaming_app.ai.networks.policy import Handicap
from pigaming_app.ai.ppo.task import LineUp, Task
from pigaming_app.ai.ppo.training import Training, columns

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
        **asdict(training.hyper),
        **constants(task),
        "arenas": list(task.arenas),
        "variants": list(task.variants),
        "match_minutes": list(task.minutes),
        "line_ups": [described(line_up) for line_up in task.line_ups],
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
