"""Validated access to untrusted TOML: every table carries its path in the file, so that errors name the full key.

`FieldError` has the key and the reason; the caller adds the name of the file.
"""

import re
import reprlib
import tomllib
from collections.abc import Mapping, Sequence
from typing import Any

from pigaming_app.sim.world import HEIGHT, WIDTH

MAX_DOTS = 64  # in a key: tomllib takes quadratic time for long dotted keys
MAX_TEXT = 200  # characters of a text in a message

_QUOTE = reprlib.Repr()
_QUOTE.maxstring = MAX_TEXT


def printable(text: str) -> str:
    """A text for one line of a message: unchanged, or a shortened literal if it is long or has control characters."""
    return text if text.isprintable() and len(text) <= MAX_TEXT else _QUOTE.repr(text)


def quote(value: object) -> str:
    """The literal of a value for a message: one line, shortened."""
    try:
        return reprlib.repr(value)
    except ValueError:  # Python does not print whole numbers of more than 4300 digits
        return "a number with too many digits"


class FieldError(Exception):
    """An entry of a file is invalid: the key, such as `wall[2].thick`, and the reason.

    `place`: where in the arena, x, y and extent in px, if the key alone does not tell. `flaw`: the kind of something
    bad in an arena that can be played all the same; it is shown, and not raised.
    """

    def __init__(self, key: str, reason: str, place: tuple[float, float, float] | None = None, flaw: str = "") -> None:
        self.key, self.reason, self.place, self.flaw = printable(key), reason, place, flaw
        super().__init__(f"{self.key}: {reason}")


class TomlTable:
    """A table of a file; `path`: prefix of its keys, such as `wall[2].`, empty for the whole file."""

    def __init__(self, entries: Mapping[str, Any], path: str = "") -> None:
        self.entries, self.path = entries, path

    @classmethod
    def parse(cls, text: str) -> "TomlTable":
        """Parse a whole TOML text. Raises FieldError with the key `syntax`."""
        if any(part.count(".") > MAX_DOTS for part in re.split(r"[\n=,]", text)):
            raise FieldError("syntax", "nested too deep")
        try:
            return cls(tomllib.loads(text))
        except ValueError as error:
            raise FieldError("syntax", printable(str(error))) from None
        except (RecursionError, MemoryError):
            raise FieldError("syntax", "nested too deep") from None

    def __contains__(self, key: str) -> bool:
        return key in self.entries

    def only(self, *known: str) -> None:
        """Raises FieldError if the table has any other key."""
        for key in self.entries:
            if key not in known:
                raise FieldError(self.path + key, f"unknown key; possible are {', '.join(known)}")

    def error(self, key: str, reason: str) -> FieldError:
        """An error for a key of this table, with its full path."""
        return FieldError(self.path + key, reason)

    def number(
        self, key: str, default: float | None = None, low: float = -1e6, high: float = 1e6, unit: str = ""
    ) -> float:
        """A number from `low` to `high`. Raises FieldError."""
        value = self.entries.get(key, default)
        if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < 1e6:
            raise self.error(key, f"{quote(value)} is not a number between -1e6 and 1e6")
        if not low <= value <= high:
            raise self.error(key, f"{value:g}{unit}, but {low:g} to {high:g} are possible")
        return float(value)

    def numbers(self, key: str, count: int, low: float, high: float) -> tuple[float, ...]:
        """A list of `count` numbers from `low` to `high`. Raises FieldError."""
        values = self.entries.get(key)
        if not isinstance(values, list) or len(values) != count:
            raise self.error(key, f"a list of {count} numbers is needed")
        row = TomlTable({f"[{i + 1}]": value for i, value in enumerate(values)}, self.path + key)
        return tuple(row.number(name, None, low, high) for name in row.entries)

    def point(self, key: str) -> tuple[float, float]:
        """A point [x, y] in the arena, px. Raises FieldError."""
        point = self.entries.get(key)
        if not isinstance(point, list) or len(point) != 2:
            raise self.error(key, "a point [x, y] is needed")
        pair = TomlTable({key: point[0]}, self.path), TomlTable({key: point[1]}, self.path)
        x, y = (coordinate.number(key) for coordinate in pair)
        if not (0 <= x <= WIDTH and 0 <= y <= HEIGHT):
            raise self.error(key, f"({x:g}, {y:g}) lies outside the arena, 0..{WIDTH:g} x 0..{HEIGHT:g}")
        return x, y

    def word(self, key: str, known: Sequence[str]) -> str:
        """A text that must be one of `known`. Raises FieldError."""
        value = self.entries.get(key)
        if value not in known:
            raise self.error(key, f"{quote(value)}; possible are {', '.join(known)}")
        return str(value)

    def table(self, key: str, reason: str = "a table is missing") -> "TomlTable":
        """The table [key]. Raises FieldError."""
        entries = self.entries.get(key)
        if not isinstance(entries, dict):
            raise self.error(key, reason)
        return TomlTable(entries, f"{self.path}{key}.")

    def tables(self, key: str) -> "list[TomlTable]":
        """The tables [[key]], in file order; empty if there are none. Raises FieldError."""
        entries = self.entries.get(key, [])
        if not isinstance(entries, list):
            raise self.error(key, f"must be written as [[{key}]]")
        for i, entry in enumerate(entries):
            if not isinstance(entry, dict):
                raise self.error(f"{key}[{i + 1}]", "must be a table")
        return [TomlTable(entry, f"{self.path}{key}[{i + 1}].") for i, entry in enumerate(entries)]
