"""Phones without a browser: real sockets to the arcade's real server, in a thread of their own."""

import asyncio
import threading
from contextlib import suppress
from typing import Any

from aiohttp import ClientError, ClientSession, ClientTimeout, ClientWebSocketResponse, TCPConnector, WSMsgType

from pigaming_app.ui.input.phone_messages import ITS_TURN, VERSION, Touches, Wish, WishKind, pack, pack_wish

BEAT = 0.15  # s between two messages of a phone that is not touched
RETRY = 0.1  # s until the next attempt to connect
ADDRESSES = "127.0.0.2", "127.0.0.3"  # of the phones: those of one address never take all places


class Handset:
    """A phone that has scanned the code. `touch` and `wish` are called from any thread. `state`: what its page shows.

    `token`: that of the page, by which it returns.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop, session: ClientSession, url: str, token: str = "") -> None:
        self._loop, self._session, self._url = loop, session, url
        self._origin = url.rsplit("/", 1)[0]
        self._frames: asyncio.Queue[bytes] = asyncio.Queue()
        self.token = token
        self.state: dict[str, Any] = {}
        self.connections = self.texts = 0
        self.error: Exception | None = None  # the last one
        self._task: asyncio.Task[None] | None = None
        self.unlock()

    def touch(self, touches: Touches) -> None:
        """Send what the player touches from now on."""
        self._loop.call_soon_threadsafe(self._frames.put_nowait, pack(touches))

    def wish(self, wish: Wish) -> None:
        """Send a name, a colour, a cheer or a vote."""
        self._loop.call_soon_threadsafe(self._frames.put_nowait, pack_wish(wish))

    def name(self, text: str) -> None:
        """Enter a name."""
        self.wish(Wish(WishKind.NAME, text=text))

    @property
    def before(self) -> int:
        """The phones that come first, as the page shows it."""
        return int(self.state.get("before", ITS_TURN))

    def lock(self) -> None:
        """Lock the phone: its socket is cut without a farewell."""
        self._loop.call_soon_threadsafe(self._cancel)

    def unlock(self) -> None:
        """Open the page again: the phone returns with the token that it has."""
        self._loop.call_soon_threadsafe(self._start)

    def _start(self) -> None:
        if self._task is None or self._task.done():
            self._task = self._loop.create_task(self._live())

    def _cancel(self) -> None:
        if self._task:
            self._task.cancel()
        self.state = {}

    async def _live(self) -> None:
        while True:
            try:
                await self._serve()
            except (ClientError, OSError, TimeoutError, RuntimeError) as error:
                self.error = error
            await asyncio.sleep(RETRY)

    async def _serve(self) -> None:
        while not self._frames.empty():
            self._frames.get_nowait()
        held = frame = pack(Touches())
        socket = await self._session.ws_connect(f"{self._url}/pad?resume={self.token}", origin=self._origin)
        reader = asyncio.create_task(self._read(socket))
        self.connections += 1
        try:
            while not socket.closed:
                await socket.send_bytes(frame)
                frame = held = frame if frame[0] == VERSION else held
                with suppress(TimeoutError):
                    async with asyncio.timeout(BEAT):  # unlike `wait_for`, it never swallows a cancellation
                        frame = await self._frames.get()
        finally:
            reader.cancel()
            if socket._response.connection and socket._response.connection.transport:
                socket._response.connection.transport.abort()
            socket._response.close()

    async def _read(self, socket: ClientWebSocketResponse) -> None:
        async for message in socket:
            if message.type is WSMsgType.TEXT:
                self.texts += 1
                values = message.json()
                self.token = values.get("resume", self.token)
                self.state = values.get("state", self.state)


class Handsets:
    """The thread of all phones."""

    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, name="handsets", daemon=True)
        self._thread.start()
        self._sessions = asyncio.run_coroutine_threadsafe(_sessions(), self._loop).result(10.0)

    def new(self, url: str, token: str = "", owner: int = 0) -> Handset:
        """A phone that scans this code, or returns with its token. `owner`: a number that selects its address."""
        return Handset(self._loop, self._sessions[owner % len(self._sessions)], url, token)

    def close(self) -> None:
        """End all phones."""
        asyncio.run_coroutine_threadsafe(_end(self._sessions), self._loop).result(10.0)
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(10.0)
        self._loop.close()


async def _sessions() -> list[ClientSession]:
    return [
        ClientSession(connector=TCPConnector(local_addr=(address, 0)), timeout=ClientTimeout(total=None, connect=3.0))
        for address in ADDRESSES
    ]


async def _end(sessions: list[ClientSession]) -> None:
    phones = asyncio.all_tasks() - {asyncio.current_task()}
    for task in phones:
        task.cancel()
    await asyncio.gather(*phones, return_exceptions=True)
    for session in sessions:
        await session.close()
