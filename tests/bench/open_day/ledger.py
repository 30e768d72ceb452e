"""What the visitors of the day saw, one JSON object a line, written before the arcade counts it and again after.

A result that was on the screen, but whose page had not followed yet when the arcade was killed, is open: the arcade may
have counted it or not, but never twice. All others have to be counted exactly once.
"""

import json
import os
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

Row = tuple[str, int]  # a high-score table as JSON, and a value
SIGNED = tuple[str, int, str]  # and initials


@dataclass(frozen=True)
class SeenMatch:
    """A match that was played to its end. `began`: local time, ISO; `event`, `fixture`, `extra` and `scores`: file,
    number, extra match after a tie, and scores by entrant of a match of an event; `settled`: the next page followed.
    """

    game: str
    began: str
    seconds: float
    people: int
    ais: int
    event: str = ""
    fixture: int = 0
    extra: int = 0
    scores: Mapping[str, float] = field(default_factory=dict)
    settled: bool = False

    @property
    def fixture_key(self) -> tuple[int, int]:
        """Which match of its event it is."""
        return self.fixture, self.extra

    @property
    def key(self) -> tuple[str, str, float, int, int]:
        """What the day log has of it."""
        return self.game, self.began, self.seconds, self.people, self.ais


@dataclass(frozen=True)
class Wait:
    """A phone's way to a seat: s in the queue, matches that began in this time up to its own, and its fair share of
    them, which follows from those who came first when it joined the queue.
    """

    visitor: int
    seconds: float
    matches: int
    fair: int


class Reading(NamedTuple):
    """Memory of a run: `at` s since the opening, MB, and the games that it has shown so far."""

    life: int
    at: float
    mb: float
    games: int


@dataclass
class Ledger:
    """All that was seen. `playing`: matches that began and have neither ended nor been left, as after a kill;
    `entries`: rows for which initials were asked, but nothing followed; `rows`: those entered.
    """

    matches: list[SeenMatch] = field(default_factory=list)
    left: int = 0
    playing: int = 0
    rows: list[SIGNED] = field(default_factory=list)
    entries: list[Row] = field(default_factory=list)
    counts: dict[str, int] = field(default_factory=dict)
    memory: list[Reading] = field(default_factory=list)
    troubles: list[str] = field(default_factory=list)
    lives: int = 0
    played: dict[int, int] = field(default_factory=dict)  # matches by group
    done: set[int] = field(default_factory=set)  # groups
    seated: set[int] = field(default_factory=set)  # visitors who have played, by number
    events: dict[int, str] = field(default_factory=dict)  # file by group
    tokens: dict[int, str] = field(default_factory=dict)  # of the page of each visitor's phone
    waits: list[Wait] = field(default_factory=list)

    @property
    def settled(self) -> list[SeenMatch]:
        """The matches that the arcade must have counted."""
        return [match for match in self.matches if match.settled]

    @property
    def open(self) -> list[SeenMatch]:
        """The matches that it may have counted."""
        return [match for match in self.matches if not match.settled]

    def __add__(self, other: "Ledger") -> "Ledger":
        """Both together. Groups and lives of the other come after those of this one."""
        groups, lives = max(self.done | {*self.events}, default=-1) + 1, self.lives
        return Ledger(
            self.matches + other.matches,
            self.left + other.left,
            self.playing + other.playing,
            self.rows + other.rows,
            self.entries + other.entries,
            dict(Counter(self.counts) + Counter(other.counts)),
            self.memory + [one._replace(life=one.life + lives) for one in other.memory],
            self.troubles + other.troubles,
            lives + other.lives,
            self.played | {groups + group: count for group, count in other.played.items()},
            self.done | {groups + group for group in other.done},
            self.seated | other.seated,
            self.events | {groups + group: path for group, path in other.events.items()},
            self.tokens | other.tokens,
            self.waits + other.waits,
        )


class LedgerFile:
    """The file of a ledger; each line is written at once."""

    def __init__(self, path: Path) -> None:
        self._file = os.open(path, os.O_WRONLY | os.O_APPEND | os.O_CREAT)

    def note(self, what: str, **values: Any) -> None:
        """Append a line."""
        os.write(self._file, json.dumps({"what": what, **values}).encode() + b"\n")

    def close(self) -> None:
        os.close(self._file)


def read(path: Path) -> Ledger:
    """The ledger in a file; an incomplete last line, from a kill, does not count."""
    return digest(json.loads(line) for line in _lines(path))


def _lines(path: Path) -> Iterator[str]:
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    yield from text.split("\n")[:-1]


def digest(lines: Iterator[dict[str, Any]]) -> Ledger:
    """The ledger of these lines. Numbers of matches and entries are unique within the whole day."""
    out = Ledger()
    over: dict[str, dict[str, Any]] = {}
    settled: set[str] = set()
    playing: set[str] = set()
    asked: dict[str, list[Row]] = {}
    for line in lines:
        match line:
            case {"what": "life"}:
                out.lives += 1
            case {"what": "playing", "match": name}:
                playing.add(name)
            case {"what": "left", "match": name}:
                playing.discard(name)
                out.left += 1
            case {"what": "round", "match": name}:
                playing.discard(name)
            case {"what": "over", "match": name, "group": group, "visitors": visitors, **seen}:
                playing.discard(name)
                over[name] = seen
                out.played[group] = out.played.get(group, 0) + 1
                out.seated.update(visitors)
            case {"what": "settled", "match": name}:
                settled.add(name)
            case {"what": "asked", "entry": name, "rows": rows}:
                asked[name] = [(table, value) for table, value in rows]
            case {"what": "entered", "entry": name, "rows": rows}:
                asked.pop(name)
                out.rows += [(table, value, initials) for table, value, initials in rows]
            case {"what": "count", "name": name}:
                out.counts[name] = out.counts.get(name, 0) + 1
            case {"what": "memory", "life": life, "at": at, "mb": mb, **seen}:
                out.memory.append(Reading(life, at, mb, seen.get("games", 0)))
            case {"what": "trouble", "text": text}:
                out.troubles.append(text)
            case {"what": "done", "group": group}:
                out.done.add(group)
            case {"what": "event", "group": group, "path": path}:
                out.events[group] = path
            case {"what": "phone", "visitor": visitor, "token": token}:
                out.tokens[visitor] = token
            case {"what": "wait", **wait}:
                out.waits.append(Wait(**wait))
            case other:
                raise ValueError(f"no line of a ledger: {other}")
    out.matches = [
        SeenMatch(**{key: seen[key] for key in _FIELDS}, settled=name in settled) for name, seen in over.items()
    ]
    out.playing = len(playing)
    out.entries = [row for rows in asked.values() for row in rows]
    return out


_FIELDS = ("game", "began", "seconds", "people", "ais", "event", "fixture", "extra", "scores")
