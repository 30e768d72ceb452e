"""Between a match and the program that plays one of its seats. Matches and connections are in different threads."""

import itertools
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, NamedTuple

from pigaming_app.ai.bots import view
from pigaming_app.sim.world import HEIGHT, HZ, WIDTH, World

Send = Callable[[str], object]
FRESH = round(0.3 * HZ)  # ticks for which a command holds
BUDGET = 0.3  # s for a decision where the match waits for it
HELD = 2000  # seats of matches that are known at the same time
FIELD = {"width": WIDTH, "height": HEIGHT, "hz": HZ}


class Serving(Enum):
    """How matches of this process treat bots: not at all; the newest command counts; they wait for each decision."""

    CLOSED = 0
    LIVE = 1
    PATIENT = 2


class SeatOfMatch(NamedTuple):
    """A seat of a match, both by number."""

    match: int
    seat: int


@dataclass(frozen=True)
class BotCommand:
    """The wish of a bot at a tick."""

    tick: int
    linear: float
    angular: float
    fire: bool
    turbo: bool


class Wire(NamedTuple):
    """A connection of a bot, by number."""

    number: int
    send: Send
    close: Callable[[], object]


@dataclass
class Dialogue:
    """What a bot knows of a seat, and its newest command."""

    wire: int = 0  # by which it was told of the match
    standing: tuple[int, ...] = ()  # the layout that it knows
    shown: int = -1  # the last tick that it was shown
    command: BotCommand | None = None


@dataclass
class BotLine:
    """The line to one bot."""

    service: Serving = Serving.CLOSED
    wire: Wire | None = None
    _missed: bool = False  # it was waited for in vain
    _dialogues: dict[SeatOfMatch, Dialogue] = field(default_factory=dict)
    _changed: threading.Condition = field(default_factory=threading.Condition)

    @property
    def connected(self) -> bool:
        return self.wire is not None

    # ---- for the match

    def decide(self, place: SeatOfMatch, game: str, state: World) -> BotCommand | None:
        """Show the bot this tick; its command, or None if it has none that still holds.

        A bot that has not answered is shown no other tick for FRESH: so it never lags behind.
        """
        wire, standing = self.wire, view.standing(state)
        if wire is None:
            return None
        with self._changed:
            own = self._dialogue(place)
            new, changed = own.wire != wire.number, own.standing != standing
            answered = own.command is not None and own.command.tick >= own.shown
            due = new or answered or self.service is Serving.PATIENT or state.tick >= own.shown + FRESH
            own.wire, own.standing = wire.number, standing
            own.shown = state.tick if due else own.shown
        if new:
            about = {"game": game, "rules": view.rules(state), "radius": state.radius, **FIELD, **view.layout(state)}
            wire.send(_text(place, {"type": "begin", **about}))
        elif changed:
            wire.send(_text(place, {"type": "layout", **view.layout(state)}))
        if due:
            wire.send(_text(place, {"type": "tick", **view.shown(state)}))
        with self._changed:
            if self.service is Serving.PATIENT:
                self._changed.wait_for(lambda: _at(own, state.tick) or self.wire is not wire, BUDGET)
            return _at(own, state.tick - (0 if self.service is Serving.PATIENT else FRESH))

    def wait(self, seconds: float) -> bool:
        """Wait until it is connected; false if it is not after so long, and then at once until it is."""
        with self._changed:
            self._missed = not self._changed.wait_for(lambda: self.connected, 0.0 if self._missed else seconds)
            return not self._missed

    # ---- for the connection

    def attach(self, send: Send, close: Callable[[], object]) -> None:
        """Connect the bot; an earlier connection is closed."""
        with self._changed:
            before, self.wire = self.wire, Wire(next(_numbers), send, close)
            for own in self._dialogues.values():
                own.command = None
            self._changed.notify_all()
        if before:
            before.close()

    def detach(self, send: Send) -> None:
        """The connection has ended."""
        with self._changed:
            if self.wire and self.wire.send is send:
                self.wire = None
                self._changed.notify_all()

    def receive(self, place: SeatOfMatch, command: BotCommand) -> None:
        """A command of the bot. It counts if the bot was shown its tick, and none later has come."""
        with self._changed:
            own = self._dialogues.get(place)
            if own and command.tick <= own.shown and (own.command is None or command.tick > own.command.tick):
                own.command = command
                self._changed.notify_all()

    def _dialogue(self, place: SeatOfMatch) -> Dialogue:
        own = self._dialogues.pop(place, None) or Dialogue()
        self._dialogues[place] = own  # last: the one used last
        while len(self._dialogues) > HELD:
            del self._dialogues[next(iter(self._dialogues))]
        return own


def _at(own: Dialogue, tick: int) -> BotCommand | None:
    """The newest command, if it is not older than this tick."""
    return own.command if own.command and own.command.tick >= tick else None


def _text(place: SeatOfMatch, message: dict[str, Any]) -> str:
    return view.text({**message, **place._asdict()})


_numbers = itertools.count(1)


def next_match() -> int:
    """A number for a match, which no other of this process has."""
    return next(_numbers)
