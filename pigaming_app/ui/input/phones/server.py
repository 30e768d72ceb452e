"""The server of the phones' page and sockets.

Everything needs the session's token, which is in the QR code; sockets opened by pages of another origin are refused. No
refusal costs more than a few bytes, and none is waited for: the arcade only ever reads queues.
"""

import asyncio
import base64
import hashlib
import hmac
import html
import json
import secrets
from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import suppress

from aiohttp import web

from pigaming_app import ASSETS
from pigaming_app.ui.input import phone_messages as protocol
from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.input.phones.connection import Connection
from pigaming_app.ui.input.phones.memory import Hall
from pigaming_app.ui.input.phones.roster import Refusal, Roster
from pigaming_app.ui.web.listener import Handler, Listener
from pigaming_app.ui.web.socket import CLOSE_SECONDS, closed

ALPHABET = "abcdefghjkmnpqrstuvwxyz23456789"  # without signs that look alike: the address may be typed
TOKEN_LENGTH = 10  # 49 bits, guessed over a network within one session
MAX_BODY = 1024  # bytes
KEEP_SECONDS = 2.0  # for which a phone waits at most until its token is on the disk
CLOSED: dict[Refusal, int] = {"full": protocol.CLOSED_FULL, "removed": protocol.CLOSED_REMOVED}
FILES = {
    "page.css": ("phones/page.css", "text/css"),
    "hall.css": ("phones/hall.css", "text/css"),
    "page.js": ("phones/page.js", "text/javascript"),
    "hall.js": ("phones/hall.js", "text/javascript"),
    "awake.mp4": ("phones/awake.mp4", "video/mp4"),
    "awake.webm": ("phones/awake.webm", "video/webm"),
    "oxanium.woff2": ("fonts/oxanium-latin-700-normal.woff2", "font/woff2"),
}
REFUSAL_STYLE = (
    "body{background:#000;color:#e2eeff;font:24px sans-serif;text-align:center;margin:35vh 8vw 0;text-wrap:balance}"
)
STYLE_HASH = base64.b64encode(hashlib.sha256(REFUSAL_STYLE.encode()).digest()).decode()


class PhoneServer(Listener):
    """Serves `phones` on a port of an address. `texts`: the texts of the page, in the language of the screen.

    `roster`: decides who plays; `token`: of the page, empty: a new one; `keep`: writes what a restart needs.
    """

    def __init__(
        self,
        phones: Phones,
        address: str,
        port: int,
        texts: Mapping[str, str],
        roster: Roster | None = None,
        token: str = "",
        keep: Callable[[Hall], None] | None = None,
    ) -> None:
        super().__init__("phones", address, port, MAX_BODY, CLOSE_SECONDS)
        self.app.middlewares.append(self._with_token)
        self.app.router.add_get("/{token}", self._get_page)
        self.app.router.add_get("/{token}/pad", self._get_socket)
        self.app.router.add_get("/{token}/{file}", self._get_file)
        self.app.cleanup_ctx.append(self._keep_always)
        self.app.on_shutdown.append(self._close_all)
        self.phones, self.texts = phones, texts
        self.roster = roster or Roster(phones)
        self.token = token or "".join(secrets.choice(ALPHABET) for _ in range(TOKEN_LENGTH))
        self.visited = False  # whether a page was asked for with the right token
        self.connections: dict[int, Connection] = {}  # by device number
        self._keep, self._kept, self._to_keep = keep, Hall(), asyncio.Event()
        self._written = asyncio.Condition()  # notified when that is done
        self._files = {name: ((ASSETS / path).read_bytes(), kind) for name, (path, kind) in FILES.items()}
        self._page = (ASSETS / "phones" / "page.html").read_text(encoding="utf-8")

    @property
    def url(self) -> str:
        """The address for phones, with the token."""
        return f"http://{self.host}/{self.token}"

    @property
    def policy(self) -> str:
        """Sockets, the page's styles, and the videos in it."""
        return (
            f"connect-src 'self' ws://{self.host}; style-src 'self' 'sha256-{STYLE_HASH}'; img-src data:; "
            "media-src data:; form-action 'none'"
        )

    def start(self) -> None:
        super().start()
        self.phones.send = self._send
        self.roster.changed = lambda: self.call(self._to_keep.set)
        self.roster.expel = lambda number, why: self.call(self._expel, number, why)

    def stop(self) -> None:
        self.phones.send = lambda number, text: None
        self.roster.changed, self.roster.expel = lambda: None, lambda number, why: None
        super().stop()

    def _send(self, number: int, text: str) -> None:
        """Hand a text to the server's thread; a phone that has just gone does not get it."""
        self.call(self._deliver, number, text)

    # ---- in the server's thread

    def _deliver(self, number: int, text: str) -> None:
        if connection := self.connections.get(number):
            connection.send(text)

    def _expel(self, number: int, why: Refusal) -> None:
        """Close the socket of a phone that the roster has sent away."""
        if connection := self.connections.pop(number, None):
            connection.replaced = True
            connection.close_soon(CLOSED[why])

    async def _close_all(self, app: web.Application) -> None:
        await asyncio.gather(*(one.close(1001) for one in self.connections.values()))

    async def _keep_always(self, app: web.Application) -> AsyncIterator[None]:
        """Write what a restart needs whenever it has changed, as long as the server runs."""
        keeper = asyncio.create_task(self._keep_changes())
        yield
        keeper.cancel()

    async def _keep_changes(self) -> None:
        """In a thread, so that no phone waits for the disk."""
        while self._keep:
            await self._to_keep.wait()
            self._to_keep.clear()
            hall = self.roster.hall(self.token)
            if hall != self._kept:
                await asyncio.to_thread(self._keep, hall)
            self._kept = hall
            async with self._written:
                self._written.notify_all()

    async def _until_kept(self, number: int) -> None:
        """Wait until the token of a phone is on the disk, so that a restart knows every token that a phone has."""
        guest = self.roster.guest(number)
        with suppress(TimeoutError):
            async with asyncio.timeout(KEEP_SECONDS), self._written:
                while self._keep and guest and all(one.token != guest.token for one in self._kept.phones):
                    await self._written.wait()

    @web.middleware
    async def _with_token(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Refuse requests without the token."""
        if not hmac.compare_digest(_first_part(request.path), self.token.encode()):
            return self.refuse("wrong token refused", request)
        return await handler(request)

    def refuse(self, kind: str, request: web.Request) -> web.Response:
        """Note a refusal; a sentence for a phone that has scanned an old code."""
        answer = super().refuse(kind, request)
        sentence = html.escape(self.texts.get("page_old", ""))
        meta = (
            '<meta name="viewport" content="width=device-width"><meta charset="utf-8"><link rel="icon" href="data:,">'
        )
        answer.text = f"<!doctype html>{meta}<style>{REFUSAL_STYLE}</style><p>{sentence}</p>"
        answer.content_type = "text/html"
        return answer

    async def _get_page(self, request: web.Request) -> web.StreamResponse:
        self.visited = True
        texts = json.dumps(dict(self.texts)).replace("<", "\\u003c")
        page = self._page.replace("{token}", self.token).replace("{texts}", texts)
        return web.Response(text=page, content_type="text/html")

    async def _get_file(self, request: web.Request) -> web.StreamResponse:
        if request.match_info["file"] not in self._files:
            raise web.HTTPNotFound
        body, kind = self._files[request.match_info["file"]]
        return web.Response(body=body, content_type=kind)

    async def _get_socket(self, request: web.Request) -> web.StreamResponse:
        peer = request.remote or ""
        if not self.own(request):
            return self.refuse("foreign origin refused", request)
        if not web.WebSocketResponse().can_prepare(request):
            raise web.HTTPBadRequest
        admitted = self.roster.admit(request.query.get("resume", ""), peer)
        if isinstance(admitted, str):
            self.refusals.note(f"phone refused: {admitted}", peer)
            return await closed(request, CLOSED[admitted], protocol.MAX_FRAME)
        number, resume = admitted
        if before := self.connections.get(number):
            before.replaced = True
        connection = self.connections[number] = Connection(self.roster, self.refusals, number, peer)
        try:
            await connection.answer.prepare(request)
            await self._until_kept(number)
            connection.send(protocol.resume_text(resume))
            await connection.play(request)
        finally:
            if not connection.replaced:
                del self.connections[number]
                self.roster.leave(number)
        return connection.answer


def _first_part(path: str) -> bytes:
    return path.strip("/").partition("/")[0].lower().encode(errors="replace")
