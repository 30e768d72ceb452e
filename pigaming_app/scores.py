"""High scores: for each game and table (an arena, and what was done there) the best ever, and the last days' best."""

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import date, datetime, timedelta
from pathlib import Path
from typing import Any

from pigaming_app.keeping import keep, recall

FILE = "scores.toml"
LENGTH = 10  # rows of a table
DAYS = 7  # for so long the tables of single days are kept
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


@dataclass(frozen=True)
class Score:
    """One row of a table: points, more is better, or milliseconds, less is. `when` is local time with its offset."""

    initials: str  # three of LETTERS
    score: int
    when: datetime
    timed: bool = False

    @property
    def order(self) -> int:
        """What tables are sorted by: the best first."""
        return self.score if self.timed else -self.score


class Scores:
    """The tables of all games. A new row is in memory only, until `save`."""

    def __init__(self) -> None:
        self._tables: dict[tuple[str, str], list[Score]] = {}

    @classmethod
    def load(cls, folder: Path) -> "tuple[Scores, list[str]]":
        """The tables kept in the folder, and one sentence for everything that was wrong with them."""
        path = folder / FILE
        found, said = recall(path, tomllib.loads)
        scores = cls()
        for game, arenas in (found or {}).items():
            for arena, rows in arenas.items() if isinstance(arenas, dict) else [("", None)]:
                good = [score for score in map(_score, rows if isinstance(rows, list) else []) if score]
                if not isinstance(rows, list) or len(good) < len(rows):
                    said.append(
                        f"{path}: {game}.{arena} has rows that are not initials, score or ms, when; they are ignored."
                    )
                if good:
                    scores._tables[game, arena] = _worth_keeping(good)
        return scores, said

    def save(self, folder: Path) -> None:
        """Keep the tables in the folder. Raises NotSaved; then the tables kept before are intact."""
        import tomli_w

        games: dict[str, dict[str, list[dict[str, Any]]]] = {}
        for (game, arena), rows in self._tables.items():
            games.setdefault(game, {})[arena] = [_entry(row) for row in rows]
        keep(folder / FILE, tomli_w.dumps(games))

    def add(
        self, game: str, arena: str, initials: str, score: int, when: datetime | None = None, timed: bool = False
    ) -> Score:
        """Note a score; `when`: now, if not said. Raises ValueError unless the initials are three of A to Z."""
        row = Score(initials, score, _local(when), timed)
        if not _are_initials(initials):
            raise ValueError(f"initials are three of A to Z, not {initials!r}")
        rows = self._tables.setdefault((game, arena), [])
        rows[:] = _worth_keeping([*rows, row])
        return row

    def best(self, game: str, arena: str, days: int | None = None, now: datetime | None = None) -> list[Score]:
        """The table, best first, at most LENGTH rows: of all time, or of the last `days` (1: today; at most DAYS)."""
        rows = self._tables.get((game, arena), [])
        if days is not None:
            first = _local(now).date() - timedelta(days=days - 1)
            rows = [row for row in rows if _day(row) >= first]
        return rows[:LENGTH]

    def place(
        self,
        game: str,
        arena: str,
        score: int,
        days: int | None = None,
        now: datetime | None = None,
        timed: bool = False,
    ) -> int | None:
        """Where a new score would stand in that table, from 1; None: not in it. It stands behind its equals."""
        order = score if timed else -score
        ahead = sum(row.order <= order for row in self.best(game, arena, days, now))
        return ahead + 1 if ahead < LENGTH else None

    def reset(self) -> None:
        """Empty every table."""
        self._tables.clear()


def _entry(row: Score) -> dict[str, Any]:
    return {"initials": row.initials, "ms" if row.timed else "score": row.score, "when": row.when}


def _score(row: object) -> Score | None:
    match row:
        case {"initials": str(initials), "score": int(score), "when": datetime() as when, **rest} if not rest:
            timed = False
        case {"initials": str(initials), "ms": int(score), "when": datetime() as when, **rest} if not rest:
            timed = True
        case _:
            return None
    good = _are_initials(initials) and not isinstance(score, bool) and (score > 0 or not timed)
    return Score(initials, score, _local(when), timed) if good else None


def _are_initials(text: str) -> bool:
    return len(text) == 3 and all(letter in LETTERS for letter in text)


def _local(when: datetime | None) -> datetime:
    """The time in the local zone, whole seconds; now, if it is None."""
    return (when.astimezone() if when else datetime.now().astimezone()).replace(microsecond=0)


def _day(row: Score) -> date:
    return row.when.astimezone().date()


def _worth_keeping(rows: Iterable[Score]) -> list[Score]:
    """The rows that any table can show, best first; of equal scores the earlier one."""
    ordered = sorted(rows, key=lambda row: (row.order, row.when))
    days = sorted({_day(row) for row in ordered})[-DAYS:]
    shown = {id(row) for day in days for row in [one for one in ordered if _day(one) == day][:LENGTH]}
    return [row for place, row in enumerate(ordered) if place < LENGTH or id(row) in shown]
