"""Blocks of README and docs/ that a program writes: derived from the code, or measured.

A block stands between `<!-- NAME -->` and `<!-- end -->`. A derived one is compared with the code in every run of the
tests; a measured one names its version and its command, and is measured again by

    python -m tests.bench.figures [--only NAME …] [--write]
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from pigaming_app import __version__

ROOT = Path(__file__).resolve().parents[3]


@dataclass(frozen=True)
class Derived:
    """A block that follows from the code."""

    page: str
    text: Callable[[], str]


@dataclass(frozen=True)
class Measured:
    """A block of figures. `table`: its rows, head first, measured with a share of the work; 1 is all of it."""

    page: str
    command: str  # that plays the same
    table: Callable[[float], list[list[str]]]
    minutes: float  # it takes on two idle cores, about

    def text(self, share: float = 1.0) -> str:
        """The block: version, command, and the table."""
        return f"Version {__version__}, `{self.command}`:\n\n{as_markdown(self.table(share))}"


def as_markdown(rows: list[list[str]]) -> str:
    """A table as text."""
    head, *body = ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join([head, "|" + "---|" * len(rows[0]), *body]).replace("|  |", "| |")


def pattern(name: str) -> re.Pattern[str]:
    """The block of a name with its markers; its text is group 1."""
    return re.compile(rf"(?<=<!-- {re.escape(name)} -->\n)(.*?)\n?(?=<!-- end -->)", re.DOTALL)


def on_page(page: str, name: str) -> str:
    """The text of a block as its page has it."""
    found = pattern(name).search((ROOT / page).read_text(encoding="utf-8"))
    assert found, f"{page} has no block {name}"
    return found[1]


def write(page: str, name: str, text: str) -> None:
    """Replace a block on its page."""
    file = ROOT / page
    filled = f"{text}\n" if text else ""
    file.write_text(pattern(name).sub(lambda _: filled, file.read_text(encoding="utf-8"), count=1), encoding="utf-8")
