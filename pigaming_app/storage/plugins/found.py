"""The plug-ins that there are. Finding one runs none of its code.

A plug-in is a package whose parts are modules of fixed names; each is optional but the first:

    __init__    API = 1, GAME: Game               the number of the API that it was written for; rules
    ai          AI: GameAI                        brains and driving styles
    network     ENCODING: Encoding, SUBJECT       inputs and outputs of networks, and how the overlay shows them
    training    TASK: Task, TALLIES: Tallies      training by PPO and by learning libraries
    screens     SCREENS: GameScreens              views, tile, lessons
    driver      DRIVER: Driver                    robots that the arcade drives

and folders `arenas`, `text` (LANGUAGE.toml), `sounds`, `brains`. A driver may come alone: its `__init__` has no GAME.
"""

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from importlib.metadata import EntryPoint, entry_points
from importlib.util import find_spec
from pathlib import Path

from pigaming_app import INSTALLED, ROOT
from pigaming_app.storage.parsing import describe_error
from pigaming_app.storage.plugins import user
from pigaming_app.storage.settings import NoHome, folders

API = 1  # the version of `pigaming_app.api`: names and their meanings. A plug-in names the one it was written for
GROUPS = ("pigaming.games", "pigaming.drivers")  # of entry points, named after the games or drivers
DISTRIBUTION = "pigaming-app"  # of this program
PREFIX = "pigaming_"  # of packages beside this one, in a clone
NAME = re.compile(r"[a-z][a-z0-9_]{0,23}")  # of a game or a driver


@dataclass(frozen=True)
class Plugin:
    """A package with a game, or with a driver alone (`drives`). `name`: of either; `own`: it belongs to this program;
    `fault`: why it cannot be loaded; `origin`: the distribution that it was installed with.
    """

    name: str
    module: str
    folder: Path
    own: bool = False
    fault: str = ""
    origin: str = ""
    drives: bool = False

    @property
    def key(self) -> str:
        """The name under which a decision is stored: an installed package is not the user's one of the same name."""
        return f"{self.name}@{self.module}" if self.origin and not self.own else self.name


def found() -> tuple[Plugin, ...]:
    """All plug-ins: beside this package, in the user's folder, installed. Of two with one name the second is faulty."""
    every: list[Plugin] = []
    for plugin in (*_beside(), *_of_user(), *_installed()):
        first = next((other for other in every if other.name == plugin.name), None)
        if first is None:
            fault = plugin.fault or _api_fault(plugin.folder)
            every.append(replace(plugin, fault=fault, drives=_is_driver(plugin.folder)))
        elif first.module != plugin.module:
            every.append(replace(plugin, fault=f"there is one in {first.folder} already"))
    return tuple(every)


def user_folder() -> Path:
    """The folder of the user's games. Raises NoHome."""
    return folders().data / user.FOLDER


def _beside() -> Iterator[Plugin]:
    if not INSTALLED:
        for folder, _ in _packages(ROOT):
            name = folder.name.removeprefix(PREFIX)
            if folder.name.startswith(PREFIX) and name != "app" and NAME.fullmatch(name):
                yield Plugin(name, folder.name, folder, own=True)


def _of_user() -> Iterator[Plugin]:
    try:
        packages = _packages(user_folder())
    except NoHome:
        return
    for folder, fault in packages:
        if NAME.fullmatch(folder.name):
            yield Plugin(folder.name, f"{user.__name__}.{folder.name}", folder, fault=fault)


def _packages(place: Path) -> list[tuple[Path, str]]:
    """The packages in a folder, by name, and why one cannot be read."""
    packages = []
    try:
        for folder in sorted(place.iterdir()):
            try:
                with (folder / "__init__.py").open("rb"):
                    packages.append((folder, ""))
            except (FileNotFoundError, NotADirectoryError):
                pass
            except OSError as error:
                packages.append((folder, f"it cannot be read ({describe_error(error)})"))
    except OSError:
        return []
    return packages


def _installed() -> Iterator[Plugin]:
    every = [entry for group in GROUPS for entry in entry_points(group=group)]
    for entry in sorted(every, key=lambda entry: entry.name):
        if NAME.fullmatch(entry.name) and entry.dist is not None:
            folder = _folder_of(entry)
            fault = "" if folder else f"{entry.module} is no package"
            origin = f"{entry.dist.name} {entry.dist.version}"
            own = entry.dist.name == DISTRIBUTION
            yield Plugin(entry.name, entry.module, folder or Path(entry.module), own, fault, origin)


def _folder_of(entry: EntryPoint) -> Path | None:
    """The folder of an installed package; none of its parents is imported."""
    first, *others = entry.module.split(".")
    try:
        spec = find_spec(first)
    except (ImportError, ValueError):
        return None
    for place in (spec.submodule_search_locations or ()) if spec else ():
        folder = Path(place, *others)
        if (folder / "__init__.py").is_file():
            return folder
    return None


def _is_driver(folder: Path) -> bool:
    """Whether a package has a driver and no game. Read without running any of its code."""
    try:
        return (folder / "driver.py").is_file() and b"GAME" not in (folder / "__init__.py").read_bytes()
    except OSError:
        return False


def _api_fault(folder: Path) -> str:
    """Why the API that a package was written for is not this one, or nothing. Read without running any of its code."""
    try:
        body = ast.parse((folder / "__init__.py").read_bytes()).body
    except (OSError, SyntaxError, ValueError):
        return ""  # its import says more
    for statement in body:
        match statement:
            case ast.Assign(targets=[ast.Name(id="API")], value=ast.Constant(value=int(number))):
                return "" if number == API else f"it was written for API {number}, but this is API {API}"
    return f"__init__.py: API = {API} is missing, the number of the API that it was written for"
