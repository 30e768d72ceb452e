"""Loading of plug-ins, part by part, so that no room imports a part of a higher one. One failure ends a plug-in.

Switching a plug-in on or off counts from the next start on: kernels and hashes are made of what was loaded first.
"""

import sys
import traceback
from collections.abc import Callable, Iterator
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TypeVar

from pigaming_app.storage.parsing import one_line
from pigaming_app.storage.plugins.consent import is_on
from pigaming_app.storage.plugins.found import Plugin, found

T = TypeVar("T")
RULES = ""  # the part in `__init__`
ABOVE = ("ai", "network", "training", "screens")  # parts that do not determine how a match plays out

_failed: dict[str, str] = {}  # sentences by name


@cache
def plugins() -> tuple[Plugin, ...]:
    """The plug-ins that may run, as they were when this was first called."""
    return tuple(plugin for plugin in found() if is_on(plugin))


def failures() -> tuple[str, ...]:
    """One sentence for each plug-in that has failed so far: name, file, line, reason."""
    return tuple(_failed.values())


def parts(part: str, attribute: str, kind: type[T], fits: Callable[[str, T], str] | None = None) -> dict[str, T]:
    """An attribute of a part of every plug-in that has it, by name of the game.

    `fits(name, object)`: the reason why it is unusable, or "". Plug-ins that fail are left out here and from then on.
    """
    found: dict[str, T] = {}
    for plugin in plugins():
        if plugin.name not in _failed and (value := _loaded(plugin, part, attribute)) is not None:
            if not isinstance(value, kind):
                leave_out(plugin.name, f"{attribute} is no {kind.__name__}")
            elif reason := fits(plugin.name, value) if fits else "":
                leave_out(plugin.name, reason)
            else:
                found[plugin.name] = value
    return found


def data_folders(kind: str) -> Iterator[tuple[str, Path]]:
    """Name and folder of each plug-in that has not failed; `kind`: arenas, text, sounds, brains. It may be missing."""
    for plugin in plugins():
        if plugin.name not in _failed:
            yield plugin.name, plugin.folder / kind


def leave_out(name: str, reason: str) -> None:
    """End a plug-in from here on, with the reason."""
    plugin = next(plugin for plugin in plugins() if plugin.name == name)
    sentence = one_line(f"The game {plugin.name} in {plugin.folder} is left out: {reason}.")
    _failed[plugin.name] = sentence
    print(f"PiGaming: {sentence}", file=sys.stderr)


def rule_sources(name: str) -> tuple[Path, ...]:
    """The source files that determine how a match of a plug-in's game plays out; none for a game of this package."""
    return tuple(
        path
        for plugin in plugins()
        if plugin.name == name
        for path in sorted(plugin.folder.rglob("*.py"))
        if path.relative_to(plugin.folder).parts[0].removesuffix(".py") not in ABOVE
    )


def _loaded(plugin: Plugin, part: str, attribute: str) -> object:
    """The attribute; None if the plug-in has no such part, or if loading it fails."""
    name = f"{plugin.module}.{part}" if part else plugin.module
    try:
        if part and find_spec(name) is None:
            return None
        module = import_module(name)
    except (Exception, SystemExit) as error:
        leave_out(plugin.name, f"{_place(plugin, error)}{type(error).__name__}: {error}")
        return None
    if not hasattr(module, attribute) and part == RULES:
        leave_out(plugin.name, f"{Path(module.__file__ or name).name}: {attribute} is missing")
    return getattr(module, attribute, None)


def _place(plugin: Plugin, error: BaseException) -> str:
    """File and line within the plug-in where an error arose."""
    if isinstance(error, SyntaxError) and error.filename:
        return f"{Path(error.filename).name}, line {error.lineno}: "
    frames = [
        frame for frame in traceback.extract_tb(error.__traceback__) if plugin.folder in Path(frame.filename).parents
    ]
    return f"{Path(frames[-1].filename).relative_to(plugin.folder)}, line {frames[-1].lineno}: " if frames else ""
