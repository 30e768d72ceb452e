"""Files of each tag, which its successors read: `tests/data/tags/VERSION` has a small one of each kind.

python -m tests.tags --write 2.1.0
"""

import sys
from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, date, datetime
from operator import attrgetter
from pathlib import Path
from typing import NamedTuple

import numpy as np

from pigaming_app.ai.learning.training import TableTraining
from pigaming_app.ai.networks import files as network_files
from pigaming_app.ai.qlearning import table_files
from pigaming_app.ai.qlearning.recipe import RECIPES
from pigaming_app.ai.registry import new_match
from pigaming_app.events import climb_files, event_files
from pigaming_app.events.ladder import Climb
from pigaming_app.events.spec import Format
from pigaming_app.games import arenas, replay
from pigaming_app.games.drawing.values import Part, drawing_of
from pigaming_app.games.match import Match
from pigaming_app.games.setup import make_setup
from pigaming_app.hardware.calibration.ground_plane import GroundPlane, Lens
from pigaming_app.hardware.control import match_recording
from pigaming_app.hardware.scan.things import Thing, ThingKind, ThingLayout
from pigaming_app.hardware.session import store
from pigaming_app.scenes.views.race import ghost as ghosts
from pigaming_app.sim import drivetrain
from pigaming_app.sim.world import DT
from pigaming_app.storage.day_log import DayLog, PlayedMatch, read_day
from pigaming_app.storage.restarts import Restart, append_restart, restarts
from pigaming_app.storage.scores import Scores, ScoreTable
from pigaming_app.storage.settings import Settings
from tests.ai.networks.random_network import random_network
from tests.events.examples import new_event, played

FOLDER = Path(__file__).parent / "data" / "tags"
NOON = datetime(2026, 11, 24, 12, tzinfo=UTC)
TABLE = ScoreTable("race", "classic", "lap", True, "standard", 3, 2)
THING = Thing(ThingKind.TALL, ((100.0, 100.0), (200.0, 110.0), (190.0, 180.0)), 82.5, 3.25)
PLANE = (1.135, 0.0236, -254.8, 0.0377, 1.1457, -207.6, 2.5e-05, 6.05e-05, 1.0)
GROUND = GroundPlane("1: 1024 × 768", Lens((1920, 1080), -0.3246, 0.1138), PLANE, 2126.0, (877.5, 615.5), 2488.0)


class Kind(NamedTuple):
    """A kind of file: it is written to a folder; what is read from a folder equals `value`."""

    write: Callable[[Path], object]
    read: Callable[[Path], object]
    value: object


def match_of(game: str, brains: list[str], minutes: float) -> Match:
    """A match of brains before its first tick."""
    return new_match(make_setup(game, brains, "classic", minutes, 7, None, None, brains))


def written_settings(folder: Path) -> None:
    settings = Settings(language="pt", music=3, real=[3, 1], controls={"keys1": {"fire": 9}})
    settings.choice("race").arena = "kidney"
    settings.save(folder)


def read_settings(folder: Path) -> object:
    settings, problems = Settings.load(folder)
    kept = settings.language, settings.music, settings.real, settings.controls, settings.choice("race").arena
    return (*kept, problems)


def write_scores(folder: Path) -> None:
    scores = Scores()
    scores.add(TABLE, "ANA", 9870, NOON)
    scores.save(folder)


def read_scores(folder: Path) -> object:
    scores, problems = Scores.load(folder)
    return [(row.initials, row.score, row.when) for row in scores.best(TABLE)], problems


def read_event(folder: Path) -> object:
    event, problems = event_files.load(folder / "event.json")
    return [] if event is None else [(one.entrant, one.wins) for one in event.standings], problems


def recorded_match(folder: Path) -> None:
    """A replay of a second of a match, and the same match as one of real robots."""
    match, recorder = (
        match_of("pitanks", ["level5", "random", "fsm", "random"], 0.05),
        match_recording.MatchRecorder(1.32),
    )
    while match.state.tick < 50:
        recorder.track.add(match.state.robots)
        match.tick()
    (folder / "pitanks.replay").write_bytes(replay.encode(match))
    recording = recorder.recording(match.state.tick, match.state.robots)
    (folder / "real.replay").write_bytes(match_recording.pack(replay.encode(match), recording))


def read_replay(folder: Path) -> object:
    """Length and players; whether it plays out alike is the engine's affair."""
    known = replay.decode((folder / "pitanks.replay").read_bytes(), "pitanks.replay")
    return known.length, [seat.brain for seat in known.setup.seats]


def read_recording(folder: Path) -> object:
    parts = match_recording.unpack((folder / "real.replay").read_bytes())
    known = replay.decode(parts[match_recording.REPLAY], "real.replay")
    return len(match_recording.recording_of(parts, known.length).track)


def write_ghost(folder: Path) -> None:
    """The second lap of an AI, as the recorder keeps one of a person."""
    match = match_of("race", ["hand3", "idle"], 2.0)
    racer, robot, track = match.state.racers[0], match.state.robots[0], []
    while racer.best_lap == 0.0:
        match.tick()
        track.append((match.state.tick, (robot.x, robot.y, robot.heading)))
    start = racer.lap_start - racer.last_lap
    first = max(i for i, (tick, _) in enumerate(track) if tick <= start)
    samples = [((tick - start) * DT, pose) for tick, pose in track[first:]]
    splits = [split * DT for split in racer.best_splits]
    ghost = ghosts.ghost_of(racer.line, racer.last_lap * DT, splits, samples)
    ghosts.save_ghost(folder, match.arena, ghost).join()


def read_ghost(folder: Path) -> object:
    (path,) = (folder / "ghosts").glob("*.json")
    _, ghost = ghosts._parsed(path.read_text(encoding="utf-8"))
    return ghost.seconds, len(ghost.poses)


def write_table(folder: Path) -> None:
    training = TableTraining(RECIPES[2], 1, fast=False, minutes=0.1)
    training.run(600)
    (folder / "ROBI.npz").write_bytes(table_files.encode(training.trained("ROBI")))


def read_table(folder: Path) -> object:
    trained = table_files.decode((folder / "ROBI.npz").read_bytes(), "ROBI.npz")
    return trained.name, trained.reward, trained.matches, trained.recipe.hit


def write_network(folder: Path) -> None:
    random = random_network()
    small = [np.where(np.arange(matrix.size).reshape(matrix.shape) % 97, 0, matrix) for matrix in random.matrices]
    (folder / "net.npz").write_bytes(network_files.encode(replace(random, matrices=[m.astype("<i2") for m in small])))


def read_network(folder: Path) -> object:
    trained = network_files.decode((folder / "net.npz").read_bytes(), "net.npz")
    return trained.game, trained.updates, trained.recipe["opponents"], trained.curve.rows[1]


def write_drawing(folder: Path) -> None:
    drawing = drawing_of(arenas.load("pitanks", "classic").source)
    wall = Part("wall", (("from", (700, 820)), ("to", (900, 820))))
    (folder / "drawn.toml").write_text(drawing.added(wall).text(), encoding="utf-8")


def read_climb(folder: Path) -> object:
    (saved,) = climb_files.parse((folder / climb_files.FILE).read_text(encoding="utf-8"))
    return saved.number, saved.climb.game, saved.climb.rung, saved.climb.eased


KINDS = {
    "settings": Kind(written_settings, read_settings, ("pt", 3, [3, 1], {"keys1": {"fire": 9}}, "kidney", [])),
    "scores": Kind(write_scores, read_scores, ([("ANA", 9870, NOON)], [])),
    "event": Kind(
        lambda folder: event_files.save(folder / "event.json", played(new_event(Format.ROUND_ROBIN, 3))),
        read_event,
        ([("P1", 2), ("P2", 1), ("P3", 0)], []),
    ),
    "climb": Kind(
        lambda folder: climb_files.save(folder, 4711, Climb("race", rung=3, eased=(2,), beaten=2)),
        read_climb,
        (4711, "race", 3, (2,)),
    ),
    "replay": Kind(recorded_match, read_replay, (50, ["level5", "random", "fsm", "random"])),
    "match of real robots": Kind(lambda folder: None, read_recording, 51),
    "ghost": Kind(write_ghost, read_ghost, (8.3718, 84)),
    "Lab robot": Kind(write_table, read_table, ("ROBI", 2, 2, 10.0)),
    "network": Kind(write_network, read_network, ("pitanks", 20, ["hand1", "hand2"], (2.0, 0.75))),
    "drawing": Kind(write_drawing, lambda folder: len(arenas.load("pitanks", str(folder / "drawn.toml")).walls), 11),
    "day log": Kind(
        lambda folder: DayLog(folder).add(PlayedMatch(datetime(2026, 11, 24, 12), "race", 61.5, 2, 1)),
        lambda folder: [*map(attrgetter("game", "seconds", "people"), read_day(folder, date(2026, 11, 24))[0])],
        [("race", 61.5, 2)],
    ),
    "restarts": Kind(
        lambda folder: append_restart(folder, Restart("2026-11-24T12:00:00+01:00", "crash", "", 61.0)),
        lambda folder: [(one.reason, one.seconds) for one in restarts(folder)],
        [("crash", 61.0)],
    ),
    "robots": Kind(
        lambda folder: (folder / "robots.toml").write_text(drivetrain.to_toml([drivetrain.NOMINAL])),
        lambda folder: store.load_robots(folder / "robots.toml")[0].left.speed,
        757.58,
    ),
    "calibration": Kind(
        lambda folder: store.save(GROUND, folder / "calibration.toml"),
        lambda folder: store.load(folder / "calibration.toml", "1: 1024 × 768", (1920, 1080)),
        GROUND,
    ),
    "things": Kind(
        lambda folder: store.save_things(ThingLayout((THING,)), folder / "things.toml"),
        lambda folder: store.load_things(folder / "things.toml"),
        ThingLayout((THING,)),
    ),
}


def main() -> int:
    """Write the files of a tag."""
    option, version = sys.argv[1:] or ("", "")
    if option != "--write":
        print(__doc__)
        return 2
    folder = FOLDER / version
    folder.mkdir(parents=True)
    for kind in KINDS.values():
        kind.write(folder)
    for path in [*folder.rglob("*.bak"), *folder.rglob(".*.lock")]:
        path.unlink()
    return 0


if __name__ == "__main__":
    sys.exit(main())
