"""The task file of a game, or that by which a network was trained, to read, change and train by."""

from dataclasses import dataclass
from pathlib import Path

from pigaming_app.jobs.terminal.options import argument
from pigaming_app.jobs.terminal.refusal import Refusal, refused


@dataclass(frozen=True, kw_only=True)
class TaskOptions:
    """Whose task."""

    whose: str = argument("a game, or the .npz file of a network", metavar="GAME|FILE")


def run(options: TaskOptions) -> int:
    """Print the file. Raises Refusal."""
    from pigaming_app.ai.brain.archive import BrainFileError
    from pigaming_app.ai.ppo.product import recorded_task
    from pigaming_app.ai.ppo.registry import TASKS, shipped_file
    from pigaming_app.ai.ppo.task_file import file_of, text_of
    from pigaming_app.games.setup import ChoiceError, require_game
    from pigaming_app.storage.parsing import read_text

    if options.whose.endswith(".npz"):
        with refused(BrainFileError):
            print(recorded_task(Path(options.whose)), end="")
        return 0
    with refused(ChoiceError):
        require_game(options.whose)
    if options.whose not in TASKS:
        raise Refusal(f"train task: there are those of {', '.join(TASKS)} only, not {options.whose}")
    path = shipped_file(options.whose)
    print(read_text(path) if path else text_of(file_of(TASKS[options.whose])), end="")
    return 0
