"""Phones switched on and off by the operator; the server and its libraries are imported when it is on."""

import time
from collections.abc import Callable, Mapping
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.input.phones import memory
from pigaming_app.ui.input.phones.roster import Roster
from pigaming_app.ui.web.network import ServerUnavailable, chosen, networks

if TYPE_CHECKING:
    from pigaming_app.ui.input.phones.server import PhoneServer

MODULES = ("aiohttp", "segno", "ifaddr")  # of the extra `phones`
CHECK_SECONDS = 3.0  # s between two looks at the network, and two attempts to start


class PhoneHost:
    """The server while phones are on. `trouble`: why phones cannot join, or None.

    `roster`: all phones; `data`: the folder where they are kept over a restart of the arcade, if anywhere.
    """

    def __init__(
        self, phones: Phones, clock: Callable[[], float] = time.monotonic, data: Callable[[], Path] | None = None
    ) -> None:
        self.phones, self._clock, self._data = phones, clock, data
        self.roster = Roster(phones)
        self._token = ""  # of the page, as long as phones are on
        self.server: PhoneServer | None = None
        self.trouble: ServerUnavailable | None = None
        self._asked: tuple[str, int] | None = None  # network and port of the settings; None: phones are off
        self._checked_at = 0.0

    @property
    def on(self) -> bool:
        """True if the operator has switched phones on."""
        return self._asked is not None

    @property
    def url(self) -> str:
        """The address for phones; empty if they cannot join."""
        return self.server.url if self.server and not self.trouble else ""

    def switch(self, on: bool, network: str, port: int, texts: Mapping[str, str]) -> None:
        """Follow the settings: phones find the same address until they are switched off. Does nothing if nothing has
        changed.
        """
        asked = (network, port) if on else None
        if asked != self._asked:
            first = self._asked is None
            self._stop()
            self._asked = asked
            if not on:
                self._forget()
            elif first:
                self._remember()
            self._start(texts)
        elif asked and self._clock() - self._checked_at > CHECK_SECONDS:
            self._check(texts)
        if self.server:
            self.server.texts = texts

    def renew(self) -> None:
        """A new address: all phones have to scan the new code, and nobody is banned."""
        asked, texts = self._asked, self.server.texts if self.server else {}
        self._stop()
        self._forget()
        self._asked = asked
        self._start(texts)

    def close(self) -> None:
        """The arcade ends: all phones are unplugged, and kept for its next start."""
        if self._data and self._token:
            memory.save(self._data(), self.roster.hall(self._token))
        self._stop()

    def _stop(self) -> None:
        if self.server:
            self.server.stop()
        self.server = self.trouble = self._asked = None

    def _remember(self) -> None:
        """What the last run kept, if it ended with phones on."""
        if self._data:
            hall = memory.load(self._data())
            self._token = hall.page
            self.roster.restore(hall)

    def _forget(self) -> None:
        self._token = ""
        self.roster.clear()
        if self._data:
            memory.forget(self._data())

    def _start(self, texts: Mapping[str, str]) -> None:
        self._checked_at = self._clock()
        if self._asked is None:
            return
        name, port = self._asked
        self.trouble = None
        try:
            require_libraries()
            from pigaming_app.ui.input.phones.server import PhoneServer

            address = chosen(name, networks()).address
            keep = partial(memory.save, self._data()) if self._data else None
            server = PhoneServer(self.phones, address, port, texts, self.roster, self._token, keep)
            server.start()
            self.server, self._token = server, server.token
        except ServerUnavailable as trouble:
            self.trouble = trouble

    def _check(self, texts: Mapping[str, str]) -> None:
        """Notice a network that is gone or has another address; try again after a failure."""
        self._checked_at = self._clock()
        if self.server is None or self._asked is None:
            self._start(texts)
            return
        try:
            address = chosen(self._asked[0], networks()).address
            self.trouble = None
        except ServerUnavailable as trouble:
            self.trouble = trouble
            return
        if address != self.server.address:
            self.server.stop()
            self.server = None
            self._start(texts)


def require_libraries() -> None:
    """Raises ServerUnavailable without the extra `phones`."""
    if not all(find_spec(module) for module in MODULES):
        raise ServerUnavailable("missing")
