"""The server of the page that makes a phone the camera. HTTPS: browsers give their camera to no other page.

Everything needs the token in the address, which is in the QR code; a socket is opened only by a page of this server.
"""

import asyncio
import hmac
import html
import json
import re
from collections.abc import Callable, Mapping
from typing import Protocol

from aiohttp import WSMessage, WSMsgType, web

from pigaming_app import ASSETS
from pigaming_app.ui.web.certificate import Certificate
from pigaming_app.ui.web.listener import Handler, Listener
from pigaming_app.ui.web.socket import CLOSE_SECONDS, DeviceSocket, closed, stop_reading

MAX_BODY = 1024  # bytes
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
    "oxanium.woff2": ("fonts/oxanium-latin-700-normal.woff2", "font/woff2"),
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


class PhoneCameraServer(Listener):
    """Serves on a port of an address. `joined`: gets the name of a phone, and two functions, which any thread may
    call: one sends a text, one closes the connection with a code. `texts`: those of the page.
    """

    received = BUFFER

    def __init__(
        self,
        address: str,
        port: int,
        token: str,
        certificate: Certificate,
        texts: Mapping[str, str],
        joined: Joined,
    ) -> None:
        super().__init__("phone camera", address, port, MAX_BODY, CLOSE_SECONDS, certificate.context)
        self.app.middlewares.append(self._with_token)
        self.app.router.add_get("/{token}", self._get_page)
        self.app.router.add_get("/{token}/pictures", self._get_socket)
        self.app.router.add_get("/{token}/{file}", self._get_file)
        self.app.on_shutdown.append(self._close_all)
        self.token, self.texts, self._joined = token, texts, joined
        self._sockets: set[DeviceSocket] = set()
        self._files = {name: ((ASSETS / path).read_bytes(), kind) for name, (path, kind) in FILES.items()}
        self._files[AUTHORITY] = certificate.authority, "application/x-x509-ca-cert"
        self._page = (ASSETS / "phones" / "camera.html").read_text(encoding="utf-8")

    @property
    def url(self) -> str:
        """The address for phones, with the token."""
        return f"{self.scheme}://{self.host}/{self.token}"

    @property
    def policy(self) -> str:
        """Sockets, the page's styles and its worker."""
        return (
            f"connect-src 'self' wss://{self.host}; style-src 'self'; worker-src 'self'; img-src data:; "
            "media-src blob:; form-action 'none'"
        )

    # ---- in the server's thread

    @web.middleware
    async def _with_token(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Refuse requests without the token."""
        first = request.path.strip("/").partition("/")[0].lower().encode(errors="replace")
        if not hmac.compare_digest(first, self.token.encode()):
            return self.refuse("wrong token refused", request)
        return await handler(request)

    def refuse(self, kind: str, request: web.Request) -> web.Response:
        """Note a refusal; a sentence for a phone that has scanned an old code."""
        answer = super().refuse(kind, request)
        sentence = html.escape(self.texts.get("old", ""))
        answer.text = f'<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><p>{sentence}</p>'
        answer.content_type = "text/html"
        return answer

    async def _get_page(self, request: web.Request) -> web.StreamResponse:
        texts = json.dumps(dict(self.texts)).replace("<", "\\u003c")
        page = self._page.replace("{token}", self.token).replace("{texts}", texts)
        return web.Response(text=page, content_type="text/html")

    async def _get_file(self, request: web.Request) -> web.StreamResponse:
        if request.match_info["file"] not in self._files:
            raise web.HTTPNotFound
        body, kind = self._files[request.match_info["file"]]
        return web.Response(body=body, content_type=kind)

    async def _get_socket(self, request: web.Request) -> web.StreamResponse:
        peer, phone = request.remote or "", request.query.get("phone", "")
        if not self.own(request):
            return self.refuse("foreign origin refused", request)
        if not web.WebSocketResponse().can_prepare(request):
            raise web.HTTPBadRequest
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
