"""How an arcade on another computer joins the event at the desk: by the PIN once, then by a token.

A token is signed with the PIN's hash, so that it outlasts a restart, and ends when the PIN is set anew.
"""

import hmac
import logging
import secrets
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from pigaming_app.ai.brain_files import is_path
from pigaming_app.events import event_files
from pigaming_app.events.changes import live
from pigaming_app.events.event import Event
from pigaming_app.events.journal import Added, Entry, Substituted
from pigaming_app.events.network.news import LOGIN, PATH, Login, News, Outdated, news_of, with_news
from pigaming_app.storage.pin import PinFile
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.schema import from_json, to_json
from pigaming_app.ui.web.server import WebReply, WebRequest, tagged

LASTS = 30 * 86_400.0  # s
JSON = "application/json"

log = logging.getLogger("pigaming")


class Joining:
    """Answers other arcades. `event`: the one at the desk; `clock`: s since the epoch."""

    def __init__(
        self, path: Path, pin: PinFile, event: Callable[[], Event], clock: Callable[[], float] = time.time
    ) -> None:
        self.path, self.pin, self._event, self._clock = path, pin, event, clock
        self._text: tuple[Event, bytes] | None = None  # of the event that was sent last

    def __call__(self, request: WebRequest) -> WebReply:
        """The answer to a request below PATH. Only a program sends one with this type and origin, no other site."""
        if request.method != "POST" or request.path not in (PATH, LOGIN):
            return WebReply(status=404)
        if not request.own or request.headers.get("content-type") != JSON:
            return WebReply(status=400)
        try:
            if request.path == LOGIN:
                return self._log_in(from_json(request.body, Login).pin, request.peer)
            if not self._admits(request.headers.get("authorization", "").removeprefix("Bearer ")):
                return WebReply(status=403)
            news = news_of(request.body)
            return self._exchanged(request, replace(news, entries=tuple(filter(_is_usable, news.entries))))
        except ValueError:
            return WebReply(status=400)

    def _log_in(self, pin: str, peer: str) -> WebReply:
        if self.pin.check(pin, peer):
            text = f"{self._clock():.0f}-{secrets.token_hex(8)}"
            return _json({"token": f"{text}-{self.pin.signature(text)}"})
        return _json({"wait": self.pin.wait(peer)}, 403)

    def _admits(self, token: str) -> bool:
        text, _, signature = token.rpartition("-")
        begun, _, _ = text.partition("-")
        right = self.pin.signature(text)
        if not right or not hmac.compare_digest(right.encode(), signature.encode(errors="replace")):
            return False
        return float(begun) > self._clock() - LASTS

    def _exchanged(self, request: WebRequest, news: News) -> WebReply:
        """Take over what an arcade has sent; the event for it, unless it has this one."""
        status = 200
        try:
            if news.entries and with_news(self._event(), news) is not self._event():
                event_files.update(self.path, lambda event: with_news(event, news))
        except Outdated:
            status = 409
        except (ValueError, NotSaved) as reason:
            log.warning("%s", reason)
            return WebReply(status=503)
        if news.live:
            live.write(self.path, news.live)
        else:
            live.remove(self.path, news.arcade)
        event = self._event()
        if self._text is None or self._text[0] is not event:
            self._text = event, event_files.to_text(event).encode()
        reply = WebReply(self._text[1], status, JSON)
        return tagged(request, reply)


def _is_usable(entry: Entry) -> bool:
    """False for an AI in a file of the other computer, which is none here."""
    match entry:
        case Added(entrant):
            return not is_path(entrant.brain)
        case Substituted(_, brain):
            return not is_path(brain)
    return True


def _json(value: object, status: int = 200) -> WebReply:
    return WebReply(to_json(value).encode(), status, JSON)
