"""Both servers against peers that send what no browser does: raw bytes, slowly, or many at once."""

import socket
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, suppress

import pytest

from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.input.phones.server import PhoneServer
from pigaming_app.ui.web import limits, listener
from pigaming_app.ui.web.listener import Listener
from pigaming_app.ui.web.network import ServerUnavailable
from pigaming_app.ui.web.refusals import LOG_SECONDS, Refusals
from pigaming_app.ui.web.server import PageServer, WebReply
from tests.ui.web.client import LONG, parsed, raw, running

pytestmark = pytest.mark.usefixtures("_no_threads_stay", "quiet")
REQUESTS = {
    "TLS": b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + b"\0" * 200,
    "a long path": b"GET " + b"/" * 20_000 + b" HTTP/1.1\r\n\r\n",
    "many headers": b"GET / HTTP/1.1\r\n" + b"".join(b"A%d: b\r\n" % i for i in range(500)) + b"\r\n",
    "another HTTP": b"GET / HTTP/9.9\r\n\r\n",
    "no path": b"OPTIONS * HTTP/1.1\r\nHost: x\r\n\r\n",
    "zeros": b"\0" * 5000,
    "half a chunk": b"POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n",
}
Maker = Callable[[str, int], Listener]
SERVERS: dict[str, Maker] = {
    "phones": lambda address, port: PhoneServer(Phones(), address, port, {}),
    "pages": lambda address, port: PageServer(lambda request: WebReply(b"x"), address, port),
}


@pytest.fixture(params=SERVERS)
def made(request: pytest.FixtureRequest) -> Maker:
    return SERVERS[str(request.param)]


@pytest.fixture
def server(made: Maker) -> Iterator[Listener]:
    with running(made("127.0.0.1", 0)) as server:
        yield server


def status(server: Listener, source: str = "127.0.0.1", host: str = "") -> int:
    """That of its first page, for a peer at an address of this computer."""
    path = getattr(server, "token", "")
    with socket.create_connection((server.address, server.port), LONG, (source, 0)) as peer:
        peer.sendall(f"GET /{path} HTTP/1.1\r\nHost: {host or server.host}\r\n\r\n".encode())
        return parsed(peer.recv(65536)).status


@pytest.mark.parametrize("name", REQUESTS)
def test_a_malformed_request_is_refused_and_others_are_served(server: Listener, name: str) -> None:
    answer = raw(server, REQUESTS[name])
    assert answer == b"" or parsed(answer).status in (400, 403, 405)
    assert status(server) == 200


def test_another_host_name_for_this_address_is_refused(server: Listener) -> None:
    names = ("evil.example", f"localhost:{server.port}", server.address)
    assert [status(server, host=name) for name in names] == [403, 403, 403]
    assert server.refusals.counts["foreign host refused"] == 3


@pytest.mark.parametrize("first", [b"", b"GET / HTTP/1.1\r\nHost:"])
def test_a_connection_without_a_complete_request_is_closed(
    made: Maker, monkeypatch: pytest.MonkeyPatch, first: bytes
) -> None:
    monkeypatch.setattr(listener, "IDLE_SECONDS", 0.2)
    with running(made("127.0.0.1", 0)) as server:
        assert raw(server, first) == b""


def test_a_slow_request_is_cut_whatever_it_dribbles(made: Maker, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(listener, "IDLE_SECONDS", 0.4)
    with running(made("127.0.0.1", 0)) as server, socket.create_connection((server.address, server.port), LONG) as peer:
        end, cut = time.monotonic() + LONG, False
        peer.sendall(b"GET / HTTP/1.1\r\nX: ")
        peer.settimeout(0.05)
        while not cut and time.monotonic() < end:
            try:
                peer.sendall(b"x")
                cut = peer.recv(100) == b""
            except TimeoutError:
                pass
            except ConnectionError:
                cut = True
        assert cut


def test_many_connections_leave_room_for_others(server: Listener, monkeypatch: pytest.MonkeyPatch) -> None:
    with ExitStack() as held:
        for i in range(limits.MAX_OPENED + 50):
            peer = held.enter_context(socket.create_connection((server.address, server.port), LONG))
            if i % 2:
                with suppress(ConnectionError):
                    peer.sendall(b"GET /")  # and no more
        end = time.monotonic() + LONG
        while not server.refusals.counts["too many connections refused"] and time.monotonic() < end:
            time.sleep(0.02)
        assert server.refusals.counts["too many connections refused"]
        held.close()
        monkeypatch.setattr(limits, "MAX_OPENED", 10**6)
        assert status(server, "127.0.0.2") == 200


def test_it_listens_on_the_chosen_address_only(server: Listener) -> None:
    with pytest.raises(OSError, match=r".*"):
        socket.create_connection(("127.0.0.2", server.port), 0.5)


def test_what_it_cannot_listen_on_is_named(made: Maker, server: Listener) -> None:
    taken = {"127.0.0.1": "port_taken", "203.0.113.9": "no_network"}  # 203.0.113.0/24 is documentation, RFC 5737
    for address, key in taken.items():
        with pytest.raises(ServerUnavailable) as trouble:
            made(address, server.port).start()
        assert trouble.value.key == key


def test_refusals_are_logged_in_one_line_per_kind_and_time(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.undo()  # of `quiet`
    now = [0.0]
    refusals = Refusals(lambda: now[0])
    for _ in range(1000):
        refusals.note("wrong token refused", "10.0.0.9")
    now[0] = LOG_SECONDS
    refusals.note("wrong token refused", "10.0.0.9")
    lines = [record.getMessage() for record in caplog.records]
    assert lines == ["phones: wrong token refused, 10.0.0.9.", "phones: wrong token refused, 10.0.0.9, and 999 more."]
    assert refusals.counts["wrong token refused"] == 1001
