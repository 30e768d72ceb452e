"""The server for programs while the operator has it on, and the stream of the match that is on the screen."""

import time
from collections.abc import Sequence
from contextlib import suppress
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from pigaming_app.ai.bots import view
from pigaming_app.ai.bots.line import FIELD, next_match
from pigaming_app.ai.bots.session import BotSession
from pigaming_app.games.match import Match
from pigaming_app.scenes.bots.vision import VisionSender
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.ui.web.network import ServerUnavailable, chosen, networks

if TYPE_CHECKING:
    from pigaming_app.ui.web.sockets import SocketServer

PORT = 8789  # TCP; 8787 and 8788 are those of phones and of the desk
RATE = 2000  # four seats, 50 times a second, up to ten times real time
CHECK_SECONDS = 3.0  # between two looks at the network, and two attempts to start


@runtime_checkable
class Running(Protocol):
    """A scene with a match."""

    match: Match


class BotHost:
    """`trouble`: why no program can connect, or None; `rate`: texts in a second that a program may send."""

    def __init__(self, rate: int = RATE) -> None:
        self._rate = rate
        self.server: SocketServer | None = None
        self.trouble: ServerUnavailable | None = None
        self.sessions: set[BotSession] = set()
        self._asked: tuple[bool, bool, str, int] | None = None
        self._vision: VisionSender | None = None
        self._checked_at = 0.0
        self._match: Match | None = None  # that observers know
        self._number, self._tick, self._standing = 0, -1, tuple[int, ...]()

    @property
    def url(self) -> str:
        """The address for programs; empty if none can connect."""
        return self.server.url if self.server else ""

    def follow(self, on: bool, vision: bool, network: str, port: int = PORT) -> None:
        """Serve programs (`on`) and send the league's packets (`vision`) on a network, whose address may change."""
        asked, now = (on, vision, network, port), time.monotonic()
        if asked == self._asked and (not (on or vision) or now - self._checked_at < CHECK_SECONDS):
            return
        if self._asked and self._asked[3] != port:
            self.close()
        self._asked, self._checked_at, self.trouble = asked, now, None
        try:
            address = _address(network) if on or vision else ""
        except ServerUnavailable as trouble:
            address, self.trouble = "", trouble
        if self.server and not (on and address == self.server.address):
            self._stop()
        if self._vision and not (vision and address == self._vision.address):
            self._vision.close()
            self._vision = None
        if on and address and self.server is None:
            self._start(address, port)
        if vision and address and self._vision is None:
            with suppress(OSError):  # it is tried again
                self._vision = VisionSender(address)

    def close(self) -> None:
        """End all connections."""
        self._stop()
        if self._vision:
            self._vision.close()
        self._vision = self._asked = self.trouble = None

    def _stop(self) -> None:
        if self.server:
            self.server.stop()
        self.server = None
        self.sessions.clear()

    def show(self, scenes: Sequence[Scene]) -> None:
        """Send the match on the screen to those who observe, once a tick."""
        match = next((scene.match for scene in reversed(scenes) if isinstance(scene, Running)), None)
        observers = [session for session in [*self.sessions] if not session.name]
        if match is None or not (observers or self._vision):
            self._match = None
            return
        state, standing = match.state, view.standing(match.state)
        if match is not self._match:
            self._match, self._number, self._tick, self._standing = match, next_match(), -1, standing
        new = [session for session in observers if session.match != self._number]
        for session in new:
            session.match = self._number
            session.send(view.text(self._begin(match)))
        if standing != self._standing:
            self._standing = standing
            self._tell(observers, {"type": "layout", **view.layout(state)})
        if state.tick != self._tick:
            self._tick = state.tick
            self._tell(observers, {"type": "tick", **view.shown(state)})
            if self._vision:
                now = time.time()
                self._vision.send(state, match.plant.mm, now, now)

    def _tell(self, observers: Sequence[BotSession], message: dict[str, Any]) -> None:
        text = view.text({**message, "match": self._number}) if observers else ""
        for session in observers:
            session.send(text)

    def _begin(self, match: Match) -> dict[str, Any]:
        setup = match.setup
        seats = [{"brain": seat.brain, "team": seat.team} for seat in setup.seats]
        told = {"type": "begin", "match": self._number, "game": setup.game, "variant": setup.variant}
        told |= {"arena": setup.arena, "minutes": setup.minutes, "seats": seats, "rules": view.rules(match.state)}
        told |= {"radius": match.state.radius, "mm": round(match.plant.mm, 4)}
        return {**told, **FIELD, **view.layout(match.state)}

    def _start(self, address: str, port: int) -> None:
        from pigaming_app.ui.web.sockets import SocketServer

        server = SocketServer("bots", address, port, self._opened, self._rate)
        try:
            server.start()
            self.server = server
        except ServerUnavailable as trouble:
            self.trouble = trouble

    def _opened(self, send: Any, close: Any) -> BotSession:
        session = BotSession(send, close, self.sessions.discard)
        self.sessions.add(session)
        return session


def _address(network: str) -> str:
    """The address of this computer on a network. Raises ServerUnavailable."""
    if not all(find_spec(module) for module in ("aiohttp", "ifaddr")):
        raise ServerUnavailable("missing")
    return chosen(network, networks()).address


def bot_host(context: Context) -> BotHost:
    """The server of a context, made at first use: `context.shared(bot_host)`."""
    return BotHost()
