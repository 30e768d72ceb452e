"""The TOML format of the scores file: writing, parsing and validation.

format = 1
resets = 0                       # number of times that all tables were cleared

[[table]]
game = "race"
arena = "classic"
achievement = "lap"
timed = true
rules = "standard"
length = 3
people = 2
side = 0
rows = [{ initials = "ABC", score = 9870, when = 2026-11-21T12:00:00+00:00 }]
"""

from collections import Counter
from dataclasses import dataclass, field
from datetime import date
from typing import Annotated, Any

from pigaming_app.storage.parsing import QUOTE_LENGTH, ParseError, one_line
from pigaming_app.storage.schema import between, from_toml, to_plain, to_toml, typed, valid_entries
from pigaming_app.storage.scores.table import Score, ScoreTable, is_score, worth_keeping

FORMAT = 1


@dataclass
class Content:
    """The content of a scores file."""

    tables: dict[ScoreTable, list[Score]] = field(default_factory=dict)
    resets: int = 0

    def copy(self) -> "Content":
        """A copy that shares no lists."""
        return Content({table: [*rows] for table, rows in self.tables.items()}, self.resets)

    def clear(self) -> None:
        """Empty every table, and count it as a reset."""
        self.tables, self.resets = {}, self.resets + 1

    def trim(self, today: date) -> None:
        """Sort every table, and drop rows that are never displayed."""
        self.tables = {table: worth_keeping(table, rows, today) for table, rows in self.tables.items() if rows}

    def rows(self) -> Counter[tuple[ScoreTable, Score]]:
        """The number of occurrences of each row."""
        return Counter((table, row) for table, rows in self.tables.items() for row in rows)


@dataclass
class Problems:
    """Invalid entries that were ignored: their number, and the location of the first."""

    count: int = 0
    first: str = ""

    def add(self, where: str, count: int = 1) -> None:
        """Count invalid entries."""
        self.count += count
        self.first = self.first or where * (count > 0)

    def sentences(self, path: object) -> list[str]:
        """A sentence on all entries; empty if there are none."""
        if not self.count:
            return []
        entries = "1 entry is not a score" if self.count == 1 else f"{self.count} entries are not scores"
        return [f"{path}: {entries} ({'' if self.count == 1 else 'first '}in {self.first}); ignored."]


@dataclass(frozen=True)
class ScoresFile:
    """The file; its tables are validated one by one."""

    resets: Annotated[int, between(0, 10**9)] = 0
    table: tuple[Any, ...] = ()


def parse(text: str) -> tuple[Content, Problems]:
    """Parse a file into its content and the ignored entries. Raises ValueError if it is not a scores file."""
    file = from_toml(text, ScoresFile, FORMAT)
    content, faults = Content(resets=file.resets), Problems()
    for i, entry in enumerate(file.table, 1):
        try:
            table, entries = typed(entry, ScoreTable), typed(entry["rows"], list[Any])
        except (ParseError, KeyError):
            faults.add(f"table {i}")
            continue
        rows = [row for row in valid_entries(entries, Score) if is_score(table, row)]
        faults.add(one_line(f"{table.game}.{table.arena}", QUOTE_LENGTH), len(entries) - len(rows))
        content.tables.setdefault(table, []).extend(rows)
    return content, faults


def to_text(content: Content) -> str:
    """The text of a scores file."""
    tables = [to_plain(table) | {"rows": to_plain(rows)} for table, rows in sorted(content.tables.items()) if rows]
    return to_toml({"resets": content.resets, "table": tables}, FORMAT)
