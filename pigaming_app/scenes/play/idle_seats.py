"""Idle seats: a seat without input for a while is asked, then an AI takes over.

Only running match time counts. The device keeps its claim: any button takes the seat back at once.
"""

from collections.abc import Collection

from pigaming_app.ui.input.events import Device

IDLE_LIMIT = 15.0  # seconds without any input until the seat is asked
ANSWER_LIMIT = 5.0  # seconds to answer


class IdleSeats:
    """Idle time of each seat, and the claims of devices that went idle."""

    def __init__(self) -> None:
        self.idle_for: dict[int, float] = {}
        self.claims: dict[Device, int] = {}  # seat by idle device

    def touch(self, seat: int) -> None:
        """Input at a seat."""
        self.idle_for[seat] = 0.0

    def prompted(self) -> dict[int, float]:
        """Remaining seconds of the seats being asked."""
        return {seat: IDLE_LIMIT + ANSWER_LIMIT - idle for seat, idle in self.idle_for.items() if idle >= IDLE_LIMIT}

    def update(self, seconds: float, driven: Collection[int]) -> list[int]:
        """Advance the seats in `driven`; returns those that did not answer."""
        self.idle_for = {seat: self.idle_for.get(seat, 0.0) + seconds for seat in driven}
        return [seat for seat, idle in self.idle_for.items() if idle >= IDLE_LIMIT + ANSWER_LIMIT]

    def leave(self, device: Device, seat: int) -> None:
        """An AI takes over for a device."""
        self.claims[device] = seat

    def reassign(self, seat: int, device: Device | None) -> None:
        """A seat has a new driver: drops all claims to it and the driver's claims to other seats."""
        self.touch(seat)
        self.claims = {claimant: left for claimant, left in self.claims.items() if left != seat and claimant != device}

    def forget(self, device: Device) -> None:
        """Drop the claim of an unplugged device."""
        self.claims.pop(device, None)
