"""Tasks by game: the games that PPO learns."""

from pigaming_app.ai.ppo import pitanks, race
from pigaming_app.ai.ppo.task import Task
from pigaming_app.storage.plugins.parts import parts

TASKS: dict[str, Task] = {
    **{task.game: task for task in (pitanks.TASK, race.TASK)},
    **parts("training", "TASK", Task),
}
