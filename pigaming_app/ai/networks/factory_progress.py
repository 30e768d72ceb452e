"""How far the work of Robot Factory has got: what environments count, and what a network learns by."""

from pigaming_app.games.factory.state import (
    DAMAGED,
    DELIVERED,
    IN_MACHINE,
    IN_SLOT,
    INPUT,
    ON_ROBOT,
    PALLETS,
    RAW,
    Factory,
)
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import ROBOTS


@kernel
def progress_of_pallets(match: Factory, team: int) -> float:
    """Steps of a team's pallets, with fractions for those lifted and those put into a machine that fits."""
    total: float = 3.0 * match.delivered[team]
    for p in range(PALLETS):
        pallet = match.pallets[p]
        if not pallet.exists or pallet.team != team or pallet.state == DELIVERED:
            continue
        if pallet.state == DAMAGED:
            total -= 0.5
            continue
        total += pallet.state - RAW
        if pallet.place == ON_ROBOT:
            total += 0.25
        elif pallet.place == IN_MACHINE or (pallet.place == IN_SLOT and match.slots[pallet.at].kind == INPUT):
            total += 0.5
    return total


@kernel
def lead_of_team(match: Factory, team: int) -> int:
    """Deliveries of a team less those of the other; in party points."""
    if match.rules.party:
        return match.points[team] - match.points[1 - team]
    return match.delivered[team] - match.delivered[1 - team]


@kernel
def success(match: Factory, team: int) -> float:
    """Of a match that is over: 1 for a win, -1 for a defeat, 0 for a tie; of allies a third for each star, or -1."""
    if match.rules.allies:
        return match.stars / 3.0 if match.stars else -1.0
    lead = lead_of_team(match, team) or more_work(match, team)
    return 1.0 if lead > 0 else -1.0 if lead < 0 else 0.0


@kernel
def more_work(match: Factory, team: int) -> int:
    """Steps of work of a team less those of the other; 0 if both have delivered everything."""
    if not match.rules.party and match.delivered[team] == match.rules.pallets:
        return 0
    more = 0
    for j in range(ROBOTS):
        if match.robots[j].present:
            more += match.loads[j].steps if match.robots[j].team == team else -match.loads[j].steps
    return more
