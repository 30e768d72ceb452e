"""Between a match and the program that plays one of its seats. Matches and connections are in different threads."""

import itertools
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from pigaming_app.ai.bots import view
from pigaming_app.sim.world import HEIGHT, HZ, WIDTH, World

Send = Callable[[str], object]
FRESH = round(0.3 * HZ)  # ticks for which a command holds
BUDGET = 0.3  # s for a decision where the match waits for it
HELD = 64  # seats of matches whose newest commands are kept
FIELD = {"width": WIDTH, "height": HEIGHT, "hz": HZ}


class SeatOfMatch(NamedTuple):
    """A seat of a match, both by number."""

    match: int
    seat: int


@dataclass(frozen=True)
class Command:
    """The wish of a bot at a tick."""

    tick: int
    linear: float
    angular: float
    fire: bool
    turbo: bool


class BotLine:
    """The line to one bot. `patient`: matches wait for its decisions, as in leagues; else the newest one counts."""

    def __init__(self, patient: bool = False) -> None:
        self.patient = patient
        self.connection = 0  # its number
        self._send: Send | None = None
        self._close: Callable[[], object] = lambda: None
        self._commands: dict[SeatOfMatch, Command] = {}
        self._changed = threading.Condition()

    @property
    def connected(self) -> bool:
        return self._send is not None

    # ---- for the match

    def begin(self, place: SeatOfMatch, game: str, state: World) -> None:
        """Tell the bot that it plays, and where."""
        self._tell(place, {"type": "begin", "game": game, "rules": view.rules(state), **FIELD, **view.layout(state)})

    def changed(self, place: SeatOfMatch, state: World) -> None:
        """Tell the bot that walls have gone or come."""
        self._tell(place, {"type": "layout", **view.layout(state)})

    def decide(self, place: SeatOfMatch, state: World) -> Command | None:
        """Show the bot this tick; its command, or None if it has none that still holds."""
        if not self._tell(place, {"type": "tick", **view.shown(state)}):
            return None
        with self._changed:
            if self.patient:
                self._changed.wait_for(lambda: self._of(place, state.tick) or not self.connected, BUDGET)
            return self._of(place, state.tick - (0 if self.patient else FRESH))

    def _of(self, place: SeatOfMatch, tick: int) -> Command | None:
        """The newest command, if it is not older than this tick."""
        command = self._commands.get(place)
        return command if command and command.tick >= tick else None

    def _tell(self, place: SeatOfMatch, message: dict[str, Any]) -> bool:
        """False if nobody is connected."""
        send = self._send
        if send:
            send(view.text({**message, **place._asdict()}))
        return bool(send)

    # ---- for the connection

    def attach(self, send: Send, close: Callable[[], object]) -> None:
        """Connect the bot; an earlier connection is closed."""
        with self._changed:
            before, self._send, self._close = self._close, send, close
            self.connection += 1
            self._commands.clear()
        before()

    def detach(self, send: Send) -> None:
        """The connection has ended."""
        with self._changed:
            if self._send is send:
                self._send, self._close = None, lambda: None
                self._changed.notify_all()

    def receive(self, place: SeatOfMatch, command: Command) -> None:
        """A command of the bot; one that is not newer than the last of its seat does not count."""
        with self._changed:
            before = self._commands.pop(place, command)
            self._commands[place] = command if command.tick > before.tick else before  # last: the one used last
            while len(self._commands) > HELD:
                del self._commands[next(iter(self._commands))]
            self._changed.notify_all()


_numbers = itertools.count(1)


def next_match() -> int:
    """A number for a match, which no other of this process has."""
    return next(_numbers)
