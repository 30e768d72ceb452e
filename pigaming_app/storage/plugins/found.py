"""The plug-ins that there are. Finding one runs none of its code.

A plug-in is a package whose parts are modules of fixed names; each is optional but the first:

    __init__    GAME: Game                        rules
    ai          AI: GameAI                        brains and driving styles
    network     ENCODING: Encoding, SUBJECT       inputs and outputs of networks, and how the overlay shows them
    training    TASK: Task, TALLIES: Tallies      training by PPO and by learning libraries
    screens     SCREENS: GameScreens              views, tile, lessons

and folders `arenas`, `text` (LANGUAGE.toml), `sounds`, `brains`.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import entry_points
from importlib.util import find_spec
from pathlib import Path

from pigaming_app import INSTALLED, ROOT
from pigaming_app.storage.plugins import user
from pigaming_app.storage.settings import NoHome, folders

GROUP = "pigaming.games"  # of entry points, named after the games
DISTRIBUTION = "pigaming-app"  # of this program
PREFIX = "pigaming_"  # of packages beside this one, in a clone
NAME = re.compile(r"[a-z][a-z0-9_]{0,23}")  # of a game


@dataclass(frozen=True)
class Plugin:
    """A package with a game. `name`: of the game; `own`: it belongs to this program."""

    name: str
    module: str
    folder: Path
    own: bool = False


def found() -> tuple[Plugin, ...]:
    """All plug-ins: beside this package, in the user's folder, installed; each game once."""
    every: dict[str, Plugin] = {}
    for plugin in (*_beside(), *_of_user(), *_installed()):
        every.setdefault(plugin.name, plugin)
    return tuple(every.values())


def user_folder() -> Path:
    """The folder of the user's games. Raises NoHome."""
    return folders().data / user.FOLDER


def _beside() -> Iterator[Plugin]:
    if not INSTALLED:
        for folder in _packages(ROOT):
            name = folder.name.removeprefix(PREFIX)
            if folder.name.startswith(PREFIX) and name != "app" and NAME.fullmatch(name):
                yield Plugin(name, folder.name, folder, own=True)


def _of_user() -> Iterator[Plugin]:
    try:
        folders_of_user = _packages(user_folder())
    except NoHome:
        return
    for folder in folders_of_user:
        if NAME.fullmatch(folder.name):
            yield Plugin(folder.name, f"{user.__name__}.{folder.name}", folder)


def _packages(place: Path) -> list[Path]:
    """The packages in a folder, by name."""
    try:
        return sorted(path.parent for path in place.glob("*/__init__.py"))
    except OSError:
        return []


def _installed() -> Iterator[Plugin]:
    for entry in sorted(entry_points(group=GROUP), key=lambda entry: entry.name):
        try:
            spec = find_spec(entry.module)
        except (ImportError, ValueError):
            continue
        if spec and spec.origin and NAME.fullmatch(entry.name):
            own = entry.dist is not None and entry.dist.name == DISTRIBUTION
            yield Plugin(entry.name, entry.module, Path(spec.origin).parent, own)
