"""Settings with which an arcade has run for a minute, kept beside the newest: a kiosk that crashes returns to them.

`tried/` in the configuration folder has the same files; `taken_back.json` in it names what was taken back, until the
operator has seen it.
"""

import contextlib
import json
import os
import time
from pathlib import Path

from pigaming_app.storage.parsing import parse_json, read_text
from pigaming_app.storage.plugins import consent
from pigaming_app.storage.plugins.found import found
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.safe_mode import DEFAULTS
from pigaming_app.storage.settings import FILE, Settings

MINUTE = 60.0  # s
TRIED = "tried"
FILES = (FILE, consent.FILE)
NOTE = "taken_back.json"
MAX_BYTES = 100_000

Contents = tuple[bytes | None, ...]  # of FILES; None: there is no such file


def contents(folder: Path) -> Contents:
    """The contents of the settings and of the decisions about plug-ins."""
    return tuple(_bytes(folder / name) for name in FILES)


def begin(config: Path) -> None:
    """Trust settings of before the first kiosk, unless they were changed within the last minute. Raises OSError."""
    file = config / FILE
    if not (config / TRIED / FILE).exists() and file.exists() and time.time() - file.stat().st_mtime > MINUTE:
        keep(config, contents(config))


def keep(config: Path, good: Contents) -> None:
    """Keep contents with which an arcade has run for a minute. Raises NotSaved."""
    for name, raw in zip(FILES, good, strict=True):
        if raw is not None and raw != _bytes(config / TRIED / name):
            write_atomic(config / TRIED / name, raw)


def take_back(config: Path) -> list[str]:
    """Take the changes since back; those of DEFAULTS if no arcade has ever run for a minute.

    Returns the names of the settings, and notes them for the operator. Raises OSError.
    """
    settings = Settings.load(config)[0]
    known = (config / TRIED / FILE).exists()
    names = settings.take_over(Settings.load(config / TRIED)[0], None if known else DEFAULTS)
    if names:
        settings.save(config)
    tried = _bytes(config / TRIED / consent.FILE)
    if known and _bytes(config / consent.FILE) not in (None, tried):
        write_atomic(config / consent.FILE, tried or b"{}\n")
        names.append("plugins")
    if names:
        write_atomic(config / TRIED / NOTE, json.dumps(sorted({*names, *taken_back(config)})).encode())
    return names


def taken_back(config: Path) -> list[str]:
    """Names of the settings that were taken back, of which the operator has not been told yet."""
    try:
        names = parse_json(read_text(config / TRIED / NOTE, MAX_BYTES))
    except (OSError, ValueError):
        return []
    return [name for name in names if isinstance(name, str)] if isinstance(names, list) else []


def forget(config: Path) -> None:
    """The operator has seen what was taken back."""
    with contextlib.suppress(OSError):
        (config / TRIED / NOTE).unlink()


def keep_defaults(config: Path, settings: Settings) -> None:
    """Save the defaults with which the arcade was started, also for the next start. Raises OSError."""
    settings.keep(DEFAULTS)
    settings.save(config)
    for plugin in found():
        if consent.is_on(plugin) and not plugin.own:
            consent.switch(plugin.key, False)


def _bytes(path: Path) -> bytes | None:
    with contextlib.suppress(OSError):
        if os.path.getsize(path) <= MAX_BYTES:
            return path.read_bytes()
    return None
