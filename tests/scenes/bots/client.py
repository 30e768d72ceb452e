"""A program of somebody else: it signs as docs/bots.md says, in a thread of its own."""

import asyncio
import hashlib
import hmac
import json
import threading
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import aiohttp

Decide = Callable[[dict[str, Any]], dict[str, Any] | None]


class Program(threading.Thread):
    """Connects at once. `decide`: the command for a tick, or None for silence; without a `name` it observes."""

    def __init__(self, url: str, name: str = "", key: str = "", decide: Decide = lambda tick: {}) -> None:
        super().__init__(daemon=True)
        self.url, self.name_of_bot, self.key, self.decide = url, name, key, decide
        self.seen: list[dict[str, Any]] = []
        self.code: int | None = None  # with which the connection was closed
        self.nonce = ""
        self._loop = asyncio.new_event_loop()
        self._socket: Any = None
        self.start()

    def run(self) -> None:
        asyncio.set_event_loop(self._loop)
        self._loop.run_until_complete(self._play())
        self._loop.close()

    def types(self) -> list[str]:
        return [message["type"] for message in self.seen]

    def say(self, text: str | bytes) -> None:
        """Send anything."""
        send = self._socket.send_bytes if isinstance(text, bytes) else self._socket.send_str
        asyncio.run_coroutine_threadsafe(send(text), self._loop).result(5.0)

    def flood(self, text: str, times: int) -> None:
        """Send a text many times, as long as the connection holds."""

        async def send() -> None:
            with suppress(ConnectionError):
                for _ in range(times):
                    await self._socket.send_str(text)

        asyncio.run_coroutine_threadsafe(send(), self._loop)

    def signed(self, message: dict[str, Any], nonce: str = "") -> str:
        text = json.dumps(message)
        told = ((nonce or self.nonce) + text).encode("ascii")
        return f"{hmac.new(self.key.encode('ascii'), told, hashlib.sha256).hexdigest()} {text}"

    def leave(self) -> None:
        """Cut the connection."""
        self._loop.call_soon_threadsafe(self._socket._response.connection.transport.abort)
        self.join(5.0)

    async def _play(self) -> None:
        async with aiohttp.ClientSession() as session, session.ws_connect(self.url) as self._socket:
            async for frame in self._socket:
                if frame.type is not aiohttp.WSMsgType.TEXT:
                    break
                message = json.loads(frame.data)
                self.seen.append(message)
                if message["type"] == "hello":
                    self.nonce = message["nonce"]
                    if self.name_of_bot:
                        await self._socket.send_str(self.signed({"type": "play", "name": self.name_of_bot}))
                if message["type"] == "tick" and self.name_of_bot and (wish := self.decide(message)) is not None:
                    place = {part: message[part] for part in ("match", "seat", "tick")}
                    await self._socket.send_str(self.signed({"type": "act", **place, **wish}))
            self.code = self._socket.close_code
