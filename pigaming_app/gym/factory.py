"""Rewards of Robot Factory: the tallies of a seat."""

from math import cos, sin, sqrt
from typing import Any

from pigaming_app.ai.tallies import Tallies, sign
from pigaming_app.games.factory.state import (
    DAMAGED,
    DELIVERED,
    IN_MACHINE,
    IN_SLOT,
    INPUT,
    ON_ROBOT,
    PALLETS,
    RAW,
)
from pigaming_app.gym.buttons import has_turbo
from pigaming_app.sim.grid import node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import CELL, ROBOTS


@kernel
def tally_factory(match: Any, seat: int, senses: Any, totals: Any) -> None:
    """Steps of work, deliveries, spoiled pallets, people driven over, lead and win of the own team, and two potentials.

    Among allies the win is a third for each star, or -1. The potentials are the progress of the team's pallets, in
    steps, of which a delivery is the third, and `errand`: the way to the seat's first target, negative, in 1000 px.
    """
    load, team = match.loads[seat], match.robots[seat].team
    totals[0], totals[1], totals[2], totals[3] = load.steps, load.delivered, load.spoiled, load.hits
    ahead = match.delivered[team] - match.delivered[1 - team]
    if match.rules.party:
        ahead = match.points[team] - match.points[1 - team]
    totals[4], totals[5] = ahead, 0.0
    totals[6], totals[7] = progress_of_pallets(match, team), -length_of_errand(match, seat, senses) / 1000.0
    if match.over and match.rules.allies:
        totals[5] = match.stars / 3.0 if match.stars else -1.0
    elif match.over:
        totals[5] = sign(ahead if ahead or match.rules.party else more_work(match, team))


@kernel
def progress_of_pallets(match: Any, team: int) -> float:
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
def length_of_errand(match: Any, seat: int, senses: Any) -> float:
    """The way to the first target, px; 0 if there is none."""
    if senses.slots[0] < 0:
        return 0.0
    me, route = match.robots[seat], senses.route
    steps = route.reach[node_at(me.x, me.y)]
    if not route.straight and steps:
        return CELL * float(steps)
    dx, dy = route.goal_x - me.x, route.goal_y - me.y
    return sqrt(dx * dx + dy * dy)


@kernel
def more_work(match: Any, team: int) -> int:
    """Steps of work of a team less those of the other; 0 if either has delivered everything."""
    if match.winner or match.delivered[team] == match.rules.pallets:
        return 0
    more = 0
    for j in range(ROBOTS):
        if match.robots[j].present:
            more += match.loads[j].steps if match.robots[j].team == team else -match.loads[j].steps
    return more


@kernel
def usable(match: Any, seat: int, ticks: int) -> tuple[bool, bool]:
    """FIRE as it goes down: with a place for pallets in reach of the fork. A robot that is frozen obeys no button."""
    rules, robot, load = match.rules, match.robots[seat], match.loads[seat]
    x, y = robot.x + rules.fork * cos(robot.heading), robot.y + rules.fork * sin(robot.heading)
    fire = False
    for s in range(match.slot_count):
        dx, dy = x - match.slots[s].x, y - match.slots[s].y
        if dx * dx + dy * dy < rules.reach * rules.reach:
            fire = True
    if load.pressed or load.frozen:
        fire = False
    return fire, load.frozen <= ticks and has_turbo(robot, rules.turbo_drain)


TALLIES = Tallies(
    ("steps", "delivered", "spoiled", "bumps", "lead", "win", "progress", "errand"),
    {"progress": 4.0, "errand": 2.0, "bumps": -0.5, "win": 5.0},
    tally_factory,
)
