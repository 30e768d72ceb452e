"""Rumbles of the pads by kind of event (see `events.py` of each view)."""

from collections.abc import Iterable, Mapping
from typing import NamedTuple


class Rumble(NamedTuple):
    """A rumble of a pad's strong and weak motor, each in [0, 1], and its length in s."""

    strong: float
    weak: float
    seconds: float


TAKEN = Rumble(0.9, 0.6, 0.28)  # a hit, or driving over a worker
GIVEN = Rumble(0.15, 0.6, 0.12)
BLOCKED = Rumble(0.4, 0.3, 0.14)
PICKED = Rumble(0.0, 0.5, 0.09)
LAP = Rumble(0.3, 0.5, 0.18)
BEST = Rumble(0.4, 0.7, 0.3)
DELIVERED = Rumble(0.5, 0.8, 0.32)
FINISH = Rumble(0.8, 0.8, 0.5)


def rumbles(kinds: Mapping[str, Rumble], events: Iterable[tuple[str, int | None]]) -> dict[int, Rumble]:
    """The strongest rumble of each seat for the (kind, seat) of one tick's events; `kinds`: those that rumble."""
    strongest: dict[int, Rumble] = {}
    for kind, seat in events:
        rumble = kinds.get(kind)
        if rumble and seat is not None:
            strongest[seat] = max(rumble, strongest.get(seat, rumble), key=_energy)
    return strongest


def _energy(rumble: Rumble) -> float:
    return (rumble.strong + rumble.weak) * rumble.seconds
