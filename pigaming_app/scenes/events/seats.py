"""Seats of the next match of an event: which device takes which, and their cards."""

from collections.abc import Callable, Iterator
from functools import partial

import pygame

from pigaming_app.events.spec import Fixture
from pigaming_app.scenes.events import next_view as view
from pigaming_app.scenes.events.drivers import driver_label, people_of, phones_of, stood_in, suggested
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.flow.match_words import brain_name
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.widgets.labels import black_out, pulse
from pigaming_app.ui.widgets.player_card import ask_bar, ready_bar


class EventSeats:
    """The seats of the first open match. `claims`: the devices that have taken one, by seat."""

    def __init__(self, context: Context, running: RunningEvent) -> None:
        self.context, self.running = context, running
        self.claims: dict[int, Device] = {}

    @property
    def fixture(self) -> Fixture | None:
        """The match; None when all have been played, or are played elsewhere."""
        return self.running.event.next_at(self.running.arcade)

    @property
    def people(self) -> list[int]:
        """Seats of people who play themselves."""
        fixture = self.fixture
        return people_of(self.running, fixture) if fixture else []

    @property
    def stood_in(self) -> list[int]:
        """Seats of people for whom an AI drives."""
        return stood_in(self.running, self.fixture) if self.fixture else []

    @property
    def waiting(self) -> list[int]:
        """Seats of people that nobody has taken."""
        return [seat for seat in self.people if seat not in self.claims]

    @property
    def called(self) -> dict[int, tuple[str, bool]]:
        """The names of the people, and whether others may take their seats: not those for whom an AI drives."""
        names = self.fixture.entrants if self.fixture else ()
        seats = [*self.people, *self.stood_in]
        return {seat: (names[seat], seat in self.people) for seat in seats}

    def keep(self) -> None:
        """Give the seats to the devices that the people have driven with before."""
        for seat in self.waiting:
            device = self._last(seat)
            if device and device not in self.claims.values() and self.context.controls.connected(device):
                self.claims[seat] = device

    def take(self, device: Device) -> bool:
        """Take a seat: the one of this device, or the first that is free; false if there is none."""
        fixture, phones = self.fixture, phones_of(self.context.controls, self._free)
        called = [seat for seat, phone in phones.items() if phone == device]
        own = [seat for seat in self.waiting if device in (self.suggested.get(seat), self._last(seat))]
        seats = [*called, *(seat for seat in (*own, *self.waiting) if device.kind != "phone" or seat not in phones)]
        if fixture is None or not seats:
            return False
        self.claims[seats[0]] = device
        self.running.devices[fixture.entrants[seats[0]]] = device
        self.context.sounds.play("join", seats[0])
        return True

    def returning(self, device: Device) -> list[int]:
        """The seat of the person who comes back on a device while an AI drives; empty: none."""
        phones = phones_of(self.context.controls, {seat: name for seat, (name, _) in self.called.items()})
        called = [seat for seat in self.stood_in if phones.get(seat) == device]
        return (called or self.stood_in)[:1]

    def move(self, device: Device, by: int) -> bool:
        """Move a device to the next seat of a person; whoever sits there takes the other one. False if it cannot."""
        seats = self.people
        own = next((seat for seat, other in self.claims.items() if other == device), None)
        if own is None or len(seats) < 2:
            return False
        there = seats[(seats.index(own) + by) % len(seats)]
        other = self.claims.pop(there, None)
        del self.claims[own]
        self.claims[there] = device
        if other:
            self.claims[own] = other
        return True

    def release(self, device: Device) -> None:
        self.claims = {seat: other for seat, other in self.claims.items() if other != device}

    @property
    def suggested(self) -> dict[int, Device]:
        """The devices for the seats that nobody has taken."""
        return suggested(self.context.controls, self._free, self.claims.values())

    def label(self, seat: int) -> str:
        """The button that takes a seat."""
        words, device = self.context.words, self.suggested.get(seat)
        return words.key_name(self.context.controls.label(device, Button.FIRE)) if device else words("remap.fire")

    def draw(self, screen: pygame.Surface, clock: float) -> None:
        """Draw the cards. `clock`: s since the page opened."""
        fixture, words = self.fixture, self.context.words
        assert fixture is not None
        count = len(fixture.entrants)
        black_out(screen, *(view.card_rect(i, count) for i in range(count)))
        for seat, name in enumerate(fixture.entrants):
            x, y = view.card_rect(seat, count).topleft
            brain, taken = self.running.brain(name), seat in self.claims
            state = view.AI if brain else view.TAKEN if taken else view.WANTED
            view.frame(seat, name, *self._driver(seat, brain), state).draw(screen, x, y)
            view.draw_robot(screen, seat, x, y, clock, taken)
            if brain:
                view.note_bar(brain_name(words, fixture.game, brain)).draw(screen, x, y)
            elif taken:
                ready_bar(seat, words("lobby.ready")).draw(screen, x, y)
            else:
                ask_bar(self.label(seat), words("events.press"), pulse(clock, 5)).draw(screen, x, y)

    def jobs(self) -> Iterator[Callable[[], object]]:
        """The cards, one by one."""
        fixture = self.fixture
        for seat, name in enumerate(fixture.entrants if fixture else ()):
            if self.fixture != fixture:
                return  # another match has become the next one
            brain = self.running.brain(name)
            yield partial(view.frame, seat, name, *self._driver(seat, brain), view.AI if brain else view.WANTED)

    @property
    def _free(self) -> dict[int, str]:
        """The seats that nobody has taken, by name."""
        return {seat: self.fixture.entrants[seat] for seat in self.waiting} if self.fixture else {}

    def _last(self, seat: int) -> Device | None:
        """What the entrant on a seat has driven with before."""
        fixture = self.fixture
        return self.running.devices.get(fixture.entrants[seat]) if fixture else None

    def _driver(self, seat: int, brain: str) -> tuple[str, str]:
        """Icon and name of who or what drives."""
        device = None if brain else self.claims.get(seat) or self.suggested.get(seat)
        return driver_label(self.context.words, self.context.controls, device, brain)
