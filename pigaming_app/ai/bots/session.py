"""One connection: what it may send, and what it is sent. Everybody may observe; who signs with a bot's key plays.

The first message of a connection is its `nonce`. A message of a bot is `SIGN JSON`: 64 hexadecimal digits, the
HMAC-SHA256 of the nonce followed by the JSON text, with the key of the bot; a blank; the text.
"""

import hmac
import secrets
from collections.abc import Callable
from typing import Annotated, Literal

from msgspec import Struct

from pigaming_app import __version__
from pigaming_app.ai.bots import brains, view
from pigaming_app.ai.bots.book import Name
from pigaming_app.ai.bots.line import FIELD, BotCommand, BotLine, SeatOfMatch
from pigaming_app.storage.parsing import ParseError
from pigaming_app.storage.schema import Finite, between, from_json

SIGN = 64  # hexadecimal digits
MALFORMED, WRONG_KEY, REPLACED = 4400, 4401, 4409  # codes of closed connections
LARGE = 2**53  # beyond it JavaScript has no whole numbers


class Play(Struct, forbid_unknown_fields=True):
    """The name of the bot that is connected."""

    type: Literal["play"]
    name: Name


class Act(Struct, forbid_unknown_fields=True):
    """A command for one seat."""

    type: Literal["act"]
    match: Annotated[int, between(0, LARGE)]
    seat: Annotated[int, between(0, 3)]
    tick: Annotated[int, between(0, LARGE)]
    linear: Finite = 0.0
    angular: Finite = 0.0
    fire: bool = False
    turbo: bool = False


class BotSession:
    """`send`: hands a text to the connection; `close`: ends it with a code; `ended`: called when it has ended."""

    def __init__(
        self,
        send: Callable[[str], object],
        close: Callable[[int], object],
        ended: "Callable[[BotSession], object]" = lambda session: None,
    ) -> None:
        self.send, self.close, self._ended = send, close, ended
        self.nonce = secrets.token_hex(16)
        self.name = ""  # of its bot; empty: it observes
        self.match = 0  # that it observes, by number
        self._line: BotLine | None = None
        self._key = b""
        send(view.text({"type": "hello", "version": __version__, "nonce": self.nonce, **FIELD}))

    def receive(self, text: str) -> int:
        """Handle a message; the code with which to close the connection, or 0."""
        sign, _, body = text.partition(" ")
        try:
            if self._line:
                return self._act(self._line, sign, body)
            return self._play(sign, from_json(body, Play).name, body)
        except (ParseError, ValueError):
            return MALFORMED

    def gone(self) -> None:
        """The connection has ended."""
        if self._line:
            self._line.detach(self.send)
        self._ended(self)

    def _play(self, sign: str, name: str, body: str) -> int:
        self._key = brains.book().keys.get(name, "").encode()
        if not self._signed(sign, body):
            return WRONG_KEY
        self.name, self._line = name, brains.line_of(name)
        self.send(view.text({"type": "welcome", "name": name}))
        self._line.attach(self.send, lambda: self.close(REPLACED))
        return 0

    def _act(self, line: BotLine, sign: str, body: str) -> int:
        known = brains.book().keys.get(self.name, "").encode() == self._key  # not removed since, nor given another key
        if not known or not self._signed(sign, body):
            return WRONG_KEY
        act = from_json(body, Act)
        command = BotCommand(act.tick, act.linear, act.angular, act.fire, act.turbo)
        line.receive(SeatOfMatch(act.match, act.seat), command)
        return 0

    def _signed(self, sign: str, body: str) -> bool:
        right = hmac.digest(self._key, (self.nonce + body).encode(), "sha256").hex() if self._key else ""
        return bool(right) and hmac.compare_digest(sign.encode(), right.encode())
