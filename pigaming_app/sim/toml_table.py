"""Reading a TOML file with care: every table knows where in the file it stands, so that what is wrong can be named.

`Wrong` carries the key and the reason; whoever opened the file adds its name and says the line.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.storage.parsing import SHOWN, one_line, shown


class Wrong(Exception):
    """Something in a file that cannot be used: the key, such as `wall[2].thick`, and the reason."""

    def __init__(self, key: str, reason: str) -> None:
        self.key, self.reason = one_line(key, SHOWN), reason
        super().__init__(f"{self.key}: {reason}")


class Table:
    """A table of a file; `path`: where it stands, such as `wall[2].`, empty for the whole file."""

    def __init__(self, entries: Mapping[str, Any], path: str = "") -> None:
        self.entries, self.path = entries, path

    def __contains__(self, key: str) -> bool:
        return key in self.entries

    def only(self, *known: str) -> None:
        """Raises Wrong for a key that is not one of these."""
        for key in self.entries:
            if key not in known:
                raise Wrong(self.path + key, f"unknown key; possible are {', '.join(known)}")

    def wrong(self, key: str, reason: str) -> Wrong:
        """What is wrong with a key of this table."""
        return Wrong(self.path + key, reason)

    def number(
        self, key: str, default: float | None = None, low: float = -1e6, high: float = 1e6, unit: str = ""
    ) -> float:
        """A number from `low` to `high`. Raises Wrong."""
        value = self.entries.get(key, default)
        if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < 1e6:
            raise self.wrong(key, f"{shown(value)} is not a number that makes sense here")
        if not low <= value <= high:
            raise self.wrong(key, f"{value:g}{unit}, but {low:g} to {high:g} are possible")
        return float(value)

    def numbers(self, key: str, count: int, low: float, high: float) -> tuple[float, ...]:
        """A list of so many numbers from `low` to `high`. Raises Wrong."""
        values = self.entries.get(key)
        if not isinstance(values, list) or len(values) != count:
            raise self.wrong(key, f"a list of {count} numbers is needed")
        row = Table({f"[{i + 1}]": value for i, value in enumerate(values)}, self.path + key)
        return tuple(row.number(name, None, low, high) for name in row.entries)

    def point(self, key: str) -> tuple[float, float]:
        """A point [x, y] in the arena, px. Raises Wrong."""
        point = self.entries.get(key)
        if not isinstance(point, list) or len(point) != 2:
            raise self.wrong(key, "a point [x, y] is needed")
        pair = Table({key: point[0]}, self.path), Table({key: point[1]}, self.path)
        x, y = (one.number(key) for one in pair)
        if not (0 <= x <= WIDTH and 0 <= y <= HEIGHT):
            raise self.wrong(key, f"({x:g}, {y:g}) lies outside the arena, 0..{WIDTH:g} x 0..{HEIGHT:g}")
        return x, y

    def word(self, key: str, known: Sequence[str]) -> str:
        """One of these words. Raises Wrong."""
        value = self.entries.get(key)
        if value not in known:
            raise self.wrong(key, f"{shown(value)}; possible are {', '.join(known)}")
        return str(value)

    def table(self, key: str, reason: str = "a table is missing") -> "Table":
        """The table [key]. Raises Wrong."""
        entries = self.entries.get(key)
        if not isinstance(entries, dict):
            raise self.wrong(key, reason)
        return Table(entries, f"{self.path}{key}.")

    def tables(self, key: str) -> "list[Table]":
        """The tables [[key]], in the order of the file; none if there are none. Raises Wrong."""
        entries = self.entries.get(key, [])
        if not isinstance(entries, list):
            raise self.wrong(key, f"must be written as [[{key}]]")
        for i, entry in enumerate(entries):
            if not isinstance(entry, dict):
                raise self.wrong(f"{key}[{i + 1}]", "must be a table")
        return [Table(entry, f"{self.path}{key}[{i + 1}].") for i, entry in enumerate(entries)]
