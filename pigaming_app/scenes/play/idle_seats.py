"""Idle seats: a seat without input for a while is asked, then an AI takes over.

Only running match time counts. The device keeps its claim: any button takes the seat back at once.
"""

from collections.abc import Collection

from pigaming_app.ui.input.events import Device

REST = 15.0  # seconds without any input until the seat is asked
ASK = 5.0  # seconds to answer


class IdleSeats:
    """Idle time of each seat, and the claims of devices that went idle."""

    def __init__(self) -> None:
        self.rest: dict[int, float] = {}
        self.away: dict[Device, int] = {}  # seat by idle device

    def alive(self, seat: int) -> None:
        """Input at a seat."""
        self.rest[seat] = 0.0

    def asked(self) -> dict[int, float]:
        """Remaining seconds of the seats being asked."""
        return {seat: REST + ASK - rest for seat, rest in self.rest.items() if rest >= REST}

    def update(self, seconds: float, driven: Collection[int]) -> list[int]:
        """Advance the seats in `driven`; returns those that did not answer."""
        self.rest = {seat: self.rest.get(seat, 0.0) + seconds for seat in driven}
        return [seat for seat, rest in self.rest.items() if rest >= REST + ASK]

    def leave(self, device: Device, seat: int) -> None:
        """An AI takes over for a device."""
        self.away[device] = seat

    def settle(self, seat: int, device: Device | None) -> None:
        """A seat has a new driver: drops all claims to it and the driver's claims to other seats."""
        self.alive(seat)
        self.away = {one: left for one, left in self.away.items() if left != seat and one != device}

    def forget(self, device: Device) -> None:
        """Drop the claim of an unplugged device."""
        self.away.pop(device, None)
