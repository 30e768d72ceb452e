"""A browser of few lines: plain requests over sockets, each on a connection of its own."""

import socket
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from dataclasses import dataclass
from typing import TypeVar
from urllib.parse import urlencode

from pigaming_app.ui.web.listener import Listener
from pigaming_app.ui.web.server import Answer, PageServer

Served = TypeVar("Served", bound=Listener)
LONG = 60.0  # s, for whatever must come: the machine may be busy


@dataclass(frozen=True)
class Received:
    """An answer; names of headers in small letters."""

    status: int
    headers: dict[str, str]
    text: str


@contextmanager
def running(server: Served) -> Iterator[Served]:
    """The server, until the end of the block."""
    server.start()
    try:
        yield server
    finally:
        server.stop()


def serving(answer: Answer) -> AbstractContextManager[PageServer]:
    """A server of pages on a free port of this computer."""
    return running(PageServer(answer, "127.0.0.1", 0))


def ask(server: PageServer, path: str, form: dict[str, str] | None = None, **headers: str) -> Received:
    """The answer to GET, or with a form to POST, with the Origin of the server unless another is given."""
    body = urlencode(form).encode() if form is not None else b""
    here = f"{server.address}:{server.port}"
    found = {"Host": here} | ({"Origin": f"http://{here}"} if form is not None else {})
    if form is not None:
        found |= {"Content-Type": "application/x-www-form-urlencoded", "Content-Length": str(len(body))}
    found |= {name.replace("_", "-"): value for name, value in headers.items()}
    lines = [f"{'GET' if form is None else 'POST'} {path} HTTP/1.1", *(f"{k}: {v}" for k, v in found.items() if v)]
    return parsed(raw(server, ("\r\n".join(lines) + "\r\n\r\n").encode() + body))


def raw(server: Listener, request: bytes) -> bytes:
    """All bytes that answer these."""
    received = b""
    with socket.create_connection((server.address, server.port), LONG) as peer:
        with suppress(ConnectionError):
            peer.sendall(request)
        with suppress(ConnectionError):
            while part := peer.recv(65536):
                received += part
    return received


def parsed(received: bytes) -> Received:
    head, _, body = received.partition(b"\r\n\r\n")
    first, *lines = head.decode("latin-1").split("\r\n")
    pairs = (line.partition(": ") for line in lines)
    return Received(int(first.split()[1]), {name.lower(): value for name, _, value in pairs}, body.decode())
