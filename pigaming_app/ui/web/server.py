"""A server of pages for browsers on the local network. `answer` runs in worker threads and sees plain values only."""

import asyncio
import base64
import hashlib
import hmac
import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from urllib.parse import parse_qsl

from aiohttp import web

from pigaming_app.ui.web import listener

MAX_BODY = 1 << 16  # bytes
MAX_FIELDS = 64  # of a form or a query
MAX_WAITING = 16  # requests that are answered at the same time; more are asked to come again
FORM = "application/x-www-form-urlencoded"
POLICY = "style-src 'self'; img-src 'self' data:; connect-src 'self'; form-action 'self'"

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


class PageServer(listener.Listener):
    """Serves what `answer` returns, on a port of an address; 0: any free one."""

    policy = POLICY

    def __init__(self, answer: Answer, address: str, port: int) -> None:
        super().__init__("pages", address, port, MAX_BODY, listener.IDLE_SECONDS)
        self.app.router.add_route("*", "/{path:.*}", self._get)
        self.answer = answer
        self._waiting = 0

    @property
    def url(self) -> str:
        """The address for browsers."""
        return f"http://{self.host}/"

    async def _get(self, request: web.Request) -> web.StreamResponse:
        reply = await self._reply(request)
        if reply.status >= 400:
            self.refusals.note(f"answered with {reply.status}", request.remote or "")
        response = web.Response(status=reply.status, body=reply.body or None)
        if reply.body:
            response.content_type = reply.kind
            if reply.kind.startswith("text/"):
                response.charset = "utf-8"
        response.headers.update(reply.headers)
        return response

    async def _reply(self, request: web.Request) -> WebReply:
        if request.method not in ("GET", "HEAD", "POST"):
            return WebReply(status=405, headers={"Allow": "GET, HEAD, POST"})
        if self._waiting >= MAX_WAITING:
            return WebReply(status=503, headers={"Retry-After": "1"})
        self._waiting += 1
        try:
            async with asyncio.timeout(listener.IDLE_SECONDS):
                body = await request.read() if request.method == "POST" else b""
            try:
                asked = self._asked(request, body)
            except ValueError:  # too many fields
                return WebReply(status=400)
            return await asyncio.to_thread(self.answer, asked)
        except TimeoutError:
            return WebReply(status=408)
        except web.HTTPException:  # too long
            raise
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
            self.own(request),
        )


def tagged(request: WebRequest, reply: WebReply) -> WebReply:
    """The reply with its mark, or without content if the browser has this one."""
    mark = f'"{base64.urlsafe_b64encode(hashlib.sha256(reply.body).digest()[:12]).decode()}"'
    if hmac.compare_digest(request.headers.get("if-none-match", "").encode(), mark.encode()):
        return WebReply(status=304, headers={"ETag": mark})
    return WebReply(reply.body, reply.status, reply.kind, {**reply.headers, "ETag": mark})


def _fields(text: str) -> dict[str, str]:
    """The fields of a form or a query; of equal names the last. Raises ValueError if they are too many."""
    return dict(parse_qsl(text, keep_blank_values=True, max_num_fields=MAX_FIELDS, errors="replace"))
