"""The server of the page that makes a phone the camera. HTTPS: browsers give their camera to no other page."""

import asyncio
import re
from collections.abc import Callable, Mapping
from typing import Protocol

from aiohttp import WSMessage, WSMsgType, web

from pigaming_app.ui.web.certificate import Certificate
from pigaming_app.ui.web.socket import DeviceSocket, closed, stop_reading
from pigaming_app.ui.web.token_page import MAX_BODY, TokenPageServer

MAX_PICTURE = 2_000_000  # bytes
MAX_RATE = 300  # messages in a second: pictures of 120 Hz, an echo of each, and some
MAX_TEXTS = 16
SILENT_SECONDS = 3.0  # without a message; a page sends two a second
BUFFER = 262_144  # bytes, for pictures to come as fast as the network is
REFUSED, FLOOD, SILENT = 4000, 4001, 4004  # reasons that the page knows, with 4003: replaced
FILES = {
    "camera.css": ("phones/camera.css", "text/css"),
    "camera.js": ("phones/camera.js", "text/javascript"),
    "encoder.js": ("phones/encoder.js", "text/javascript"),
}
AUTHORITY = "pigaming.crt"
NAME = re.compile(r"[0-9a-f]{32}")  # of a phone for itself


class PictureSession(Protocol):
    """What the connection of a phone means. All calls are made in the server's thread."""

    def receive(self, message: bytes) -> int:
        """Use a message; the code with which to close the connection, or 0."""

    def gone(self) -> None:
        """The connection has ended."""


Joined = Callable[[str, Callable[[str], None], Callable[[int], None]], PictureSession]


class PhoneCameraServer(TokenPageServer):
    """Serves on a port of an address. `joined`: gets the name of a phone, and two functions, which any thread may
    call: one sends a text, one closes the connection with a code. `texts`: those of the page.
    """

    received = BUFFER
    page, socket, files, old = "camera.html", "pictures", FILES, "old"

    def __init__(
        self, address: str, port: int, token: str, certificate: Certificate, texts: Mapping[str, str], joined: Joined
    ) -> None:
        super().__init__("phone camera", address, port, token, texts, certificate.context)
        self.app.on_shutdown.append(self._close_all)
        self._joined = joined
        self._sockets: set[DeviceSocket] = set()
        self._files[AUTHORITY] = certificate.authority, "application/x-x509-ca-cert"

    @property
    def policy(self) -> str:
        """The page's worker and its picture, too."""
        return f"{super().policy}; worker-src 'self'; media-src blob:"

    # ---- in the server's thread

    async def connect(self, request: web.Request) -> web.WebSocketResponse:
        peer, phone = request.remote or "", request.query.get("phone", "")
        if not NAME.fullmatch(phone):
            self.refusals.note("phone without a name refused", peer)
            return await closed(request, REFUSED, MAX_BODY)
        socket = DeviceSocket(MAX_PICTURE, MAX_TEXTS, MAX_RATE, silent=SILENT_SECONDS)
        await socket.answer.prepare(request)
        self._sockets.add(socket)
        session = self._joined(
            phone, lambda text: self.call(socket.send, text), lambda code: self.call(socket.close_soon, code)
        )
        try:
            code = await socket.serve(lambda message: _received(message, session), lambda: FLOOD, SILENT)
            if code:
                self.refusals.note(f"phone closed with {code}", peer)
                stop_reading(request)
                await socket.close(code)
        finally:
            session.gone()
            self._sockets.discard(socket)
        if request.transport:
            request.transport.abort()
        return socket.answer

    async def _close_all(self, app: web.Application) -> None:
        await asyncio.gather(*(socket.close(1001) for socket in self._sockets))


def _received(message: WSMessage, session: PictureSession) -> int:
    return session.receive(message.data) if message.type is WSMsgType.BINARY else REFUSED
