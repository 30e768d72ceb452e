"""A server of pages for browsers on the local network, in a thread of its own.

Any device may send anything: connections, sizes, times and methods are limited as for phones, requests for another host
are refused, and what is refused goes to the log in at most one line of its kind every few seconds. `answer` runs in
worker threads and sees plain values only.
"""

import asyncio
import base64
import hashlib
import hmac
import logging
import socket
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import parse_qsl

from aiohttp import web

from pigaming_app.ui.input.phones.limits import ConnectionLimits
from pigaming_app.ui.input.phones.network import PhonesUnavailable
from pigaming_app.ui.input.phones.refusals import ErrorsOfLibrary, Refusals
from pigaming_app.ui.input.phones.server import IDLE_SECONDS, RECEIVE_BYTES, START_SECONDS, cause

MAX_BODY = 1 << 16  # bytes
MAX_FIELDS = 64  # of a form or a query
MAX_WAITING = 16  # requests that are answered at the same time; more are asked to come again
FORM = "application/x-www-form-urlencoded"
POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; font-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'"
)

log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class WebRequest:
    """What a browser asks. `path` begins with /; `own`: it comes from a page of this server, as its Origin says."""

    method: str
    path: str
    query: Mapping[str, str] = field(default_factory=dict)
    form: Mapping[str, str] = field(default_factory=dict)
    cookies: Mapping[str, str] = field(default_factory=dict)
    headers: Mapping[str, str] = field(default_factory=dict)  # names in small letters
    body: bytes = b""
    peer: str = ""
    own: bool = False


@dataclass(frozen=True)
class WebReply:
    """An answer; `headers` are added to those of all answers."""

    body: bytes = b""
    status: int = 200
    kind: str = "text/html"
    headers: Mapping[str, str] = field(default_factory=dict)


Answer = Callable[[WebRequest], WebReply]


class PageServer:
    """Serves what `answer` returns, on a port of an address; 0: any free one."""

    def __init__(self, answer: Answer, address: str, port: int) -> None:
        self.answer, self.address, self.port = answer, address, port
        self.refusals = Refusals(server="pages")
        self._loop: asyncio.AbstractEventLoop | None = None
        self._ended: asyncio.Event | None = None
        self._waiting = 0
        self._ready, self._error = threading.Event(), ""
        self._thread = threading.Thread(target=self._run, name="pages", daemon=True)

    @property
    def url(self) -> str:
        """The address for browsers."""
        return f"http://{self.address}:{self.port}/"

    def start(self) -> None:
        """Listen. Raises PhonesUnavailable if the port is taken or forbidden, or the address is not this computer's."""
        self._thread.start()
        if not self._ready.wait(START_SECONDS):
            self._error = "port_forbidden"
        if self._error:
            self.stop()
            raise PhonesUnavailable(self._error, port=self.port)

    def stop(self) -> None:
        """Close all connections and end the thread."""
        if self._loop and self._ended and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._ended.set)
        self._thread.join(START_SECONDS)

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
        logger = logging.Logger("pages")  # not in the hierarchy: its messages become refusals
        logger.addHandler(ErrorsOfLibrary(self.refusals))
        app = web.Application(client_max_size=MAX_BODY)
        app.router.add_route("*", "/{path:.*}", self._get)
        settings: dict[str, Any] = {
            "access_log": None,
            "logger": logger,
            "keepalive_timeout": IDLE_SECONDS,
            "lingering_time": 0.0,
        }
        runner = web.AppRunner(app, shutdown_timeout=IDLE_SECONDS)
        await runner.setup()
        try:
            assert runner.server is not None
            guard = ConnectionLimits(runner.server, settings, self.refusals)
            listening = socket.create_server((self.address, self.port))
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BYTES)  # accepted ones inherit it
            listener = await self._loop.create_server(guard.handler, sock=listening)
            self.port = listener.sockets[0].getsockname()[1]
            self._ready.set()
            await self._ended.wait()
            listener.close()
        finally:
            await runner.cleanup()

    async def _get(self, request: web.Request) -> web.StreamResponse:
        """One answer; the connection is closed after it."""
        reply = await self._reply(request)
        if reply.status >= 400:
            self.refusals.note(f"answered with {reply.status}", request.remote or "")
        response = web.Response(status=reply.status, body=reply.body or None)
        if reply.body:
            response.content_type = reply.kind
            if reply.kind.startswith("text/"):
                response.charset = "utf-8"
        response.headers.update(HEADERS)
        response.headers.update(reply.headers)
        response.force_close()
        return response

    async def _reply(self, request: web.Request) -> WebReply:
        host = f"{self.address}:{self.port}"
        if request.headers.get("Host", "") != host:
            return WebReply(status=403)
        if request.method not in ("GET", "HEAD", "POST"):
            return WebReply(status=405, headers={"Allow": "GET, HEAD, POST"})
        if self._waiting >= MAX_WAITING:
            return WebReply(status=503, headers={"Retry-After": "1"})
        self._waiting += 1
        try:
            async with asyncio.timeout(IDLE_SECONDS):
                body = await request.read() if request.method == "POST" else b""
            try:
                asked = self._asked(request, body)
            except ValueError:  # too many fields
                return WebReply(status=400)
            return await asyncio.to_thread(self.answer, asked)
        except TimeoutError:
            return WebReply(status=408)
        except web.HTTPException as error:  # too long
            return WebReply(status=error.status)
        except Exception:  # of `answer`: the other pages are served on
            log.exception("a page cannot be shown")
            return WebReply(status=500)
        finally:
            self._waiting -= 1

    def _asked(self, request: web.Request, body: bytes) -> WebRequest:
        """The plain values of a request. Raises ValueError."""
        form = _fields(body.decode(errors="replace")) if request.content_type == FORM else {}
        return WebRequest(
            request.method,
            request.path,
            _fields(request.rel_url.raw_query_string),
            form,
            dict(request.cookies),
            {name.lower(): value for name, value in request.headers.items()},
            body,
            request.remote or "",
            request.headers.get("Origin", "") == f"http://{self.address}:{self.port}",
        )


HEADERS = {
    "Server": "PiGaming",
    "Cache-Control": "no-store",
    "Referrer-Policy": "same-origin",
    "X-Content-Type-Options": "nosniff",
    "Content-Security-Policy": POLICY,
}


def tagged(request: WebRequest, reply: WebReply) -> WebReply:
    """The reply with its mark, or without content if the browser has this one."""
    mark = f'"{base64.urlsafe_b64encode(hashlib.sha256(reply.body).digest()[:12]).decode()}"'
    if hmac.compare_digest(request.headers.get("if-none-match", "").encode(), mark.encode()):
        return WebReply(status=304, headers={"ETag": mark})
    return WebReply(reply.body, reply.status, reply.kind, {**reply.headers, "ETag": mark})


def _fields(text: str) -> dict[str, str]:
    """The fields of a form or a query; of equal names the last. Raises ValueError if they are too many."""
    return dict(parse_qsl(text, keep_blank_values=True, max_num_fields=MAX_FIELDS, errors="replace"))
