"""Tasks by game: the games that PPO learns."""

from pigaming_app.ai.ppo.task import Task
from pigaming_app.games.registry import OURS
from pigaming_app.storage.optional import optional
from pigaming_app.storage.plugins.parts import parts

TASKS: dict[str, Task] = {
    **{game: room.TASK for game in OURS if (room := optional(f"ai.ppo.{game}"))},
    **parts("training", "TASK", Task),
}
