"""The TOML format of the scores file: writing, parsing and validation.

format = 2
resets = 0                       # number of times that all tables were cleared

[[migrated]]                     # a file of version 1.3.0
file = "scores.toml"
backup = "scores-1.3.0.toml"
digest = "9f86d081…"
when = 2026-11-22T10:00:00+00:00
rows = { pitanks = 8, race = 4 }

[[table]]
game = "race"
arena = "classic"
feat = "lap"
timed = true
rules = "standard"
length = 3
people = 2
side = 0
rows = [{ initials = "ABC", ms = 9870, when = 2026-11-21T12:00:00+00:00 }]
"""

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from datetime import date, datetime
from typing import Any

from pigaming_app.storage.parsing import QUOTE_LENGTH, one_line, parse_toml
from pigaming_app.storage.scores.table import MAX_NAME, Score, ScoreTable, is_score, local, worth_keeping

FORMAT = 2
MAX_RESETS = 10**9
MAX_PEOPLE = 99
MAX_LENGTH = 1000


@dataclass(frozen=True)
class Migrated:
    """A migrated file of version 1.3.0: its name, its backup's name, time, and number of new rows per game."""

    file: str
    backup: str
    digest: str  # SHA-256 of the file
    when: datetime
    rows: Mapping[str, int]


@dataclass
class Content:
    """The content of a scores file."""

    tables: dict[ScoreTable, list[Score]] = field(default_factory=dict)
    resets: int = 0
    migrated: list[Migrated] = field(default_factory=list)

    def copy(self) -> "Content":
        """A copy that shares no lists."""
        return Content({table: [*rows] for table, rows in self.tables.items()}, self.resets, [*self.migrated])

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
        self.first = self.first or where

    def sentences(self, path: object) -> list[str]:
        """A sentence on all entries; empty if there are none."""
        if not self.count:
            return []
        entries = "1 entry is not a score" if self.count == 1 else f"{self.count} entries are not scores"
        return [f"{path}: {entries} ({'' if self.count == 1 else 'first '}in {self.first}); ignored."]


def parse(text: str) -> tuple[Content, Problems]:
    """Parse a file into its content and the ignored entries. Raises ValueError if it is not a scores file."""
    document = parse_toml(text)
    if type(document.get("format")) is not int or document["format"] != FORMAT:
        raise ValueError(f"its format is not {FORMAT}")
    content, faults = Content(resets=_resets(document.get("resets"))), Problems()
    for i, entry in enumerate(_list(document.get("table", []), "table", faults), 1):
        table = _table(entry)
        if table is None:
            faults.add(f"table {i}")
            continue
        rows = content.tables.setdefault(table, [])
        rows += read_rows(table, entry.get("rows"), one_line(f"{table.game}.{table.arena}", QUOTE_LENGTH), faults)
    for entry in _list(document.get("migrated", []), "migrated", faults):
        if migrated := _migrated(entry):
            content.migrated.append(migrated)
        else:
            faults.add("migrated")
    return content, faults


def to_text(content: Content) -> str:
    """The text of a scores file."""
    import tomli_w

    tables = [
        {**asdict(table), "rows": [_entry(table, row) for row in rows]}
        for table, rows in sorted(content.tables.items())
        if rows
    ]
    migrated = [asdict(entry) for entry in content.migrated]
    return tomli_w.dumps({"format": FORMAT, "resets": content.resets, "migrated": migrated, "table": tables})


def read_rows(table: ScoreTable, entries: object, where: str, faults: Problems) -> list[Score]:
    """The valid rows of a list; invalid ones are added to `faults`."""
    rows = []
    for entry in _list(entries, where, faults):
        if row := row_of(table, entry):
            rows.append(row)
        else:
            faults.add(where)
    return rows


def row_of(table: ScoreTable, entry: object) -> Score | None:
    """The row of an entry; None if it is not valid in this table."""
    match entry:
        case {"initials": str(initials), "when": datetime() as when, **rest}:
            pass
        case _:
            return None
    value = rest.pop("ms" if table.timed else "score", None)
    if rest or type(value) is not int:
        return None
    try:
        row = Score(initials, value, local(when))
    except ValueError:
        return None
    return row if is_score(table, row) else None


def _list(value: object, where: str, faults: Problems) -> Iterable[Any]:
    if isinstance(value, list):
        return value
    faults.add(where)
    return []


def _table(entry: object) -> ScoreTable | None:
    match entry:
        case {
            "game": str(game),
            "arena": str(arena),
            "feat": str(feat),
            "timed": bool(timed),
            "rules": str(rules),
            "length": int() | float() as length,
            "people": int(people),
            "side": int(side),
            "rows": _,
            **rest,
        } if not rest:
            pass
        case _:
            return None
    short = max(map(len, (game, arena, feat, rules))) <= MAX_NAME
    counts = all(type(count) is int and 0 <= count <= MAX_PEOPLE for count in (people, side))
    plausible = not isinstance(length, bool) and 0 <= length <= MAX_LENGTH
    return ScoreTable(game, arena, feat, timed, rules, length, people, side) if short and counts and plausible else None


def _migrated(entry: object) -> Migrated | None:
    match entry:
        case {
            "file": str(file),
            "backup": str(backup),
            "digest": str(digest),
            "when": datetime() as when,
            "rows": dict(rows),
        }:
            pass
        case _:
            return None
    try:
        counts = all(type(count) is int and count >= 0 for count in rows.values())
        valid = counts and _is_file_name(file) and _is_file_name(backup)
        return Migrated(file, backup, digest, local(when), rows) if valid else None
    except ValueError:
        return None


def _is_file_name(file: str) -> bool:
    """True if `file` is a file name without a folder."""
    return 0 < len(file) <= MAX_NAME and file.isprintable() and not set(file) & set("/\\:")


def _resets(value: object) -> int:
    return value if type(value) is int and 0 <= value <= MAX_RESETS else 0


def _entry(table: ScoreTable, row: Score) -> Mapping[str, Any]:
    return {"initials": row.initials, "ms" if table.timed else "score": row.score, "when": row.when}
