"""Robot Factory, variant party: endless orders, rush orders, loose pallets, the fast machine.

An order is a pallet of a team. When it has been delivered, or damaged for too long, it comes back as the next order of
the team whose warehouse it came from, whoever delivered it. Loose pallets lie half done in the shared slots, belong to
nobody until somebody lifts them, and come back in the same way.
"""

from pigaming_app.games.factory.pallets import free_shared, move
from pigaming_app.games.factory.state import (
    DELIVERED,
    HALF,
    IN_SLOT,
    MACHINES,
    MAX_PALLETS,
    NOBODY,
    PALLETS,
    RAW,
    TEAMS,
    WAITING,
    Factory,
)
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.rng import uniform


@kernel
def set_out(match: Factory) -> None:
    """Put the first orders and loose pallets in place, and draw the turns of the fast machine."""
    rules = match.rules
    for m in range(MACHINES):
        match.turns[m] = m
    for m in range(MACHINES - 1, 0, -1):
        other = int(uniform(match) * (m + 1))
        match.turns[m], match.turns[other] = match.turns[other], match.turns[m]
    for team in range(TEAMS):
        for i in range(rules.orders):
            match.pallets[team * MAX_PALLETS + i].exists = 1
            order(match, team * MAX_PALLETS + i)
    for i in range(rules.loose):
        p = (i % TEAMS) * MAX_PALLETS + rules.orders + i // TEAMS
        match.pallets[p].exists, match.pallets[p].loose = 1, 1
        order(match, p)
    place_loose(match)
    choose_fast(match)


@kernel
def order(match: Factory, p: int) -> None:
    """Make pallet p, wherever it is, the next order of its warehouse, or a loose pallet again."""
    pallet, rules = match.pallets[p], match.rules
    pallet.steps, pallet.fed, pallet.rush = 0, 0, 0
    if pallet.loose:
        pallet.state, pallet.team = HALF, NOBODY
        move(match, p, WAITING, NOBODY)
        return
    team = p // MAX_PALLETS
    pallet.state, pallet.team = RAW, team
    match.ordered[team] += 1
    if match.ordered[team] % rules.rush_every == 0:
        pallet.rush = rules.rush
    move(match, p, WAITING, team)


@kernel
def run_orders(match: Factory) -> None:
    """One tick of deadlines, of delivered pallets until they come back, and of the fast machine."""
    for p in range(PALLETS):
        pallet = match.pallets[p]
        if not pallet.exists:
            continue
        if pallet.state != DELIVERED:
            if pallet.rush:
                pallet.rush -= 1
        else:
            if pallet.place != IN_SLOT:  # in a slot the rules of every variant count
                pallet.waited += 1
            if pallet.waited >= match.rules.renew:
                order(match, p)
    place_loose(match)
    choose_fast(match)


@kernel
def place_loose(match: Factory) -> None:
    """Move waiting loose pallets to free shared slots."""
    for p in range(PALLETS):
        pallet = match.pallets[p]
        if pallet.exists and pallet.loose and pallet.place == WAITING:
            s = free_shared(match)
            if s < 0:
                return
            move(match, p, IN_SLOT, s)


@kernel
def choose_fast(match: Factory) -> None:
    """Mark the machine whose turn it is."""
    turn = match.tick // match.rules.fast_every % MACHINES
    for m in range(MACHINES):
        match.machines[m].fast = 1 if match.turns[turn] == m else 0


@kernel
def is_level(match: Factory) -> bool:
    """True if both teams have the same points."""
    return bool(match.points[0] == match.points[1])
