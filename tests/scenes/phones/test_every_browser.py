"""The page's whole way in each of the three families of browsers that phones have.

It waits in the queue, gets a name, cheers, sits down, drives, is locked twice, sees its place, and finds the arcade
again after a restart. The other phones are sockets.
"""

import socket
import time
from collections.abc import Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from pathlib import Path
from typing import Any

import pytest
from aiohttp import ClientSession

from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.play.reconnect import Reconnect
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import Results
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.input.phones import connection
from pigaming_app.ui.input.phones.guest import Stage
from tests.matches import setup_of
from tests.scenes.arcade import Arcade
from tests.scenes.phones.browser import browsing, chromium, running_browser
from tests.scenes.phones.firefox import firefox, firefox_browsing
from tests.scenes.phones.touch_page import LONG, OPEN, PORTRAIT
from tests.scenes.phones.visitors import OpenDay
from tests.scenes.phones.webkit import webkit, webkit_browsing
from tests.ui.input.phones.client import phone as socket_phone

pytestmark = [pytest.mark.long, pytest.mark.usefixtures("_no_threads_stay")]
WITHOUT_WAKE_LOCK = "Object.defineProperty(navigator, 'wakeLock', { value: undefined, configurable: true }) && true"
WATCH = """(() => {
    window.begun = [];
    const Real = window.WebSocket;
    window.WebSocket = class extends Real {
        constructor(...all) { super(...all); window.begun.push(performance.now()); }
    };
    return true;
})()"""  # when sockets were opened


@asynccontextmanager
async def chromium_browsing() -> Any:
    with running_browser() as address:
        async with browsing(address) as browser:
            yield browser


def needs(found: str | None, packages: str) -> Any:
    return pytest.mark.skipif(not found, reason=f"no such browser: apt-get install {packages}")


FAMILIES = [
    pytest.param(chromium_browsing, id="chromium", marks=needs(chromium(), "chromium")),
    pytest.param(firefox_browsing, id="firefox", marks=needs(firefox(), "firefox-esr")),
    pytest.param(webkit_browsing, id="webkit", marks=needs(webkit(), "webkit2gtk-driver xvfb")),
]


def free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


@pytest.mark.again  # Chromium plays in test_browser.py, too
@pytest.mark.parametrize("family", FAMILIES)
def test_a_phone_goes_its_whole_way(
    family: Callable[[], AbstractAsyncContextManager[Any]],
    controls: Controls,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    monkeypatch.setattr(connection, "SILENT_SECONDS", LONG)  # a slow browser is no phone without Wi-Fi
    day = OpenDay(Arcade(controls), family, free_port())
    arcade, host = day.arcade, day.arcade.context.shared(phone_host)
    lobby = arcade.open(Lobby(arcade.context, "pitanks"))
    me = Device("phone", 4)

    def begin() -> MatchScene:
        match = MatchScene(arcade.context, setup_of("pitanks", ["human"] * 4, "classic", 5), lobby.seats.devices())
        arcade.open(match)
        return match

    def guest() -> Any:
        return host.roster.guest(me.number)

    async def story(browser: Any) -> None:
        async with ClientSession() as session:
            assert host.server
            others = [await socket_phone(session, host.server) for _ in range(4)]
            page = await browser.phone(day.url, PORTRAIT)
            await page.until(OPEN)
            await page.reads("before", "You are next")
            await page.value(WITHOUT_WAKE_LOCK)
            await name_it(page, guest, day)
            await page.until("!document.querySelector('#games').matches(':empty')")
            await page.tap_first("#games button")
            await day.until(lambda: day.link.audience.ballot.next_game[1], "a vote")
            await page.tap_first(".cheer")
            await day.until(lambda: guest().cheered_at > 0.0, "a cheer")
            await page.until("!document.getElementById('video').paused")  # it stays awake
            for one in others[1:]:
                await one.socket.close()
            await page.reads("seat", "Press A to join")
            await page.tap("fire")
            await page.reads("seat", "Zoë")
            seat = lobby.seats.devices().index(me)
            match = await day.between_frames(begin)
            await page.until("document.body.classList.contains('playing')")
            await day.until(lambda: not match.opening.countdown.locked, "start")
            await page.steer(0, -1)
            await day.drives(me, lambda state: state.linear > 0.95)
            await page.lift(0)
            await page.touch(1, *await page.middle("fire"))
            await day.drives(me, lambda state: state.fire and state.linear == 0.0)
            await page.lift(1)
            await locked_twice(page, day, match, seat)
            await day.between_frames(lambda: setattr(match.match.state.rules, "ticks", match.match.state.tick + 60))
            await day.top(Results)
            await page.until("/^[1-4](st|nd|rd|th)$/.test(document.getElementById('seat').textContent)")
            await restarted(page, day)
            assert guest().name == "Zoë"
            assert guest().stage in (Stage.TURN, Stage.PLAYING)

    try:
        day.run(story)
    finally:
        host.close()


async def name_it(page: Any, guest: Callable[[], Any], day: OpenDay) -> None:
    """First an unkind name, then one that is shown; another colour and the left hand."""
    await page.tap("me")
    await page.value("document.getElementById('name').value = 'sh1t'")
    await page.tap("save")
    await page.reads("unkind", "Please choose another name.")
    await page.value("document.getElementById('name').value = 'Zoë'")
    await page.tap_first("#colours button:nth-child(3)")
    await page.tap("hand")
    await page.until("document.body.classList.contains('left')")
    stick, buttons = await page.middle("stick"), await page.middle("buttons")
    assert stick[0] > buttons[0], "the sides are swapped"
    await page.tap("hand")
    await page.tap("save")
    await page.until("!document.body.classList.contains('naming')")
    await day.until(lambda: (guest().name, guest().colour) == ("Zoë", 2), "a name and a colour")


async def locked_twice(page: Any, day: OpenDay, match: MatchScene, seat: int) -> None:
    """The first time, all wait for the phone; the second time nobody does. Unlocked, it comes back at once."""
    me = match.devices[seat]
    await page.value(WATCH)
    for attempt in range(2):
        await page.lock(True)
        if attempt == 0:
            await day.top(Reconnect)
        else:
            await day.until(lambda: match.devices[seat] is None, "an AI")
            assert isinstance(day.arcade.stack.top, MatchScene)
        await page.value("(window.unlocked = performance.now()) && true")
        await page.lock(False)
        await page.until(OPEN)
        assert await page.value("window.begun.at(-1) - window.unlocked") < 1000.0
        await page.tap("fire")
        await day.top(MatchScene)
        await day.until(lambda: match.devices[seat] == me, "the same seat")


async def restarted(page: Any, day: OpenDay) -> None:
    """A new process has what is on the disk: the same address, and the phone's token."""
    host, before = day.arcade.context.shared(phone_host), day.url

    def restart() -> None:
        host.close()
        host.roster.clear()

    await day.between_frames(restart)
    await page.until(f"!({OPEN})")
    begun = time.monotonic()
    await page.until(OPEN)
    assert time.monotonic() - begun < LONG
    assert day.url == before
