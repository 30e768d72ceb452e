"""Raw bytes from a hostile peer: frames and requests that no browser sends, and many connections at once."""

import os
import socket
import struct
import time
import zlib
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from itertools import pairwise

import pytest
from aiohttp import ClientSession

from pigaming_app.ui.input import phone_messages as protocol
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.input.phones import connection
from pigaming_app.ui.input.phones.server import PhoneServer
from pigaming_app.ui.web import limits
from tests.ui.input.phones.client import phone, play, serving, until
from tests.ui.input.phones.test_server import pressed, presses, still_plays
from tests.ui.web.client import LONG

pytestmark = pytest.mark.usefixtures("_no_threads_stay")
FIN, RESERVED, TEXT, BINARY, CLOSE, PING = 0x80, 0x40, 1, 2, 8, 9
REFUSED_FRAME = "malformed or giant frame refused"


@pytest.fixture
def server(controls: Controls) -> Iterator[PhoneServer]:
    with serving(controls.phones) as server:
        yield server


def frame(opcode: int, payload: bytes, bits: int = FIN) -> bytes:
    """A WebSocket frame (RFC 6455, 5.2); its mask is zero."""
    size = len(payload)
    length = bytes([size]) if size < 126 else b"\x7e" + struct.pack(">H", size)
    return bytes([bits | opcode, length[0] | 0x80]) + length[1:] + b"\0" * 4 + payload


def handshake(server: PhoneServer, resume: str = "", *more: str) -> bytes:
    here = f"{server.address}:{server.port}"
    lines = (
        f"GET /{server.token}/pad?resume={resume} HTTP/1.1", f"Host: {here}", f"Origin: http://{here}",
        "Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
        "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==", *more,
    )  # fmt: skip
    return ("\r\n".join(lines) + "\r\n\r\n").encode()


def connected(server: PhoneServer) -> socket.socket:
    return socket.create_connection((server.address, server.port), LONG)


def opened(server: PhoneServer, *more: str) -> tuple[socket.socket, bytes]:
    """An open WebSocket, and the answer to its handshake."""
    peer = connected(server)
    peer.sendall(handshake(server, "", *more))
    answer = peer.recv(4000)
    assert answer.startswith(b"HTTP/1.1 101")
    return peer, answer


def rest(peer: socket.socket) -> bytes:
    """The bytes until the server ends the connection."""
    received = b""
    with suppress(ConnectionError):
        while part := peer.recv(4000):
            received += part
    return received


STATE = protocol.pack(protocol.Touches(0.5, 0.5))
BOMB = zlib.compress(b"\0" * 10_000_000, 9)
FRAMES = {
    "text that is not UTF-8": frame(TEXT, b"\xff\xfe\xff\xfe"),
    "JSON with a NaN": frame(TEXT, b'{"x": NaN}'),
    "JSON with infinity": frame(TEXT, b'{"x": -Infinity, "y": 1e999}'),
    "a huge number": frame(TEXT, b"9" * 60),
    "compressed though not agreed": frame(BINARY, STATE, FIN | RESERVED),
    "a bomb": frame(BINARY, BOMB[:60000], FIN | RESERVED),
    "an unknown opcode": frame(5, STATE),
    "a continuation of nothing": frame(0, STATE),
    "a giant out of fragments": frame(BINARY, b"x" * 40, 0) + frame(0, b"x" * 40, 0) * 50 + frame(0, b"x" * 40),
    "fragments within a message": frame(BINARY, b"x", 0) + frame(BINARY, b"x"),
    "a ping": frame(PING, b"x"),
    "a fragmented ping": frame(PING, b"x", 0),
    "a long ping": frame(PING, b"x" * 200),
    "an invalid closing code": frame(CLOSE, struct.pack(">H", 7)),
    "a closing reason that is not UTF-8": frame(CLOSE, struct.pack(">H", 1000) + b"\xff\xff"),
    "half a closing code": frame(CLOSE, b"\x03"),
    "an empty frame": frame(BINARY, b""),
    "another version": frame(BINARY, b"\x02\x00\x00\x00"),
    "a byte too many": frame(BINARY, STATE + b"\x00"),
    "text": frame(TEXT, b"{" * 60),
    "a giant": frame(BINARY, b"x" * 65_000),
    "gigabytes announced": b"\x82\xff" + (2**62).to_bytes(8, "big") + b"\0" * 4 + b"x" * 1000,
}


@pytest.mark.usefixtures("quiet")
@pytest.mark.parametrize("name", FRAMES)
def test_a_frame_that_no_page_sends_ends_the_connection(controls: Controls, server: PhoneServer, name: str) -> None:
    peer, _ = opened(server)
    with peer:
        peer.sendall(FRAMES[name])
        rest(peer)
    play(lambda session: until(lambda: server.refusals.counts[REFUSED_FRAME] == 1 and not server.phones._connected))
    pressed(controls)
    play(lambda session: still_plays(session, server, controls))


@pytest.mark.usefixtures("quiet")
def test_fragments_count_as_messages_and_may_not_dribble(controls: Controls, server: PhoneServer) -> None:
    """A state in four fragments is a valid message; one that never ends leaves a phone silent, so it is unplugged."""
    peer, _ = opened(server)
    with peer:
        pieces = [frame(BINARY, STATE[:1], 0), *(frame(0, STATE[i : i + 1], FIN if i == 3 else 0) for i in (1, 2, 3))]
        for piece in pieces:
            peer.sendall(piece)
        play(lambda session: until(lambda: server.phones._connected[0].touches.x > 0.0))
        cut = False
        for i in range(40):
            try:
                peer.sendall(frame(0 if i else BINARY, b"", 0))
            except ConnectionError:
                cut = True
                break
            time.sleep(0.1)
        assert cut
    play(lambda session: until(lambda: not server.phones._connected))


def test_compression_is_not_agreed(server: PhoneServer) -> None:
    peer, answer = opened(server, "Sec-WebSocket-Extensions: permessage-deflate; client_max_window_bits")
    with peer:
        assert b"deflate" not in answer.lower()


@pytest.mark.usefixtures("quiet")
@pytest.mark.parametrize("method", ["HEAD", "POST", "PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT", "PATCH", "BREW"])
@pytest.mark.parametrize("path", ["", "/pad", "/page.js", "/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd"])
def test_other_methods_change_nothing(controls: Controls, server: PhoneServer, method: str, path: str) -> None:
    with connected(server) as peer:
        head = f"{method} /{server.token}{path} HTTP/1.1\r\nHost: {server.address}:{server.port}\r\n"
        peer.sendall(f"{head}Content-Length: 4\r\n\r\n\0\0\0\0".encode())
        answer = rest(peer)
    assert b"root:" not in answer
    status = int(answer.split()[1])
    assert status in ((200, 403, 404) if method == "HEAD" else (400, 403, 404, 405)), answer
    if method == "HEAD":
        assert answer.endswith(b"\r\n\r\n"), "no body"
    assert pressed(controls) == []


@pytest.mark.usefixtures("quiet")
def test_http_1_0_gets_the_page_and_no_socket(controls: Controls, server: PhoneServer) -> None:
    with connected(server) as peer:
        peer.sendall(f"GET /{server.token} HTTP/1.0\r\nHost: {server.address}:{server.port}\r\n\r\n".encode())
        assert b"<!doctype html>" in rest(peer)
    with connected(server) as peer:
        peer.sendall(f"GET /{server.token} HTTP/1.0\r\n\r\n".encode())
        assert b" 403 " in rest(peer)[:20], "no host"
    with connected(server) as peer:
        peer.sendall(handshake(server).replace(b"HTTP/1.1", b"HTTP/1.0"))
        peer.settimeout(0.5)
        try:
            first = peer.recv(100)
        except TimeoutError:
            first = b""
    assert b" 200 " not in first
    play(lambda session: until(lambda: not server.phones._connected))


@pytest.mark.usefixtures("quiet")
def test_five_hundred_connections_leave_room_for_those_who_play(controls: Controls, server: PhoneServer) -> None:
    async def story(session: ClientSession) -> None:
        one = await phone(session, server)
        pressed(controls)
        with ExitStack() as held:
            for i in range(500):
                peer = held.enter_context(connected(server))
                if i % 2:
                    with suppress(ConnectionError):
                        peer.sendall(b"GET /")  # and no more
                if i % 5 == 0:
                    await one.touch(0.0, -1.0)
            await until(lambda: server.refusals.counts["too many connections refused"] >= 500 - limits.MAX_OPENED)
            await one.touch(0.0, 1.0)
            seen = await presses(controls, lambda seen: (Button.DOWN, 0) in seen)
            assert (Button.LOST, 0) not in seen

    play(story)


@pytest.mark.usefixtures("quiet")
def test_two_phones_with_the_same_identity_are_one_device(
    controls: Controls, server: PhoneServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of many connections at once with the same token, one holds the seat; the device is never there twice."""
    monkeypatch.setattr(connection, "SILENT_SECONDS", LONG)

    async def story(session: ClientSession) -> None:
        one = await phone(session, server)
        pressed(controls)
        stolen = handshake(server, one.resume)
        with ExitStack() as held:
            peers = [held.enter_context(connected(server)) for _ in range(12)]
            for peer in peers:
                peer.sendall(stolen)
            await until(lambda: server.phones.full)
            assert len(server.phones._connected) == 4
        await until(lambda: not server.phones._connected)
        seen = pressed(controls)
        for number in range(4):
            changes = [button for button, other in seen if other == number]
            assert all(a != b for a, b in pairwise(changes)), "found and lost by turns"
        await still_plays(session, server, controls)

    play(story)


@pytest.mark.usefixtures("quiet")
def test_a_half_open_connection_is_an_unplugged_pad(controls: Controls, server: PhoneServer) -> None:
    """A peer that neither reads, sends, nor answers the farewell."""
    before = len(os.listdir("/proc/self/fd")) if os.path.isdir("/proc/self/fd") else 0
    peer, _ = opened(server)
    with peer:
        play(lambda session: until(lambda: pressed(controls) == [(Button.FOUND, 0)]))
        play(lambda session: until(lambda: pressed(controls) == [(Button.LOST, 0)]))
    if before:
        play(lambda session: until(lambda: len(os.listdir("/proc/self/fd")) <= before + 3))
