"""Reading and parsing of untrusted files: capped size, regular files only, a short reason for every failure.

Whole numbers beyond 64 bits are parsed as infinities, so that every range check rejects them.
"""

import errno
import json
import os
import re
import stat
import tomllib
from math import inf
from pathlib import Path
from typing import Any

MAX_BYTES = 1_000_000  # default limit for a file
MAX_DEPTH = 32  # levels of tables and lists
QUOTE_LENGTH = 60  # characters of a value in a message
MESSAGE_LENGTH = 400  # characters of a whole message
_WHOLE = range(-(2**63), 2**63)
_DIGITS = 400  # whole numbers of so many digits overflow a float


class ParseError(ValueError):
    """A text cannot be parsed; the message is a short reason."""


def read(path: Path, limit: int = MAX_BYTES) -> bytes:
    """Read a regular file of at most `limit` bytes. Raises OSError, also for devices, pipes and larger files."""
    if not stat.S_ISREG(os.stat(path).st_mode):
        raise OSError(errno.EISDIR if path.is_dir() else errno.EINVAL, "it is not a file")
    with open(path, "rb", opener=_open_non_blocking) as file:
        opened = os.fstat(file.fileno())
        if not stat.S_ISREG(opened.st_mode):
            raise OSError(errno.EINVAL, "it is not a file")
        content = file.read(limit + 1) if opened.st_size <= limit else b""
    if max(len(content), opened.st_size) > limit:
        raise OSError(errno.EFBIG, f"it is larger than {limit:,} bytes")
    return content


def read_text(path: Path, limit: int = MAX_BYTES) -> str:
    """Read a UTF-8 file, without its byte order mark. Raises OSError or ParseError."""
    try:
        return read(path, limit).decode("utf-8-sig")  # Notepad writes a byte order mark
    except UnicodeDecodeError:
        raise ParseError("it is not text in UTF-8") from None


def parse_toml(text: str) -> dict[str, Any]:
    """Parse a TOML text. Raises ParseError."""
    if any(part.count(".") > 2 * MAX_DEPTH for part in re.split(r"[\n=,]", text)):
        raise ParseError(f"nested more than {MAX_DEPTH} deep")  # tomllib takes quadratic time for long dotted keys
    try:
        tables = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ParseError(one_line(str(error))) from None
    except ValueError:
        raise ParseError("a number has too many digits") from None
    except (RecursionError, MemoryError):
        raise ParseError(f"nested more than {MAX_DEPTH} deep") from None
    _bound([tables])
    return tables


def parse_json(text: str | bytes) -> Any:
    """Parse a JSON text. NaN and infinities are accepted. Raises ParseError."""
    try:
        value = json.loads(text, parse_int=_whole)
    except UnicodeDecodeError:
        raise ParseError("it is not text in UTF-8") from None
    except ValueError as error:
        raise ParseError(one_line(str(error))) from None
    except (RecursionError, MemoryError):
        raise ParseError(f"nested more than {MAX_DEPTH} deep") from None
    root = [value]
    _bound(root)
    return root[0]


def describe_error(error: Exception) -> str:
    """The reason why a file could not be read or written, as a phrase for a message."""
    if not isinstance(error, OSError):
        return one_line(str(error))
    match error.errno:
        case errno.ENOSPC | errno.EDQUOT:
            return "the disk is full"
        case errno.EROFS | errno.EACCES | errno.EPERM:
            return "no permission"
        case _:
            return one_line(error.strerror or str(error))


def name_of(path: Path) -> str:
    """The name of a file for a message, also of `.`, which has none."""
    return path.name or str(path)


def quote(value: object) -> str:
    """The literal of a value for a message: one line, shortened."""
    return one_line(repr(value), QUOTE_LENGTH)


def one_line(text: str, limit: int = MESSAGE_LENGTH) -> str:
    """A text on one line: control characters, line ends and invalid Unicode escaped, the middle of long texts cut."""
    if len(text) > limit:
        text = f"{text[: 2 * limit // 3]}…{text[-limit // 3 :]}"
    return "".join(char if char.isprintable() else ascii(char)[1:-1] for char in text)


def _open_non_blocking(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))  # opening a pipe without a writer would block


def _whole(digits: str) -> int | float:
    return int(digits) if len(digits) < _DIGITS else float(digits)


def _bound(tree: list[Any]) -> None:
    """Replace whole numbers beyond 64 bits by infinities. Raises ParseError if the tree is deeper than MAX_DEPTH."""
    level: list[Any] = [tree]
    for _ in range(MAX_DEPTH + 1):
        deeper: list[Any] = []
        for node in level:
            for key, value in list(node.items() if isinstance(node, dict) else enumerate(node)):
                if isinstance(value, dict | list):
                    deeper.append(value)
                elif isinstance(value, int) and value not in _WHOLE:
                    node[key] = inf if value > 0 else -inf
        level = deeper
    if level:
        raise ParseError(f"nested more than {MAX_DEPTH} deep")
