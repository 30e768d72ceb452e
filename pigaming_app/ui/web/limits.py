"""How many connections the server takes, of all peers and of each."""

import asyncio
from typing import Any

from aiohttp import web

from pigaming_app.ui.web.refusals import RateMeter, Refusals

MAX_CONNECTIONS, MAX_OF_PEER = 160, 96  # a school may be behind one address: 31 phones, and pages that load
MAX_OPENED, OPENED_SECONDS = 200, 10.0  # connections that a peer may open in that time: five for each page


class ConnectionLimits:
    """Limits the connections of all peers and of each."""

    def __init__(self, server: web.Server, settings: dict[str, Any], refusals: Refusals) -> None:
        self.server, self.settings, self.refusals = server, settings, refusals
        self.open: dict[web.RequestHandler, str] = {}  # address of the peer of each connection
        self._opened: dict[str, RateMeter] = {}

    def handler(self) -> asyncio.Protocol:
        """A protocol for a new connection."""
        return _Guest(self)

    def admits(self, peer: str) -> bool:
        """True if a peer may open one more connection."""
        if len(self._opened) > MAX_CONNECTIONS:
            self._opened.clear()
        meter = self._opened.setdefault(peer, RateMeter(MAX_OPENED, OPENED_SECONDS))
        often = meter.exceeded(asyncio.get_running_loop().time())
        return not often and len(self.open) < MAX_CONNECTIONS and [*self.open.values()].count(peer) < MAX_OF_PEER


class _Guest(web.RequestHandler):
    """An HTTP connection that is cut at once if its peer has too many."""

    __slots__ = ("_guard",)

    def __init__(self, guard: ConnectionLimits) -> None:
        super().__init__(guard.server, loop=asyncio.get_running_loop(), **guard.settings)
        self._guard = guard

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        super().connection_made(transport)
        name = transport.get_extra_info("peername")
        peer = str(name[0]) if name else ""
        if self._guard.admits(peer):
            self._guard.open[self] = peer
        else:
            self._guard.refusals.note("too many connections refused", peer)
            self.force_close()

    def connection_lost(self, exc: BaseException | None) -> None:
        self._guard.open.pop(self, None)
        super().connection_lost(exc)
