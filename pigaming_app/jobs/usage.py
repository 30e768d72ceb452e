"""What can be asked for on the command line, and how it is said when it is not understood: in one line."""

import argparse
from typing import NoReturn

from pigaming_app.jobs.calibrate import options as calibrate_options
from pigaming_app.jobs.options import MOST_WHOLE, path, real, whole, word

LONGEST_RUN = 3600  # s of a recording
JOBS = "play, replay, duel, league, train, bench, calibrate, robots, fidelity, doctor, test"


class Wrong(Exception):
    """Something asked for that cannot be done: one line, exit code 2."""


class Parser(argparse.ArgumentParser):
    """A parser that says one line, and no usage text, when it does not understand."""

    def error(self, message: str) -> NoReturn:
        """Say what was wrong and leave."""
        raise Wrong(message)


def parser() -> argparse.ArgumentParser:
    """Everything that can be asked for."""
    main = Parser(
        prog="main.py", description="PiGaming: a robot arcade. Without arguments: play.", epilog=f"Jobs: {JOBS}"
    )
    main.add_argument("--kiosk", action="store_true", help="nobody can leave the arcade")
    main.add_argument("--display", type=whole(high=64), help="which display, from 1 on")
    _mat_options(main)
    main.add_argument("--frames", type=whole(), help=argparse.SUPPRESS)
    jobs = main.add_subparsers(dest="job", metavar="JOB", parser_class=Parser)
    _play_options(jobs.add_parser("play", help="a match at once"))
    replay = jobs.add_parser("replay", help="watch a recorded match, or prove that it plays out the same")
    replay.add_argument("file", type=path)
    replay.add_argument("--verify", action="store_true", help="exit 1 where it plays out differently")
    duel = jobs.add_parser("duel", help="many matches of two brains")
    duel.add_argument("game")
    duel.add_argument("left")
    duel.add_argument("right")
    _duel_options(duel)
    league = jobs.add_parser("league", help="every brain against every other")
    league.add_argument("game")
    league.add_argument("brains", nargs="*", metavar="brain")
    _duel_options(league)
    _train_options(jobs.add_parser("train", help="a robot learns from nothing"))
    bench = jobs.add_parser("bench", help="how fast it all is here")
    bench.add_argument("game", nargs="?", default="pitanks", help="a game, or `robots`: the proof of the robot loop")
    bench.add_argument("--json", action="store_true")
    calibrate_options(jobs.add_parser("calibrate", help="bring picture, mat and camera together"))
    robots = jobs.add_parser("robots", help="which robots, radios and cameras are there, and how well")
    robots.add_argument("--pair", action="store_true", help="spin each robot in turn: who is who?")
    robots.add_argument("--latency", action="store_true", help="shake each robot: how late is it all?")
    _arena_options(robots)
    fidelity = jobs.add_parser("fidelity", help="measure real robots, and let the simulator know")
    fidelity.add_argument("what", choices=["record", "identify", "replay"])
    fidelity.add_argument("file", type=path, help="of the run (JSONL)")
    fidelity.add_argument("--seconds", type=whole(high=LONGEST_RUN), default=60, help="to record")
    fidelity.add_argument("--out", type=path, help="the file of the robots; left out: the arcade's own")
    fidelity.add_argument("--plots", type=path, metavar="FOLDER", help="draw how good it is (needs matplotlib)")
    fidelity.add_argument("--robots", type=path, metavar="FILE", help="the robots to replay with")
    _arena_options(fidelity)
    doctor = jobs.add_parser("doctor", help="what is there, what is missing, what to do")
    doctor.add_argument("--json", action="store_true")
    jobs.add_parser("test", help="lint, types, tests; --quick, --long, further words go to pytest")
    return main


def _arena_options(job: argparse.ArgumentParser) -> None:
    job.add_argument(
        "--emulate", type=whole(0), nargs="?", const=1, metavar="SEED", help="an emulated arena, no hardware"
    )
    job.add_argument("--camera", type=whole(0), help="its number, other than in the settings")
    job.add_argument("--port", type=word, help="of the radio, other than in the settings")
    job.add_argument("--json", action="store_true", help="print one JSON object")


def _train_options(train: argparse.ArgumentParser) -> None:
    train.add_argument("what", choices=["qlearning"])
    train.add_argument("--reward", type=whole(), default=1, choices=[1, 2], help="which of the two published ones")
    train.add_argument("--matches", type=whole(), default=200, help="of self-play, in all")
    train.add_argument("--minutes", type=real(0.0, 3600.0), default=2.0, help="of each match")
    train.add_argument("--seed", type=whole(-MOST_WHOLE), default=1)
    train.add_argument("--arena", default="classic")
    train.add_argument("--out", type=path, required=True, help="the file of the table (.npz)")
    train.add_argument("--resume", action="store_true", help="go on from the file that is there")
    train.add_argument("--set", action="append", default=[], metavar="NAME=NUMBER", help="a choice other than usual")
    train.add_argument("--curve", type=path, help="draw how it went (PNG; needs matplotlib)")
    train.add_argument("--csv", type=path, help="write how it went as numbers")
    train.add_argument("--plain", action="store_true", help="without numba: the same table, slower")
    train.add_argument("--json", action="store_true", help="print the result as one JSON object")


def _play_options(play: argparse.ArgumentParser) -> None:
    play.add_argument("--game", default="pitanks")
    play.add_argument("--seats", help="who sits where: human, off, or an AI; left out: human,normal")
    play.add_argument("--teams", help="a number for each seat, such as 0,0,1,1; left out: everybody for themselves")
    play.add_argument("--arena", help="a name, or the path of a .toml file; left out: the game's first")
    play.add_argument("--minutes", type=real(0.0, 3600.0))
    play.add_argument("--variant")
    _goals(play)
    play.add_argument("--seed", type=whole(-MOST_WHOLE), default=1)
    play.add_argument("--headless", action="store_true", help="no window, no sound")
    play.add_argument("--speed", default="1", help="how many times as fast, or max")
    play.add_argument("--record", type=path, help="write a replay")
    play.add_argument("--screenshot", type=path, help="save a picture (PNG)")
    play.add_argument("--at", type=real(0.0, 3600.0), default=5.0, help="after so many seconds of the match")
    play.add_argument("--robots", type=path, help="measured robots (see fidelity): simulated ones drive like them")
    play.add_argument("--real", help="seats with real robots, such as 1,3, or all")
    _mat_options(play)
    play.add_argument("--kiosk", action="store_true")
    play.add_argument("--display", type=whole(high=64))
    play.add_argument("--json", action="store_true", help="print the result as one JSON object")


def _mat_options(job: argparse.ArgumentParser) -> None:
    told = "real robots in an emulated arena; a second window shows what its camera sees"
    job.add_argument("--emulate", type=whole(0), nargs="?", const=1, metavar="SEED", help=told)
    job.add_argument("--camera", type=whole(0), metavar="NUMBER", help="over the mat; this and what follows is kept")
    job.add_argument("--port", type=word, help="of the radio; empty: the first there is")
    job.add_argument("--baud", type=whole(), help="of the radio")
    job.add_argument("--radio", metavar="MODE", help="api2, api1, transparent, or stock: a robot on a cable")


def _duel_options(job: argparse.ArgumentParser) -> None:
    job.add_argument("--matches", type=whole(), default=100, help="of each two brains")
    job.add_argument("--seed", type=whole(-MOST_WHOLE), default=1)
    job.add_argument("--minutes", type=real(0.0, 3600.0))
    job.add_argument("--arena", help="left out: the game's first")
    job.add_argument("--variant")
    _goals(job)
    job.add_argument("--json", action="store_true")


def _goals(job: argparse.ArgumentParser) -> None:
    for goal in ("laps", "pallets"):
        job.add_argument(f"--{goal}", type=whole(), help=f"how many {goal}, in the game that is played for them")
