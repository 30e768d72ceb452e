"""A server of WebSockets for programs on the local network: texts both ways, each connection with a session."""

import asyncio
from collections.abc import Callable
from typing import Protocol

from aiohttp import WSMessage, WSMsgType, web

from pigaming_app.ui.web.listener import Listener
from pigaming_app.ui.web.socket import CLOSE_SECONDS, DeviceSocket

HEARTBEAT = 4.0  # s between two pings; who does not answer within half of it is gone
MAX_TEXT = 1024  # bytes that a program may send at once
MAX_WAITING = 64  # texts for a slow program; older ones are dropped
MAX_SOCKETS = 32
NO_TEXT, TOO_FAST, FULL = 4400, 4429, 4503  # codes of closed connections


class SocketSession(Protocol):
    """What a connection means. All calls are made in the server's thread."""

    def receive(self, text: str) -> int:
        """Handle a text; the code with which to close the connection, or 0."""

    def gone(self) -> None:
        """The connection has ended."""


NewSession = Callable[[Callable[[str], None], Callable[[int], None]], SocketSession]


class SocketServer(Listener):
    """Opens a session for each connection. `opened`: gets two functions, which any thread may call: one sends a text,
    one closes the connection with a code. `rate`: texts in a second that a program may send.
    """

    policy = "connect-src 'none'"

    def __init__(self, name: str, address: str, port: int, opened: NewSession, rate: int) -> None:
        super().__init__(name, address, port, MAX_TEXT, CLOSE_SECONDS)
        self.app.router.add_get("/", self._get)
        self.app.on_shutdown.append(self._close_all)
        self._opened, self._rate = opened, rate
        self._sockets: set[DeviceSocket] = set()

    @property
    def url(self) -> str:
        """The address for programs."""
        return f"ws://{self.host}/"

    # ---- in the server's thread

    async def _get(self, request: web.Request) -> web.StreamResponse:
        if not web.WebSocketResponse().can_prepare(request):
            raise web.HTTPUpgradeRequired
        socket = DeviceSocket(MAX_TEXT, MAX_WAITING, self._rate, heartbeat=HEARTBEAT)
        await socket.answer.prepare(request)
        if len(self._sockets) >= MAX_SOCKETS:
            self.refusals.note("too many programs refused", request.remote or "")
            await socket.close(FULL)
            return socket.answer
        self._sockets.add(socket)
        session = self._opened(
            lambda text: self.call(socket.send, text), lambda code: self.call(socket.close_soon, code)
        )
        try:
            code = await socket.serve(lambda message: _received(message, session), lambda: TOO_FAST)
            if code:
                await socket.close(code)
                self.refusals.note(f"program closed with {code}", request.remote or "")
        finally:
            session.gone()
            self._sockets.discard(socket)
        return socket.answer

    async def _close_all(self, app: web.Application) -> None:
        await asyncio.gather(*(socket.close(1001) for socket in self._sockets))


def _received(message: WSMessage, session: SocketSession) -> int:
    return session.receive(message.data) if message.type is WSMsgType.TEXT else NO_TEXT
