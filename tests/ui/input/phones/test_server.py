"""The server: a page and sockets for phones, and everything that it refuses."""

import asyncio
import json
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress

import pytest
from aiohttp import ClientSession, WSServerHandshakeError

from pigaming_app.ui.input import phone_messages as protocol
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, StickState
from pigaming_app.ui.input.phone_messages import BITS, SeatView, Wish, WishKind
from pigaming_app.ui.input.phones import connection
from pigaming_app.ui.input.phones import roster as rosters
from pigaming_app.ui.input.phones import server as servers
from pigaming_app.ui.input.phones.server import PhoneServer
from tests.ui.input.phones.client import origin, phone, play, serving, socket_of, until
from tests.ui.web.client import LONG

pytestmark = pytest.mark.usefixtures("_no_threads_stay")


@pytest.fixture
def patient(controls: Controls, monkeypatch: pytest.MonkeyPatch) -> None:
    """No phone counts as silent because this machine is slow."""
    monkeypatch.setattr(connection, "SILENT_SECONDS", 2 * LONG)
    monkeypatch.setattr(controls.phones, "clock", lambda: 0.0)


@pytest.fixture
def server(controls: Controls, patient: None) -> Iterator[PhoneServer]:
    with serving(controls.phones) as server:
        yield server


def pressed(controls: Controls) -> list[tuple[Button, int]]:
    return [(press.button, press.device.number) for press in controls.presses([])]


async def answer(session: ClientSession, server: PhoneServer, path: str, **headers: str) -> tuple[int, str]:
    async with session.get(f"{origin(server)}{path}", headers=headers) as response:
        return response.status, (await response.read()).decode(errors="replace")


async def presses(controls: Controls, enough: Callable[[list[tuple[Button, int]]], object]) -> list[tuple[Button, int]]:
    """The presses from now on, until they are enough."""
    seen: list[tuple[Button, int]] = []

    def found() -> object:
        seen.extend(pressed(controls))
        return enough(seen)

    await until(found)
    return seen


async def drives(controls: Controls, number: int, state: StickState) -> None:
    """Wait until a phone drives so."""
    await until(lambda: [pressed(controls)] and controls.drive(Device("phone", number)) == state)


async def still_plays(session: ClientSession, server: PhoneServer, controls: Controls) -> None:
    """A phone joins, presses FIRE, and leaves."""
    one = await phone(session, server)
    await one.touch(buttons=BITS[Button.FIRE])
    await presses(controls, lambda seen: Button.FIRE in dict(seen))
    await one.socket.close()
    await presses(controls, lambda seen: Button.LOST in dict(seen))


def test_a_phone_joins_drives_and_is_told_its_seat(controls: Controls, server: PhoneServer) -> None:
    async def story(session: ClientSession) -> None:
        one = await phone(session, server)
        await one.touch(0.0, -1.0, BITS[Button.FIRE])
        await drives(controls, 0, StickState(1.0, 0.0, True))
        controls.phones.show(0, SeatView(2, "#14e48c", True, "3", "1:05", name="Ana"))
        tally = {"score": "3", "clock": "1:05", "place": "", "before": -1, "line": "", "name": "Ana", "called": False}
        assert await one.told() == {"state": {"seat": 2, "color": "#14e48c", "playing": True, **tally}}
        controls.rumble(Device("phone", 0), 1.0, 0.5, 0.2)
        assert await one.told() == {"rumble": [1.0, 0.5, 200]}
        await one.socket.close()
        await presses(controls, lambda seen: seen[-1:] == [(Button.LOST, 0)])

    play(story)


def test_the_page_has_its_texts_and_nothing_from_elsewhere(server: PhoneServer) -> None:
    async def story(session: ClientSession) -> None:
        async with session.get(server.url) as response:
            page = await response.text()
            policy = response.headers["Content-Security-Policy"]
            assert response.headers["Cache-Control"] == "no-store"
            assert "Set-Cookie" not in response.headers
        assert "default-src 'none'" in policy
        assert "fire \\u003c/script>" in page, "a text cannot end the script"
        for name in servers.FILES:
            status, body = await answer(session, server, f"/{server.token}/{name}")
            assert status == 200
            assert len(body) > 1000
            for word in ("http://", "https://", "//cdn", "document.cookie", "localStorage", "innerHTML"):
                assert word not in page + (body if name != "oxanium.woff2" else "")
        assert (await answer(session, server, f"/{server.token.upper()}"))[0] == 200, "the QR code is in capitals"

    play(story)


@pytest.mark.parametrize("path", ["/", "/abcdefghjk", "/abcdefghjk/page.js", "/%ff%fe", "//", "/../etc/passwd"])
def test_without_the_token_nothing_is_served(controls: Controls, server: PhoneServer, path: str) -> None:
    async def story(session: ClientSession) -> None:
        status, body = await answer(session, server, path)
        assert status == 403
        assert "This code is old." in body
        assert server.refusals.counts["wrong token refused"] == 1

    play(story)


def test_an_old_token_is_refused_after_switching_off_and_on(controls: Controls) -> None:
    with serving(controls.phones) as server:
        old, port = server.token, server.port
    with serving(controls.phones, port=port) as server:
        assert server.token != old

        async def story(session: ClientSession) -> None:
            assert (await answer(session, server, f"/{old}"))[0] == 403
            with pytest.raises(WSServerHandshakeError) as refused:
                await session.ws_connect(f"{origin(server)}/{old}/pad", origin=origin(server))
            assert refused.value.status == 403

        play(story)


@pytest.mark.parametrize("foreign", ["http://evil.example", "null", "", "http://127.0.0.1", "https://127.0.0.1:1"])
def test_a_page_of_another_origin_opens_no_socket(controls: Controls, server: PhoneServer, foreign: str) -> None:
    async def story(session: ClientSession) -> None:
        with pytest.raises(WSServerHandshakeError) as refused:
            await socket_of(session, server, origin=foreign or None)
        assert refused.value.status == 403
        assert server.refusals.counts["foreign origin refused"] == 1
        assert pressed(controls) == []

    play(story)


def test_unknown_pages_and_methods_are_refused(controls: Controls, server: PhoneServer) -> None:
    async def story(session: ClientSession) -> None:
        for path in ("/settings.toml", "/page.html", "/..%2f..%2fsettings.toml", "/pad/pad"):
            assert (await answer(session, server, f"/{server.token}{path}"))[0] == 404
        assert (await answer(session, server, f"/{server.token}/pad"))[0] == 403, "no socket, no origin"
        async with session.post(server.url, data=b"x" * 5000) as response:
            assert response.status == 405
        await still_plays(session, server, controls)

    play(story)


def test_a_flood_ends_the_connection_and_slows_nobody(controls: Controls, server: PhoneServer) -> None:
    async def story(session: ClientSession) -> None:
        good, bad = await phone(session, server), await phone(session, server)
        flood, sent = server.refusals.counts, 0
        with suppress(ConnectionError):
            while not flood["more than 200 messages in a second refused"]:
                await bad.touch(buttons=sent % 2)
                sent += 1
        assert sent > protocol.MAX_RATE
        assert await bad.closed() in (protocol.CLOSED_FLOOD, 1006)
        await until(lambda: server.refusals.counts["more than 200 messages in a second refused"] == 1)
        await good.touch(0.0, -1.0)
        await drives(controls, 0, StickState(1.0))

    play(story)


def test_sixty_messages_a_second_are_no_flood() -> None:
    from pigaming_app.ui.web.refusals import RateMeter

    meter = RateMeter(protocol.MAX_RATE)
    assert not any(meter.exceeded(i / 60) for i in range(600))
    assert not any(meter.exceeded(20 + i / 199) for i in range(600))
    assert any(meter.exceeded(40 + i / 220) for i in range(600))


def test_a_fifth_phone_waits_without_a_say_and_plays_when_one_leaves(controls: Controls, server: PhoneServer) -> None:
    async def story(session: ClientSession) -> None:
        four = [await phone(session, server) for _ in range(4)]
        fifth = await phone(session, server)
        await fifth.touch(0.0, -1.0, BITS[Button.FIRE])
        await four[3].touch(buttons=BITS[Button.FIRE])
        await presses(controls, lambda seen: (Button.FIRE, 3) in seen)
        assert sorted(server.phones.plugged) == [0, 1, 2, 3]
        controls.phones.show(4, SeatView(before=0, line="3 : 2"))
        told = await fifth.told()
        assert (told["state"]["before"], told["state"]["line"]) == (0, "3 : 2"), "it is told what happens"
        await four[2].socket.close()
        await until(lambda: [pressed(controls)] and sorted(server.phones.plugged) == [0, 1, 3, 4])
        await fifth.touch()
        await fifth.touch(buttons=BITS[Button.FIRE])
        await presses(controls, lambda seen: (Button.FIRE, 4) in seen)

    play(story)


def test_thirty_two_phones_connect_and_the_next_one_is_told_that_the_hall_is_full(
    controls: Controls, server: PhoneServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(rosters, "MAX_OF_ADDRESS", rosters.MAX_CONNECTED)

    async def story(session: ClientSession) -> None:
        all_phones = [await phone(session, server) for _ in range(rosters.MAX_CONNECTED)]
        assert len({one.resume for one in all_phones}) == 32
        late = await socket_of(session, server)
        await late.receive()
        assert late.close_code == protocol.CLOSED_FULL
        assert len(server.roster.queue()) == 28
        await all_phones[9].socket.close()
        await until(lambda: len(server.roster.queue()) == 27)
        await phone(session, server)

    play(story)


def test_a_name_a_colour_and_a_vote_arrive(controls: Controls, server: PhoneServer) -> None:
    async def story(session: ClientSession) -> None:
        one = await phone(session, server)
        for wish in (Wish(WishKind.NAME, text="Zoë"), Wish(WishKind.COLOUR, 3), Wish(WishKind.GAME, 2)):
            await one.socket.send_bytes(protocol.pack_wish(wish))
        await until(lambda: server.roster.guests()[0].colour == 3)
        assert controls.phones.names[0] == "Zoë"
        assert server.roster.wishes() == [(0, Wish(WishKind.GAME, 2))]
        await one.socket.send_bytes(protocol.pack_wish(Wish(WishKind.NAME, text="x" * 64)))
        assert await one.closed() in (protocol.CLOSED_MALFORMED, 1009, 1006), "longer than a frame may be"

    play(story)


def test_a_removed_phone_is_told_so(controls: Controls, server: PhoneServer) -> None:
    async def story(session: ClientSession) -> None:
        one, two = await phone(session, server), await phone(session, server)
        server.roster.remove(0, ban=True)
        assert await one.closed() == protocol.CLOSED_REMOVED
        again = await socket_of(session, server, one.resume)
        await again.receive()
        assert again.close_code == protocol.CLOSED_REMOVED
        await two.touch(buttons=BITS[Button.FIRE])
        await presses(controls, lambda seen: (Button.FIRE, 1) in seen)

    play(story)


def test_a_phone_that_returns_gets_its_number_back(controls: Controls, server: PhoneServer) -> None:
    async def story(session: ClientSession) -> None:
        one, two = await phone(session, server), await phone(session, server)
        pressed(controls)
        for locked, number in ((one, 0), (two, 1)):
            await locked.socket.close()
            assert await presses(controls, bool) == [(Button.LOST, number)]
        again = await phone(session, server, two.resume)
        assert pressed(controls) == [(Button.FOUND, 1)]
        assert again.resume != two.resume
        stranger = await phone(session, server, two.resume)
        assert pressed(controls) == [(Button.FOUND, 2)], "a token counts once"
        await stranger.socket.close()

    play(story)


def test_a_phone_that_returns_before_it_was_missed_replaces_itself(controls: Controls, server: PhoneServer) -> None:
    """The network dropped the old connection, and the server has not noticed yet."""

    async def story(session: ClientSession) -> None:
        old = await phone(session, server)
        await old.touch(0.0, -1.0, BITS[Button.FIRE])
        await presses(controls, lambda seen: {(Button.FIRE, 0), (Button.UP, 0)} <= {*seen})
        new = await phone(session, server, old.resume)
        assert pressed(controls) == [], "neither lost nor found"
        controls.forget_taps()
        assert controls.drive(Device("phone", 0)) == StickState(), "nothing held before counts"
        await old.touch(1.0, 0.0)
        await old.closed()
        assert controls.drive(Device("phone", 0)) == StickState(), "the old connection has no say"
        await new.touch(1.0, 0.0)
        await until(lambda: pressed(controls) == [(Button.RIGHT, 0)])
        assert controls.drive(Device("phone", 0)) == StickState(angular=1.0)

    play(story)


def test_a_silent_phone_is_unplugged(controls: Controls, server: PhoneServer, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection, "SILENT_SECONDS", 0.1)

    async def story(session: ClientSession) -> None:
        one = await phone(session, server)
        assert await one.closed() in (protocol.CLOSED_SILENT, 1006)
        await until(lambda: not server.phones._connected)
        assert pressed(controls) == [], "found and lost within one frame"

    play(story)


@pytest.mark.usefixtures("patient")
def test_a_machine_that_stalls_unplugs_nobody_whose_messages_wait(
    controls: Controls, server: PhoneServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connection, "SILENT_SECONDS", 0.5)

    async def story(session: ClientSession) -> None:
        one = await phone(session, server)
        await one.touch(0.0, -1.0)
        await drives(controls, 0, StickState(1.0))
        stalls = threading.Event()
        assert server._loop
        server._loop.call_soon_threadsafe(stalls.set)
        server._loop.call_soon_threadsafe(time.sleep, 0.8)
        await asyncio.to_thread(stalls.wait)
        await one.touch(0.0, -1.0, BITS[Button.FIRE])
        seen = await presses(controls, bool)
        assert seen[0] == (Button.FIRE, 0)
        await one.socket.close()

    play(story)


@pytest.mark.usefixtures("patient")
def test_switching_off_unplugs_all_phones(controls: Controls) -> None:
    async def story(session: ClientSession) -> None:
        with serving(controls.phones) as server:
            one, _ = await phone(session, server), await phone(session, server)
            assert pressed(controls) == [(Button.FOUND, 0), (Button.FOUND, 1)]
        assert pressed(controls) == [(Button.LOST, 0), (Button.LOST, 1)]
        assert await one.closed() in (1001, 1006)

    play(story)


def test_texts_for_a_slow_phone_do_not_pile_up(controls: Controls, server: PhoneServer) -> None:
    async def story(session: ClientSession) -> None:
        one = await phone(session, server)
        await until(lambda: pressed(controls))
        sender = server.connections[0]
        for i in range(1000):
            sender._texts.append(json.dumps(i))
        assert len(sender._texts) == connection.MAX_TEXTS
        await one.socket.close()
        await asyncio.sleep(0)

    play(story)
