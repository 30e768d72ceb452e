"""Show a recorded match, or verify that it plays out the same."""

import sys
from dataclasses import dataclass
from pathlib import Path

from pigaming_app.games.replay import ReplayError
from pigaming_app.jobs.arcade import show
from pigaming_app.jobs.terminal.options import argument, flag, path
from pigaming_app.jobs.terminal.refusal import refused
from pigaming_app.scenes.files import load_replay


@dataclass(frozen=True, kw_only=True)
class ReplayOptions:
    """The replay, and what for."""

    file: Path = argument("replay", path, metavar="FILE")
    verify: bool = flag("no window; exit code 1 if it plays out differently")


def run(options: ReplayOptions) -> int:
    """Show or verify the replay; 1: it plays out differently. Raises Refusal."""
    with refused(ReplayError):
        replay = load_replay(options.file)
        if replay.other_engine:
            name = options.file.name
            print(f"{name}: recorded with another version of the engine; it may play out differently", file=sys.stderr)
        if options.verify:
            from pigaming_app.scenes.features.replays import verify

            same = verify(replay)
            print(f"{options.file.name}: plays out {'the same' if same else 'DIFFERENTLY'}")
            return 0 if same else 1
    from pigaming_app.scenes.launch import Options
    from pigaming_app.scenes.replays.watch import ReplayScene

    return show(Options(first_scene=lambda context: ReplayScene(context, replay), without_title=True))
