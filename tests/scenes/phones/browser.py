"""A headless Chromium, driven by the DevTools protocol: pages with a touch screen, each as a phone of its own."""

import asyncio
import itertools
import shutil
import subprocess
import tempfile
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from pathlib import Path
from typing import Any

from aiohttp import ClientSession, ClientWebSocketResponse, WSMsgType

from tests.scenes.phones.touch_page import LANDSCAPE, LONG, TouchPage

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
OPTIONS = (
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run", "--mute-audio",
    "--remote-debugging-port=0", "--disable-extensions", "--disable-background-networking", "--disable-sync",
    "--disable-component-update", "--disable-default-apps", "--disable-breakpad",
    "--disable-background-timer-throttling", "--disable-renderer-backgrounding",
)  # fmt: skip
AS_AN_IPHONE = "navigator.vibrate = Element.prototype.requestFullscreen = undefined;"
WATCH_VIBRATION = "window.shaken = []; navigator.vibrate = (ms) => { window.shaken.push(ms); return true; };"


def chromium() -> str | None:
    """The path of the browser, if it is installed."""
    return next((path for name in NAMES if (path := shutil.which(name))), None)


class Browser:
    """A running browser. Sessions of the protocol share one socket."""

    def __init__(self, socket: ClientWebSocketResponse) -> None:
        self._socket = socket
        self._numbers = itertools.count(1)
        self._answers: dict[int, asyncio.Future[Any]] = {}
        self.contexts: list[str] = []  # one of each phone
        self.errors: list[str] = []  # exceptions, and messages of the console, of all pages

    async def ask(self, method: str, session: str | None = None, **parameters: Any) -> Any:
        """The result of a command."""
        number = next(self._numbers)
        self._answers[number] = answer = asyncio.get_running_loop().create_future()
        message: dict[str, Any] = {"id": number, "method": method, "params": parameters}
        await self._socket.send_json(message | ({"sessionId": session} if session else {}))
        async with asyncio.timeout(LONG):
            return await answer

    async def listen(self) -> None:
        """Receive answers and events until the socket is closed."""
        async for message in self._socket:
            if message.type is not WSMsgType.TEXT:
                return
            content = message.json()
            if answer := self._answers.pop(content.get("id"), None):
                if "error" in content:
                    answer.set_exception(RuntimeError(str(content["error"])))
                else:
                    answer.set_result(content["result"])
            elif content.get("method") in ("Runtime.exceptionThrown", "Log.entryAdded"):
                self.errors.append(str(content["params"]))

    async def phone(
        self, url: str, size: tuple[int, int] = LANDSCAPE, vibrates: bool = True, source: str = ""
    ) -> "Page":
        """A page in a window of its own that shares nothing with the others. `source`: runs before its own scripts."""
        context = (await self.ask("Target.createBrowserContext"))["browserContextId"]
        self.contexts.append(context)
        target = await self.ask("Target.createTarget", url="about:blank", browserContextId=context, newWindow=True)
        attached = await self.ask("Target.attachToTarget", targetId=target["targetId"], flatten=True)
        page = Page(self, attached["sessionId"], size)
        for domain in ("Page", "Runtime", "Log"):
            await page.ask(f"{domain}.enable")
        await page.resize(*size)
        await page.ask("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
        await page.ask("Emulation.setFocusEmulationEnabled", enabled=True)
        source += WATCH_VIBRATION if vibrates else AS_AN_IPHONE
        await page.ask("Page.addScriptToEvaluateOnNewDocument", source=source)
        await page.ask("Page.navigate", url=url)
        return page


class Page(TouchPage):
    """A phone in Chromium."""

    def __init__(self, browser: Browser, session: str, size: tuple[int, int]) -> None:
        super().__init__(size)
        self.browser, self.session = browser, session

    async def ask(self, method: str, **parameters: Any) -> Any:
        return await self.browser.ask(method, self.session, **parameters)

    async def resize(self, width: int, height: int) -> None:
        """Set the size of the screen, px."""
        await self.ask(
            "Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=True
        )

    async def value(self, expression: str) -> Any:
        answer = await self.ask("Runtime.evaluate", expression=expression, returnByValue=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    async def touch(self, finger: int, x: float, y: float) -> None:
        kind = "touchMove" if finger in self.fingers else "touchStart"
        self.fingers[finger] = (x, y)
        await self._dispatch(kind, self.fingers)

    async def lift(self, finger: int) -> None:
        await self._dispatch("touchEnd", {finger: self.fingers.pop(finger)})

    async def _dispatch(self, kind: str, fingers: dict[int, tuple[float, float]]) -> None:
        points = [{"x": x, "y": y, "id": finger} for finger, (x, y) in fingers.items()]
        await self.ask("Input.dispatchTouchEvent", type=kind, touchPoints=points)


@contextmanager
def running_browser(*options: str) -> Iterator[str]:
    """The address of a browser with an empty profile, ended and deleted afterwards."""
    path = chromium()
    assert path
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        command = [path, *OPTIONS, *options, f"--user-data-dir={profile}", "about:blank"]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            yield _address(process, Path(profile) / "DevToolsActivePort")
        finally:
            ended(process)


def ended(process: subprocess.Popen[bytes]) -> None:
    """End a process that was started here."""
    process.terminate()
    try:
        process.wait(5.0)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


@asynccontextmanager
async def browsing(address: str) -> AsyncIterator[Browser]:
    """A running browser; the pages opened in it are closed afterwards."""
    async with ClientSession() as session, session.ws_connect(address, max_msg_size=0) as socket:
        browser = Browser(socket)
        listener = asyncio.create_task(browser.listen())
        yield browser
        for context in browser.contexts:
            await browser.ask("Target.disposeBrowserContext", browserContextId=context)
        listener.cancel()


def _address(process: subprocess.Popen[bytes], port_file: Path) -> str:
    """From the file that Chromium writes when it listens: the port, and the path of its socket."""
    end = time.monotonic() + LONG
    while time.monotonic() < end and process.poll() is None:
        lines = port_file.read_text().split() if port_file.exists() else []
        if len(lines) == 2:
            return f"ws://127.0.0.1:{lines[0]}{lines[1]}"
        time.sleep(0.05)
    raise RuntimeError("the browser has not started")
