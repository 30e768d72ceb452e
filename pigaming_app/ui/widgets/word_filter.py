"""The filter of rude words for the high scores: assets/rude.toml."""

import tomllib
from functools import cache
from itertools import product

from pigaming_app import ASSETS

HARMLESS = "BOT"  # replaces a rude word


def is_rude(initials: str) -> bool:
    """True if three letters are, or can be read as, a rude word."""
    words, read_as = _lists()
    readings = product(*((letter, *read_as.get(letter, "")) for letter in initials))
    return any("".join(reading) in words for reading in readings)


@cache
def _lists() -> tuple[frozenset[str], dict[str, str]]:
    table = tomllib.loads((ASSETS / "rude.toml").read_text(encoding="utf-8"))
    return frozenset(table["words"]), table["read_as"]
