"""One phone's socket: receives its frames, sends it texts, and ends it when it is silent, floods or talks nonsense."""

import asyncio
from collections import deque

from aiohttp import WSMessage, WSMsgType, web

from pigaming_app.ui.input import phone_messages as protocol
from pigaming_app.ui.input.phones.roster import Roster
from pigaming_app.ui.web.refusals import RateMeter, Refusals

SILENT_SECONDS = 1.5  # without a message, after which a phone counts as unplugged; a page sends at least five a second
STALL_SECONDS = 0.05  # for messages that were waiting while this computer did nothing
CLOSE_SECONDS = 0.3  # for the farewell; then the connection is cut
MAX_TEXTS = 8  # waiting for a slow phone; older ones are dropped


class Connection:
    """The socket of the phone with this device number."""

    def __init__(self, roster: Roster, refusals: Refusals, number: int, peer: str) -> None:
        self.roster, self.refusals, self.number, self.peer = roster, refusals, number, peer
        self.socket = web.WebSocketResponse(
            timeout=CLOSE_SECONDS, autoping=False, compress=False, max_msg_size=protocol.MAX_FRAME
        )
        self.replaced = False  # by a new connection of the same phone
        self._texts: deque[str] = deque(maxlen=MAX_TEXTS)
        self._waiting = asyncio.Event()
        self._meter = RateMeter(protocol.MAX_RATE)

    def send(self, text: str) -> None:
        """Queue a text for the phone."""
        self._texts.append(text)
        self._waiting.set()

    async def serve(self, request: web.Request) -> None:
        """Receive frames until the phone leaves or is refused."""
        sender = asyncio.create_task(self._send_texts())
        try:
            code = await self._receive()
        finally:
            sender.cancel()
        if code:
            stop_reading(request)
            await self.close(code)
        if request.transport:
            request.transport.abort()

    async def close(self, code: int) -> None:
        """Close the socket with a reason that the page knows."""
        try:
            async with asyncio.timeout(CLOSE_SECONDS):
                await self.socket.close(code=code, drain=False)
        except (TimeoutError, OSError):
            pass  # it is cut instead

    async def _receive(self) -> int:
        """The reason for which the phone is refused, or 0 when it has left."""
        loop = asyncio.get_running_loop()
        while True:
            try:
                message = await self._next()
            except TimeoutError:
                return protocol.CLOSED_SILENT
            if message.type in (WSMsgType.CLOSE, WSMsgType.CLOSING, WSMsgType.CLOSED) or self.replaced:
                return 0
            if self._meter.exceeded(loop.time()):
                self.refusals.note(f"more than {protocol.MAX_RATE} messages in a second refused", self.peer)
                return protocol.CLOSED_FLOOD
            frame = message.data if message.type is WSMsgType.BINARY else b""
            if wish := protocol.parse_wish(frame):
                self.roster.wish(self.number, wish)
                continue
            touches = protocol.parse(frame)
            if touches is None:
                self.refusals.note("malformed or giant frame refused", self.peer)
                return protocol.CLOSED_MALFORMED
            if not self.roster.receive(self.number, touches):
                self.refusals.note("phone dropped while the arcade was busy", self.peer)
                return protocol.CLOSED_FLOOD

    async def _next(self) -> WSMessage:
        """The next message. Raises TimeoutError if the phone is silent, but not if this computer stalled meanwhile."""
        try:
            return await self.socket.receive(timeout=SILENT_SECONDS)
        except TimeoutError:
            return await self.socket.receive(timeout=STALL_SECONDS)

    async def _send_texts(self) -> None:
        while True:
            await self._waiting.wait()
            self._waiting.clear()
            while self._texts:
                try:
                    await self.socket.send_str(self._texts.popleft())
                except (ConnectionError, RuntimeError):
                    return  # closed; the receiver notices


def stop_reading(request: web.Request) -> None:
    """Leave what a peer still sends in the network's buffers, where it costs nothing, until the connection is cut."""
    if request.transport and not request.transport.is_closing():
        request.transport.pause_reading()
