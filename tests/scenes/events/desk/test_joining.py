"""An arcade joins at the desk: by the PIN, then by a token; what anybody else sends changes nothing."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

from pigaming_app.events.changes.live import LiveMatch, LiveMatches, write
from pigaming_app.events.event import Event
from pigaming_app.events.event_files import save, update
from pigaming_app.events.journal import Postponed, Recorded, Substituted, Summoned
from pigaming_app.events.network import mirror
from pigaming_app.events.network.link import EventLink, Exchange, Offline, Unwelcome, log_in
from pigaming_app.events.network.mirror import Host, host_at, host_of, note, path_of
from pigaming_app.events.network.news import PATH
from pigaming_app.events.spec import Entrant, Format
from pigaming_app.scenes.events.desk.joining import LASTS, Joining
from pigaming_app.storage.pin import PinFile
from pigaming_app.ui.web.server import PageServer, WebReply, WebRequest
from tests.events.examples import ranked
from tests.jobs.kiosk.test_supervisor import Clock
from tests.scenes.events.desk.examples import PIN, cup, desk_on, new_event
from tests.ui.web.client import ask, raw, serving

pytestmark = pytest.mark.usefixtures("_no_threads_stay")


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return new_event(tmp_path, form=Format.ROUND_ROBIN)


@pytest.fixture
def server(path: Path) -> Iterator[PageServer]:
    with serving(desk_on(path)) as server:
        yield server


@pytest.fixture
def host(server: PageServer) -> Host:
    """The desk, with a token."""
    return admitted(server)


@pytest.fixture
def copy(host: Host, path: Path, tmp_path: Path) -> Path:
    """A copy of the event on another computer."""
    copy = path_of(tmp_path / "there", host, cup(path))
    save(copy, cup(path))
    return copy


def admitted(server: PageServer) -> Host:
    host = Host(server.address, server.port)
    return replace(host, token=log_in(host, PIN))


def test_what_either_has_got_is_taken_over(path: Path, host: Host, copy: Path) -> None:
    exchange = Exchange(host, "right")
    update(copy, lambda event: event.after(Summoned(1, "right")).record(ranked(event.open[0], *event.open[0].entrants)))
    update(path, lambda event: event.after(Postponed(2)))
    exchange.run(copy)
    assert cup(path).journal == cup(copy).journal
    assert [type(entry) for entry in cup(path).journal] == [Postponed, Summoned, Recorded]
    before = path.stat()
    exchange.run(copy)
    assert path.stat() == before, "nothing new"
    update(path, lambda event: event.withdraw("Duda").renamed("Finals"))
    exchange.run(copy)
    assert cup(copy) == cup(path)


def test_a_claim_that_comes_too_late_is_given_up(path: Path, host: Host, copy: Path) -> None:
    exchange = Exchange(host, "right")
    exchange.run(copy)
    update(path, lambda event: event.after(Summoned(1, "left")))
    update(copy, lambda event: event.after(Summoned(1, "right")))
    exchange.run(copy)
    assert cup(copy).calls == cup(path).calls == {1: "left"}
    exchange.run(copy)
    assert len(cup(path).journal) == 1


def test_a_host_whose_last_entry_was_lost_gets_it_back(path: Path, host: Host, copy: Path) -> None:
    """As after a power cut, when the backup has taken the place of the file."""
    exchange, before = Exchange(host, "right"), path.read_text()
    update(path, lambda event: event.after(Postponed(2)))
    exchange.run(copy)
    path.write_text(before)
    update(copy, lambda event: event.after(Postponed(1)))
    for _ in range(3):
        exchange.run(copy)
    assert cup(path).journal == cup(copy).journal == (Postponed(2), Postponed(1))


def test_its_score_is_on_the_page_of_the_host_until_it_shows_something_else(
    path: Path, host: Host, copy: Path, server: PageServer
) -> None:
    exchange = Exchange(host, "right")
    write(copy, LiveMatch("right", 1, {"Ana": "12"}, "1:30", 1))
    exchange.run(copy)
    assert "1:30" in ask(server, "/").text
    assert [one.arcade for one in LiveMatches(path).now()] == ["right"]
    next(copy.parent.glob(".*.live-*")).unlink()
    exchange.run(copy)
    assert LiveMatches(path).now() == ()


def test_another_event_at_the_desk_is_not_mixed_with_this_one(path: Path, host: Host, copy: Path) -> None:
    exchange = Exchange(host, "right")
    exchange.run(copy)
    new_event(path.parent, "Eva", "Fee", "Gil")
    before = copy.read_bytes()
    with pytest.raises(Unwelcome, match="another event"):
        exchange.run(copy)
    assert copy.read_bytes() == before
    assert path_of(copy.parent, host, cup(path)) != copy


def test_a_token_outlasts_a_restart_but_not_a_new_pin(path: Path) -> None:
    with serving(desk_on(path)) as server:
        host = admitted(server)
    with serving(desk_on(path)) as server:  # the same PIN, but with another salt
        with pytest.raises(Unwelcome):
            Exchange(replace(host, port=server.port), "right").fetch()
        host = admitted(server)
    pin = PinFile(path.parent)
    clock = Clock()
    joining = Joining(path, pin, lambda: cup(path), clock)
    clock.now = float(host.token.partition("-")[0])
    body = b'{"arcade": "right"}'
    assert sent(joining, body, host.token).status == 200
    assert sent(joining, body, host.token[:-1]).status == 403
    clock.now += LASTS + 1.0
    assert sent(joining, body, host.token).status == 403
    clock.now -= LASTS
    pin.remove()
    for token in (host.token, "", "-", "--", host.token.rpartition("-")[0] + "-"):
        assert sent(joining, body, token).status == 403


def sent(joining: Joining, body: bytes, token: str, **more: str) -> WebReply:
    headers = {"content-type": "application/json", "authorization": f"Bearer {token}"} | more
    return joining(WebRequest("POST", PATH, headers=headers, body=body, peer="192.0.2.7", own=True))


def test_an_ai_in_a_file_of_the_other_computer_is_left_out(path: Path, host: Host, copy: Path) -> None:
    def changed(event: Event) -> Event:
        event = event.add(Entrant("Eva", "/etc/passwd.npz")).substitute("Ana", "..\\x.onnx")
        return event.substitute("Bia", "level1")

    exchange = Exchange(host, "right")
    exchange.run(copy)
    update(copy, changed)
    for _ in range(2):
        exchange.run(copy)
        assert cup(copy).journal == cup(path).journal == (Substituted("Bia", "level1"),)


def test_guessing_the_pin_takes_as_long_as_at_the_desk(server: PageServer) -> None:
    host = Host(server.address, server.port)
    for i in range(4):
        with pytest.raises(Unwelcome, match=r"not the PIN|next attempt"):
            log_in(host, f"{i:06}")
    with pytest.raises(Unwelcome, match=r"next attempt in \d+ s") as refused:
        log_in(host, PIN)
    assert refused.value.wait > 1.0
    assert ask(server, "/desk/login", {"pin": PIN}).status == 403, "one count for both"


def test_no_page_of_another_site_and_nobody_without_a_token_changes_anything(
    path: Path, host: Host, server: PageServer
) -> None:
    before = path.read_bytes()
    entry = {"entry": "withdrawal", "name": "Ana"}
    mark = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"  # SHA-256 of nothing
    body = json.dumps({"arcade": "right", "after": 0, "mark": mark, "entries": [entry]})
    here = f"{server.address}:{server.port}"
    right = {
        "Host": here,
        "Origin": f"http://{here}",
        "Content-Type": "application/json",
        "Authorization": f"Bearer {host.token}",
        "Content-Length": str(len(body)),
    }

    def status(method: str = "POST", **wrong: str) -> int:
        lines = [f"{method} {PATH} HTTP/1.1", *(f"{k}: {v}" for k, v in (right | wrong).items() if v)]
        return int(raw(server, ("\r\n".join(lines) + "\r\n\r\n" + body).encode()).split()[1])

    assert status(Origin="http://evil.example") == status(Origin="") == 400
    assert status(**{"Content-Type": "text/plain"}) == 400
    assert status(Authorization="") == status(Authorization=f"Bearer {host.token[:-1]}x") == 403
    assert status(Host="evil.example") == 403
    assert status("OPTIONS") == 405
    assert status("GET") == 404
    assert path.read_bytes() == before
    assert status() == 200
    assert cup(path).withdrawn == {"Ana"}


WILD = (b"", b"9", b"-", b"[", b"\\u0000", b"1e999", b"\xff")


def test_any_body_is_answered_and_the_file_stays_readable(path: Path, host: Host) -> None:
    random, joining = Random(3), desk_on(path)._joining
    token = log_in_here(joining)
    news = json.dumps(
        {
            "arcade": "right",
            "mark": "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855",
            "entries": [
                {"entry": "result", "outcome": {"fixture": 1, "places": [["Ana"], ["Duda"]]}},
                {"entry": "seats", "fixture": 2, "entrants": ["Caio", "Bia"]},
                {"entry": "late", "entrant": {"name": "Eva", "brain": "level1"}},
            ],
            "live": {"arcade": "right", "match": 2, "scores": {"Bia": "3"}},
        }
    ).encode()
    seen = set()
    for _ in range(1500):
        wild = bytearray(news)
        for _ in range(random.randint(1, 3)):
            at = random.randrange(len(wild))
            wild[at : at + random.choice((0, 1, 1, 5))] = random.choice(
                (b"", b"9", b"-", b"[", b"\\u0000", b"1e999", b"\xff")
            )
        seen.add(sent(joining, bytes(wild), token).status)
    assert {200, 400} <= seen <= {200, 400, 409}
    cup(path)


def log_in_here(joining: Joining) -> str:
    body = json.dumps({"pin": PIN}).encode()
    headers = {"content-type": "application/json"}
    reply = joining(WebRequest("POST", "/join/login", headers=headers, body=body, peer="192.0.2.8", own=True))
    return str(json.loads(reply.body)["token"])


@pytest.mark.parametrize(
    "answer",
    [
        WebReply(b"", 200),
        WebReply(b"[]", 200),
        WebReply(b"\xff", 200),
        WebReply(b'{"format": 1, "spec": {}, "journal": []}', 200),
        WebReply(b"[" * 9999, 200),
        WebReply(b"x" * 8_100_000, 200),
        WebReply(b"", 304),
        WebReply(b"", 500),
        WebReply(b"", 302, headers={"Location": "http://192.0.2.1/"}),
    ],
    ids=str,
)
def test_a_host_that_answers_anything_is_offline(tmp_path: Path, answer: WebReply) -> None:
    with serving(lambda request: answer) as server:
        host = Host(server.address, server.port, "x")
        with pytest.raises(Offline):
            Exchange(host, "right").fetch()
        with pytest.raises(Offline):
            log_in(host, PIN)


def test_without_a_host_the_copy_stays_and_the_link_goes_on_trying(path: Path, host: Host, copy: Path) -> None:
    nobody = replace(host, port=1)
    note(copy, nobody)
    link = EventLink(copy, nobody, "right")
    link.stop()
    assert "cannot be reached" in link.trouble
    assert cup(copy) == cup(path)


def test_where_a_copy_is_from_is_noted_for_its_owner_only(tmp_path: Path, host: Host, copy: Path) -> None:
    note(copy, host)
    assert host_of(copy) == host
    assert host_of(tmp_path / "cup.json") is None
    assert mirror.latest(copy.parent, host) == copy
    (secret,) = copy.parent.glob(".*.host")
    assert secret.stat().st_mode & 0o077 == 0 or not hasattr(secret, "owner")


@pytest.mark.parametrize(
    ("address", "expected"),
    [
        ("http://192.168.1.5", ("192.168.1.5", 8788)),
        ("http://192.168.1.5:9000/desk", ("192.168.1.5", 9000)),
        ("HTTP://Host.local/", ("host.local", 8788)),
    ],
)
def test_an_address_as_people_type_it(address: str, expected: tuple[str, int]) -> None:
    host = host_at(address, 8788)
    assert (host.address, host.port) == expected


@pytest.mark.parametrize(
    "address", ["http://", "http://a b", "http://x:99999", "http://x:y", "http://ü", "http://[::1"]
)
def test_anything_else_is_no_address(address: str) -> None:
    with pytest.raises(ValueError):  # noqa: PT011
        host_at(address, 8788)
