"""One WebSocket of a device: receives its messages within limits, sends it texts, and ends it for a reason."""

import asyncio
from collections import deque
from collections.abc import Callable
from contextlib import suppress

from aiohttp import WSMessage, WSMsgType, web

from pigaming_app.ui.web.refusals import RateMeter

CLOSE_SECONDS = 0.3  # for the farewell; then the connection is cut
STALL_SECONDS = 0.05  # for messages that were waiting while this computer did nothing
ENDS = (WSMsgType.CLOSE, WSMsgType.CLOSING, WSMsgType.CLOSED)


class DeviceSocket:
    """`most`: bytes of a message; `texts`: that wait for a slow device, older ones are dropped; `rate`: messages in a
    second. A device is gone that is silent for `silent` s, or that answers no ping, one every `heartbeat` s.
    """

    def __init__(
        self, most: int, texts: int, rate: int, *, silent: float | None = None, heartbeat: float | None = None
    ) -> None:
        self.answer = web.WebSocketResponse(
            timeout=CLOSE_SECONDS,
            heartbeat=heartbeat,
            autoping=heartbeat is not None,
            compress=False,
            max_msg_size=most,
        )
        self._silent = silent
        self._texts: deque[str] = deque(maxlen=texts)
        self._waiting = asyncio.Event()
        self._meter = RateMeter(rate)
        self._ends: set[asyncio.Task[None]] = set()

    def send(self, text: str) -> None:
        """Queue a text."""
        self._texts.append(text)
        self._waiting.set()

    def close_soon(self, code: int) -> None:
        """Close it for a reason that the device knows, without waiting for that."""
        task = asyncio.ensure_future(self.close(code))
        self._ends.add(task)
        task.add_done_callback(self._ends.discard)

    async def close(self, code: int) -> None:
        """Close it for a reason that the device knows."""
        with suppress(TimeoutError, OSError):  # it is cut instead
            async with asyncio.timeout(CLOSE_SECONDS):
                await self.answer.close(code=code, drain=False)

    async def serve(self, receive: Callable[[WSMessage], int], flooded: Callable[[], int], silent: int = 0) -> int:
        """Hand messages to `receive` until the device leaves, or is refused by its answer. The reason, or 0.

        `flooded`: is asked for the reason when messages come too fast; `silent`: that of a silent device.
        """
        sender, loop = asyncio.create_task(self._send_texts()), asyncio.get_running_loop()
        code = 0
        try:
            while not code:
                try:
                    message = await self._next()
                except TimeoutError:
                    return silent
                if message.type in ENDS:
                    return 0
                code = flooded() if self._meter.exceeded(loop.time()) else receive(message)
            return code
        finally:
            sender.cancel()

    async def _next(self) -> WSMessage:
        """The next message. Raises TimeoutError if the device is silent, but not if this computer stalled meanwhile."""
        try:
            return await self.answer.receive(timeout=self._silent)
        except TimeoutError:
            return await self.answer.receive(timeout=STALL_SECONDS)

    async def _send_texts(self) -> None:
        while True:
            await self._waiting.wait()
            self._waiting.clear()
            while self._texts:
                try:
                    await self.answer.send_str(self._texts.popleft())
                except (ConnectionError, RuntimeError):
                    return  # closed; the receiver notices


def stop_reading(request: web.Request) -> None:
    """Leave what a peer still sends in the network's buffers, where it costs nothing, until the connection is cut."""
    if request.transport and not request.transport.is_closing():
        request.transport.pause_reading()


async def closed(request: web.Request, code: int, most: int) -> web.WebSocketResponse:
    """A socket that is closed at once, for a reason that the page knows."""
    socket = DeviceSocket(most, 1, 1)
    await socket.answer.prepare(request)
    stop_reading(request)
    await socket.close(code)
    if request.transport:
        request.transport.abort()  # over TLS, the peer would wait for a farewell that is not read
    return socket.answer
