"""Robot Factory, variant together: the times for three and two stars, from floor, robots and pallets.

The expected time is that of strong players: setting up, then for each pallet the longer of two times, that of the
machines and that of the robots. A robot's time for a pallet is its way through the floor and back, and the handling.
"""

from math import hypot

from pigaming_app.games.factory.layout import Floor, SlotSpec
from pigaming_app.games.factory.state import ENTRY, EXIT, INPUT, OUTPUT, A, B

SET_UP = 12.0  # s until the first pallet leaves the first machine
MACHINES_TIME = 7.2  # s, from pallet to pallet, of two machines of a kind with their workers' ways
HANDLING = 8.0  # s of lifting and setting down a pallet, three times each
PACE = 230.0  # px/s, mean speed on a way
THREE_STARS, TWO_STARS = 1.35, 2.0  # limits, as multiples of the expected time


def expected_time(floor: Floor, robots: int, pallets: int) -> float:
    """Time in which strong players deliver everything, s."""
    return SET_UP + pallets * max(MACHINES_TIME, (HANDLING + way(floor) / PACE) / robots)


def way(floor: Floor) -> float:
    """Mean way of a robot for one pallet, px: from its entry by the nearest machines to an exit, and to an entry."""
    entries, exits = ([slot for slot in floor.slots if slot.kind == kind] for kind in (ENTRY, EXIT))
    into, out = ([_slots(floor, kind, of) for of in (A, B)] for kind in (INPUT, OUTPUT))
    to_machines = sum(_nearest(slot, into[A]) for slot in entries) / len(entries)
    between = sum(_nearest(slot, into[B]) for slot in out[A]) / len(out[A])
    to_exit = sum(_nearest(slot, exits) for slot in out[B]) / len(out[B])
    back = sum(_nearest(slot, entries) for slot in exits) / len(exits)
    return to_machines + between + to_exit + back


def _slots(floor: Floor, kind: int, of: int) -> list[SlotSpec]:
    """The input or output slots of the machines of a kind."""
    return [slot for slot in floor.slots if slot.kind == kind and floor.machines[slot.machine].kind == of]


def _nearest(slot: SlotSpec, others: list[SlotSpec]) -> float:
    return min(hypot(slot.x - other.x, slot.y - other.y) for other in others)
