"""WebKit, as in iPhones, driven by WebDriver: its small browser on a screen of its own. It has a mouse and no touch."""

import asyncio
import glob
import os
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from typing import Any

from aiohttp import ClientError, ClientSession

from tests.scenes.phones.browser import ended
from tests.scenes.phones.touch_page import LANDSCAPE, LONG, TouchPage

BROWSERS = "/usr/lib/*/webkit2gtk-4*/MiniBrowser"  # Debian's place; the first one is taken


def webkit() -> str | None:
    """The path of the browser, if it, its driver and a virtual screen are installed."""
    found = sorted(glob.glob(BROWSERS))
    return found[0] if found and shutil.which("WebKitWebDriver") and shutil.which("Xvfb") else None


class WebKitPage(TouchPage):
    """The one page of a session. Its one finger is the mouse: a second one moves it there."""

    def __init__(self, browser: "WebKit", size: tuple[int, int]) -> None:
        super().__init__(size)
        self.browser = browser

    async def value(self, expression: str) -> Any:
        return await self.browser.ask("POST", "/execute/sync", script=f"return {expression};", args=[])

    async def touch(self, finger: int, x: float, y: float) -> None:
        move = {"type": "pointerMove", "x": round(x), "y": round(y)}
        down = [] if self.fingers else [{"type": "pointerDown", "button": 0}]
        self.fingers = {finger: (x, y)}
        await self._perform([move, *down])

    async def lift(self, finger: int) -> None:
        self.fingers = {}
        await self._perform([{"type": "pointerUp", "button": 0}])

    async def _perform(self, actions: list[dict[str, Any]]) -> None:
        source = {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": actions}
        await self.browser.ask("POST", "/actions", actions=[source])


class WebKit:
    """A session. `errors`: WebDriver reports none."""

    def __init__(self, session: ClientSession, address: str) -> None:
        self._session, self._address = session, address
        self._path = ""
        self.errors: list[str] = []

    async def ask(self, method: str, path: str, **body: Any) -> Any:
        """The value of an answer. Raises RuntimeError if the command fails."""
        content = body if method == "POST" else None
        async with self._session.request(method, f"{self._address}{self._path}{path}", json=content) as answer:
            value = (await answer.json(content_type=None))["value"]
        if isinstance(value, dict) and "error" in value:
            raise RuntimeError(f"{value['error']}: {value['message']}")
        return value

    async def begin(self, binary: str) -> None:
        """Start the browser."""
        browser = {"webkitgtk:browserOptions": {"binary": binary, "args": ["--automation"]}}
        value = await self.ask("POST", "/session", capabilities={"alwaysMatch": browser})
        self._path = f"/session/{value['sessionId']}"

    async def phone(self, url: str, size: tuple[int, int] = LANDSCAPE) -> WebKitPage:
        """The page in the window of the session; the bars of the window come on top of its size."""
        width, height = size
        await self.ask("POST", "/window/rect", width=width, height=height + 40)
        await self.ask("POST", "/url", url=url)
        return WebKitPage(self, size)


@asynccontextmanager
async def webkit_browsing() -> AsyncIterator[WebKit]:
    """A running browser without a profile on a virtual screen, both ended afterwards."""
    binary = webkit()
    assert binary
    reader, writer = os.pipe()
    null = subprocess.DEVNULL
    command = ["Xvfb", "-displayfd", str(writer), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"]
    screen = subprocess.Popen(command, pass_fds=[writer], stdout=null, stderr=null)
    os.close(writer)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as home, os.fdopen(reader) as told:
        try:
            display = (await asyncio.to_thread(told.readline)).strip()
            own = {"DISPLAY": f":{display}", "HOME": home, "XDG_RUNTIME_DIR": home, "LIBGL_ALWAYS_SOFTWARE": "1"}
            quiet = {"NO_AT_BRIDGE": "1", "GIO_USE_VFS": "local", "GSETTINGS_BACKEND": "memory"}
            rest = {name: value for name, value in os.environ.items() if name != "WAYLAND_DISPLAY"}
            driver = subprocess.Popen(
                ["WebKitWebDriver", f"--port={port}"], env=rest | own | quiet, stdout=null, stderr=null
            )
            try:
                async with ClientSession() as session:
                    browser = WebKit(session, f"http://127.0.0.1:{port}")
                    await _listens(browser)
                    await browser.begin(binary)
                    yield browser
                    with suppress(RuntimeError, ClientError):
                        await browser.ask("DELETE", "")
            finally:
                ended(driver)
        finally:
            ended(screen)


async def _listens(browser: WebKit) -> None:
    """Wait until the driver answers."""
    end = time.monotonic() + LONG
    while True:
        try:
            await browser.ask("GET", "/status")
            return
        except ClientError:
            assert time.monotonic() < end, "WebKitWebDriver has not started"
            await asyncio.sleep(0.05)
