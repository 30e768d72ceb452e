"""The page in a real browser: four phones by touch through the lobby and a whole match in real time.

Browser, server and arcade share a machine that may be slow: a story waits for what it causes, for LONG at most, and
never for a fixed time. The arcade's time is counted by frames, and stands still where a page could be late.
"""

import json
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import pytest

from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.join import JoinByPhone
from pigaming_app.scenes.play.reconnect import Reconnect
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import Results
from pigaming_app.sim.world import HZ
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.phone_messages import Wish, WishKind
from pigaming_app.ui.input.phones import connection
from tests.matches import setup_of
from tests.scenes.arcade import Arcade, Floor
from tests.scenes.phones.browser import Browser, browsing, chromium, running_browser
from tests.scenes.phones.touch_page import LONG, OPEN, PORTRAIT
from tests.scenes.phones.visitors import OpenDay

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not chromium(), reason="no Chromium: apt-get install chromium"),
    pytest.mark.usefixtures("_no_threads_stay"),
]
WATCH_FLASH = """
new MutationObserver(([change]) => { window.flashed ||= change.target.classList.contains("lit"); })
    .observe(document.getElementById("flash"), { attributes: true }); 1
"""
SEAT_ROOM = """
(() => {
    const range = document.createRange(), seat = document.getElementById("seat");
    range.selectNodeContents(seat);
    return document.getElementById("who").clientWidth - range.getBoundingClientRect().width;
})()
"""
ROOM_LEFT = """
(() => {
    const box = (id) => document.getElementById(id).getBoundingClientRect();
    document.body.classList.add("playing");
    document.getElementById("score").textContent = "20/20";
    document.getElementById("clock").textContent = "59:59";
    return box("start").left - box("clock").right;
})()
"""
SHORTEST, LONGEST = 12.0, 300.0  # s, a match: it ends when all is tested


@pytest.fixture(scope="module")
def browser() -> Iterator[str]:
    """One browser for all tests: to start it takes more time than most of them."""
    with running_browser() as address:
        yield address


@pytest.fixture
def day(browser: str, controls: Controls, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    monkeypatch.setattr(connection, "SILENT_SECONDS", LONG)  # a slow browser is no phone without Wi-Fi
    day = OpenDay(Arcade(controls), lambda: browsing(browser))
    yield day
    day.arcade.context.shared(phone_host).close()


def test_four_pages_play_a_whole_match(day: OpenDay) -> None:
    arcade = day.arcade
    controls = arcade.context.controls
    lobby = arcade.open(Lobby(arcade.context, "pitanks"))
    matches: list[MatchScene] = []

    def begin() -> MatchScene:
        setup = setup_of("pitanks", ["human"] * 4, "classic", LONGEST / 60, 5, "plain")
        matches.append(MatchScene(arcade.context, setup, lobby.seats.devices()))
        arcade.open(matches[0])
        return matches[0]

    async def story(browser: Browser) -> None:
        pages = []
        for seat in range(4):
            page = await browser.phone(day.url, PORTRAIT if seat == 3 else (844, 390), vibrates=seat != 2)
            await page.until(OPEN)
            await page.tap("fire")
            await page.until(f"document.getElementById('seat').textContent === 'Player {seat + 1}'")
            pages.append(page)
        colors = [await page.value("getComputedStyle(document.querySelector('#who')).color") for page in pages]
        assert len(set(colors)) == 4
        assert isinstance(arcade.stack.top, JoinByPhone)
        match = await day.between_frames(begin)
        devices = [device for device in match.devices if device]
        assert [device.kind for device in devices] == ["phone"] * 4
        for page in pages:
            await page.until("document.body.classList.contains('playing')")
        await pages[0].until("/^[0-5]:\\d\\d$/.test(document.getElementById('clock').textContent)")
        assert await pages[0].value("document.getElementById('score').textContent") == "0"
        await day.until(lambda: not match.opening.countdown.locked, "start")
        robots = match.match.state.robots
        starts = [(robot.x, robot.y, robot.heading) for robot in robots]
        for page, (x, y) in zip(pages, ((0, -1), (0.7, -0.7), (-1, 0), (1, 0.3)), strict=True):
            await page.steer(x, y)
            await page.touch(1, *await page.middle("fire"))  # a second finger
        for device in devices:
            await day.drives(device, lambda state: state.fire and abs(state.linear) + abs(state.angular) > 0.5)
        for page, device in zip(pages, devices, strict=True):
            await page.lift(1)
            await page.touch(1, *await page.middle("turbo"))
            await day.drives(device, lambda state: state.turbo and not state.fire)
        for robot, start in zip(robots, starts, strict=True):
            await day.until(lambda r=robot, s=start: (r.x, r.y, r.heading) != s, "movement")  # type: ignore[misc]
        await pages[2].value(WATCH_FLASH)
        for target in (0, 2):  # feel a hit, with and without vibration
            await day.between_frames(lambda hit=devices[target]: controls.rumble(hit, 0.9, 0.6, 0.28))  # type: ignore[misc]
        await pages[0].until("window.shaken.includes(280)")
        await pages[2].until("window.flashed")
        can_fill = [await page.value("document.getElementById('full').offsetWidth > 0") for page in pages]
        assert can_fill == [True, True, False, True]
        await pages[1].lock(True)
        await day.top(Reconnect)
        await pages[1].lock(False)
        await day.plugged(0, 1, 2, 3)
        await pages[1].until(OPEN)
        await pages[1].tap("fire")
        await day.top(MatchScene)
        assert [device for device in match.devices if device] == devices, "the same device in the same seat"
        for seat, page in enumerate(pages):
            for finger in list(page.fingers):
                await page.lift(finger)
            await page.steer((-1) ** seat, -0.5)
            await page.touch(1, *await page.middle("fire"))
        state = match.match.state
        state.rules.ticks = max(round(SHORTEST * HZ), state.tick + 2 * HZ)
        await day.top(Results)
        for page in pages:
            await page.until("!document.body.classList.contains('playing')")
            await page.until("['1st', '2nd', '3rd', '4th'].includes(document.getElementById('seat').textContent)")

    day.run(story)
    assert matches[0].match.over


def test_the_page_reports_what_went_wrong(day: OpenDay) -> None:
    arcade = day.arcade
    arcade.open(Lobby(arcade.context, "pitanks"))

    async def story(browser: Browser) -> None:
        old = f"{day.url.rpartition('/')[0]}/abcdefghjk"
        page = await browser.phone(old)
        await page.until("document.body.textContent.includes('no longer valid')")
        five = []
        for number in range(5):  # one after another: their numbers are 0 to 4
            five.append(await browser.phone(day.url))
            await five[-1].until(OPEN)
            await day.plugged(*range(min(4, number + 1)))
        await five[4].until("document.body.classList.contains('waiting')")
        await five[4].until("document.getElementById('before').textContent === 'You are next'")
        await five[0].ask("Page.navigate", url="about:blank")
        await five[4].until("!document.body.classList.contains('waiting')")
        await five[1].value("window.loadedBefore = true")
        await five[1].ask("Page.reload")
        await five[1].until(f"!window.loadedBefore && {OPEN}")
        await day.plugged(1, 2, 3, 4)  # a reloaded page is the same device
        browser.errors.clear()  # the refused page is an entry in the log

    day.run(story)


def test_touches_become_stick_and_buttons(day: OpenDay) -> None:
    arcade = day.arcade
    controls = arcade.context.controls

    async def story(browser: Browser) -> None:
        for number, size in enumerate(((844, 390), PORTRAIT)):
            page = await browser.phone(day.url, size)
            await page.until(OPEN)
            await day.plugged(*range(number + 1))
            device = controls.handhelds()[-1]
            await page.steer(0, -1)
            await day.drives(device, lambda state: state.linear > 0.95 and abs(state.angular) < 0.1)
            await page.steer(1, 0)
            await day.drives(device, lambda state: state.angular > 0.95 and abs(state.linear) < 0.1)
            await page.touch(1, *await page.middle("fire"))
            await day.drives(device, lambda state: state.fire and not state.turbo)
            await page.touch(2, *await page.middle("turbo"))
            await day.drives(device, lambda state: state.fire and state.turbo and state.angular > 0.95)
            await page.lift(0)
            await day.drives(device, lambda state: state.angular == 0.0 and state.fire)
            await page.lift(1)
            await page.lift(2)
            await day.drives(device, lambda state: not state.fire and not state.turbo)
            fire, turbo = await page.middle("fire"), await page.middle("turbo")
            await page.touch(1, *fire)
            await page.touch(1, *turbo)  # a thumb that slides over
            await day.drives(device, lambda state: state.turbo and not state.fire)
            await page.lift(1)
            await day.drives(device, lambda state: not state.turbo)
        for width, height in ((320, 568), (568, 320)):
            await page.resize(width, height)
            assert await page.value(ROOM_LEFT) >= 0, "a lap and a long time"

    day.run(story)


class Call(Floor):
    """A scene that calls somebody."""

    called: ClassVar = {0: ("Ana", True)}

    def __init__(self, context: Context) -> None:
        self.access = Access(context, lambda: [None] * 4)


def test_a_phone_that_is_called_says_so_in_every_language_on_the_smallest_screen(day: OpenDay) -> None:
    context, roster = day.arcade.context, day.link.host.roster

    async def story(browser: Browser) -> None:
        page = await browser.phone(day.url, (568, 320))
        await page.until(OPEN)
        roster.wish(0, Wish(WishKind.NAME, text="ana"))
        await day.between_frames(lambda: day.arcade.open(Call(context)))
        for language in LANGUAGES:
            await day.between_frames(partial(setattr, context, "words", Words(language)))
            said = context.words("phones.page_called")
            await page.until(f"document.getElementById('seat').textContent === {json.dumps(said)}")
            assert await page.value(SEAT_ROOM) >= 0, said

    day.run(story)
