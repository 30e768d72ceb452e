"""What all servers of this computer share: aiohttp in a thread of its own, bound to one address.

Any device may send anything: connections, sizes and times are limited, requests for another host are refused, and each
answer ends its connection. What is refused goes to the log in at most one line of its kind every few seconds.
"""

import asyncio
import errno
import logging
import socket
import ssl
import threading
from collections.abc import Awaitable, Callable
from contextlib import suppress
from typing import Any

from aiohttp import web

from pigaming_app.ui.web.limits import ConnectionLimits
from pigaming_app.ui.web.network import ServerUnavailable
from pigaming_app.ui.web.refusals import ErrorsOfLibrary, Refusals

START_SECONDS = 5.0  # for the server to listen
RECEIVE_BYTES = 8192  # buffered by the system for a connection: bounds what a flood makes the server parse at once
IDLE_SECONDS = 5.0  # without a complete request
FORBIDDEN_ERRORS = (errno.EACCES, errno.EPERM, 10013)  # 10013: Windows' WSAEACCES
POLICY = "default-src 'none'; script-src 'self'; font-src 'self'; base-uri 'none'; frame-ancestors 'none'"
Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


class Listener:
    """A server on a port of an address; 0: any free one. `name`: of its thread, and in the log; `body`: bytes of a
    request at most; `closing`: s for connections to end; `tls`: certificate and key, for HTTPS.
    """

    received = RECEIVE_BYTES

    def __init__(
        self, name: str, address: str, port: int, body: int, closing: float, tls: ssl.SSLContext | None = None
    ) -> None:
        self._tls, self.scheme = tls, "https" if tls else "http"
        self.name, self.address, self.port = name, address, port
        self.refusals = Refusals(server=name)
        self.app = web.Application(middlewares=[self._guarded], client_max_size=body)
        self._closing = closing
        self._loop: asyncio.AbstractEventLoop | None = None
        self._ended: asyncio.Event | None = None
        self._ready, self._error = threading.Event(), ""
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    @property
    def host(self) -> str:
        """Address and port."""
        return f"{self.address}:{self.port}"

    @property
    def policy(self) -> str:
        """What pages may do beyond POLICY."""
        raise NotImplementedError

    def start(self) -> None:
        """Listen. Raises ServerUnavailable if the port is taken or forbidden, or the address is not this computer's."""
        self._thread.start()
        if not self._ready.wait(START_SECONDS):
            self._error = "port_forbidden"
        if self._error:
            self.stop()
            raise ServerUnavailable(self._error, port=self.port)

    def stop(self) -> None:
        """Close all connections and end the thread."""
        if self._ended:
            self.call(self._ended.set)
        self._thread.join(START_SECONDS)

    def call(self, act: Callable[..., object], *arguments: object) -> None:
        """Let the server's thread do something, unless it has ended."""
        if self._loop and not self._loop.is_closed():
            with suppress(RuntimeError):  # it ends at this moment
                self._loop.call_soon_threadsafe(act, *arguments)

    # ---- in the server's thread

    def own(self, request: web.Request) -> bool:
        """True if it comes from a page of this server, as its Origin says."""
        return request.headers.get("Origin", "") == f"{self.scheme}://{self.host}"

    def refuse(self, kind: str, request: web.Request) -> web.Response:
        """Note a refusal; the answer to it."""
        self.refusals.note(kind, request.remote or "")
        return web.Response(status=403)

    def _run(self) -> None:
        try:
            asyncio.run(self._serve())
        except OSError as error:
            self._error = cause(error)
        finally:
            self._ready.set()

    async def _serve(self) -> None:
        self._loop, self._ended = asyncio.get_running_loop(), asyncio.Event()
        logger = logging.Logger(self.name)  # not in the hierarchy: its messages become refusals
        logger.addHandler(ErrorsOfLibrary(self.refusals))
        settings: dict[str, Any] = {
            "access_log": None,
            "logger": logger,
            "keepalive_timeout": IDLE_SECONDS,
            "lingering_time": 0.0,
        }
        runner = web.AppRunner(self.app, shutdown_timeout=self._closing)
        await runner.setup()
        try:
            assert runner.server is not None
            guard = ConnectionLimits(runner.server, settings, self.refusals)
            listening = socket.create_server((self.address, self.port))
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, self.received)  # accepted ones inherit it
            patience = IDLE_SECONDS if self._tls else None
            listener = await self._loop.create_server(
                guard.handler, sock=listening, ssl=self._tls, ssl_handshake_timeout=patience
            )
            self.port = listener.sockets[0].getsockname()[1]
            self._ready.set()
            await self._ended.wait()
            listener.close()
        finally:
            await runner.cleanup()

    @web.middleware
    async def _guarded(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Refuse requests for another host; close the connection after each answer."""
        try:
            if request.headers.get("Host", "") == self.host:
                response = await handler(request)
            else:
                response = self.refuse("foreign host refused", request)
        except web.HTTPException as error:
            self.refusals.note(f"answered with {error.status}", request.remote or "")
            response = web.Response(status=error.status)
        if not response.prepared:
            for name, value in self._headers.items():
                response.headers.setdefault(name, value)
            response.force_close()
        return response

    @property
    def _headers(self) -> dict[str, str]:
        return {
            "Server": "PiGaming",
            "Cache-Control": "no-store",
            "Referrer-Policy": "same-origin",
            "X-Content-Type-Options": "nosniff",
            "Content-Security-Policy": f"{POLICY}; {self.policy}",
        }


def cause(error: OSError) -> str:
    """The key of the sentence for an address that cannot be listened on."""
    if error.errno in FORBIDDEN_ERRORS:
        return "port_forbidden"
    return "port_taken" if error.errno in (errno.EADDRINUSE, 10048) else "no_network"
