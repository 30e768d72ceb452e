"""The server of the phones' page and sockets: aiohttp in a thread of its own, bound to one address.

Everything needs the session's token, which is in the QR code. Requests for another host, sockets opened by pages of
another origin, and peers with many connections are refused. No refusal costs more than a few bytes, and none is waited
for: the arcade only ever reads queues.
"""

import asyncio
import base64
import errno
import hashlib
import hmac
import html
import json
import logging
import secrets
import socket
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from aiohttp import web

from pigaming_app import ASSETS
from pigaming_app.ui.input import phone_messages as protocol
from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.input.phones.connection import CLOSE_SECONDS, Connection, stop_reading
from pigaming_app.ui.input.phones.limits import ConnectionLimits
from pigaming_app.ui.input.phones.memory import Hall
from pigaming_app.ui.input.phones.network import PhonesUnavailable
from pigaming_app.ui.input.phones.refusals import ErrorsOfLibrary, Refusals
from pigaming_app.ui.input.phones.roster import Refusal, Roster

START_SECONDS = 5.0  # for the server to listen
ALPHABET = "abcdefghjkmnpqrstuvwxyz23456789"  # without signs that look alike: the address may be typed
TOKEN_LENGTH = 10  # 49 bits, guessed over a network within one session
RECEIVE_BYTES = 8192  # buffered by the system for a connection: bounds what a flood makes the server parse at once
IDLE_SECONDS = 5.0  # without a complete request
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
FORBIDDEN_ERRORS = (errno.EACCES, errno.EPERM, 10013)  # 10013: Windows' WSAEACCES


class PhoneServer:
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
        self.phones, self.address, self.port, self.texts = phones, address, port, texts
        self.roster = roster or Roster(phones)
        self.token = token or "".join(secrets.choice(ALPHABET) for _ in range(TOKEN_LENGTH))
        self.refusals = Refusals()
        self.visited = False  # whether a page was asked for with the right token
        self.connections: dict[int, Connection] = {}  # by device number
        self._keep, self._kept, self._to_keep = keep, Hall(), asyncio.Event()
        self._written = asyncio.Condition()  # notified when that is done
        self._farewells: set[asyncio.Future[None]] = set()
        self._files = {name: ((ASSETS / path).read_bytes(), kind) for name, (path, kind) in FILES.items()}
        self._page = (ASSETS / "phones" / "page.html").read_text(encoding="utf-8")
        self._loop: asyncio.AbstractEventLoop | None = None
        self._ended: asyncio.Event | None = None
        self._ready, self._error = threading.Event(), ""
        self._thread = threading.Thread(target=self._run, name="phones", daemon=True)

    @property
    def url(self) -> str:
        """The address for phones, with the token."""
        return f"http://{self.address}:{self.port}/{self.token}"

    def start(self) -> None:
        """Listen. Raises PhonesUnavailable if the port is taken or forbidden, or the address is not this computer's."""
        self._thread.start()
        if not self._ready.wait(START_SECONDS):
            self._error = "port_forbidden"
        if self._error:
            self.stop()
            raise PhonesUnavailable(self._error, port=self.port)
        self.phones.send = self._send
        self.roster.changed = lambda: self._call(self._to_keep.set)
        self.roster.expel = lambda number, why: self._call(self._expel, number, why)

    def stop(self) -> None:
        """Close all connections and end the thread."""
        self.phones.send = lambda number, text: None
        self.roster.changed, self.roster.expel = lambda: None, lambda number, why: None
        if self._ended:
            self._call(self._ended.set)
        self._thread.join(START_SECONDS)

    # ---- in the main loop's thread

    def _send(self, number: int, text: str) -> None:
        """Hand a text to the server's thread; a phone that has just gone does not get it."""
        self._call(self._deliver, number, text)

    def _call(self, act: Callable[..., object], *arguments: object) -> None:
        """Let the server's thread do something, unless it has ended."""
        if self._loop and not self._loop.is_closed():
            with suppress(RuntimeError):  # it ends at this moment
                self._loop.call_soon_threadsafe(act, *arguments)

    # ---- in the server's thread

    def _run(self) -> None:
        try:
            asyncio.run(self._serve())
        except OSError as error:
            self._error = cause(error)
        finally:
            self._ready.set()

    async def _serve(self) -> None:
        self._loop, self._ended = asyncio.get_running_loop(), asyncio.Event()
        logger = logging.Logger("phones")  # not in the hierarchy: its messages become refusals
        logger.addHandler(ErrorsOfLibrary(self.refusals))
        app = web.Application(middlewares=[self._checked], client_max_size=1024)
        app.router.add_get("/{token}", self._get_page)
        app.router.add_get("/{token}/pad", self._get_socket)
        app.router.add_get("/{token}/{file}", self._get_file)
        settings: dict[str, Any] = {
            "access_log": None,
            "logger": logger,
            "keepalive_timeout": IDLE_SECONDS,
            "lingering_time": 0.0,
        }
        runner = web.AppRunner(app, shutdown_timeout=CLOSE_SECONDS)
        await runner.setup()
        try:
            assert runner.server is not None
            guard = ConnectionLimits(runner.server, settings, self.refusals)
            listening = socket.create_server((self.address, self.port))
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BYTES)  # accepted ones inherit it
            listener = await self._loop.create_server(guard.handler, sock=listening)
            self.port = listener.sockets[0].getsockname()[1]
            self._ready.set()
            keeper = asyncio.create_task(self._keep_always())
            await self._ended.wait()
            listener.close()
            await asyncio.gather(*(one.close(1001) for one in self.connections.values()))
            keeper.cancel()
        finally:
            await runner.cleanup()

    def _deliver(self, number: int, text: str) -> None:
        if connection := self.connections.get(number):
            connection.send(text)

    def _expel(self, number: int, why: Refusal) -> None:
        """Close the socket of a phone that the roster has sent away."""
        if connection := self.connections.pop(number, None):
            connection.replaced = True
            task = asyncio.ensure_future(connection.close(CLOSED[why]))
            self._farewells.add(task)
            task.add_done_callback(self._farewells.discard)

    async def _keep_always(self) -> None:
        """Write what a restart needs whenever it has changed: in a thread, so that no phone waits for the disk."""
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
    async def _checked(self, request: web.Request, handler: Any) -> web.StreamResponse:
        """Refuse requests for another host and without the token; close the connection after each answer."""
        try:
            if request.headers.get("Host", "") != f"{self.address}:{self.port}":
                response = self._refused("foreign host refused", request)
            elif not hmac.compare_digest(_first_part(request.path), self.token.encode()):
                response = self._refused("wrong token refused", request)
            else:
                response = await handler(request)
        except web.HTTPException as error:
            self.refusals.note("unknown page refused", request.remote or "")
            response = web.Response(status=error.status)
        if not response.prepared:
            response.headers.update(self._headers())
            response.force_close()
        return response

    def _headers(self) -> dict[str, str]:
        sockets = f"connect-src 'self' ws://{self.address}:{self.port}"
        policy = (
            "default-src 'none'; script-src 'self'; font-src 'self'; img-src data:; media-src data:; base-uri 'none'; "
            f"style-src 'self' 'sha256-{STYLE_HASH}'"
        )
        return {
            "Server": "PiGaming",
            "Cache-Control": "no-store",
            "Referrer-Policy": "no-referrer",
            "X-Content-Type-Options": "nosniff",
            "Content-Security-Policy": f"{policy}; {sockets}; form-action 'none'; frame-ancestors 'none'",
        }

    def _refused(self, kind: str, request: web.Request) -> web.StreamResponse:
        self.refusals.note(kind, request.remote or "")
        sentence = html.escape(self.texts.get("page_old", ""))
        meta = (
            '<meta name="viewport" content="width=device-width"><meta charset="utf-8"><link rel="icon" href="data:,">'
        )
        page = f"<!doctype html>{meta}<style>{REFUSAL_STYLE}</style><p>{sentence}</p>"
        return web.Response(status=403, text=page, content_type="text/html")

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
        if request.headers.get("Origin", "") != f"http://{self.address}:{self.port}":
            return self._refused("foreign origin refused", request)
        if not web.WebSocketResponse().can_prepare(request):
            raise web.HTTPBadRequest
        admitted = self.roster.admit(request.query.get("resume", ""), peer)
        if isinstance(admitted, str):
            self.refusals.note(f"phone refused: {admitted}", peer)
            return await _closed(request, CLOSED[admitted])
        number, resume = admitted
        if before := self.connections.get(number):
            before.replaced = True
        connection = self.connections[number] = Connection(self.roster, self.refusals, number, peer)
        try:
            await connection.socket.prepare(request)
            await self._until_kept(number)
            connection.send(protocol.resume_text(resume))
            await connection.serve(request)
        finally:
            if not connection.replaced:
                del self.connections[number]
                self.roster.leave(number)
        return connection.socket


def _first_part(path: str) -> bytes:
    return path.strip("/").partition("/")[0].lower().encode(errors="replace")


async def _closed(request: web.Request, code: int) -> web.WebSocketResponse:
    """A socket that is closed at once, for a reason that the page knows."""
    answer = web.WebSocketResponse(timeout=CLOSE_SECONDS, max_msg_size=protocol.MAX_FRAME, compress=False)
    await answer.prepare(request)
    stop_reading(request)
    await answer.close(code=code)
    return answer


def cause(error: OSError) -> str:
    """The key of the sentence for an address that cannot be listened on."""
    if error.errno in FORBIDDEN_ERRORS:
        return "port_forbidden"
    return "port_taken" if error.errno in (errno.EADDRINUSE, 10048) else "no_network"
