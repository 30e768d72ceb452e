"""Show a recorded match, or verify that it plays out the same."""

import sys
from argparse import ArgumentParser, Namespace

from pigaming_app.games.replay import ReplayError
from pigaming_app.jobs.arcade import show
from pigaming_app.jobs.terminal.options import path
from pigaming_app.jobs.terminal.refusal import refused
from pigaming_app.scenes.files import load_replay


def options(parser: ArgumentParser) -> None:
    parser.add_argument("file", type=path, metavar="FILE", help="replay")
    parser.add_argument("--verify", action="store_true", help="no window; exit code 1 if it plays out differently")


def run(arguments: Namespace) -> int:
    """Show or verify the replay; 1: it plays out differently. Raises Refusal."""
    with refused(ReplayError):
        replay = load_replay(arguments.file)
        if replay.other_engine:
            name = arguments.file.name
            print(f"{name}: recorded with another version of the engine; it may play out differently", file=sys.stderr)
        if arguments.verify:
            from pigaming_app.scenes.features.replays import verify

            same = verify(replay)
            print(f"{arguments.file.name}: plays out {'the same' if same else 'DIFFERENTLY'}")
            return 0 if same else 1
    from pigaming_app.scenes.launch import Options
    from pigaming_app.scenes.play.replay import ReplayScene

    return show(Options(first_scene=lambda context: ReplayScene(context, replay), without_title=True))
