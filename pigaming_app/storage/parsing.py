"""Reading files that anybody may have edited: capped size, regular files only, and one short reason for every failure.

Whole numbers beyond 64 bits come back as an infinity, so that every range check refuses them.
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

MAX_BYTES = 1_000_000  # bytes of a file, where nothing else is given
MAX_DEPTH = 32  # levels of tables and lists
QUOTE_LENGTH = 60  # characters of a value in a message
MESSAGE_LENGTH = 400  # characters of a whole message
_WHOLE = range(-(2**63), 2**63)
_DIGITS = 400  # from here on a whole number is infinite as a float, too


class ParseError(ValueError):
    """A text that cannot be parsed; the message is a short reason."""


def read(path: Path, limit: int = MAX_BYTES) -> bytes:
    """The content of a regular file of at most `limit` bytes; devices and pipes are refused. Raises OSError."""
    if not stat.S_ISREG(os.stat(path).st_mode):
        raise OSError(errno.EISDIR if path.is_dir() else errno.EINVAL, "it is not a file")
    with open(path, "rb", opener=_without_waiting) as file:
        opened = os.fstat(file.fileno())
        if not stat.S_ISREG(opened.st_mode):
            raise OSError(errno.EINVAL, "it is not a file")
        content = file.read(limit + 1) if opened.st_size <= limit else b""
    if max(len(content), opened.st_size) > limit:
        raise OSError(errno.EFBIG, f"it is larger than {limit:,} bytes")
    return content


def read_text(path: Path, limit: int = MAX_BYTES) -> str:
    """The text of a UTF-8 file, without a byte order mark. Raises OSError or ParseError."""
    try:
        return read(path, limit).decode("utf-8-sig")  # Notepad writes the mark
    except UnicodeDecodeError:
        raise ParseError("it is not text in UTF-8") from None


def parse_toml(text: str) -> dict[str, Any]:
    """The tables of a TOML text. Raises ParseError."""
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
    """The value of a JSON text. NaN and infinities are accepted. Raises ParseError."""
    try:
        value = json.loads(text, parse_int=_whole)
    except UnicodeDecodeError:
        raise ParseError("it is not text in UTF-8") from None
    except ValueError as error:
        raise ParseError(one_line(str(error))) from None
    except (RecursionError, MemoryError):
        raise ParseError(f"nested more than {MAX_DEPTH} deep") from None
    whole = [value]
    _bound(whole)
    return whole[0]


def describe_error(error: Exception) -> str:
    """Why a file could not be read or written, to follow a colon or stand in brackets."""
    if not isinstance(error, OSError):
        return one_line(str(error))
    match error.errno:
        case errno.ENOSPC | errno.EDQUOT:
            return "the disk is full"
        case errno.EROFS | errno.EACCES | errno.EPERM:
            return "no permission"
        case _:
            return one_line(error.strerror or str(error))


def quote(value: object) -> str:
    """A value as a message quotes it: one line, not too long."""
    return one_line(repr(value), QUOTE_LENGTH)


def one_line(text: str, most: int = MESSAGE_LENGTH) -> str:
    """Text on one line: control characters, line ends and broken Unicode are escaped, a long middle is left out."""
    if len(text) > most:
        text = f"{text[: 2 * most // 3]}…{text[-most // 3 :]}"
    return "".join(one if one.isprintable() else ascii(one)[1:-1] for one in text)


def _without_waiting(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))  # a pipe has no writer perhaps


def _whole(digits: str) -> int | float:
    return int(digits) if len(digits) < _DIGITS else float(digits)


def _bound(tree: list[Any]) -> None:
    """Make whole numbers beyond 64 bits infinite. Raises ParseError for a tree that is too deep."""
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
