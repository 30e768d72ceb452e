"""What the scenes mean to phones: who has a seat, for how many there is one, whether a match runs or has just ended."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.input.phone_pads import MAX_PHONES

if TYPE_CHECKING:  # the title does not wait for these
    from pigaming_app.scenes.play.drivers import Drivers
    from pigaming_app.scenes.results.headline import EndedMatch


@runtime_checkable
class Seated(Protocol):
    """A scene that knows the device of each seat."""

    access: Access


@runtime_checkable
class Driven(Protocol):
    """A scene in which devices drive robots."""

    drivers: "Drivers"


@runtime_checkable
class Ended(Protocol):
    """A scene after a match."""

    ended: "EndedMatch"


@runtime_checkable
class Calling(Protocol):
    """A scene that calls people by their names. `called`: for each seat of a person the name, and whether others may
    take it, too.
    """

    called: Mapping[int, tuple[str, bool]]


@dataclass(frozen=True)
class Seating:
    """The seats of the uppermost scene that has any. `places`: phones that may act there; `seat_free`: one whose turn
    it is can sit down; `match`: one is on the stack; `winners`: phones that won the match on top, None: there is none;
    `called`: see `Roster.update`; `kept`: phones that play again, whoever waits.
    """

    devices: tuple[Device | None, ...] = ()
    places: int = MAX_PHONES
    seat_free: bool = True
    match: bool = False
    winners: tuple[int, ...] | None = None
    called: Mapping[str, int] = field(default_factory=dict)
    kept: tuple[int, ...] = ()

    @property
    def phones(self) -> list[int]:
        """The numbers of the phones with a seat."""
        return numbers(self.devices)


def seating(scenes: Sequence[Scene]) -> Seating:
    """The seats of the scenes on the stack: of a match or its results, whatever page is over it."""
    with_seats = [scene for scene in reversed(scenes) if isinstance(scene, Seated)]
    of_match = next((scene for scene in with_seats if isinstance(scene, Driven | Ended)), None)
    seated = of_match or next(iter(with_seats), None)
    if seated is None:
        return Seating()
    devices = tuple(seated.access.devices())
    others = sum(device is not None and device.kind != "phone" for device in devices)
    phones = tuple(numbers(devices))
    if isinstance(coming(seated), Calling):  # its seats are held until the next call
        return Seating(devices, len(phones), False, True)
    if isinstance(seated, Calling) and seated.called:
        seats = seated.called
        places = sum(everybody for _, everybody in seats.values())
        awaited = {name: int(not everybody) for seat, (name, everybody) in seats.items() if devices[seat] is None}
        return Seating(devices, (places or MAX_PHONES) - others, bool(awaited), called=awaited, kept=phones)
    if isinstance(seated, Driven):
        drivers = seated.drivers
        free = [seat for seat in drivers.takeable if seat not in drivers.idle.claims.values()]
        held = {*numbers(devices), *numbers(drivers.idle.claims)}
        return Seating(devices, len(held) + len(free), bool(free), True)
    if isinstance(seated, Ended):
        rows = seated.ended.outcome.rows
        won = tuple(numbers([devices[row.seat] for row in rows if row.place == 1]))
        due = bool(getattr(seated, "claims", ())) or seated is not scenes[-1]  # initials are to be entered first
        return Seating(devices, len(rows) - others, True, winners=None if due else won)
    return Seating(devices, len(devices) - others, None in devices)


def coming(scene: Scene) -> Scene | None:
    """What follows the moments after a match."""
    following = getattr(scene, "then", None)
    return (coming(following) or following) if following else None


def numbers(devices: Sequence[Device | None] | dict[Device, int]) -> list[int]:
    """The numbers of those that are phones."""
    return [device.number for device in devices if device and device.kind == "phone"]
