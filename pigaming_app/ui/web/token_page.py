"""A server of one page behind a token in its address, with a WebSocket: what phones scan the code of.

Everything needs the token; a socket is opened only by a page of this server.
"""

import base64
import hashlib
import hmac
import html
import json
import ssl
from collections.abc import Mapping

from aiohttp import web

from pigaming_app import ASSETS
from pigaming_app.ui.web.listener import Handler, Listener
from pigaming_app.ui.web.socket import CLOSE_SECONDS

MAX_BODY = 1024  # bytes
REFUSAL_STYLE = (
    "body{background:#000;color:#e2eeff;font:24px sans-serif;text-align:center;margin:35vh 8vw 0;text-wrap:balance}"
)
STYLE_HASH = base64.b64encode(hashlib.sha256(REFUSAL_STYLE.encode()).digest()).decode()
META = '<meta name="viewport" content="width=device-width"><meta charset="utf-8"><link rel="icon" href="data:,">'
FONT = {"oxanium.woff2": ("fonts/oxanium-latin-700-normal.woff2", "font/woff2")}


class TokenPageServer(Listener):
    """Serves on a port of an address; 0: any free one.

    `token`, `texts`: of the page. `tls`: certificate and key, for HTTPS.
    """

    page: str  # file in assets/phones
    socket: str  # last part of the socket's address
    files: Mapping[str, tuple[str, str]]  # what the page loads: path in assets, and content type
    old: str  # key of the text for somebody with a token of before

    def __init__(
        self,
        name: str,
        address: str,
        port: int,
        token: str,
        texts: Mapping[str, str],
        tls: ssl.SSLContext | None = None,
    ) -> None:
        super().__init__(name, address, port, MAX_BODY, CLOSE_SECONDS, tls)
        self.app.middlewares.append(self._with_token)
        self.app.router.add_get("/{token}", self._get_page)
        self.app.router.add_get(f"/{{token}}/{self.socket}", self._get_socket)
        self.app.router.add_get("/{token}/{file}", self._get_file)
        self.token, self.texts = token, texts
        self._files = {
            key: ((ASSETS / path).read_bytes(), kind) for key, (path, kind) in {**self.files, **FONT}.items()
        }
        self._page = (ASSETS / "phones" / self.page).read_text(encoding="utf-8")

    @property
    def url(self) -> str:
        """The address for phones, with the token."""
        return f"{self.scheme}://{self.host}/{self.token}"

    @property
    def policy(self) -> str:
        """The socket, and the page's styles."""
        socket = f"{'wss' if self.scheme == 'https' else 'ws'}://{self.host}"
        style = f"style-src 'self' 'sha256-{STYLE_HASH}'"
        return f"connect-src 'self' {socket}; {style}; img-src data:; form-action 'none'"

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
        sentence = html.escape(self.texts.get(self.old, ""))
        answer.text = f"<!doctype html>{META}<style>{REFUSAL_STYLE}</style><p>{sentence}</p>"
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
        if not self.own(request):
            return self.refuse("foreign origin refused", request)
        if not web.WebSocketResponse().can_prepare(request):
            raise web.HTTPBadRequest
        return await self.connect(request)

    async def connect(self, request: web.Request) -> web.WebSocketResponse:
        """Serve a socket of the page until it ends; its answer."""
        raise NotImplementedError
