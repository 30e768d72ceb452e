"""One phone's socket: receives its frames, sends it texts, and ends it when it is silent, floods or talks nonsense."""

import asyncio
import secrets
from collections import deque

from aiohttp import WSMessage, WSMsgType, web

from pigaming_app.ui.input import phone_messages as protocol
from pigaming_app.ui.input.phone_messages import Touches
from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.input.phones.refusals import RateMeter, Refusals

SILENT_SECONDS = 1.5  # without a message, after which a phone counts as unplugged; a page sends at least five a second
STALL_SECONDS = 0.05  # for messages that were waiting while this computer did nothing
CLOSE_SECONDS = 0.3  # for the farewell; then the connection is cut
MAX_TEXTS = 8  # waiting for a slow phone; older ones are dropped


class Connection:
    """The socket of the phone with this device number."""

    def __init__(self, phones: Phones, refusals: Refusals, number: int, peer: str) -> None:
        self.phones, self.refusals, self.number, self.peer = phones, refusals, number, peer
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
            touches = protocol.parse(message.data) if message.type is WSMsgType.BINARY else None
            if touches is None:
                self.refusals.note("malformed or giant frame refused", self.peer)
                return protocol.CLOSED_MALFORMED
            if not self.phones.receive(self.number, touches):
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


class PhoneSeats:
    """The connections by device number, and the tokens with which phones return to theirs."""

    MAX_TOKENS = 64  # phones remembered

    def __init__(self, phones: Phones, refusals: Refusals) -> None:
        self.phones, self.refusals = phones, refusals
        self.connections: dict[int, Connection] = {}
        self._numbers: dict[str, int] = {}  # device number by resume token, oldest first

    def admit(self, token: str, peer: str) -> tuple[Connection, str] | None:
        """A connection for a phone, and its new resume token; None if four others are connected."""
        number = self._numbers.pop(token, None)
        before = self.connections.get(number) if number is not None else None
        if before is None and self.phones.full:
            if number is not None:
                self._numbers[token] = number
            return None
        if before is not None and number is not None:  # its old connection has not noticed yet that it is gone
            before.replaced = True
            self.phones.receive(number, Touches())
        else:
            number = self.phones.connect(number)
        connection = Connection(self.phones, self.refusals, number, peer)
        self.connections[number] = connection
        resume = secrets.token_urlsafe(12)
        self._numbers[resume] = number
        for oldest in list(self._numbers)[: -self.MAX_TOKENS]:
            del self._numbers[oldest]
        return connection, resume

    def leave(self, connection: Connection) -> None:
        """The phone of a connection is gone, unless it has a newer one."""
        if not connection.replaced:
            self.connections.pop(connection.number, None)
            self.phones.disconnect(connection.number)
