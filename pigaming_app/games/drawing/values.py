"""A drawing: the tables of an arena file as immutable values, equal if they mean the same, and written as TOML again.

A change makes a new drawing, so an editor undoes by keeping the old ones. Tables and keys are those of the file: in
`wall` the points `from` and `to`, `thick`, `health` or `solid`; in `corner` the control points of a course.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import Any

from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import HEIGHT, WIDTH

FAR = 400.0  # px beyond the rim
Point = tuple[float, float]
Value = str | bool | int | float | tuple["Value", ...]


@dataclass(frozen=True)
class Part:
    """A table of an arena file: its name, its entries, and whether it is one of several, such as [[wall]]."""

    kind: str
    entries: tuple[tuple[str, Value], ...]
    several: bool = True

    @classmethod
    def of(cls, kind: str, /, *, several: bool = True, **entries: Value) -> "Part":
        """A part with these entries; a key that is a word of Python, such as `from`, ends with an underscore."""
        return cls(kind, tuple((key.rstrip("_"), value) for key, value in entries.items()), several)

    def get(self, key: str, default: Value = ()) -> Value:
        """The value of an entry."""
        return next((value for name, value in self.entries if name == key), default)

    def number(self, key: str, default: float, least: float = -1e4, most: float = 1e4) -> float:
        """A number among its entries, from `least` to `most`."""
        value = self.get(key, default)
        return min(max(float(value), least), most) if isinstance(value, int | float) and isfinite(value) else default

    def stepped(self, key: str, values: Sequence[float], default: float) -> "Part":
        """This part with a number changed to the next larger of some values, after the largest to the smallest."""
        value = self.number(key, default)
        return self.changed(key, next((other for other in values if other > value + 1e-6), values[0]))

    def in_whole_px(self) -> "Part":
        """This part with all its points in whole px within the arena."""
        points = {key: found for key, value in self.entries if (found := point(value))}
        rounded = {
            key: (round(min(max(x, 0.0), WIDTH)), round(min(max(y, 0.0), HEIGHT))) for key, (x, y) in points.items()
        }
        return replace(self, entries=tuple((key, rounded.get(key, value)) for key, value in self.entries))

    def point(self, key: str) -> Point:
        """A point among its entries, px, not far from the arena; the middle of the arena if there is none."""
        return point(self.get(key)) or (WIDTH / 2, HEIGHT / 2)

    def changed(self, key: str, value: Value | None) -> "Part":
        """This part with another value; None: without the entry."""
        kept = {**dict(self.entries), key: value}
        return replace(self, entries=tuple((name, entry) for name, entry in kept.items() if entry is not None))


@dataclass(frozen=True)
class Drawing:
    """An arena: its parts, in the order of the file."""

    parts: tuple[Part, ...]

    def of(self, kind: str) -> tuple[Part, ...]:
        """The parts of a kind, in order; wall[2] of a message is the second of them."""
        return tuple(part for part in self.parts if part.kind == kind)

    def added(self, part: Part) -> "Drawing":
        """With another part, after all of its kind."""
        after = max((i + 1 for i, other in enumerate(self.parts) if other.kind == part.kind), default=len(self.parts))
        return replace(self, parts=(*self.parts[:after], part, *self.parts[after:]))

    def changed(self, kind: str, k: int, part: Part | None) -> "Drawing":
        """With another part in place of the k-th of a kind, from 0; None: without it."""
        at = [i for i, other in enumerate(self.parts) if other.kind == kind][k]
        return replace(self, parts=(*self.parts[:at], *((part,) if part else ()), *self.parts[at + 1 :]))

    def text(self) -> str:
        """The text of an arena file."""
        return "\n".join(_table(part) for part in self.parts)

    def document(self) -> dict[str, Any]:
        """Tables and lists as TOML has them, to be read by the game."""
        tables: dict[str, Any] = {}
        for part in self.parts:
            entries = {key: _listed(value) for key, value in part.entries}
            if part.several:
                tables.setdefault(part.kind, []).append(entries)
            else:
                tables[part.kind] = entries
        return tables


def point(value: Value) -> Point | None:
    """A value as a point, px, not far from the arena; None if it is none."""
    match value:
        case (int() | float() as x, int() | float() as y) if isfinite(x) and isfinite(y):
            return min(max(float(x), -FAR), WIDTH + FAR), min(max(float(y), -FAR), HEIGHT + FAR)
    return None


def drawing_of(source: str) -> Drawing:
    """The drawing of an arena file, which need not be playable. Raises FieldError if it is not made of tables."""
    parts = []
    for kind, found in TomlTable.parse(source).entries.items():
        tables = found if isinstance(found, list) else [found]
        if not all(isinstance(table, Mapping) for table in tables):
            raise FieldError(kind, "a table is needed")
        for table in tables:
            entries = tuple((key, _frozen(f"{kind}.{key}", value)) for key, value in table.items())
            parts.append(Part(kind, entries, isinstance(found, list)))
    return Drawing(tuple(parts))


def _table(part: Part) -> str:
    name = _key(part.kind)
    lines = [f"[[{name}]]" if part.several else f"[{name}]"]
    return "\n".join([*lines, *(f"{_key(key)} = {_literal(value)}" for key, value in part.entries)]) + "\n"


def _literal(value: Value) -> str:
    match value:
        case bool():
            return str(value).lower()
        case str():
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
        case tuple():
            return f"[{', '.join(map(_literal, value))}]"
        case _:
            return repr(value)


def _key(key: str) -> str:
    """A key, in quotes unless it is a plain word."""
    return key if key.isascii() and key.replace("_", "a").replace("-", "a").isalnum() else _literal(key)


def _frozen(key: str, value: object) -> Value:
    match value:
        case str() | bool() | int() | float():
            return value
        case list():
            return tuple(_frozen(key, entry) for entry in value)
        case _:
            raise FieldError(key, "a text, a number or a list is needed")


def _listed(value: Value) -> str | bool | int | float | Sequence[Any]:
    return [_listed(entry) for entry in value] if isinstance(value, tuple) else value
