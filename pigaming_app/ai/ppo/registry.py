"""Tasks by game: the games that PPO learns, by the task files that ship beside their networks."""

from collections.abc import Container, Iterator
from pathlib import Path

from pigaming_app.ai.networks.files import BRAINS
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.ppo.standard import standard_task
from pigaming_app.ai.ppo.task import Task
from pigaming_app.ai.ppo.task_file import SUFFIX, TaskFileError, read_task
from pigaming_app.games.registry import OURS
from pigaming_app.storage.optional import optional
from pigaming_app.storage.plugins.parts import data_folders, has_failed, leave_out, parts


def shipped_file(game: str) -> Path | None:
    """The task file of a game; None for a plug-in without one, whose numbers are in its code."""
    path = dict.fromkeys(OURS, BRAINS).get(game) or dict(data_folders("brains")).get(game)
    path = path and path / f"{game}{SUFFIX}"
    return path if path and path.is_file() else None


def _filed(game: str, code: Task) -> Task:
    path = shipped_file(game)
    return read_task(path, code, check=False) if path else code


def _fault(game: str, code: Task) -> str:
    """Why a plug-in's task is unusable, or nothing."""
    try:
        task = _filed(game, code)
    except TaskFileError as error:
        return str(error)
    if not task.line_ups:
        return f"TASK has no line-ups, and there is no file brains/{game}{SUFFIX}"
    return ""


def _by_points(own: Container[str]) -> Iterator[tuple[str, Task]]:
    """Tasks of the plug-ins that have an encoding alone; `own`: games that have a task."""
    for game, encoding in ENCODINGS.items():
        if game in own or game in OURS or has_failed(game):
            continue
        if reason := _fault(game, task := standard_task(encoding)):
            leave_out(game, reason)
        else:
            yield game, task


_OWN = {
    **{game: room.TASK for game in OURS if (room := optional(f"ai.ppo.{game}"))},
    **parts("training", "TASK", Task, _fault),
}
TASKS: dict[str, Task] = {game: _filed(game, code) for game, code in (*_OWN.items(), *_by_points(_OWN))}
