"""Loading of plug-ins, part by part, so that no room imports a part of a higher one. One failure ends a plug-in.

Switching a plug-in on or off counts from the next start on: kernels and hashes are made of what was loaded first.
"""

import re
import sys
import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, nullcontext, redirect_stdout
from functools import cache, cached_property
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from threading import current_thread, main_thread
from types import FrameType
from typing import TypeVar

from pigaming_app.storage.parsing import one_line
from pigaming_app.storage.plugins import trial
from pigaming_app.storage.plugins.consent import is_on
from pigaming_app.storage.plugins.endless import overseer
from pigaming_app.storage.plugins.found import Plugin, found
from pigaming_app.storage.plugins.time_limit import TookTooLong, time_limit
from pigaming_app.storage.safe_mode import is_safe

T = TypeVar("T")
RULES, SCREENS, EDITOR, DRIVER = "", "screens", "editor", "driver"  # parts; the rules are in `__init__`
ABOVE = (
    "ai",
    "network",
    "training",
    "exploits",
    SCREENS,
    EDITOR,
    DRIVER,
)  # parts that do not determine how a match plays out

LOADING = 20.0  # s, for one part

_failed: dict[Plugin, str] = {}  # sentences
_stopped: set[str] = set()  # names of games that failed while they played: their parts stay


@cache
def plugins() -> tuple[Plugin, ...]:
    """The plug-ins that may run, as they were when this was first called; in safe mode only those of this program."""
    if trial.is_trial():
        return ()
    usable: list[Plugin] = []
    for plugin in found():
        if plugin.own if is_safe() else is_on(plugin):
            if reason := plugin.fault or ("" if plugin.own else trial.fault(plugin, (RULES, *ABOVE), LOADING)):
                _leave_out(plugin, reason)
            else:
                usable.append(plugin)
    overseer.oversee(plugin for plugin in usable if not plugin.own)
    return tuple(usable)


@cache
def undecided() -> tuple[Plugin, ...]:
    """The plug-ins that nobody had decided about when this was first called."""
    return tuple(plugin for plugin in found() if is_on(plugin) is None and not plugin.fault)


def failures() -> tuple[str, ...]:
    """One sentence for each plug-in that has failed so far: name, file, line, reason."""
    return tuple(_failed.values())


def failure(plugin: Plugin) -> str:
    """The sentence of a plug-in that has failed so far, else nothing."""
    return _failed.get(plugin, "")


def has_failed(name: str) -> bool:
    """Whether a plug-in with this game has failed, and no other one plays it."""
    named = [plugin for plugin in (*plugins(), *_failed) if plugin.name == name]
    return bool(named) and all(plugin in _failed for plugin in named)


def stopped() -> set[str]:
    """The names of the games that failed while they played."""
    return _stopped


def parts(part: str, attribute: str, kind: type[T], fits: Callable[[str, T], str] | None = None) -> dict[str, T]:
    """An attribute of a part of every plug-in that has it, by name of the game.

    `fits(name, object)`: the reason why it is unusable, or "". Plug-ins that fail are left out here and from then on.
    """
    found, before = dict[str, T](), {*_failed}
    for plugin in plugins():
        if plugin.drives and part not in (DRIVER, RULES):
            continue
        if plugin not in _failed and (value := _loaded(plugin, part, attribute)) is not None:
            if not isinstance(value, kind):
                _leave_out(plugin, f"{attribute} is no {kind.__name__}")
            elif reason := fits(plugin.name, value) if fits else "":
                _leave_out(plugin, reason)
            else:
                found[plugin.name] = value
    if part == EDITOR:  # loaded while the game is on the screen: its texts and arenas stay
        _stopped.update(plugin.name for plugin in {*_failed} - before)
    return found


class Registry(Mapping[str, T]):
    """Parts of all games by name: `ours`, then an attribute of each plug-in's `part`, as `parts` has them.

    Plug-ins are loaded at the first look, since they import rooms that may themselves import the registry.
    """

    def __init__(
        self,
        ours: Mapping[str, T],
        part: str,
        attribute: str,
        kind: type[T],
        fits: Callable[[str, T], str] | None = None,
    ) -> None:
        self._ours, self._source = ours, (part, attribute, kind, fits)

    @cached_property
    def _all(self) -> dict[str, T]:
        return {**self._ours, **parts(*self._source)}

    def __getitem__(self, game: str) -> T:
        return self._all[game]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)


def data_folders(kind: str) -> Iterator[tuple[str, Path]]:
    """Name and folder of each plug-in that has not failed; `kind`: arenas, text, sounds, brains. It may be missing."""
    for plugin in plugins():
        if plugin not in _failed or plugin.name in _stopped:
            yield plugin.name, plugin.folder / kind


def hidden() -> set[str]:
    """The names of the plug-ins that no screen shows: they have failed so far, or have no screens."""
    return {plugin.name for plugin in _failed} | _headless()


@cache
def _headless() -> set[str]:
    loaded = [plugin for plugin in plugins() if plugin not in _failed]
    return {plugin.name for plugin in loaded if not find_spec(f"{plugin.module}.{SCREENS}")}


def leave_out(name: str, reason: str) -> None:
    """End a plug-in from here on, with the reason."""
    _leave_out(next(plugin for plugin in plugins() if plugin.name == name), reason)


def blame(error: BaseException) -> Plugin | None:
    """The plug-in in whose code an error arose while it played, which is left out from here on; None: elsewhere."""
    for plugin in plugins():
        if isinstance(error, KeyboardInterrupt) and not _is_raised_by(plugin, error):
            continue
        remote = "\n".join(reversed(str(error.__cause__ or "").splitlines()))  # a traceback in another process
        if place := _place(plugin, error) or _place_in_text(plugin, str(error)) or _place_in_text(plugin, remote):
            return stop(plugin, f"{place}{_named(error)}")
    return None


def stop(plugin: Plugin, reason: str) -> Plugin:
    """Leave out a plug-in that failed while it played, with the reason. Returns it."""
    if plugin not in _failed:
        _stopped.add(plugin.name)
        _leave_out(plugin, reason)
    return plugin


def is_running(frame: FrameType) -> bool:
    """Whether the code of a plug-in is among the callers of a frame, or the frame itself."""
    files = {Path(caller.f_code.co_filename) for caller, _ in traceback.walk_stack(frame)}
    return any(plugin.folder in file.parents for plugin in plugins() for file in files)


def rule_sources(name: str) -> tuple[Path, ...]:
    """The source files that determine how a match of a plug-in's game plays out; none for a game of this package."""
    return tuple(path for plugin in plugins() if plugin.name == name for path in _sources(plugin, ABOVE))


def kernel_sources(plugin: Plugin) -> tuple[Path, ...]:
    """The source files of a plug-in with kernels: all but what belongs to the screen."""
    return tuple(_sources(plugin, (SCREENS, EDITOR)))


def _sources(plugin: Plugin, without: tuple[str, ...]) -> Iterator[Path]:
    """The source files of a plug-in without some parts."""
    for path in sorted(plugin.folder.rglob("*.py")):
        if path.relative_to(plugin.folder).parts[0].removesuffix(".py") not in without:
            yield path


def _loaded(plugin: Plugin, part: str, attribute: str) -> object:
    """The attribute; None if the plug-in has no such part, or if loading it fails."""
    name = f"{plugin.module}.{part}" if part else plugin.module
    try:
        with time_limit(LOADING), _prints_aside():
            if part and find_spec(name) is None:  # this imports the package
                return None
            module = import_module(name)
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt) and not _is_raised_by(plugin, error):
            raise
        _leave_out(plugin, f"{_place(plugin, error)}{_named(error)}")
        return None
    if not hasattr(module, attribute) and part == RULES and not plugin.drives:
        _leave_out(plugin, f"{Path(module.__file__ or name).name}: {attribute} is missing")
    return getattr(module, attribute, None)


def _prints_aside() -> AbstractContextManager[object]:
    """Prints go to standard error, as the output may be data; in one thread only, since the stream is global."""
    return redirect_stdout(sys.stderr) if current_thread() is main_thread() else nullcontext()


def _leave_out(plugin: Plugin, reason: str) -> None:
    kind = "driver" if plugin.drives else "game"
    sentence = one_line(f"The {kind} {plugin.name} in {plugin.folder} is left out: {reason.rstrip('.')}.")
    _failed[plugin] = sentence
    print(f"PiGaming: {sentence}", file=sys.stderr)


def _named(error: BaseException) -> str:
    """An error in one line."""
    if isinstance(error, TookTooLong):
        return str(error)
    return f"{type(error).__name__}: {' '.join(str(error).split())}".rstrip(": ")


def _is_raised_by(plugin: Plugin, error: BaseException) -> bool:
    """Whether the code of a plug-in itself raised an error, and not somebody who interrupted it."""
    frames = traceback.extract_tb(error.__traceback__)
    return bool(frames) and plugin.folder in Path(frames[-1].filename).parents


def _place_in_text(plugin: Plugin, message: str) -> str:
    """File and line within the plug-in that a text names first."""
    for file, line in re.findall(r'File "([^"]+)", line (\d+)', message):
        path = Path(file).resolve()
        if path.is_relative_to(plugin.folder.resolve()):
            return f"{path.relative_to(plugin.folder.resolve())}, line {line}: "
    return ""


def _place(plugin: Plugin, error: BaseException) -> str:
    """File and line within the plug-in where an error arose."""
    if isinstance(error, SyntaxError) and error.filename:
        return f"{Path(error.filename).name}, line {error.lineno}: "
    frames = [
        frame for frame in traceback.extract_tb(error.__traceback__) if plugin.folder in Path(frame.filename).parents
    ]
    return f"{Path(frames[-1].filename).relative_to(plugin.folder)}, line {frames[-1].lineno}: " if frames else ""
