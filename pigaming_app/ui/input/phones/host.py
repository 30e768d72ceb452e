"""Phones switched on and off by the operator; the server and its libraries are imported when it is on."""

import time
from collections.abc import Callable, Mapping
from importlib.util import find_spec
from typing import TYPE_CHECKING

from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.input.phones.network import PhonesUnavailable, chosen, networks

if TYPE_CHECKING:
    from pigaming_app.ui.input.phones.server import PhoneServer

MODULES = ("aiohttp", "segno", "ifaddr")  # of the extra `phones`
CHECK_SECONDS = 3.0  # s between two looks at the network, and two attempts to start


class PhoneHost:
    """The server while phones are on. `trouble`: why phones cannot join, or None."""

    def __init__(self, phones: Phones, clock: Callable[[], float] = time.monotonic) -> None:
        self.phones, self._clock = phones, clock
        self.server: PhoneServer | None = None
        self.trouble: PhonesUnavailable | None = None
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
        """Follow the settings: each start has a new token. Does nothing if nothing has changed."""
        asked = (network, port) if on else None
        if asked != self._asked:
            self.close()
            self._asked = asked
            self._start(texts)
        elif asked and self._clock() - self._checked_at > CHECK_SECONDS:
            self._check(texts)
        if self.server:
            self.server.texts = texts

    def close(self) -> None:
        """Stop the server; all phones are unplugged."""
        if self.server:
            self.server.stop()
        self.server = self.trouble = self._asked = None

    def _start(self, texts: Mapping[str, str]) -> None:
        self._checked_at = self._clock()
        if self._asked is None:
            return
        name, port = self._asked
        self.trouble = None
        try:
            require_libraries()
            from pigaming_app.ui.input.phones.server import PhoneServer

            server = PhoneServer(self.phones, chosen(name, networks()).address, port, texts)
            server.start()
            self.server = server
        except PhonesUnavailable as trouble:
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
        except PhonesUnavailable as trouble:
            self.trouble = trouble
            return
        if address != self.server.address:
            self.server.stop()
            self.server = None
            self._start(texts)


def require_libraries() -> None:
    """Raises PhonesUnavailable without the extra `phones`."""
    if not all(find_spec(module) for module in MODULES):
        raise PhonesUnavailable("missing")
