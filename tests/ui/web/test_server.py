"""The server of pages: what it answers, and to whom."""

import threading

import pytest

from pigaming_app.ui.web import listener
from pigaming_app.ui.web import server as servers
from pigaming_app.ui.web.server import WebReply, WebRequest, tagged
from tests.ui.web.client import LONG, ask, parsed, raw, serving

pytestmark = pytest.mark.usefixtures("_no_threads_stay", "quiet")


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


@pytest.mark.parametrize("method", ["PUT", "DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT", "FOO"])
def test_other_methods_are_refused(method: str) -> None:
    with serving(echo) as server:
        head = f"{method} / HTTP/1.1\r\nHost: {server.address}:{server.port}\r\n\r\n"
        received = raw(server, head.encode())
        assert received == b"" or parsed(received).status in (400, 404, 405)


def test_a_giant_form_and_one_of_many_fields_are_refused() -> None:
    with serving(echo) as server:
        assert ask(server, "/", {"a": "x" * servers.MAX_BODY}).status == 413
        assert ask(server, "/", {f"a{i}": "" for i in range(servers.MAX_FIELDS + 1)}).status == 400
        assert ask(server, "/?" + "a=&" * 100).status == 400
        assert ask(server, "/", {"a": "x" * 1000}).status == 200


def test_a_body_that_never_ends_is_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(listener, "IDLE_SECONDS", 0.3)
    with serving(echo) as server:
        head = f"POST / HTTP/1.1\r\nHost: {server.address}:{server.port}\r\nContent-Length: 100\r\n\r\nab"
        assert parsed(raw(server, head.encode())).status == 408
        assert server._waiting == 0


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
