"""A headless Firefox, driven by WebDriver BiDi over its own socket: pages with a touch screen, as phones."""

import asyncio
import itertools
import json
import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from pathlib import Path
from typing import Any

from aiohttp import ClientSession, ClientWebSocketResponse

from tests.scenes.phones.browser import ended
from tests.scenes.phones.touch_page import LANDSCAPE, LONG, TouchPage

NAMES = ("firefox-esr", "firefox")
PREFERENCES = (
    'user_pref("media.autoplay.default", 0);\nuser_pref("datareporting.policy.dataSubmissionEnabled", false);\n'
)


def firefox() -> str | None:
    """The path of the browser, if it is installed."""
    return next((path for name in NAMES if (path := shutil.which(name))), None)


class FirefoxPage(TouchPage):
    """A phone in Firefox, in a window of its own: a tab behind another one would be a locked phone."""

    def __init__(self, browser: "Firefox", context: str, size: tuple[int, int]) -> None:
        super().__init__(size)
        self.browser, self.context = browser, context

    async def value(self, expression: str) -> Any:
        wrapped = f"JSON.stringify([{expression}])"
        answer = await self.browser.ask(
            "script.evaluate", expression=wrapped, target={"context": self.context}, awaitPromise=False
        )
        if answer["type"] != "success":
            raise RuntimeError(str(answer["exceptionDetails"]["text"]))
        return json.loads(answer["result"]["value"])[0]

    async def touch(self, finger: int, x: float, y: float) -> None:
        move = {"type": "pointerMove", "x": round(x), "y": round(y)}
        down = [] if finger in self.fingers else [{"type": "pointerDown", "button": 0}]
        self.fingers[finger] = (x, y)
        await self._perform(finger, [move, *down])

    async def lift(self, finger: int) -> None:
        del self.fingers[finger]
        await self._perform(finger, [{"type": "pointerUp", "button": 0}])

    async def _perform(self, finger: int, actions: list[dict[str, Any]]) -> None:
        source = {"type": "pointer", "id": f"finger{finger}", "parameters": {"pointerType": "touch"}}
        await self.browser.ask("input.performActions", context=self.context, actions=[{**source, "actions": actions}])


class Firefox:
    """A running browser. `errors`: of all pages."""

    def __init__(self, socket: ClientWebSocketResponse) -> None:
        self._socket, self._numbers = socket, itertools.count(1)
        self._answers: dict[int, asyncio.Future[Any]] = {}
        self.errors: list[str] = []

    async def ask(self, method: str, **parameters: Any) -> Any:
        """The result of a command. Raises RuntimeError if it fails."""
        number = next(self._numbers)
        self._answers[number] = answer = asyncio.get_running_loop().create_future()
        await self._socket.send_json({"id": number, "method": method, "params": parameters})
        async with asyncio.timeout(LONG):
            return await answer

    async def listen(self) -> None:
        """Receive answers and events until the socket is closed."""
        async for message in self._socket:
            content = message.json()
            if answer := self._answers.pop(content.get("id"), None):
                if "error" in content:
                    answer.set_exception(RuntimeError(f"{content['error']}: {content['message']}"))
                else:
                    answer.set_result(content["result"])
            elif content.get("method") == "log.entryAdded" and content["params"]["level"] == "error":
                self.errors.append(str(content["params"]["text"]))

    async def phone(self, url: str, size: tuple[int, int] = LANDSCAPE) -> FirefoxPage:
        """A page in a window of its own that shares nothing with the others."""
        user = (await self.ask("browser.createUserContext"))["userContext"]
        context = (await self.ask("browsingContext.create", type="window", userContext=user))["context"]
        width, height = size
        await self.ask("browsingContext.setViewport", context=context, viewport={"width": width, "height": height})
        await self.ask("browsingContext.navigate", context=context, url=url, wait="complete")
        return FirefoxPage(self, context, size)


@asynccontextmanager
async def firefox_browsing() -> AsyncIterator[Firefox]:
    """A running browser with an empty profile, ended and deleted afterwards."""
    path = firefox()
    assert path
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        (Path(profile) / "user.js").write_text(PREFERENCES)
        command = [path, "--headless", "--no-remote", "--profile", profile, "--remote-debugging-port=0", "about:blank"]
        null = subprocess.DEVNULL
        process = subprocess.Popen(command, stdout=null, stderr=null, env={**os.environ, "HOME": profile})
        try:
            address = await _address(process, Path(profile) / "WebDriverBiDiServer.json")
            async with ClientSession() as session, session.ws_connect(address, max_msg_size=0) as socket:
                browser = Firefox(socket)
                listener = asyncio.create_task(browser.listen())
                await browser.ask("session.new", capabilities={})
                await browser.ask("session.subscribe", events=["log.entryAdded"])
                yield browser
                with suppress(RuntimeError, TimeoutError):
                    await browser.ask("browser.close")
                listener.cancel()
        finally:
            ended(process)


async def _address(process: subprocess.Popen[bytes], file: Path) -> str:
    """From the file that Firefox writes when it listens."""
    end = time.monotonic() + LONG
    while time.monotonic() < end and process.poll() is None:
        with suppress(OSError, ValueError, KeyError):
            return f"ws://127.0.0.1:{json.loads(file.read_text())['ws_port']}/session"
        await asyncio.sleep(0.05)
    raise RuntimeError("Firefox has not started")
