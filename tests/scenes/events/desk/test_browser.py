"""The desk in a real browser: the operator logs in, enters and corrects a result, and everybody sees it."""

import asyncio
import json
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from pigaming_app.events.event_files import update
from pigaming_app.events.journal import Paused
from pigaming_app.events.spec import Format
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.web.server import PageServer
from tests.cases import repeated
from tests.events.examples import ranked
from tests.scenes.events.desk.examples import PIN, cup, desk_on, new_event
from tests.scenes.phones.browser import Browser, Page, browsing, chromium, running_browser
from tests.ui.web.client import serving

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not chromium(), reason="no Chromium: apt-get install chromium"),
    pytest.mark.usefixtures("_no_threads_stay"),
]
LAPTOP, TABLET, PHONE, PROJECTOR = (1366, 768), (820, 1180), (390, 844), (1920, 1080)
NAMES = ("Ana", "Björn", "Çağla", "Diego", "Élodie Wintermantel", "François", "Gül", "<b>Hanna</b>")
TOO_WIDE = "document.documentElement.scrollWidth > innerWidth"
LONG_NAMES = tuple(f"{letter * 10} {letter.lower() * 13}" for letter in "ABCDEFGHIJKLMNOP")


@pytest.fixture(scope="module")
def browser() -> Iterator[str]:
    with running_browser() as address:
        yield address


def story(browser: str, tell: Callable[[Browser], Awaitable[None]]) -> None:
    async def run() -> None:
        async with browsing(browser) as found:
            await tell(found)
            assert [error for error in found.errors if "'recommendation'" not in error] == []

    asyncio.run(run())


async def opened(page: Page, url: str) -> None:
    await page.value("window.before = 1; 1")
    await page.ask("Page.navigate", url=url)
    await page.until("!window.before && document.readyState === 'complete'")


async def sent(page: Page, button: str, **fields: str) -> None:
    """Fill in fields by their names, click a button, and wait for the next page."""
    for name, text in fields.items():
        await page.value(f"document.querySelector('main [name={name}]').value = {json.dumps(text)}; 1")
    await page.value(f"window.before = 1; document.querySelector({json.dumps(button)}).click(); 1")
    await page.until("!window.before && document.readyState === 'complete'")


async def logged_in(browser: Browser, server: PageServer, size: tuple[int, int], language: str = "en") -> Page:
    page = await browser.phone(f"{server.url}desk?language={language}", size)
    await page.until("document.querySelector('[name=pin]') !== null")
    await sent(page, "main button", pin=PIN)
    await page.until("location.pathname === '/desk'")
    return page


def test_the_whole_way_of_a_result(tmp_path: Path, browser: str) -> None:
    path = new_event(tmp_path, *NAMES)

    async def tell(browser: Browser) -> None:
        public = await browser.phone(server.url, PHONE)
        await public.until("document.body.innerText.includes('Hanna')")
        desk = await logged_in(browser, server, LAPTOP)
        await sent(desk, "a[href='/desk/match/1']")
        await sent(desk, "[value=result]", score0="3", score1="1")
        await public.until("document.querySelector('.results').innerText.includes('1. Ana 3')")
        assert cup(path).outcomes[1].scores == {"Ana": 3.0, "Élodie Wintermantel": 1.0}
        await sent(desk, "a[href='/desk/match/1']")
        await sent(desk, "[value=correct]", score0="3", score1="5", reason="seats mixed up")
        await public.until("document.querySelector('.results').innerText.includes('1. Élodie Wintermantel 5')")
        await sent(desk, "a[href='/desk/enter']")
        await sent(desk, "[action='/desk/enter'] button", name="<i>Ida</i>", team="Red")
        await public.until("document.body.innerText.includes('<i>Ida</i>')")
        assert not await public.value("document.querySelector('main i, main b b')")
        await sent(desk, "a[href='/desk/break']")
        await sent(desk, "[value=begin]", note="until 11:30")
        await public.until("document.querySelector('.banner').innerText === 'Break until 11:30'")
        await sent(desk, "[action='/desk/logout'] button")
        assert await desk.value("document.querySelector('[name=pin]') !== null")

    with serving(desk_on(path)) as server:
        story(browser, tell)


def test_a_change_elsewhere_is_on_both_pages_and_spares_what_is_typed(tmp_path: Path, browser: str) -> None:
    path = new_event(tmp_path, *NAMES)

    async def tell(browser: Browser) -> None:
        desk = await logged_in(browser, server, TABLET)
        typing = await logged_in(browser, server, TABLET)
        await sent(typing, "a[href='/desk/match/2']")
        await typing.value("document.querySelector('[name=score0]').value = '12'; 1")
        update(path, lambda event: event.record(ranked(event.open[0], *event.open[0].entrants)))
        await desk.until("document.body.innerText.includes('Correct a result')")
        assert await typing.value("document.querySelector('[name=score0]').value") == "12"

    with serving(desk_on(path)) as server:
        story(browser, tell)


def test_a_form_of_another_site_changes_nothing(tmp_path: Path, browser: str) -> None:
    """The browser has the cookie; the other site has even the key of the forms."""
    path = new_event(tmp_path, *NAMES)
    before = path.read_bytes()

    async def tell(browser: Browser) -> None:
        desk = await logged_in(browser, server, LAPTOP)
        key = await desk.value("document.querySelector('[name=key]').value")
        form = f"<form method=post action='{server.url}desk/entrant/0'><input name=do value=withdraw>"
        form += f"<input name=key value='{key}'></form>"
        await opened(desk, "about:blank")
        await desk.value(
            f"window.before = 1; document.body.innerHTML = {json.dumps(form)}; document.forms[0].submit(); 1"
        )
        await desk.until("!window.before && document.querySelector('[name=pin], .wrong') !== null")
        browser.errors.clear()  # the browser tells of the 403

    with serving(desk_on(path)) as server:
        story(browser, tell)
    assert path.read_bytes() == before


@pytest.mark.parametrize("language", repeated(LANGUAGES))
def test_every_page_fits_every_screen(tmp_path: Path, browser: str, language: str) -> None:
    path = new_event(tmp_path, *LONG_NAMES, form=Format.KNOCKOUT, title="W" * 60)
    update(path, lambda event: event.record(ranked(event.open[0], *event.open[0].entrants)))

    async def tell(browser: Browser) -> None:
        for size in (LAPTOP, TABLET, PHONE):
            page = await logged_in(browser, server, size, language)
            for address in ("", "desk", "desk/match/1", "desk/match/2", "desk/enter", "desk/entrant/3", "desk/break"):
                await opened(page, f"{server.url}{address}?language={language}")
                assert not await page.value(TOO_WIDE), (size, address)
                assert await page.value("document.documentElement.lang") == language

    with serving(desk_on(path)) as server:
        story(browser, tell)


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_challenge_is_arranged_and_the_week_ended_on_every_screen(
    tmp_path: Path, browser: str, language: str
) -> None:
    path = new_event(tmp_path, *LONG_NAMES, form=Format.CHALLENGE)

    async def tell(browser: Browser) -> None:
        for i, size in enumerate((LAPTOP, TABLET, PHONE)):
            page = await logged_in(browser, server, size, language)
            await sent(page, "a[href='/desk/arrange']")
            assert not await page.value(TOO_WIDE)
            await page.value("document.querySelector('[name=name0]').value = 'DDDDDDDDDD ddddddddddddd'; 1")
            await page.value("document.querySelector('[name=name1]').value = 'BBBBBBBBBB bbbbbbbbbbbbb'; 1")
            await sent(page, "[action='/desk/arrange'] button")
            assert [{*one.entrants} for one in cup(path).open] == [{LONG_NAMES[3], LONG_NAMES[1]}]
            await sent(page, "a[href='/desk/close']")
            assert not await page.value(TOO_WIDE)
            await sent(page, "button.grave")
            assert cup(path).progress.closed == i + 1

    with serving(desk_on(path)) as server:
        story(browser, tell)


SMALL = """
[...document.querySelectorAll('.shown, header')].flatMap((part) => [...part.querySelectorAll('*')])
    .filter((one) => [...one.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim()))
    .filter((one) => parseFloat(getComputedStyle(one).fontSize) < 26)
    .map((one) => one.outerHTML)
"""
OUTSIDE = """
[...document.querySelectorAll('.shown *')].filter((one) => one.getBoundingClientRect().bottom > innerHeight + 1)
    .map((one) => one.outerHTML.slice(0, 200))
"""


@pytest.mark.parametrize("form", [Format.KNOCKOUT, Format.SWISS])
def test_a_projector_shows_every_part_by_turns_large_enough(tmp_path: Path, browser: str, form: Format) -> None:
    """26 of 1080 px are 2.4 % of the height: on a picture of 1.2 m, letters of 2 cm and more."""
    path = new_event(tmp_path, *LONG_NAMES, form=form, title="W" * 60)
    for _ in range(20):
        if cup(path).open:
            update(path, lambda event: event.record(ranked(event.open[0], *event.open[0].entrants)))

    update(path, lambda event: event.after(Paused("until 11:30")))

    async def tell(browser: Browser) -> None:
        page = await browser.phone(f"{server.url}?big", PROJECTOR)
        await page.until("document.querySelector('.shown') !== null")
        count = await page.value("document.querySelectorAll('.page').length")
        assert count > 3
        seen: set[Any] = set()
        for _ in range(count):
            assert await page.value("document.querySelectorAll('.shown').length") == 1
            assert await page.value(SMALL) == []
            assert await page.value(OUTSIDE) == []
            seen.add(await page.value("document.querySelector('.shown').innerText"))
            await page.value("turn(1); 1")
        assert len(seen) == count

    with serving(desk_on(path)) as server:
        story(browser, tell)
