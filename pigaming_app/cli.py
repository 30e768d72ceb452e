"""The command line: one job a subcommand. What is wrong is said in one line on standard error, with exit code 2."""

import argparse
import json
import os
import sys
from dataclasses import asdict
from typing import Any

from pigaming_app.jobs import console as streams
from pigaming_app.jobs.usage import Wrong, parser
from pigaming_app.storage.parsing import one_line, reason

OF_ROBOTS = ("robots", "calibrate", "fidelity")
FOLDERS = ("ghosts", "pictures", "robots")  # of files, in that for data


def main(argv: list[str]) -> int:
    """Do what the arguments say; the exit code."""
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")  # standard output belongs to the job
    streams.prepare()
    try:
        code = _refused_in_one_line(argv)
    except SystemExit as end:  # argparse, after --help
        code = int(end.code or 0)
    except BrokenPipeError:
        code = 1
    except KeyboardInterrupt:
        code = 130
    return streams.flushed(code)


def _refused_in_one_line(argv: list[str]) -> int:
    """Do what the arguments say; the exit code, 2 after a line on standard error."""
    from pigaming_app.ai.qlearning.table_files import TableError
    from pigaming_app.games.replay import ReplayError
    from pigaming_app.games.setup import ChoiceError
    from pigaming_app.sim.arena import ArenaError

    try:
        return _do(argv)
    except BrokenPipeError:
        raise
    except (Wrong, ChoiceError, ArenaError, ReplayError, TableError) as wrong:
        refusal = str(wrong)
    except OSError as trouble:  # NotSaved, or a full standard output
        refusal = str(trouble) if trouble.strerror is None else _named(trouble)
    streams.say(refusal)
    if argv and argv[0] in OF_ROBOTS:
        from pigaming_app.storage.log import note
        from pigaming_app.storage.settings import folders

        note(folders().data, one_line(refusal))
    return 2


def _do(argv: list[str]) -> int:
    if argv and argv[0] == "test":
        from pigaming_app.jobs.checks import run as check

        return check(argv[1:])
    arguments = parser().parse_args(argv)
    if arguments.job != "doctor":  # which changes nothing
        _sweep()
    return int(JOB[arguments.job or "arcade"](arguments))


def _sweep() -> None:
    """Delete what a process that was killed left among the user's files."""
    from pigaming_app.storage.safe_files import sweep
    from pigaming_app.storage.settings import folders

    where = folders()
    sweep(where.config, where.data, *(where.data / folder for folder in FOLDERS))


def _named(trouble: OSError) -> str:
    return f"{trouble.filename or 'the output cannot be written'}: {reason(trouble)}"


def mat_settings(arguments: argparse.Namespace) -> dict[str, Any]:
    """The settings of camera and radio that were given. Raises Wrong for a value that does not fit."""
    from pigaming_app.storage.settings import Settings

    given = {name: getattr(arguments, name, None) for name in ("camera", "port", "baud", "radio")}
    given = {name: value for name, value in given.items() if value is not None}
    for name, value in given.items():
        try:
            Settings().choose(name, value)
        except ValueError as wrong:
            raise Wrong(f"--{wrong}") from None
    return given


def goal(arguments: argparse.Namespace) -> int | None:
    """The goal that was asked for; None: the game's own. Raises Wrong for the goal of another game."""
    from pigaming_app.games import GAMES

    for word in ("laps", "pallets"):
        wished: int | None = getattr(arguments, word)
        if wished is not None:
            if arguments.game in GAMES and GAMES[arguments.game].goal != word:
                raise Wrong(f"--{word}: {arguments.game} is not played for {word}")
            return wished
    return None


def arcade(arguments: argparse.Namespace) -> int:
    """The arcade itself."""
    from pigaming_app.scenes.app import Options

    display, chosen = _display(arguments), mat_settings(arguments)
    frames, emulate = arguments.frames, arguments.emulate
    return _open(Options(kiosk=arguments.kiosk, display=display, frames=frames, emulate=emulate, chosen=chosen))


def play(arguments: argparse.Namespace) -> int:
    """A match at once, on the screen or without one."""
    from pigaming_app.jobs import play as playing

    return playing.play(arguments, goal(arguments), mat_settings(arguments), _open, Wrong)


def replay(arguments: argparse.Namespace) -> int:
    """Watch a replay, or prove it."""
    from pigaming_app.games import replay as replays

    found = replays.load(arguments.file)
    if arguments.verify:
        same = replays.verify(found)
        print(f"{arguments.file.name}: plays out {'the same' if same else 'DIFFERENTLY'}")
        return 0 if same else 1
    from pigaming_app.scenes.app import Options
    from pigaming_app.scenes.play.replay import ReplayScene

    return _open(Options(first=lambda context: ReplayScene(context, found), alone=True))


def duel(arguments: argparse.Namespace) -> int:
    """Many matches of two brains."""
    from pigaming_app.ai import BRAINS
    from pigaming_app.ai.experiments import league
    from pigaming_app.games import GAMES
    from pigaming_app.games.setup import one_of

    one_of("game", arguments.game, list(GAMES))
    for brain in (arguments.left, arguments.right):
        one_of("brain", brain, list(BRAINS[arguments.game]))
    result = league.duel(
        arguments.game,
        arguments.left,
        arguments.right,
        arguments.matches,
        arguments.seed,
        arguments.minutes,
        arguments.arena,
        arguments.variant,
        goal=goal(arguments),
    )
    if arguments.json:
        print(json.dumps(asdict(result)))
        return 0
    low, high = result.wilson95
    print(f"{'':10}{'wins':>7}{'ties':>7}{'losses':>7}{'mean score':>12}")
    print(f"{result.left:10}{result.wins:7}{result.ties:7}{result.losses:7}{result.mean_score_left:12.2f}")
    print(f"{result.right:10}{result.losses:7}{result.ties:7}{result.wins:7}{result.mean_score_right:12.2f}")
    print(f"{result.left} wins {100 * result.wins / result.matches:.1f} % of {result.matches} matches", end=" ")
    print(f"(Wilson 95 %: {100 * low:.1f} to {100 * high:.1f} %), {result.ticks_per_second:,.0f} ticks/s")
    return 0


def league(arguments: argparse.Namespace) -> int:
    """Every brain against every other."""
    from pigaming_app.jobs import league as ranking

    return ranking.rank(arguments, goal(arguments))


def train(arguments: argparse.Namespace) -> int:
    """A robot learns from nothing."""
    from pigaming_app.jobs import train as trains

    return trains.train(arguments)


def bench(arguments: argparse.Namespace) -> int:
    """How fast it all is here."""
    from pigaming_app.games import GAMES
    from pigaming_app.games.setup import one_of
    from pigaming_app.jobs.bench import job as benches

    if arguments.game == "robots":
        figures = _bench_robots()
    else:
        one_of("game", arguments.game, [*GAMES, "robots"])
        figures = benches.measure(arguments.game)
    if arguments.json:
        print(json.dumps(figures))
    else:
        _print_figures(figures)
    return 0


def _print_figures(figures: dict[str, Any], indent: str = "") -> None:
    """A line for each figure; those that belong together are indented below their name."""
    for key, value in figures.items():
        if isinstance(value, dict):
            print(indent + key)
            _print_figures(value, indent + "  ")
        else:
            print(f"{indent + key:40} {value if not isinstance(value, float) else f'{value:,.3f}'}")


def _bench_robots() -> dict[str, Any]:
    """The proof of the robot loop; says on the way what it found, on standard error."""
    from pigaming_app.hardware.vision.markers import NoVision, opencv
    from pigaming_app.jobs.bench.robots import Unproven, measure, reached

    def note(line: str) -> None:
        print(line, file=sys.stderr, flush=True)

    try:
        opencv()
        figures = measure(note)
    except (NoVision, Unproven) as reason:
        raise Wrong(str(reason)) from None
    missed = [key for key, good in reached(figures).items() if not good]
    note(f"not reached: {', '.join(missed)}" if missed else "everything is reached")
    return figures


def calibrate(arguments: argparse.Namespace) -> int:
    """Bring picture, mat and camera together."""
    from pigaming_app.jobs.calibrate import NotCalibrated, run

    mat_settings(arguments)
    try:
        return run(arguments, _open)
    except NotCalibrated as trouble:
        raise Wrong(str(trouble)) from None


def robots(arguments: argparse.Namespace) -> int:
    """What is there of real robots."""
    from pigaming_app.jobs.robots import NotThere, run

    mat_settings(arguments)
    try:
        return run(arguments)
    except NotThere as missing:
        raise Wrong(str(missing)) from None


def fidelity(arguments: argparse.Namespace) -> int:
    """Record real robots, identify them, replay a run."""
    from pigaming_app.jobs.fidelity import NotDone, run

    mat_settings(arguments)
    try:
        return run(arguments)
    except NotDone as trouble:
        raise Wrong(str(trouble)) from None


def doctor(arguments: argparse.Namespace) -> int:
    """What is there and what is missing."""
    from pigaming_app.jobs.doctor import run

    return run(arguments.json)


def _display(arguments: argparse.Namespace) -> int | None:
    return None if arguments.display is None else arguments.display - 1


def _open(options: Any) -> int:
    """Run the arcade; without a display, say so."""
    from pigaming_app.scenes.app import run
    from pigaming_app.ui.window import NoDisplay

    try:
        return run(options)
    except NoDisplay as missing:
        raise Wrong(str(missing)) from None


JOB = {
    "arcade": arcade,
    "play": play,
    "replay": replay,
    "duel": duel,
    "league": league,
    "train": train,
    "bench": bench,
    "calibrate": calibrate,
    "robots": robots,
    "fidelity": fidelity,
    "doctor": doctor,
}
