"""Rewards of Robot Factory: the tallies of a seat."""

from math import cos, sin, sqrt
from typing import Any

from pigaming_app.ai.networks.factory_progress import lead_of_team, progress_of_pallets, success
from pigaming_app.ai.tallies import Tallies
from pigaming_app.gym.buttons import has_turbo
from pigaming_app.sim.grid import node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import CELL


@kernel
def tally_factory(match: Any, seat: int, senses: Any, totals: Any) -> None:
    """Steps of work, deliveries, spoiled pallets, people driven over, lead and win of the own team, and two potentials.

    Among allies the win is a third for each star, or -1. The potentials are the progress of the team's pallets, in
    steps, of which a delivery is the third, and `errand`: the way to the seat's first target, negative, in 1000 px.
    """
    load, team = match.loads[seat], match.robots[seat].team
    totals[0], totals[1], totals[2], totals[3] = load.steps, load.delivered, load.spoiled, load.hits
    totals[4], totals[5] = lead_of_team(match, team), success(match, team) if match.over else 0.0
    totals[6], totals[7] = progress_of_pallets(match, team), -length_of_errand(match, seat, senses) / 1000.0


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
