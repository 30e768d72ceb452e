"""What a network has gone through, the ones that it was continued from included: how many decisions, and with whom."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from pigaming_app.ai.brain.archive import BrainFileError, read
from pigaming_app.ai.networks.files import MAX_BYTES, TrainedNetwork, decode
from pigaming_app.ai.ppo.task import LEARNERS, OFF, POOL
from pigaming_app.ai.ppo.task_file import parse_task_file
from pigaming_app.storage.parsing import ParseError

PPO = "ppo"  # the learner of networks that record their task; those of other libraries have none
MOST_STARTS = 20  # networks in a row, each continued from the next


class History(NamedTuple):
    """The trainings of a network as one."""

    decisions: int | None = None  # of its robots; None: not known
    met: frozenset[str] = frozenset()  # AIs on the seats of its matches, as far as recorded
    recorded: bool = False  # whether these are all


def history_of(network: TrainedNetwork, folder: Path, deeper: int = MOST_STARTS) -> History:
    """The history of a network. One that does not tell that of its start needs its file beside it, in `folder`."""
    recipe = network.recipe
    before = _before(recipe, folder, deeper) if recipe.get("start") else History(0, recorded=True)
    decisions = None if before.decisions is None else before.decisions + network.decisions
    try:
        seats = {name for line_up in parse_task_file(str(recipe["task"])).line_ups for name in line_up.seats}
    except (KeyError, ParseError):
        return History(decisions, before.met, before.recorded and recipe.get("learner") != PPO)
    return History(decisions, before.met | (seats - {*LEARNERS, POOL, OFF}), before.recorded)


def recipe_of(start: str, history: History) -> dict[str, Any]:
    """What a recipe tells of the network that was continued."""
    decisions, met, recorded = history
    return {"start": start, "start_decisions": decisions, "start_met": sorted(met), "start_recorded": recorded}


def _before(recipe: Mapping[str, Any], folder: Path, deeper: int) -> History:
    """The history of the network that was continued."""
    match recipe:
        case {"start_decisions": int(decisions), "start_met": list(met), "start_recorded": bool(recorded)}:
            return History(max(0, decisions), frozenset(map(str, met)), recorded)
    file = folder / f"{recipe['start']}.npz"
    try:
        return history_of(decode(read(file, MAX_BYTES), file.name), folder, deeper - 1) if deeper else History()
    except BrainFileError:
        return History()
