"""Stories in a real browser beside an arcade in real time, which has the main thread."""

import asyncio
import threading
import time
from collections import deque
from collections.abc import Callable, Coroutine
from contextlib import AbstractAsyncContextManager
from typing import Any, TypeVar

from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.link import PhoneLink
from pigaming_app.scenes.play.reconnect import Reconnect
from pigaming_app.scenes.results.scene import Results
from pigaming_app.ui.input.events import Device, StickState
from tests.scenes.arcade import Arcade
from tests.scenes.phones.touch_page import LONG

T = TypeVar("T")
Browsing = Callable[[], AbstractAsyncContextManager[Any]]  # a browser with pages as phones, and `errors` of them


class Visitors(threading.Thread):
    """Runs a story in the browser beside the arcade, which has the main thread."""

    def __init__(self, browsing: Browsing, story: Callable[[Any], Coroutine[Any, Any, None]]) -> None:
        super().__init__(daemon=True)
        self.browsing, self.story = browsing, story
        self.error: BaseException | None = None

    def run(self) -> None:
        try:
            asyncio.run(self._run())
        except BaseException as error:
            self.error = error

    async def _run(self) -> None:
        async with self.browsing() as browser:
            await self.story(browser)
            assert browser.errors == []


class OpenDay:
    """An arcade in real time, with phones on."""

    def __init__(self, arcade: Arcade, browsing: Browsing, port: int = 0) -> None:
        self.arcade, self.link, self.browsing = arcade, PhoneLink(arcade.context), browsing
        self._jobs: deque[Callable[[], None]] = deque()
        settings = arcade.context.settings
        settings.phones, settings.phones_network, settings.phones_port = True, "127.0.0.1", port
        self.link.update(arcade.stack.scenes)

    @property
    def url(self) -> str:
        return self.arcade.context.shared(phone_host).url

    def run(self, story: Callable[[Any], Coroutine[Any, Any, None]]) -> None:
        """Frames until the visitors are through."""
        visitors = Visitors(self.browsing, story)
        visitors.start()
        last = time.perf_counter()
        while visitors.is_alive():
            now = time.perf_counter()
            while self._jobs:
                self._jobs.popleft()()
            waits = isinstance(self.arcade.stack.top, (Reconnect, Results))
            self.arcade.frame(0.0 if waits else min(0.1, now - last))
            self.link.update(self.arcade.stack.scenes)
            last = now
            time.sleep(max(0.0, 1 / 60 - (time.perf_counter() - now)))
        if visitors.error:
            raise visitors.error

    async def between_frames(self, job: Callable[[], T]) -> T:
        """Do something in the arcade's thread; returns its result."""
        done: list[T] = []
        self._jobs.append(lambda: done.append(job()))
        await self.until(lambda: done, "a frame")
        return done[0]

    async def until(self, condition: Callable[[], Any], what: str) -> None:
        """Wait until the arcade's thread has done its part."""
        end = time.monotonic() + LONG
        while not condition():
            assert time.monotonic() < end, f"no {what}; on top lies {type(self.arcade.stack.top).__name__}"
            await asyncio.sleep(0.02)

    async def plugged(self, *numbers: int) -> None:
        """Wait until exactly these phones are plugged in."""
        phones = self.arcade.context.controls.phones
        await self.until(lambda: sorted(phones.plugged) == list(numbers), f"phones {numbers}")

    async def top(self, scene: type) -> None:
        """Wait for a scene."""
        await self.until(lambda: isinstance(self.arcade.stack.top, scene), scene.__name__)

    async def drives(self, device: Device, condition: Callable[[StickState], bool]) -> None:
        """Wait until a phone drives so."""
        await self.until(lambda: condition(self.arcade.context.controls.drive(device)), f"such drive of {device}")
