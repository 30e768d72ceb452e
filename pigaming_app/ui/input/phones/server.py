"""The server of the phones' page and sockets.

No refusal costs more than a few bytes, and none is waited for: the arcade only ever reads queues.
"""

import asyncio
import secrets
from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import suppress

from aiohttp import web

from pigaming_app.ui.input import phone_messages as protocol
from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.input.phones.connection import Connection
from pigaming_app.ui.input.phones.memory import Hall
from pigaming_app.ui.input.phones.roster import Refusal, Roster
from pigaming_app.ui.web.socket import closed
from pigaming_app.ui.web.token_page import TokenPageServer

ALPHABET = "abcdefghjkmnpqrstuvwxyz23456789"  # without signs that look alike: the address may be typed
TOKEN_LENGTH = 10  # 49 bits, guessed over a network within one session
KEEP_SECONDS = 2.0  # for which a phone waits at most until its token is on the disk
CLOSED: dict[Refusal, int] = {"full": protocol.CLOSED_FULL, "removed": protocol.CLOSED_REMOVED}
FILES = {
    "page.css": ("phones/page.css", "text/css"),
    "hall.css": ("phones/hall.css", "text/css"),
    "page.js": ("phones/page.js", "text/javascript"),
    "hall.js": ("phones/hall.js", "text/javascript"),
    "awake.mp4": ("phones/awake.mp4", "video/mp4"),
    "awake.webm": ("phones/awake.webm", "video/webm"),
}


class PhoneServer(TokenPageServer):
    """Serves `phones` on a port of an address. `texts`: the texts of the page, in the language of the screen.

    `roster`: decides who plays; `token`: of the page, empty: a new one; `keep`: writes what a restart needs.
    """

    page, socket, files, old = "page.html", "pad", FILES, "page_old"

    def __init__(
        self,
        phones: Phones,
        address: str,
        port: int,
        texts: Mapping[str, str],
        roster: Roster | None = None,
        token: str = "",
        keep: Callable[[Hall], None] | None = None,
    ) -> None:
        token = token or "".join(secrets.choice(ALPHABET) for _ in range(TOKEN_LENGTH))
        super().__init__("phones", address, port, token, texts)
        self.app.cleanup_ctx.append(self._keep_always)
        self.app.on_shutdown.append(self._close_all)
        self.phones = phones
        self.roster = roster or Roster(phones)
        self.visited = False  # whether a page was asked for with the right token
        self.connections: dict[int, Connection] = {}  # by device number
        self._keep, self._kept, self._to_keep = keep, Hall(), asyncio.Event()
        self._written = asyncio.Condition()  # notified when that is done

    @property
    def policy(self) -> str:
        """The videos in the page, too."""
        return f"{super().policy}; media-src data:"

    def start(self) -> None:
        super().start()
        self.phones.send = self._send
        self.roster.changed = lambda: self.call(self._to_keep.set)
        self.roster.expel = lambda number, why: self.call(self._expel, number, why)

    def stop(self) -> None:
        self.phones.send = lambda number, text: None
        self.roster.changed, self.roster.expel = lambda: None, lambda number, why: None
        super().stop()

    def _send(self, number: int, text: str) -> None:
        """Hand a text to the server's thread; a phone that has just gone does not get it."""
        self.call(self._deliver, number, text)

    # ---- in the server's thread

    def _deliver(self, number: int, text: str) -> None:
        if connection := self.connections.get(number):
            connection.send(text)

    def _expel(self, number: int, why: Refusal) -> None:
        """Close the socket of a phone that the roster has sent away."""
        if connection := self.connections.pop(number, None):
            connection.replaced = True
            connection.close_soon(CLOSED[why])

    async def _close_all(self, app: web.Application) -> None:
        await asyncio.gather(*(one.close(1001) for one in self.connections.values()))

    async def _keep_always(self, app: web.Application) -> AsyncIterator[None]:
        """Write what a restart needs whenever it has changed, as long as the server runs."""
        keeper = asyncio.create_task(self._keep_changes())
        yield
        keeper.cancel()

    async def _keep_changes(self) -> None:
        """In a thread, so that no phone waits for the disk."""
        while self._keep:
            await self._to_keep.wait()
            self._to_keep.clear()
            hall = self.roster.hall(self.token)
            if hall != self._kept:
                await asyncio.to_thread(self._keep, hall)
            self._kept = hall
            async with self._written:
                self._written.notify_all()

    async def _until_kept(self, number: int) -> None:
        """Wait until the token of a phone is on the disk, so that a restart knows every token that a phone has."""
        guest = self.roster.guest(number)
        with suppress(TimeoutError):
            async with asyncio.timeout(KEEP_SECONDS), self._written:
                while self._keep and guest and all(one.token != guest.token for one in self._kept.phones):
                    await self._written.wait()

    async def _get_page(self, request: web.Request) -> web.StreamResponse:
        self.visited = True
        return await super()._get_page(request)

    async def connect(self, request: web.Request) -> web.WebSocketResponse:
        peer = request.remote or ""
        admitted = self.roster.admit(request.query.get("resume", ""), peer)
        if isinstance(admitted, str):
            self.refusals.note(f"phone refused: {admitted}", peer)
            return await closed(request, CLOSED[admitted], protocol.MAX_FRAME)
        number, resume = admitted
        if before := self.connections.get(number):
            before.replaced = True
        connection = self.connections[number] = Connection(self.roster, self.refusals, number, peer)
        try:
            await connection.answer.prepare(request)
            await self._until_kept(number)
            connection.send(protocol.resume_text(resume))
            await connection.play(request)
        finally:
            if not connection.replaced:
                del self.connections[number]
                self.roster.leave(number)
        return connection.answer
