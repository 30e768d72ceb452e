"""A child who walks off: a seat at which nothing moves for a while is asked, then an AI drives on.

Only time in which the match runs counts. The device keeps its claim: any button of it takes the seat back at once.
"""

from collections.abc import Collection

from pigaming_app.ui.input.events import Device

REST = 15.0  # seconds with the stick at rest and no button down until the seat is asked
ASK = 5.0  # seconds in which it may answer


class IdleSeats:
    """How long nothing has moved at each seat, and whose seats AIs hold."""

    def __init__(self) -> None:
        self.rest: dict[int, float] = {}
        self.away: dict[Device, int] = {}  # devices that have left their seats, and which

    def alive(self, seat: int) -> None:
        """Something has moved at a seat."""
        self.rest[seat] = 0.0

    def asked(self) -> dict[int, float]:
        """The seats that are asked, and how many seconds each has left."""
        return {seat: REST + ASK - rest for seat, rest in self.rest.items() if rest >= REST}

    def update(self, seconds: float, driven: Collection[int]) -> list[int]:
        """Let time pass at the seats that people drive; those at which nobody has answered."""
        self.rest = {seat: self.rest.get(seat, 0.0) + seconds for seat in driven}
        return [seat for seat, rest in self.rest.items() if rest >= REST + ASK]

    def leave(self, device: Device, seat: int) -> None:
        """An AI drives on for a device."""
        self.away[device] = seat

    def settle(self, seat: int, device: Device | None) -> None:
        """A seat has changed hands: all claims to it are void, and so is that of its new driver to another one."""
        self.alive(seat)
        self.away = {one: left for one, left in self.away.items() if left != seat and one != device}

    def forget(self, device: Device) -> None:
        """A device was unplugged."""
        self.away.pop(device, None)
