"""Robot Factory: locations of pallets. Only `move` changes them, so that none is lost, duplicated or in two places."""

from pigaming_app.games.factory.state import (
    BY_WORKER,
    DAMAGED,
    ENTRY,
    EXIT,
    IN_MACHINE,
    IN_SLOT,
    MAX_PALLETS,
    ON_ROBOT,
    PALLETS,
    SHARED_SLOTS,
    SHELVES,
    SHIPPED,
    WAITING,
    WORKERS,
    Factory,
)
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.rng import uniform


@kernel
def move(match: Factory, p: int, place: int, at: int) -> None:
    """Move pallet p from its place to an empty one."""
    pallet = match.pallets[p]
    link(match, pallet.place, pallet.at, 0)
    pallet.place, pallet.at = place, at
    if pallet.state != DAMAGED:
        pallet.waited = 0
    link(match, place, at, p + 1)


@kernel
def link(match: Factory, place: int, at: int, content: int) -> None:
    """Set the content of a place: 1 + a pallet, or 0."""
    if place == IN_SLOT:
        match.slots[at].pallet = content
    elif place == ON_ROBOT:
        match.loads[at].pallet = content
    elif place == IN_MACHINE:
        match.machines[at].pallet = content
    elif place == BY_WORKER:
        match.workers[at].pallet = content


@kernel
def first_slot(side: int, kind: int) -> int:
    """Index of the first slot of an entry or exit, `side` being the team whose warehouses these are on the floor."""
    return side * 2 * SHELVES + (0 if kind == ENTRY else SHELVES)


@kernel
def side_of(match: Factory, p: int) -> int:
    """The side on which pallet p belongs into the warehouses: its team's, or among allies the one it came from."""
    return int(p // MAX_PALLETS if match.rules.allies else match.pallets[p].team)


@kernel
def free_shelf(match: Factory, side: int, kind: int) -> int:
    """The first free slot of an entry or exit that no worker is carrying a pallet to; -1 if there is none."""
    first = first_slot(side, kind)
    for s in range(first, first + SHELVES):
        if not match.slots[s].pallet and not is_destination(match, s):
            return s
    return -1


@kernel
def is_destination(match: Factory, s: int) -> bool:
    """True if a worker is carrying a pallet to slot s."""
    found = False
    for w in range(WORKERS):
        if match.workers[w].pallet and match.workers[w].shelf == s:
            found = True
    return found


@kernel
def free_shared(match: Factory) -> int:
    """A free shared slot, drawn at random; -1 if there is none."""
    count = 0
    for s in range(SHARED_SLOTS, match.slot_count):
        count += 0 if match.slots[s].pallet else 1
    if not count:
        return -1
    drawn = int(uniform(match) * count)
    for s in range(SHARED_SLOTS, match.slot_count):
        if not match.slots[s].pallet:
            if not drawn:
                return s
            drawn -= 1
    return -1


@kernel
def stock_up(match: Factory, side: int) -> None:
    """Move waiting pallets to the free slots of the entry where they wait."""
    for p in range(PALLETS):
        if match.pallets[p].exists and match.pallets[p].place == WAITING and match.pallets[p].at == side:
            s = free_shelf(match, side, ENTRY)
            if s < 0:
                return
            move(match, p, IN_SLOT, s)


@kernel
def ship(match: Factory, team: int, side: int) -> None:
    """Ship the oldest pallet of an exit if all its slots are full and more pallets of the team are to come."""
    if match.delivered[team] == match.rules.pallets:
        return
    first = first_slot(side, EXIT)
    oldest, longest = -1, -1
    for s in range(first, first + SHELVES):
        p = match.slots[s].pallet - 1
        if p < 0:
            return
        if match.pallets[p].waited > longest:
            oldest, longest = p, match.pallets[p].waited
    move(match, oldest, SHIPPED, side)
