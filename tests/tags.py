"""Files of each tag, which its successors read: `tests/data/tags/VERSION` has a small one of each kind.

python -m tests.tags --write 2.0.0
"""

import sys
from collections.abc import Callable
from pathlib import Path

from pigaming_app.ai.learning.training import TableTraining
from pigaming_app.ai.qlearning import table_files
from pigaming_app.ai.qlearning.recipe import RECIPES
from pigaming_app.ai.registry import new_match
from pigaming_app.games.match import Match
from pigaming_app.games.replay import encode
from pigaming_app.games.setup import make_setup
from pigaming_app.scenes.views.race import ghost_files
from pigaming_app.sim.world import DT

FOLDER = Path(__file__).parent / "data" / "tags"


def match_of(game: str, brains: list[str], minutes: float, seed: int) -> Match:
    """A match of brains before its first tick."""
    return new_match(make_setup(game, brains, "classic", minutes, seed, None, None, brains))


def write_replay(folder: Path) -> None:
    match = match_of("pitanks", ["level5", "random", "fsm", "random"], 0.1, 2018)
    while not match.over:
        match.tick()
    (folder / "pitanks.replay").write_bytes(encode(match))


def write_ghost(folder: Path) -> None:
    """The second lap of an AI, as the recorder keeps one of a person."""
    match = match_of("race", ["hand3", "idle"], 2.0, 7)
    racer, robot, track = match.state.racers[0], match.state.robots[0], []
    while racer.best_lap == 0.0:
        match.tick()
        track.append((match.state.tick, (robot.x, robot.y, robot.heading)))
    start = racer.lap_start - racer.last_lap
    first = max(i for i, (tick, _) in enumerate(track) if tick <= start)
    samples = [((tick - start) * DT, pose) for tick, pose in track[first:]]
    ghost = ghost_files.ghost_of(racer.line, racer.last_lap * DT, [split * DT for split in racer.best_splits], samples)
    ghost_files.save_ghost(folder, match.arena, ghost).join()


def write_table(folder: Path) -> None:
    training = TableTraining(RECIPES[2], 1, fast=False, minutes=0.1)
    training.run(600)
    (folder / "ROBI.npz").write_bytes(table_files.encode(training.trained("ROBI")))


WRITERS: tuple[Callable[[Path], None], ...] = (write_replay, write_ghost, write_table)


def main() -> int:
    """Write the files of a tag."""
    option, version = sys.argv[1:] or ("", "")
    if option != "--write":
        print(__doc__)
        return 2
    folder = FOLDER / version
    folder.mkdir(parents=True, exist_ok=True)
    for write in WRITERS:
        write(folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
