"""A copy of an event and the computer that has it: what either has got is taken over by the other.

The host's journal is the one truth. Without a connection the copy goes on alone, and its entries are sent afterwards.
What the host sends may be anything: sizes, times and types are limited.
"""

import logging
import threading
import time
from collections.abc import Mapping, Sequence
from http.client import HTTPConnection, HTTPException
from pathlib import Path

from pigaming_app.events import event_files
from pigaming_app.events.changes import live
from pigaming_app.events.event import Event
from pigaming_app.events.journal import Entry
from pigaming_app.events.network import mirror
from pigaming_app.events.network.mirror import Host
from pigaming_app.events.network.news import LOGIN, PATH, Login, News, first_of, mark_of
from pigaming_app.storage.parsing import one_line, parse_json
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.schema import to_json

EVERY, LOOK = 0.25, 0.05  # s between two exchanges, and between two looks for a change of the copy
AGAIN, PATIENCE = 1.0, 30.0  # s until the next attempt without a connection, and after a refusal
WAIT, LONGEST = 2.0, 10.0  # s for an answer to go on, and for all of it
LONG = 200  # characters of a refusal

log = logging.getLogger("pigaming")


class Offline(Exception):
    """The host does not answer, or not as a desk does."""


class Unwelcome(Exception):
    """The host refuses: the PIN is wrong or has changed, or it has another event now. `wait`: s until the next PIN."""

    def __init__(self, reason: str, wait: float = 0.0) -> None:
        super().__init__(reason)
        self.wait = wait


def log_in(host: Host, pin: str) -> str:
    """The token for a PIN. Raises Offline, or Unwelcome if it is wrong."""
    status, _, body = _ask(host, LOGIN, to_json(Login(pin)))
    try:
        answer = parse_json(body)
        if status == 200:
            return str(answer["token"])
        wait = float(answer["wait"])
    except (ValueError, KeyError, TypeError):
        raise Offline(f"{host.url} is no desk of an event") from None
    raise Unwelcome(f"next attempt in {wait:.0f} s" if wait else "that is not the PIN", wait)


class Exchange:
    """Keeps the copy in a file, which this computer may change at any time, and the host's event equal."""

    def __init__(self, host: Host, arcade: str) -> None:
        self.host, self.arcade = host, arcade
        self.theirs: Event | None = None  # as the host had it last
        self._mark = ""  # of its text

    def fetch(self) -> Event:
        """The event of the host. Raises Offline or Unwelcome."""
        return self._send(News(self.arcade))[0]

    def run(self, path: Path) -> None:
        """Send what the copy has got, and take over what the host has. Raises Offline, Unwelcome or NotSaved."""
        theirs = self.theirs or self.fetch()
        ours = event_files.latest(path)
        if not event_files.same_event(theirs, ours):
            raise Unwelcome("it has another event now")
        sent = first_of(event_files.beyond(ours.journal, theirs.journal)[1])
        now = live.read(path, self.arcade)
        news = News(self.arcade, len(theirs.journal), mark_of(theirs.journal), sent, now)
        fresh, judged = self._send(news)
        if not event_files.same_event(fresh, ours):
            raise Unwelcome("it has another event now")
        if fresh != ours:
            event_files.update(path, lambda ours: _renewed(fresh, ours, sent if judged else ()))

    def _send(self, news: News) -> tuple[Event, bool]:
        """Send news. The event as the host has it, and false if it begins otherwise, so that nothing was taken."""
        more = {"If-None-Match": self._mark} if self._mark and not news.entries else {}
        status, mark, body = _ask(self.host, PATH, to_json(news), more)
        if status == 403:
            raise Unwelcome("it needs the PIN")
        if status not in (200, 304, 409):
            raise Offline(f"{self.host.url} answers with {status}")
        if status != 304 or self.theirs is None:
            try:
                self.theirs, self._mark = event_files.parse(body.decode()), mark
            except ValueError as reason:
                raise Offline(one_line(f"{self.host.url}: {reason}", LONG)) from None
        return self.theirs, status != 409


def _renewed(theirs: Event, ours: Event, sent: Sequence[Entry]) -> Event:
    """The host's event with what only the copy has; what was sent and is not there was refused."""
    common, own = event_files.beyond(ours.journal, theirs.journal)
    return event_files.merged(theirs, common, event_files.without(own, sent))


class EventLink:
    """An exchange that goes on in a thread. `trouble`: why there is none just now; empty while there is."""

    def __init__(self, path: Path, host: Host, arcade: str) -> None:
        self.path, self.trouble = path, ""
        self._exchange = Exchange(host, arcade)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="joined event", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """End it after a last exchange."""
        self._ended.set()
        self._thread.join(LONGEST)

    def _run(self) -> None:
        while True:
            ending = self._ended.is_set()
            version = event_files.version(self.path)
            pause = self._once()
            if ending:
                return
            until = time.monotonic() + pause
            while time.monotonic() < until and not self._ended.wait(LOOK):
                if pause == EVERY and event_files.version(self.path) != version:
                    break

    def _once(self) -> float:
        """One exchange; returns the seconds until the next one."""
        try:
            self._exchange.run(self.path)
        except Unwelcome as reason:
            return self._fails(f"{self._exchange.host.url}: {reason}", PATIENCE)
        except (Offline, NotSaved, ValueError) as reason:
            return self._fails(str(reason), AGAIN)
        if self.trouble:
            log.warning("%s: connected again", self._exchange.host.url)
        self.trouble = ""
        return EVERY

    def _fails(self, reason: str, pause: float) -> float:
        if not self.trouble:
            log.warning("%s", reason)
        self.trouble = reason
        return pause


def link_of(path: Path, arcade: str) -> EventLink | None:
    """The link of a copy, which begins at once; None for an event of this computer."""
    host = mirror.host_of(path)
    return EventLink(path, host, arcade) if host and arcade else None


def _ask(host: Host, path: str, body: str, more: Mapping[str, str] | None = None) -> tuple[int, str, bytes]:
    """Status, mark and text of an answer. Raises Offline."""
    headers = {
        "Content-Type": "application/json",
        "Authorization": f"Bearer {host.token}",
        "Origin": host.url.removesuffix("/"),
        **(more or {}),
    }
    until = time.monotonic() + LONGEST
    connection = HTTPConnection(host.address, host.port, timeout=WAIT)
    try:
        connection.request("POST", path, body.encode(), headers)
        answer = connection.getresponse()
        parts = [answer.read1(1 << 16)]
        while parts[-1]:
            if sum(map(len, parts)) > event_files.MAX_BYTES or time.monotonic() > until:
                raise Offline(f"{host.url} does not come to an end")
            parts.append(answer.read1(1 << 16))
        if answer.length:
            raise Offline(f"{host.url} has broken off")
        return answer.status, answer.headers.get("ETag", ""), b"".join(parts)
    except (OSError, HTTPException, ValueError) as reason:
        raise Offline(one_line(f"{host.url} cannot be reached: {str(reason) or type(reason).__name__}", LONG)) from None
    finally:
        connection.close()
