"""Robot Factory: initial state of a match, its goal, and its statistics."""

from collections.abc import Mapping

from pigaming_app.games.factory.layout import Floor
from pigaming_app.games.factory.orders import set_out
from pigaming_app.games.factory.pallets import stock_up
from pigaming_app.games.factory.pedestrians import send
from pigaming_app.games.factory.stars import THREE_STARS, TWO_STARS, expected_time
from pigaming_app.games.factory.state import (
    FIRE,
    HOLD,
    ICE,
    MAX_PALLETS,
    NOBODY,
    RAW,
    SHARED_SLOTS,
    TEAMS,
    WAITING,
    Factory,
    FactoryRules,
)
from pigaming_app.games.game import ALLIES, PAIRS, Setup, Variant
from pigaming_app.games.simple import seat_robots
from pigaming_app.games.starts import dealt, dealt_to_ends
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import DT, HZ, ROBOTS

PALLETS = FactoryRules().pallets  # per team, the default goal
GOALS = tuple(range(2, MAX_PALLETS + 1))
OVERTIME = 30.0  # s
VARIANTS = Variant.by_name(
    Variant("standard", (3, 5, 8), 5, GOALS, PALLETS, PAIRS, teams=(0, 1, 0, 1), achievements=("time",)),
    Variant(
        "party",
        (2, 3, 5),
        3,
        team_mode=PAIRS,
        teams=(0, 1, 0, 1),
        overtime=OVERTIME,
        columns=("score", "delivered", "stolen"),
        achievements=("points",),
    ),
    Variant("together", (3, 5, 8), 5, (4, 6, 8, 10, 12), 8, ALLIES, teams=(0, 0, 0, 0), achievements=("time",)),
)
STEPS_PER_DELIVERY = 1000.0  # steps of work that weigh as much as one delivery: more than a match can have


def start(match: Factory, arena: Arena, setup: Setup) -> None:
    """Fill a fresh match: walls, machines, people, robots on their team's starts, pallets, rules, random seed."""
    allies = VARIANTS[setup.variant].team_mode == ALLIES
    seat_robots(match, arena, setup, dealt if allies else dealt_to_ends)
    floor = floor_of(match, arena)
    set_rules(match.rules, setup)
    match.rules.fork = arena.radius + HOLD
    if match.rules.allies:
        expected = expected_time(floor, sum(robot.present for robot in match.robots), match.rules.pallets)
        match.rules.three_stars, match.rules.two_stars = (
            round(THREE_STARS * expected * HZ),
            round(TWO_STARS * expected * HZ),
        )
    for motion, robot in zip(match.motions, match.robots, strict=True):
        motion.x, motion.y = robot.x, robot.y
    _place_equipment(match, floor)
    if match.rules.party:
        set_out(match)
    else:
        _place_pallets(match)
    for side in (ICE, FIRE):
        stock_up(match, side)


def floor_of(match: Factory, arena: Arena) -> Floor:
    """The floor of a match: the warehouses belong to the teams that start beside them."""
    floor: Floor = arena.plan
    pairs = zip(match.robots, match.starts, strict=True)
    return floor.swapped if any(robot.present and robot.team != k % TEAMS for robot, k in pairs) else floor


def _place_pallets(match: Factory) -> None:
    """The pallets of both teams, or those of the allies in turn at either entry."""
    rules = match.rules
    for i in range(rules.pallets if rules.allies else TEAMS * rules.pallets):
        side = i % TEAMS
        pallet = match.pallets[side * MAX_PALLETS + i // TEAMS]
        pallet.exists, pallet.team, pallet.state = 1, ICE if rules.allies else side, RAW
        pallet.place, pallet.at = WAITING, side


def _place_equipment(match: Factory, floor: Floor) -> None:
    """Place slots, machines, people and the aisle."""
    match.slot_count = len(floor.slots) if match.rules.party else SHARED_SLOTS
    for slot, spec in zip(match.slots, floor.slots[: match.slot_count], strict=False):
        team = ICE if match.rules.allies and spec.team != NOBODY else spec.team
        slot.kind, slot.team, slot.machine, slot.x, slot.y = spec.kind, team, spec.machine, spec.x, spec.y
    for machine, body in zip(match.machines, floor.machines, strict=True):
        machine.kind, machine.x, machine.y = body.kind, body.x, body.y
        machine.spot_x, machine.spot_y = body.spot_x, body.spot_y
    for worker, (x, y) in zip(match.workers, floor.homes, strict=True):
        worker.x, worker.y, worker.home_x, worker.home_y, worker.machine = x, y, x, y, -1
        send(worker, x, y)
    match.aisle[:] = floor.aisle


def rules_of(setup: Setup) -> FactoryRules:
    """The rules of a match."""
    rules = FactoryRules()
    set_rules(rules, setup)
    return rules


def set_rules(rules: FactoryRules, setup: Setup) -> None:
    """Adapt fresh rules to a setup."""
    rules.ticks = round(setup.minutes * 60 * HZ)
    rules.pallets = setup.goal or rules.pallets
    if setup.variant == "party":
        rules.party, rules.pallets = 1, 0
        rules.orders, rules.loose, rules.renew = 4, 3, 5 * HZ
        rules.rush_every, rules.rush, rules.rush_points = 3, 60 * HZ, 2
        rules.claim, rules.overtime = 4 * HZ, round(OVERTIME * HZ)
        rules.fast_every, rules.fast_process = 45 * HZ, 2 * HZ
    elif setup.variant == "together":
        rules.allies = 1


def ranking_key(match: Factory, seat: int) -> float:
    """Deliveries of a seat's team (in party points), then the work done on pallets that its robots fed to machines.

    Work is ignored once a team has delivered everything, so that two teams finishing on the same tick tie. Allies that
    have delivered everything are ranked by the time left, above 0, and all others below 0.
    """
    team, rules = match.robots[seat].team, match.rules
    if rules.allies and match.stars:
        return 1.0 + rules.ticks - match.tick
    done = match.points[team] if rules.party else match.delivered[team]
    if done == rules.pallets and not rules.party:
        return done * STEPS_PER_DELIVERY
    steps = sum(match.loads[i].steps for i in range(ROBOTS) if match.robots[i].team == team)
    missing = rules.pallets if rules.allies else 0
    return (done - missing) * STEPS_PER_DELIVERY + min(STEPS_PER_DELIVERY - 1.0, steps)


def stats(match: Factory, seat: int) -> Mapping[str, float]:
    """Statistics of a seat: pallets delivered, steps of work on pallets it fed to machines, people driven over.

    In party also pallets taken from the other team; for allies their stars.
    """
    load = match.loads[seat]
    facts = {"delivered": load.delivered, "steps": load.steps, "bumps": load.hits}
    if match.rules.party:
        facts["stolen"] = load.stolen
    if match.rules.allies:
        facts["stars"] = match.stars
    return facts


def records(match: Factory, seat: int) -> Mapping[str, int]:
    """Time in which the seat's team delivered everything, in ms, or in party its points; empty if there is neither."""
    if match.rules.party:
        return {"points": match.points[match.robots[seat].team]}
    done = match.delivered[match.robots[seat].team] == match.rules.pallets
    return {"time": round(1000 * DT * match.tick)} if done else {}
