"""A server of WebSockets for programs on the local network: texts both ways, each connection with a session."""

import asyncio
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import Protocol

from aiohttp import WSMsgType, web

from pigaming_app.ui.web.listener import Listener
from pigaming_app.ui.web.refusals import RateMeter

CLOSE_SECONDS = 0.3  # for the farewell; then the connection is cut
HEARTBEAT = 4.0  # s between two pings; who does not answer within half of it is gone
MAX_TEXT = 1024  # bytes that a program may send at once
MAX_WAITING = 64  # texts for a slow program; older ones are dropped
MAX_SOCKETS = 32
TOO_FAST, FULL = 4429, 4503  # codes of closed connections


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
        self._sockets: set[_Socket] = set()

    @property
    def url(self) -> str:
        """The address for programs."""
        return f"ws://{self.host}/"

    # ---- in the server's thread

    async def _get(self, request: web.Request) -> web.StreamResponse:
        if not web.WebSocketResponse().can_prepare(request):
            raise web.HTTPUpgradeRequired
        socket = _Socket(self._rate)
        await socket.answer.prepare(request)
        if len(self._sockets) >= MAX_SOCKETS:
            self.refusals.note("too many programs refused", request.remote or "")
            await socket.end(FULL)
            return socket.answer
        self._sockets.add(socket)
        session = self._opened(
            lambda text: self.call(socket.send, text), lambda code: self.call(socket.close_soon, code)
        )
        try:
            code = await socket.serve(session)
            if code:
                self.refusals.note(f"program closed with {code}", request.remote or "")
        finally:
            session.gone()
            self._sockets.discard(socket)
        return socket.answer

    async def _close_all(self, app: web.Application) -> None:
        await asyncio.gather(*(socket.end(1001) for socket in self._sockets))


class _Socket:
    def __init__(self, rate: int) -> None:
        self.answer = web.WebSocketResponse(
            timeout=CLOSE_SECONDS, heartbeat=HEARTBEAT, compress=False, max_msg_size=MAX_TEXT
        )
        self._texts: deque[str] = deque(maxlen=MAX_WAITING)
        self._waiting = asyncio.Event()
        self._meter = RateMeter(rate)
        self._ends: set[asyncio.Task[None]] = set()

    def send(self, text: str) -> None:
        self._texts.append(text)
        self._waiting.set()

    def close_soon(self, code: int) -> None:
        task = asyncio.ensure_future(self.end(code))
        self._ends.add(task)
        task.add_done_callback(self._ends.discard)

    async def serve(self, session: SocketSession) -> int:
        """Receive until the program leaves or is refused; the code of the latter, or 0."""
        sender, loop = asyncio.create_task(self._send_texts()), asyncio.get_running_loop()
        code = 0
        try:
            async for message in self.answer:
                if message.type is not WSMsgType.TEXT:
                    code = 4400
                elif self._meter.exceeded(loop.time()):
                    code = TOO_FAST
                else:
                    code = session.receive(message.data)
                if code:
                    break
        finally:
            sender.cancel()
        if code:
            await self.end(code)
        return code

    async def end(self, code: int) -> None:
        with suppress(TimeoutError, OSError):
            async with asyncio.timeout(CLOSE_SECONDS):
                await self.answer.close(code=code, drain=False)

    async def _send_texts(self) -> None:
        while True:
            await self._waiting.wait()
            self._waiting.clear()
            while self._texts:
                try:
                    await self.answer.send_str(self._texts.popleft())
                except (ConnectionError, RuntimeError):
                    return  # closed; the receiver notices
