"""Types of the values of options, for argparse: each accepts what makes sense and says in one line what it needs."""

import argparse
from collections.abc import Callable
from math import isfinite
from pathlib import Path

from pigaming_app.storage.parsing import quote

MOST_WHOLE = 2**63 - 1


def whole(low: int = 1, high: int = MOST_WHOLE) -> Callable[[str], int]:
    """Whole numbers from `low` to `high`."""

    def parse(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{quote(text)} is not a whole number") from None
        if number < low:
            raise argparse.ArgumentTypeError(f"{quote(text)} is less than {low}")
        if number > high:
            raise argparse.ArgumentTypeError(f"{quote(text)} is more than {high}")
        return number

    return parse


def real(low: float, high: float) -> Callable[[str], float]:
    """Numbers from `low` to `high`."""

    def parse(text: str) -> float:
        try:
            number = float(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{quote(text)} is not a number") from None
        if not isfinite(number) or not low <= number <= high:
            raise argparse.ArgumentTypeError(f"{quote(text)} is not between {low:g} and {high:g}")
        return number

    return parse


def path(text: str) -> Path:
    """A path that the system accepts, such as the name of a file."""
    if not text or "\0" in text:
        raise argparse.ArgumentTypeError(f"{quote(text)} is not the name of a file")
    return Path(text)


def word(text: str) -> str:
    """Printable text."""
    if not text.isprintable():
        raise argparse.ArgumentTypeError(f"{quote(text)} is not a plain text")
    return text
