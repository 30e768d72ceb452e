"""The server of pages against peers that send what no browser does."""

import logging
import socket
import threading
import time
from contextlib import ExitStack, suppress
from typing import Any

import pytest

from pigaming_app.ui.input.phones import limits, refusals
from pigaming_app.ui.web import server as servers
from pigaming_app.ui.web.server import PageServer, WebReply, WebRequest, tagged
from tests.ui.input.phones.test_raw import REQUESTS
from tests.ui.web.client import LONG, ask, parsed, raw, serving

pytestmark = pytest.mark.usefixtures("_no_threads_stay", "quiet")


@pytest.fixture
def quiet(caplog: pytest.LogCaptureFixture, capfd: Any, monkeypatch: pytest.MonkeyPatch) -> Any:
    """No traceback is printed or logged, and one line of a kind at most, however long the test takes."""
    monkeypatch.setattr(refusals, "LOG_SECONDS", 1e6)
    logging.getLogger("pigaming").propagate = True
    yield
    assert "Traceback" not in caplog.text + "".join(capfd.readouterr())
    kinds = [record.getMessage().split(",")[0] for record in caplog.records]
    assert len(kinds) == len(set(kinds)), kinds


def echo(request: WebRequest) -> WebReply:
    return WebReply(f"{request.method} {request.path} {dict(request.form)} {request.own}".encode())


def test_a_page_has_the_headers_that_keep_others_out() -> None:
    with serving(echo) as server:
        page = ask(server, "/a/b")
    assert (page.status, page.text) == (200, "GET /a/b {} False")
    policy = page.headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert "frame-ancestors 'none'" in policy
    assert page.headers["cache-control"] == "no-store"
    assert page.headers["connection"] == "close"


def test_a_form_is_known_by_its_origin() -> None:
    with serving(echo) as server:
        assert ask(server, "/x", {"a": "ü&="}).text == "POST /x {'a': 'ü&='} True"
        for origin in ("http://evil.example", "null", "", f"http://{server.address}"):
            assert ask(server, "/x", {}, Origin=origin).text.endswith("False")


def test_another_host_is_refused() -> None:
    with serving(echo) as server:
        for host in ("evil.example", f"localhost:{server.port}", server.address, ""):
            assert ask(server, "/", Host=host).status in (400, 403)


@pytest.mark.parametrize("method", ["PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT", "FOO"])
def test_other_methods_are_refused(method: str) -> None:
    with serving(echo) as server:
        head = f"{method} / HTTP/1.1\r\nHost: {server.address}:{server.port}\r\n\r\n"
        received = raw(server, head.encode())
        assert received == b"" or parsed(received).status in (400, 404, 405)


@pytest.mark.parametrize("name", REQUESTS)
def test_a_malformed_request_is_refused_and_others_are_served(name: str) -> None:
    with serving(echo) as server:
        assert b" 200 " not in raw(server, REQUESTS[name])[:20]
        assert ask(server, "/").status == 200


def test_a_giant_form_and_one_of_many_fields_are_refused() -> None:
    with serving(echo) as server:
        assert ask(server, "/", {"a": "x" * servers.MAX_BODY}).status == 413
        assert ask(server, "/", {f"a{i}": "" for i in range(servers.MAX_FIELDS + 1)}).status == 400
        assert ask(server, "/?" + "a=&" * 100).status == 400
        assert ask(server, "/", {"a": "x" * 1000}).status == 200


def test_a_body_that_never_ends_is_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(servers, "IDLE_SECONDS", 0.3)
    with serving(echo) as server:
        head = f"POST / HTTP/1.1\r\nHost: {server.address}:{server.port}\r\nContent-Length: 100\r\n\r\nab"
        assert parsed(raw(server, head.encode())).status == 408
        assert server._waiting == 0


def test_a_slow_request_is_cut_whatever_it_dribbles(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(servers, "IDLE_SECONDS", 0.4)
    with serving(echo) as server, socket.create_connection((server.address, server.port), LONG) as peer:
        begun, cut = time.monotonic(), False
        peer.setblocking(False)
        while not cut and time.monotonic() - begun < LONG:
            try:
                peer.sendall(b"G" if time.monotonic() - begun < 0.05 else b"E")
                cut = peer.recv(100) == b""
            except BlockingIOError:
                time.sleep(0.05)
            except ConnectionError:
                cut = True
        assert cut


def test_many_connections_leave_room_for_others(monkeypatch: pytest.MonkeyPatch) -> None:
    with serving(echo) as server, ExitStack() as held:
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
        assert _other(server) == 200


def _other(server: PageServer) -> int:
    """Status of a page for a peer at another address of this computer."""
    with socket.create_connection((server.address, server.port), LONG, ("127.0.0.2", 0)) as peer:
        peer.sendall(f"GET / HTTP/1.1\r\nHost: {server.address}:{server.port}\r\n\r\n".encode())
        return parsed(peer.recv(65536)).status


def test_more_requests_than_can_be_answered_are_asked_to_come_again() -> None:
    go_on, inside = threading.Event(), threading.Semaphore(0)

    def slow(request: WebRequest) -> WebReply:
        inside.release()
        go_on.wait(LONG)
        return WebReply(b"x")

    with serving(slow) as server:
        server._waiting = servers.MAX_WAITING - 1
        first = threading.Thread(target=ask, args=(server, "/"))
        first.start()
        assert inside.acquire(timeout=LONG)
        assert ask(server, "/").status == 503
        go_on.set()
        first.join()
        assert ask(server, "/").status == 200


def test_a_page_that_fails_ends_no_other(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(servers.log, "exception", lambda *_: None)

    def failing(request: WebRequest) -> WebReply:
        if request.path == "/bad":
            raise ValueError
        return WebReply(b"x")

    with serving(failing) as server:
        assert ask(server, "/bad").status == 500
        assert ask(server, "/").status == 200


def test_a_page_that_the_browser_has_is_not_sent_again() -> None:
    with serving(lambda request: tagged(request, echo(request))) as server:
        first = ask(server, "/")
        again = ask(server, "/", If_None_Match=first.headers["etag"])
        assert (again.status, again.text) == (304, "")
        assert ask(server, "/other", If_None_Match=first.headers["etag"]).status == 200


def test_a_port_that_is_taken_is_named() -> None:
    from pigaming_app.ui.input.phones.network import PhonesUnavailable

    with serving(echo) as server:
        other = PageServer(echo, server.address, server.port)
        with pytest.raises(PhonesUnavailable, match="port_taken"):
            other.start()
