"""The server for a phone's pictures, its certificate, and everything that it refuses. Clients check the certificate."""

import asyncio
import ssl
import stat
import subprocess
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from shutil import which
from typing import Any

import pytest
from aiohttp import ClientSession, ClientSSLError, TCPConnector, WSMsgType

from pigaming_app.ui.web import certificate as certificates
from pigaming_app.ui.web import phone_camera
from pigaming_app.ui.web.certificate import Certificate
from pigaming_app.ui.web.phone_camera import PhoneCameraServer
from tests.ui.web.client import LONG, running

pytestmark = pytest.mark.usefixtures("_no_threads_stay")
TOKEN, PHONE = "abcdefghjk", "0123456789abcdef" * 2
HERE = "127.0.0.1"
CLOSING = 0.5  # s until the last connection is cut


class Session:
    """Notes what a phone sends."""

    def __init__(self, phone: str, send: Callable[[str], None], close: Callable[[int], None]) -> None:
        self.phone, self.send, self.close = phone, send, close
        self.got: list[bytes] = []
        self.ended = False
        send("hello")

    def receive(self, message: bytes) -> int:
        self.got.append(message)
        return 4000 if message == b"nonsense" else 0

    def gone(self) -> None:
        self.ended = True


class Served:
    """A running server and the sessions of its phones."""

    def __init__(self, path: Path) -> None:
        self.sessions: list[Session] = []
        self.certificate = Certificate(path, HERE)
        texts = {"old": "Old <code>.", "running": "</script>"}
        self.server = PhoneCameraServer(HERE, 0, TOKEN, self.certificate, texts, self._joined)

    def _joined(self, *about: Any) -> Session:
        self.sessions.append(Session(*about))
        return self.sessions[-1]

    def play(self, story: Callable[[ClientSession], Awaitable[None]]) -> None:
        """Run a story of clients that trust the authority, and no other."""
        trust = ssl.create_default_context(cadata=self.certificate.authority)

        async def run() -> None:
            async with ClientSession(connector=TCPConnector(ssl=trust)) as session, asyncio.timeout(2 * LONG):
                await story(session)
            await asyncio.sleep(CLOSING)

        asyncio.run(run())

    async def socket(self, session: ClientSession, phone: str = PHONE, **more: Any) -> Any:
        origin = {"origin": f"https://{self.server.host}", **more}
        return await session.ws_connect(f"{self.server.url}/pictures?phone={phone}", **origin)


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    served = Served(tmp_path / "camera.pem")
    with running(served.server):
        yield served


async def closed(socket: Any) -> int | None:
    while (await socket.receive(timeout=LONG)).type not in (WSMsgType.CLOSE, WSMsgType.CLOSED, WSMsgType.CLOSING):
        pass
    code: int | None = socket.close_code
    await socket.close()
    return code


async def until(condition: Callable[[], Any]) -> None:
    async with asyncio.timeout(LONG):
        while not condition():
            await asyncio.sleep(0.005)


def test_pictures_arrive_and_texts_go_out(served: Served) -> None:
    picture = bytes(range(256)) * 4000

    async def story(session: ClientSession) -> None:
        socket = await served.socket(session)
        assert (await socket.receive(timeout=LONG)).data == "hello"
        await socket.send_bytes(picture)
        await until(lambda: served.sessions[0].got)
        await asyncio.to_thread(served.sessions[0].send, "next")
        assert (await socket.receive(timeout=LONG)).data == "next"
        await socket.close()
        await until(lambda: served.sessions[0].ended)

    served.play(story)
    assert served.sessions[0].phone == PHONE
    assert served.sessions[0].got == [picture]


def test_the_page_and_its_files_come_with_the_token_only(served: Served) -> None:
    async def story(session: ClientSession) -> None:
        async with session.get(served.server.url.upper().replace("HTTPS", "https")) as answer:
            page = await answer.text()
            assert answer.status == 200
            assert TOKEN in page
            assert "\\u003c/script>" in page
            assert "worker-src 'self'" in answer.headers["Content-Security-Policy"]
        for name in phone_camera.FILES:
            async with session.get(f"{served.server.url}/{name}") as answer:
                assert (answer.status, len(await answer.read()) > 100) == (200, True)
        async with session.get(f"{served.server.url}/{phone_camera.AUTHORITY}") as answer:
            assert await answer.read() == served.certificate.authority
        for path in ("", "/wrongtoken", "/wrongtoken/camera.js", f"/{TOKEN}/page.js", f"/{TOKEN}x"):
            async with session.get(f"https://{served.server.host}{path}") as answer:
                assert answer.status in (403, 404), path
                assert (answer.status == 403) == (not path.startswith(f"/{TOKEN}/"))
        async with session.get(served.server.url, headers={"Host": "evil.example"}) as answer:
            assert answer.status == 403

    served.play(story)


def test_sockets_need_token_origin_and_a_name(served: Served) -> None:
    async def story(session: ClientSession) -> None:
        right = {"Origin": f"https://{served.server.host}"}
        wrong: tuple[dict[str, str], ...]
        wrong = {"Origin": f"http://{served.server.host}"}, {"Origin": "https://evil.example"}, {"Origin": "null"}, {}
        stranger = served.server.url.replace(TOKEN, "zzzzzzzzzz")
        for url, headers in ((stranger, right), *((served.server.url, one) for one in wrong)):
            async with session.get(f"{url}/pictures?phone={PHONE}", headers=headers) as answer:
                assert answer.status == 403
        async with session.get(f"{served.server.url}/pictures?phone={PHONE}", headers=right) as answer:
            assert answer.status == 400, "no socket"
        for name in ("", "x", "G" * 32, PHONE + "0"):
            assert await closed(await served.socket(session, name)) == phone_camera.REFUSED

    served.play(story)
    assert served.sessions == []
    assert served.server.refusals.counts["foreign origin refused"] == 4
    assert served.server.refusals.counts["phone without a name refused"] == 4


def test_nonsense_texts_giants_and_floods_end_the_connection(served: Served, monkeypatch: pytest.MonkeyPatch) -> None:
    async def story(session: ClientSession) -> None:
        socket = await served.socket(session)
        await socket.send_bytes(b"nonsense")
        assert await closed(socket) == 4000
        socket = await served.socket(session)
        await socket.send_str("text")
        assert await closed(socket) == phone_camera.REFUSED
        socket = await served.socket(session)
        await socket.send_bytes(bytes(phone_camera.MAX_PICTURE + 1))
        assert await closed(socket) in (1009, 1006, phone_camera.REFUSED)
        socket = await served.socket(session)
        for _ in range(phone_camera.MAX_RATE + 1):
            await socket.send_bytes(b"x")
        assert await closed(socket) == phone_camera.FLOOD
        await until(lambda: all(one.ended for one in served.sessions))

    served.play(story)
    assert len(served.sessions[-1].got) == phone_camera.MAX_RATE
    assert served.sessions[2].got == []


def test_a_silent_phone_is_gone(served: Served, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(phone_camera, "SILENT_SECONDS", 0.05)

    async def story(session: ClientSession) -> None:
        assert await closed(await served.socket(session)) == phone_camera.SILENT
        await until(lambda: served.sessions[0].ended)

    served.play(story)


def test_who_does_not_know_the_authority_is_warned(served: Served) -> None:
    async def story(_: ClientSession) -> None:
        async with ClientSession() as session:
            with pytest.raises(ClientSSLError):
                await session.get(served.server.url)

    served.play(story)


def test_the_certificate_is_made_once_and_anew_for_another_address(tmp_path: Path, monkeypatch: Any) -> None:
    path = tmp_path / "folder" / "camera.pem"
    first = Certificate(path, "192.168.0.7").authority
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert Certificate(path, "192.168.0.7").authority == first
    second = Certificate(path, "192.168.0.8").authority
    assert second != first
    path.write_text(path.read_text()[:700])
    third = Certificate(path, "192.168.0.8").authority
    assert third != second
    monkeypatch.setattr(certificates, "LEFT", certificates.DAYS + 1)
    assert Certificate(path, "192.168.0.8").authority != third
    assert stat.S_IMODE(path.stat().st_mode) == 0o600


@pytest.mark.skipif(not which("openssl"), reason="no openssl")
def test_openssl_accepts_the_certificate_for_its_address_only(tmp_path: Path) -> None:
    path = tmp_path / "camera.pem"
    authority = tmp_path / "authority.pem"
    authority.write_text(ssl.DER_cert_to_PEM_cert(Certificate(path, "10.1.2.3").authority))

    def verified(*more: str) -> bool:
        command = [
            "openssl",
            "verify",
            "-x509_strict",
            "-purpose",
            "sslserver",
            "-CAfile",
            str(authority),
            *more,
            str(path),
        ]
        return subprocess.run(command, capture_output=True, check=False).returncode == 0

    assert verified("-verify_ip", "10.1.2.3")
    assert not verified("-verify_ip", "10.1.2.4")
    text = subprocess.run(
        ["openssl", "x509", "-in", str(authority), "-noout", "-text"], capture_output=True, text=True, check=True
    ).stdout
    assert "10.1.2.3/255.255.255.255" in text, "whoever installs it trusts it for this address only"
    assert path.read_text().count("PRIVATE KEY") == 2, "the key of the authority is not kept"
