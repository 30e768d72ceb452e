"""An event with phones: real sockets, with the names of their owners, who play their own matches."""

import math
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import partial

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.spec import DEFAULT_AI, Entrant, EventSpec, Fixture, Format
from pigaming_app.scenes.events import next_page
from pigaming_app.scenes.events.next_page import INPUT_LOCKOUT, NextMatch
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.link import PhoneLink
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.awards.moment import AwardsMoment
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.ui.input.events import Button, StickState
from pigaming_app.ui.input.phone_messages import BITS, Touches
from pigaming_app.ui.input.phones import connection
from pigaming_app.ui.input.phones.roster import TURN_SECONDS
from tests.bench.open_day.handsets import Handset, Handsets
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.events.drawn import running, saved

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed", "_no_threads_stay")
LONG = 60.0  # s, for whatever must come: the machine may be busy
NAMES = ("Ana", "Bea", "Zoë", "Duda", "Eva", "Fred", "Gil", "Ida", "Jo", "Kai", "Lou", "Mia")


class Hall:
    """An arcade with an event, and phones in front of it."""

    def __init__(self, arcade: Arcade, names: tuple[str, ...], form: Format) -> None:
        self.arcade, self.link = arcade, PhoneLink(arcade.context)
        rounds = 2 if form is Format.SWISS else 0
        entrants = tuple(map(Entrant, names))
        spec = EventSpec("Hall", form, ("pitanks",), entrants, rounds, 2, minutes={"pitanks": 1.0})
        self.run: RunningEvent = running(Event(spec))
        settings = arcade.context.settings
        settings.phones, settings.phones_network, settings.phones_port = True, "127.0.0.1", 0
        self.link.update(arcade.stack.scenes)
        self.handsets, self.phones = Handsets(), dict[str, Handset]()
        arcade.open(NextMatch(arcade.context, self.run))

    def scan(self, owner: str, name: str = "") -> Handset:
        """The phone of a person, with a name."""
        phone = self.phones[owner] = self.handsets.new(self.arcade.context.shared(phone_host).url)
        self.until(lambda: phone.state)
        phone.name(name)
        self.until(lambda: not name or phone.state["name"])
        return phone

    def close(self) -> None:
        self.handsets.close()
        self.arcade.context.shared(phone_host).close()

    def frame(self) -> None:
        self.arcade.frame(1 / 30)
        self.link.update(self.arcade.stack.scenes)
        time.sleep(0.001)

    def until(self, condition: Callable[[], object]) -> None:
        end = time.monotonic() + LONG
        while not condition():
            shown = {owner: phone.state for owner, phone in self.phones.items()}
            assert time.monotonic() < end, f"on top lies {type(self.arcade.stack.top).__name__}; {shown}"
            self.frame()

    def next(self) -> Fixture:
        """The match whose players are called, as soon as its page takes presses."""
        self.until(lambda: isinstance(self.arcade.stack.top, NextMatch))
        page = self.arcade.shown(NextMatch)
        self.until(lambda: page.clock > INPUT_LOCKOUT)
        assert page.fixture
        return page.fixture

    def takes(self, owner: str, seat: int) -> None:
        """A person presses A, and the phone shows their seat."""
        self.tap(owner)
        self.until(lambda: self.seats().get(seat) == owner)

    def match(self) -> MatchScene:
        """The match, when the robots may drive."""
        self.until(lambda: isinstance(self.arcade.stack.top, MatchScene))
        match = self.arcade.shown(MatchScene)
        match.opening.countdown.seconds_left = 0.05
        self.until(lambda: not match.opening.countdown.locked)
        return match

    def play(self, *scores: int) -> None:
        """Play the match to its end; the moments after it are those of its players."""
        match = self.arcade.finish(*scores)
        while isinstance(self.arcade.stack.top, (WinnersMoment, AwardsMoment)):
            assert not self.called() | self.turns()
            assert len(self.seats()) == sum(bool(device) for device in match.devices)
            self.arcade.press(Button.FIRE, device=match.devices[0] or KEYS[0])
            self.frame()

    def tap(self, owner: str, button: Button = Button.FIRE) -> None:
        for buttons in (BITS[button], 0):
            self.phones[owner].touch(Touches(buttons=buttons))

    def called(self) -> set[str]:
        """Whose phones say that their owner is called."""
        return {owner for owner, phone in self.phones.items() if phone.state.get("called")}

    def calls(self, owners: set[str]) -> bool:
        return self.called() == owners

    def asks(self, owners: set[str]) -> bool:
        return self.turns() == owners

    def turns(self) -> set[str]:
        """Whose phones ask for a press."""
        states = {owner: phone.state for owner, phone in self.phones.items()}
        return {owner for owner, state in states.items() if state and state["seat"] < 0 and state["before"] == -1}

    def seats(self) -> dict[int, str]:
        """Whose phones show a seat."""
        return {phone.state["seat"]: owner for owner, phone in self.phones.items() if phone.state.get("seat", -1) >= 0}

    def drives(self, owner: str, seat: int, match: MatchScene) -> bool:
        """True if the robot of a seat, and no other, moves as soon as a phone's stick does."""
        robots = match.match.state.robots
        before = [(robot.x, robot.y) for robot in robots]
        self.phones[owner].touch(Touches(0.0, -1.0))
        self.until(lambda: math.dist(before[seat], (robots[seat].x, robots[seat].y)) > 1.0)
        others = [i for i in range(2) if i != seat]
        still = all(math.dist(before[i], (robots[i].x, robots[i].y)) < 0.5 for i in others)
        self.phones[owner].touch(Touches())
        phone, controls = match.devices[seat], self.arcade.context.controls
        self.until(lambda: phone and controls.drive(phone) == StickState())
        for _ in range(15):  # until it stands
            self.frame()
        return still


@pytest.fixture
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """No phone counts as silent because this machine is slow."""
    monkeypatch.setattr(connection, "SILENT_SECONDS", LONG)


@pytest.fixture
def halls(arcade: Arcade, patient: None) -> Iterator[Callable[..., Hall]]:
    with ExitStack() as opened:

        def made(*names: str, form: Format = Format.SWISS) -> Hall:
            hall = Hall(arcade, names, form)
            opened.callback(hall.close)
            return hall

        yield made


@pytest.mark.long
def test_in_a_swiss_event_of_twelve_everybody_plays_with_their_own_phone(halls: Callable[..., Hall]) -> None:
    hall = halls(*NAMES)
    for owner in NAMES[5:] + NAMES[:5]:  # in the queue they stand in another order than in the draw
        hall.scan(owner, f" {owner.lower()} ")
    played: Counter[str] = Counter()
    while not hall.run.event.over:
        fixture = hall.next()
        pair = {*fixture.entrants}
        hall.until(partial(hall.calls, pair))
        hall.until(partial(hall.asks, pair))  # nobody else can act
        for seat, owner in reversed([*enumerate(fixture.entrants)]):
            hall.takes(owner, seat)
        match = hall.match()
        for seat, owner in enumerate(fixture.entrants):
            assert hall.drives(owner, seat, match)
            played[owner] += 1
        hall.play(5, 1)
    assert played == dict.fromkeys(NAMES, 2)
    assert saved(hall.run).over


def test_whoever_waits_may_take_the_seat_of_somebody_without_a_phone(halls: Callable[..., Hall]) -> None:
    """Of two who are called, one has no phone here: the first of the queue may play, but not in the other's place."""
    hall = halls(*NAMES[:4])
    fixture = hall.next()
    away, here = fixture.entrants
    for owner in ("first", "second", "third", here):
        hall.scan(owner, owner)
    hall.until(partial(hall.calls, {here}))
    hall.until(partial(hall.asks, {here, "first"}))
    hall.takes("first", 0)
    assert hall.called() == {here}
    hall.takes(here, 1)
    match = hall.match()
    assert hall.drives("first", 0, match)
    assert hall.drives(here, 1, match)
    hall.play(5, 1)
    hall.until(lambda: not hall.seats())
    hall.next()
    hall.until(lambda: hall.turns() == {"second", "third"})  # who played is last in the queue
    assert {*saved(hall.run).outcomes[fixture.number].places} == {(away,), (here,)}


def test_the_owner_who_comes_late_is_called_before_the_first_of_the_queue(halls: Callable[..., Hall]) -> None:
    hall = halls(*NAMES[:4])
    late = hall.next().entrants[1]
    hall.scan("first", "first")
    hall.scan("second", "second")
    hall.until(lambda: hall.turns() == {"first", "second"})
    hall.scan(late, late.upper())
    hall.until(lambda: hall.turns() == {"first", late})
    hall.phones[late].lock()
    hall.until(lambda: hall.phones["second"].state["before"] == -1)
    hall.phones[late].unlock()
    hall.until(lambda: hall.phones["second"].state["before"] == 0)


def test_pads_and_keys_play_for_anybody_as_before(halls: Callable[..., Hall]) -> None:
    hall = halls(*NAMES[:4])
    owner = hall.next().entrants[0]
    hall.scan(owner, owner)
    hall.until(partial(hall.calls, {owner}))
    hall.arcade.press(Button.FIRE, device=KEYS[0])
    page = hall.arcade.shown(NextMatch)
    assert page.seats.claims == {1: KEYS[0]}, "the seat that no phone is called to"
    hall.arcade.press(Button.FIRE, device=KEYS[1])
    assert page.seats.claims == {1: KEYS[0], 0: KEYS[1]}
    hall.until(lambda: not hall.called() | hall.turns())


def test_an_ai_that_drives_for_somebody_gives_the_seat_back_to_their_phone(
    halls: Callable[..., Hall], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(next_page, "ALL_READY", math.inf)
    hall = halls(*NAMES[:4])
    _, owner = hall.next().entrants
    for name in ("first", "second", owner):
        hall.scan(name, name)
    hall.until(partial(hall.calls, {owner}))
    hall.phones[owner].lock()
    hall.until(lambda: hall.turns() >= {"first", "second"})
    hall.takes("first", 0)
    hall.arcade.press(Button.Y, device=KEYS[0])
    assert hall.run.brain(owner) == DEFAULT_AI
    hall.phones[owner].unlock()
    hall.until(partial(hall.calls, {owner}))
    hall.takes(owner, 1)
    assert hall.run.brain(owner) == ""


def test_after_a_tie_those_who_played_keep_their_seats(halls: Callable[..., Hall]) -> None:
    hall = halls(*NAMES[:4], form=Format.KNOCKOUT)
    _, here = hall.next().entrants
    for owner in ("first", "second", here):
        hall.scan(owner, owner)
    hall.until(partial(hall.calls, {here}))
    hall.takes("first", 0)
    hall.takes(here, 1)
    hall.match()
    hall.play(3, 3)
    extra = hall.next()
    assert extra.extra == 1
    match = hall.match()
    assert hall.drives("first", 0, match)
    assert hall.drives(here, 1, match)


def test_whoever_lets_a_call_pass_makes_room_until_they_touch_their_phone(halls: Callable[..., Hall]) -> None:
    hall = halls(*NAMES[:4])
    owner, _ = hall.next().entrants
    for name in (owner, "first", "second"):
        hall.scan(name, name)
    hall.until(partial(hall.calls, {owner}))
    guest = hall.link.host.roster.guest(0)
    assert guest
    guest.turn = TURN_SECONDS
    hall.until(lambda: hall.turns() == {"first", "second"})
    assert not hall.called()
    hall.tap(owner)
    hall.until(partial(hall.calls, {owner}))
