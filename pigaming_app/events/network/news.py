"""What an arcade on another computer sends to the one that has the event, and what counts of it.

Both have the first `after` entries of the journal, as `mark` shows; the arcade adds its own ones behind them. One whose
answer was lost is sent again: what the journal has got meanwhile does not count a second time.
"""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass

from pigaming_app.events.changes.live import LiveMatch
from pigaming_app.events.event import Event
from pigaming_app.events.event_files import merged
from pigaming_app.events.journal import Entry
from pigaming_app.events.spec import check_name
from pigaming_app.storage.schema import Count, Line, from_json, to_json

PATH, LOGIN = "/join", "/join/login"  # at the desk
BYTES = 40_000  # of the entries that are sent at once, at least one


@dataclass(frozen=True)
class News:
    """The news of an arcade. `live`: what it plays just now; None: nothing of this event."""

    arcade: Line
    after: Count = 0
    mark: Line = ""
    entries: tuple[Entry, ...] = ()
    live: LiveMatch | None = None

    def __post_init__(self) -> None:
        check_name(self.arcade, "bad_arcade")
        if self.live and self.live.arcade != self.arcade:
            raise ValueError("live: it is of another arcade")


@dataclass(frozen=True)
class Login:
    """The operator's PIN."""

    pin: Line


class Outdated(ValueError):
    """The journal does not begin as the arcade has it."""


def news_of(body: bytes) -> News:
    """News from the network. Raises ValueError."""
    return from_json(body, News)


def mark_of(journal: Sequence[Entry]) -> str:
    """A hash of these entries."""
    return hashlib.sha256("\n".join(map(to_json, journal)).encode()).hexdigest()


def with_news(event: Event, news: News) -> Event:
    """The event with what it has not got of the news, as far as that is possible. Raises Outdated."""
    if news.after > len(event.journal) or mark_of(event.journal[: news.after]) != news.mark:
        raise Outdated("the journal does not begin like this")
    return merged(event, news.after, news.entries)


def first_of(entries: Sequence[Entry]) -> tuple[Entry, ...]:
    """As many of these as are sent at once."""
    size, count = 0, 0
    for entry in entries:
        size += len(to_json(entry).encode())
        if count and size > BYTES:
            break
        count += 1
    return tuple(entries[:count])
