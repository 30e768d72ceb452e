"""Hostile values for files and command lines, and trees in which each value in turn is replaced by one."""

import copy
from math import inf, nan
from typing import Any

HUGE = 10**400
DEEP: list[Any] = [[[[[[[[[[]]]]]]]]]]
VALUES: tuple[Any, ...] = (
    None, True, False, 0, -1, 1, 2**31, 2**63, -(2**64), HUGE, -HUGE, 0.0, -0.5, 5e-324, 1e308, -1e308, inf, -inf, nan,
    "", "a" * 300, "\n\x1b[2J", "9" * 20, [], [None], [[]], [0] * 9, [1e308] * 9, [-1] * 4,
    {}, {"a": {}}, {"": [1]}, DEEP,
)  # fmt: skip


def mutated(tree, values=VALUES):
    """Copies of a tree of tables and lists: a value replaced, a key or entry removed, duplicated or added."""
    for path in paths(tree):
        for value in values:
            yield changed(tree, path, lambda at, key, value=value: at.__setitem__(key, value))
        yield changed(tree, path, lambda at, key: at.__delitem__(key))
        yield changed(tree, path, lambda at, key: at.__setitem__(key, [at[key], at[key]]))
        if isinstance(path[-1], int):
            yield changed(tree, path, lambda at, key: at.insert(key, at[key]))
        else:
            yield changed(tree, path, lambda at, key: at.__setitem__("a\nb" * 100, at.pop(key)))


def paths(tree, above=()):
    """The path of every value of a tree; in long lists only of the first and last entries."""
    entries = list(tree.items() if isinstance(tree, dict) else enumerate(tree))
    for key, value in entries if len(entries) <= 40 else [*entries[:2], *entries[-2:]]:
        yield (*above, key)
        if isinstance(value, dict | list):
            yield from paths(value, (*above, key))


def changed(tree, path, change):
    """A copy of a tree with one change at a path."""
    whole = copy.deepcopy(tree)
    at = whole
    for key in path[:-1]:
        at = at[key]
    change(at, path[-1])
    return whole


def toml(value):
    """TOML of any tree, one line for each entry; values that TOML lacks become strings."""
    return "".join(f"{_key(key)} = {_toml(entry)}\n" for key, entry in value.items())


def _toml(value):
    match value:
        case dict():
            return "{" + ", ".join(f"{_key(key)} = {_toml(entry)}" for key, entry in value.items()) + "}"
        case list() | tuple():
            return "[" + ", ".join(_toml(entry) for entry in value) + "]"
        case bool():
            return str(value).lower()
        case int() | float():
            return str(value)
        case _:
            return _key(str(value))


def _key(text):
    escaped = "".join(one if one.isprintable() and one not in '"\\' else f"\\u{ord(one):04x}" for one in text)
    return f'"{escaped}"'
