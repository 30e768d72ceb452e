"""One phone's socket, which ends when it is silent, floods or talks nonsense."""

from aiohttp import WSMessage, WSMsgType, web

from pigaming_app.ui.input import phone_messages as protocol
from pigaming_app.ui.input.phones.roster import Roster
from pigaming_app.ui.web.refusals import Refusals
from pigaming_app.ui.web.socket import DeviceSocket, stop_reading

SILENT_SECONDS = 1.5  # without a message, after which a phone counts as unplugged; a page sends at least five a second
MAX_TEXTS = 8  # waiting for a slow phone; older ones are dropped


class Connection(DeviceSocket):
    """The socket of the phone with this device number."""

    def __init__(self, roster: Roster, refusals: Refusals, number: int, peer: str) -> None:
        super().__init__(protocol.MAX_FRAME, MAX_TEXTS, protocol.MAX_RATE, silent=SILENT_SECONDS)
        self.roster, self.refusals, self.number, self.peer = roster, refusals, number, peer
        self.replaced = False  # by a new connection of the same phone

    async def play(self, request: web.Request) -> None:
        """Receive frames until the phone leaves or is refused."""
        code = await self.serve(self._receive, self._flooded, protocol.CLOSED_SILENT)
        if code and not self.replaced:
            stop_reading(request)
            await self.close(code)
        if request.transport:
            request.transport.abort()

    def _receive(self, message: WSMessage) -> int:
        """Act on a frame; the reason for which the phone is refused, or 0."""
        if self.replaced:
            return protocol.CLOSED_REPLACED
        frame = message.data if message.type is WSMsgType.BINARY else b""
        if wish := protocol.parse_wish(frame):
            self.roster.wish(self.number, wish)
            return 0
        touches = protocol.parse(frame)
        if touches is None:
            self.refusals.note("malformed or giant frame refused", self.peer)
            return protocol.CLOSED_MALFORMED
        if not self.roster.receive(self.number, touches):
            self.refusals.note("phone dropped while the arcade was busy", self.peer)
            return protocol.CLOSED_FLOOD
        return 0

    def _flooded(self) -> int:
        self.refusals.note(f"more than {protocol.MAX_RATE} messages in a second refused", self.peer)
        return protocol.CLOSED_FLOOD
