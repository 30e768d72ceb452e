"""The order of the phones: who plays, whose turn it is, who waits. It has neither sockets nor scenes.

At most PLACES phones may act at a time: to the scenes they are devices like pads. All others wait in a queue: who has
waited longest comes first, and after a match those who played are last. Whoever is called by name comes before all
others. A phone that is locked during its match keeps its place until the end. The server's thread and the main loop
share one roster.
"""

import secrets
import threading
import time
from collections import Counter, deque
from collections.abc import Callable, Collection, Mapping
from typing import Literal

from pigaming_app.ui.input.phone_messages import Touches, Wish, WishKind, name_text
from pigaming_app.ui.input.phone_pads import MAX_PHONES as PLACES
from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.input.phones.guest import CHEER_SECONDS, Guest, Stage, hash_of
from pigaming_app.ui.input.phones.memory import FORGET_SECONDS, Hall, KnownPhone
from pigaming_app.ui.input.phones.names import kind_name
from pigaming_app.ui.web.refusals import RateMeter

MAX_CONNECTED, MAX_OF_ADDRESS = 32, 31  # phones: a school may be behind one address, which never takes the last one
MAX_NEW, NEW_SECONDS = 40, 600.0  # phones that one address may bring in that time
MAX_KNOWN = 128  # phones remembered, connected or not
TURN_SECONDS = 60.0  # in which a phone has to take a seat that is free
MAX_MISSED = 2  # turns in a row that a phone may miss
UNTOUCHED_SECONDS = 300.0  # in the queue without a touch
AWAY_SECONDS = 120.0  # for which a phone that is locked keeps its place in the queue
MAX_WISHES = 256  # that the main loop has not read yet
COLOURS = 8  # to choose from

Refusal = Literal["full", "removed"]


class Roster:
    """All phones. `places`: how many may act now; `changed`: called when what `hall` returns has changed."""

    def __init__(self, phones: Phones, clock: Callable[[], float] = time.monotonic) -> None:
        self.phones, self.clock = phones, clock
        self.places = PLACES
        self.changed: Callable[[], None] = lambda: None
        self.expel: Callable[[int, Refusal], None] = lambda number, why: None  # closes a socket; set by the server
        self._guests: dict[int, Guest] = {}
        self._called: dict[str, tuple[str, int]] = {}  # by what a phone is named: the name, and places that it adds
        self._silent: set[int] = set()  # phones that have let this call pass
        self._banned: set[str] = set()  # hashes of tokens and of addresses
        self._new: dict[str, RateMeter] = {}  # by address
        self._wishes: deque[tuple[int, Wish]] = deque(maxlen=MAX_WISHES)
        self._updated_at = clock()
        self._lock = threading.RLock()

    # ---- for the server's thread

    def admit(self, token: str, address: str) -> tuple[int, str] | Refusal:
        """Let a phone in: its device number and its new token, or why not. A token counts once."""
        with self._lock:
            now, hashed = self.clock(), hash_of(token)
            if hashed in self._banned or hash_of(address) in self._banned:
                return "removed"
            guest = next((one for one in self._guests.values() if one.token == hashed), None)
            if not (guest and guest.connected) and not self._room(address):
                return "full"
            if guest is None:
                if len(self._new) > MAX_KNOWN:
                    self._new.clear()
                meter = self._new.setdefault(address, RateMeter(MAX_NEW, NEW_SECONDS))
                if meter.spent(now):
                    return "full"
                meter.exceeded(now)
                self._drop_oldest()
                number = self.phones.new_number()
                guest = Guest(number, "", address, now, now, now, colour=number % COLOURS)
                self._guests[number] = guest
            elif not guest.connected and now - guest.left_at > AWAY_SECONDS and not guest.placed:
                guest.since, guest.stage = now, Stage.WAITING
            fresh = secrets.token_urlsafe(12)
            guest.token, guest.address, guest.touched_at = hash_of(fresh), address, now
            guest.connected, guest.touches = True, Touches()
            self.phones.receive(guest.number, Touches())  # of an old connection that has not noticed that it is gone
            self.phones.forget_shown(guest.number)
            self._fill()
            self.changed()
            return guest.number, fresh

    def leave(self, number: int) -> None:
        """A phone is locked, closed or out of reach."""
        with self._lock:
            if guest := self._guests.get(number):
                guest.connected, guest.left_at = False, self.clock()
                if guest.stage is Stage.TURN:
                    guest.stage = Stage.WAITING
                self._fill()
                self.changed()

    def receive(self, number: int, touches: Touches) -> bool:
        """Note what a phone's player touches; a scene gets it if the phone may act. False if too much is queued."""
        with self._lock:
            guest = self._guests.get(number)
            if guest is None:
                return False
            if touches != guest.touches:
                self._touch(guest, bool(touches.buttons & ~guest.touches.buttons))
                guest.touches = touches
            return self.phones.receive(number, touches)

    def wish(self, number: int, wish: Wish) -> None:
        """Note a name, a colour, a cheer or a vote."""
        with self._lock:
            guest = self._guests.get(number)
            if guest is None:
                return
            self._touch(guest, True)
            if wish.kind is WishKind.NAME:
                name = kind_name(wish.text)
                refused = not name and bool(wish.text.strip())
                guest.name = guest.name if refused else name
                self.phones.names[number] = guest.name
                self.phones.send(number, name_text(guest.name, refused))
                self.changed()
            elif wish.kind is WishKind.COLOUR:
                guest.colour = wish.number % COLOURS
                self.changed()
            elif wish.kind is not WishKind.CHEER or self._may_cheer(guest):
                self._wishes.append((number, wish))

    # ---- for the main loop

    def update(
        self,
        places: int,
        seated: Collection[int],
        match: bool,
        seat_free: bool,
        called: Mapping[str, int] | None = None,
    ) -> None:
        """Follow the scene on top. `places`: phones that may act; `seated`: those with a seat; `match`: these keep it,
        locked or not; `seat_free`: a phone whose turn it is can take one; `called`: the names of people who are called,
        with the number of places that each adds for their own phone alone.
        """
        with self._lock:
            self._call(called or {})
            now = self.clock()
            seconds, self._updated_at = now - self._updated_at, now
            self.places = max(0, min(PLACES, places))
            for guest in list(self._guests.values()):
                self._age(guest, now, seconds if seat_free else 0.0)
                if guest.placed and guest.number in seated and (guest.connected or match):
                    guest.stage, guest.missed, guest.turn = Stage.PLAYING, 0, 0.0
                elif guest.stage is Stage.PLAYING and not match:
                    guest.stage = Stage.TURN if guest.connected else Stage.WAITING
            self._fill()

    def rotate(self, staying: Collection[int] = ()) -> None:
        """A match is over: who played goes to the end of the queue, but for those who stay."""
        with self._lock:
            now = self.clock()
            for guest in self._guests.values():
                if guest.stage is Stage.PLAYING:
                    guest.played, guest.since, guest.turn = guest.played + 1, now, 0.0
                    stays = guest.number in staying and guest.connected
                    guest.stage = Stage.TURN if stays else Stage.WAITING
            self._fill()
            self.changed()

    def wishes(self) -> list[tuple[int, Wish]]:
        """The cheers and votes since the last call, with the numbers of the phones."""
        found = []
        while self._wishes:
            found.append(self._wishes.popleft())
        return found

    def guests(self) -> list[Guest]:
        """The phones that are connected or keep a place: who plays, then the queue, then who left it."""
        with self._lock:
            order = [Stage.PLAYING, Stage.TURN, Stage.WAITING, Stage.IDLE]
            there = [guest for guest in self._guests.values() if guest.connected or guest.placed]
            return sorted(there, key=lambda guest: (order.index(guest.stage), guest.rank))

    def queue(self) -> list[Guest]:
        """The connected phones that wait, the next one first."""
        with self._lock:
            waiting = [one for one in self._guests.values() if one.connected and one.stage is Stage.WAITING]
            return sorted(waiting, key=lambda guest: guest.rank)

    def guest(self, number: int) -> Guest | None:
        """The phone with this number, if it is known."""
        return self._guests.get(number)

    def remove(self, number: int, ban: bool = False) -> None:
        """Send a phone away. With `ban` it does not return, nor does its address unless others have it, too."""
        with self._lock:
            guest = self._guests.pop(number, None)
            if guest is None:
                return
            if ban:
                self._banned.add(guest.token)
            if ban and all(other.address != guest.address for other in self._guests.values()):
                self._banned.add(hash_of(guest.address))
            self.phones.forget(number)
            self.expel(number, "removed")
            self._fill()
            self.changed()

    # ---- memory

    def hall(self, page: str) -> Hall:
        """What a restart of the arcade needs, with the token of the page."""
        with self._lock:
            known = sorted(self._guests.values(), key=lambda one: (not one.placed, one.rank))[:MAX_KNOWN]
            phones = tuple(
                KnownPhone(one.number, one.token, one.name, one.colour, one.played) for one in known if one.token
            )
            return Hall(page, phones, tuple(sorted(self._banned)))

    def restore(self, hall: Hall) -> None:
        """Remember the phones of before a restart, in their order; they are away for now."""
        with self._lock:
            now = self.clock()
            self._guests, self._banned = {}, set(hall.banned)
            for place, one in enumerate(hall.phones):
                since = now - (len(hall.phones) - place) * 1e-3
                self._guests[one.number] = Guest(
                    one.number, one.token, "", since, now, now, kind_name(one.name), one.colour % COLOURS, one.played
                )
                self.phones.names[one.number] = self._guests[one.number].name
            self.phones.reserve(max((one.number + 1 for one in hall.phones), default=0))

    def clear(self) -> None:
        """Forget all phones, and who is banned."""
        with self._lock:
            for number in list(self._guests):
                self.phones.forget(number)
            self._guests, self._banned = {}, set()
            self._new.clear()

    # ---- inside

    def _room(self, address: str) -> bool:
        """True if one more phone may connect; one that has left the queue makes room for it."""
        there = [one for one in self._guests.values() if one.connected]
        of_address = Counter(one.address for one in there)
        if len(there) < MAX_CONNECTED and of_address[address] < MAX_OF_ADDRESS:
            return True
        crowd = there if len(there) >= MAX_CONNECTED else [one for one in there if one.address == address]
        idle = [one for one in crowd if one.stage is Stage.IDLE]
        if not idle or (of_address[address] >= MAX_OF_ADDRESS and idle[0].address != address):
            return False
        gone = max(idle, key=lambda one: (of_address[one.address], -one.touched_at))
        del self._guests[gone.number]
        self.phones.forget(gone.number)
        self.expel(gone.number, "full")
        return True

    def _drop_oldest(self) -> None:
        """Forget the phone that is away longest if too many are remembered."""
        away = [one for one in self._guests.values() if not one.connected and not one.placed]
        if len(self._guests) >= MAX_KNOWN and away:
            oldest = min(away, key=lambda one: one.left_at)
            del self._guests[oldest.number]
            self.phones.forget(oldest.number)

    def _touch(self, guest: Guest, pressed: bool) -> None:
        guest.touched_at = self.clock()
        self._silent.discard(guest.number)
        if guest.stage is Stage.IDLE and pressed:
            guest.stage, guest.since, guest.missed = Stage.WAITING, guest.touched_at, 0
            self._fill()

    def _may_cheer(self, guest: Guest) -> bool:
        now = self.clock()
        due = now - guest.cheered_at >= CHEER_SECONDS
        guest.cheered_at = now if due else guest.cheered_at
        return due

    def _age(self, guest: Guest, now: float, turn: float) -> None:
        """Let time pass for a phone: `turn` s in which it could have taken a seat."""
        if not guest.connected and not guest.placed:
            if now - guest.left_at > FORGET_SECONDS:
                del self._guests[guest.number]
                self.phones.forget(guest.number)
                self.changed()
        elif guest.stage is Stage.WAITING and now - guest.touched_at > UNTOUCHED_SECONDS:
            guest.stage = Stage.IDLE
        elif guest.stage is Stage.TURN and turn and self.queue():
            guest.turn += turn
            if guest.turn >= TURN_SECONDS:
                self._silent.add(guest.number)
                guest.turn, guest.since, guest.missed = 0.0, now, guest.missed + 1
                guest.stage = Stage.WAITING if guest.missed < MAX_MISSED else Stage.IDLE
                self.changed()

    def _call(self, called: Mapping[str, int]) -> None:
        """Note who is called, by the names that phones may have."""
        names = {kind_name(name).casefold(): (name, places) for name, places in called.items()}
        names.pop("", None)
        if names.keys() != self._called.keys():
            self._silent.clear()
        self._called = names

    def _calls(self) -> dict[int, str]:
        """The phones that are called, with the name: of several with the same one the next in the queue."""
        free = [one for one in self._guests.values() if one.connected and one.stage is not Stage.PLAYING]
        found: dict[str, int] = {}
        for guest in sorted(free, key=lambda one: (one.stage is not Stage.TURN, one.rank)):
            if guest.name.casefold() in self._called and guest.number not in self._silent:
                found.setdefault(guest.name.casefold(), guest.number)
        return {number: self._called[name][0] for name, number in found.items()}

    def _fill(self) -> None:
        """Give free places to those who are called, then to those who wait longest; take them from those called last
        if there are too many.
        """
        calls = self._calls()
        free = self.places - sum(guest.stage is Stage.PLAYING for guest in self._guests.values())
        free += sum(places for name, places in self._called.values() if name in calls.values())
        there = [guest for guest in self._guests.values() if guest.connected and guest.stage is not Stage.PLAYING]
        there = [guest for guest in there if guest.stage is not Stage.IDLE or guest.number in calls]
        there.sort(key=lambda guest: (guest.number not in calls, guest.stage is not Stage.TURN, guest.rank))
        for place, guest in enumerate(there):
            if place < min(free, PLACES) and guest.stage is not Stage.TURN:
                guest.stage, guest.turn = Stage.TURN, 0.0
            elif place >= min(free, PLACES) and guest.stage is Stage.TURN:
                guest.stage = Stage.WAITING
        for guest in self._guests.values():
            self.phones.plug(guest.number, guest.connected and guest.placed)
        self.phones.watching = {one.number for one in self._guests.values() if one.connected and not one.placed}
        self.phones.called = {number: name for number, name in calls.items() if self._guests[number].placed}
