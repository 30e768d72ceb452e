"""The bots of this computer with their keys: `bots.json` in the folder of the settings. Several arcades may use it."""

import os
import re
import secrets
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.parsing import read_text
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.schema import from_json, to_json

FILE = "bots.json"
MOST = 32
PREFIX = "bot:"  # of a bot's name wherever an AI is named
LONGEST_NAME = 12
NAME = rf"[a-z0-9_-]{{1,{LONGEST_NAME}}}"
KEY_BYTES = 16
Name = Annotated[str, Meta(pattern=rf"^{NAME}\Z")]
Key = Annotated[str, Meta(pattern=rf"^[0-9a-f]{{{2 * KEY_BYTES}}}\Z")]


@dataclass(frozen=True)
class _Bots:
    """The file: a key by name."""

    keys: Annotated[dict[Name, Key], Meta(max_length=MOST)] = field(default_factory=dict)


class BotBook:
    """The bots in a folder."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / FILE
        self._read: tuple[tuple[int, int, int], Mapping[str, str]] | None = None  # the file's mark and content

    @property
    def keys(self) -> Mapping[str, str]:
        """The key of each bot, 32 hexadecimal digits, by name; none of a file that cannot be read."""
        try:
            status = os.stat(self.path)
            mark = status.st_mtime_ns, status.st_size, status.st_ino
            if self._read is None or self._read[0] != mark:
                self._read = mark, from_json(read_text(self.path), _Bots).keys
            return self._read[1]
        except (OSError, ValueError):
            return {}

    def add(self, name: str) -> str:
        """The key of a new bot, or a new one of a bot that exists. Raises ValueError or NotSaved."""
        if not re.fullmatch(NAME, name):
            raise ValueError(f"a name has 1 to {LONGEST_NAME} small letters, digits, - or _")
        with locked(self.path):
            self._require_readable()
            keys = {**self.keys, name: secrets.token_hex(KEY_BYTES)}
            if len(keys) > MOST:
                raise ValueError(f"there are {MOST} bots already")
            self._write(keys)
        return keys[name]

    def remove(self, name: str) -> None:
        """Raises ValueError without such a bot, or NotSaved."""
        with locked(self.path):
            self._require_readable()
            keys = dict(self.keys)
            if keys.pop(name, None) is None:
                raise ValueError(f"no bot {name}")
            self._write(keys)

    def _require_readable(self) -> None:
        """Raises ValueError for a file whose keys would be lost."""
        try:
            from_json(read_text(self.path), _Bots)
        except FileNotFoundError:
            return
        except (OSError, ValueError):
            raise ValueError(f"{self.path} cannot be read: mend it or delete it") from None

    def _write(self, keys: Mapping[str, str]) -> None:
        write_atomic(self.path, to_json(_Bots(dict(keys))).encode())
        if os.name != "nt":
            os.chmod(self.path, 0o600)
        self._read = None
