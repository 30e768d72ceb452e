"""A phone without a browser: a WebSocket of the same library, and plain requests."""

import asyncio
import json
from collections.abc import Awaitable, Callable
from contextlib import AbstractContextManager
from typing import Any, TypeVar

from aiohttp import ClientSession, ClientWebSocketResponse, WSMsgType

from pigaming_app.ui.input.phone_messages import Touches, pack
from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.input.phones.server import PhoneServer
from tests.ui.web.client import LONG, running

TEXTS = {"page_old": "This code is old.", "page_fire": "fire </script>"}
T = TypeVar("T")


class Phone:
    """An open socket. `resume`: the token of its first message."""

    def __init__(self, socket: ClientWebSocketResponse) -> None:
        self.socket, self.resume = socket, ""

    async def touch(self, x: float = 0.0, y: float = 0.0, buttons: int = 0) -> None:
        await self.socket.send_bytes(pack(Touches(x, y, buttons)))

    async def told(self) -> Any:
        """The next message of the arcade."""
        return json.loads((await self.socket.receive(timeout=LONG)).data)

    async def closed(self) -> int | None:
        """The code with which the arcade closes the socket; None if it is cut. Earlier messages are skipped."""
        while True:
            message = await self.socket.receive(timeout=LONG)
            if message.type in (WSMsgType.CLOSE, WSMsgType.CLOSED, WSMsgType.CLOSING, WSMsgType.ERROR):
                return self.socket.close_code


async def phone(session: ClientSession, server: PhoneServer, resume: str = "") -> Phone:
    """A phone that has scanned the code."""
    one = Phone(await socket_of(session, server, resume))
    while not one.resume:  # it comes when it is on the disk; the seat may come first
        one.resume = (await one.told()).get("resume", "")
    return one


async def socket_of(session: ClientSession, server: PhoneServer, resume: str = "", **more: Any) -> Any:
    options: dict[str, Any] = {"origin": origin(server), **more}
    return await session.ws_connect(f"{server.url}/pad?resume={resume}", **options)


def origin(server: PhoneServer) -> str:
    return f"http://{server.address}:{server.port}"


def play(story: Callable[[ClientSession], Awaitable[T]]) -> T:
    """Run a story of phones to its end."""

    async def run() -> T:
        async with ClientSession() as session, asyncio.timeout(2 * LONG):
            return await story(session)

    return asyncio.run(run())


async def until(condition: Callable[[], Any]) -> None:
    """Wait until the server's thread has done its part."""
    async with asyncio.timeout(LONG):
        while not condition():
            await asyncio.sleep(0.005)


def serving(phones: Phones, **options: Any) -> AbstractContextManager[PhoneServer]:
    return running(PhoneServer(phones, "127.0.0.1", options.pop("port", 0), options.pop("texts", TEXTS)))
