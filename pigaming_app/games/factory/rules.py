"""Rules of Robot Factory: bring all your pallets through machine A, machine B and out.

Fire lifts and sets down. A raw pallet goes into a machine A, comes out half done, goes into a machine B, comes out
done, and goes to your exit; people work the machines. A pallet in the wrong machine is spoiled, and replaced only after
ten seconds. Nobody can lift the other team's pallets. If you drive over a person, who is never hurt, you stand still
for three seconds. The first team to deliver everything wins; both on the same tick is a tie. When the time is up, more
deliveries win, then more work.

In party, orders never end (see orders.py) and points decide; when level, the next point does. Allies share one team and
all warehouses, and play against the clock.
"""

from math import cos, sin

from pigaming_app.games.factory.orders import is_level, order, run_orders
from pigaming_app.games.factory.pallets import free_shelf, move, ship, side_of, stock_up
from pigaming_app.games.factory.pedestrians import track_motion
from pigaming_app.games.factory.state import (
    DAMAGED,
    DELIVERED,
    DONE,
    ENTRY,
    EXIT,
    IN_SLOT,
    INPUT,
    MACHINE_SLOTS,
    NOBODY,
    ON_ROBOT,
    OUTPUT,
    PALLETS,
    RAW,
    SHARED,
    SHELVES,
    TEAMS,
    WAITING,
    WORKERS,
    Factory,
)
from pigaming_app.games.factory.workers import fits, run_machines_and_workers
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robot import stop, stop_all, use_turbo
from pigaming_app.sim.things.mud import SLOW, in_mud
from pigaming_app.sim.world import ROBOTS

APART = 6.0  # px of hysteresis: a touch ends at this distance beyond contact


@kernel
def judge(match: Factory) -> None:
    """One tick of the rules: forks, pallets, machines and people, then the requested speeds."""
    if match.over:
        stop_all(match)
        return
    first = match.tick % ROBOTS if match.rules.party else 0  # of two forks at one pallet no seat is always the first
    for i in range(ROBOTS):
        k = (first + i) % ROBOTS
        if match.robots[k].present:
            track_motion(match.motions[k], match.robots[k])
            use_fork(match, k)
    age_pallets(match)
    if match.rules.party:
        run_orders(match)
    for team in range(TEAMS):
        stock_up(match, team)
    run_machines_and_workers(match)
    for k in range(ROBOTS):
        if match.robots[k].present:
            check_people(match, k)
            steer(match, k)
    match.tick += 1
    check_end(match)


@kernel
def check_end(match: Factory) -> None:
    """End the match when a team has delivered everything, or when the time is up; in party not while level."""
    rules = match.rules
    if rules.party:
        late = match.tick - rules.ticks
        if late >= rules.overtime or (late >= 0 and not is_level(match)):
            match.over = 1
        return
    for team in range(TEAMS):
        if match.delivered[team] == rules.pallets:
            match.over, match.winner = 1, 0 if match.winner else team + 1
    if match.over and rules.allies:
        match.stars = 3 if match.tick <= rules.three_stars else 2 if match.tick <= rules.two_stars else 1
    if match.tick >= rules.ticks:
        match.over = 1


@kernel
def use_fork(match: Factory, k: int) -> None:
    """Lift a pallet or set one down at each press of fire, unless robot k is frozen."""
    load, fire = match.loads[k], match.actions[k].fire
    pressed = fire and not load.pressed
    load.aim, load.pressed = match.actions[k].aim, fire
    if load.refused:
        load.refused += 1
    if not pressed or load.frozen:
        return
    robot, rules = match.robots[k], match.rules
    x, y = robot.x + rules.fork * cos(robot.heading), robot.y + rules.fork * sin(robot.heading)
    s = slot_for(match, k, x, y)
    if s < 0:
        load.refused = 1
        return
    load.refused = 0
    if load.pallet:
        set_down(match, k, s)
    else:
        lift(match, k, s)


@kernel
def lift(match: Factory, k: int, s: int) -> None:
    """Lift the pallet of slot s with robot k; from then on it belongs to the robot's team."""
    p, team = match.slots[s].pallet - 1, match.robots[k].team
    pallet = match.pallets[p]
    if pallet.team != team:
        if pallet.team != NOBODY:
            match.loads[k].stolen += 1
        pallet.team = team
    move(match, p, ON_ROBOT, k)


@kernel
def slot_for(match: Factory, k: int, x: float, y: float) -> int:
    """The slot nearest to (x, y) at which robot k can lift or set down; -1 if none is within reach."""
    best, nearest2 = -1, match.rules.reach * match.rules.reach
    for s in range(match.slot_count):
        slot = match.slots[s]
        dx, dy = x - slot.x, y - slot.y
        distance2 = dx * dx + dy * dy
        if distance2 < nearest2 and (may_set_down(match, k, s) if match.loads[k].pallet else may_lift(match, k, s)):
            best, nearest2 = s, distance2
    return best


@kernel
def may_lift(match: Factory, k: int, s: int) -> bool:
    """True if slot s holds an undelivered pallet of robot k's team, or in party one that anybody may take."""
    slot = match.slots[s]
    if not slot.pallet:
        return False
    pallet = match.pallets[slot.pallet - 1]
    if pallet.state == DELIVERED:
        return False
    if pallet.team == match.robots[k].team or slot.kind == SHARED:
        return True
    return bool(match.rules.party and slot.kind == OUTPUT and pallet.waited >= match.rules.claim)


@kernel
def may_set_down(match: Factory, k: int, s: int) -> bool:
    """True if robot k may set down its pallet in slot s."""
    slot = match.slots[s]
    if slot.kind == OUTPUT:
        return False
    if slot.kind == INPUT or slot.kind == SHARED:
        return bool(not slot.pallet)
    if slot.team != match.robots[k].team:
        return False
    state = match.pallets[match.loads[k].pallet - 1].state
    if slot.kind == ENTRY:
        return bool(not slot.pallet)
    return bool(state == DONE and not slot.pallet)


@kernel
def set_down(match: Factory, k: int, s: int) -> None:
    """Set down robot k's pallet in slot s, and apply the result: spoiled in a wrong machine, delivered at the exit."""
    load, slot = match.loads[k], match.slots[s]
    p = load.pallet - 1
    pallet = match.pallets[p]
    move(match, p, IN_SLOT, s)
    if slot.kind == INPUT and pallet.state != DAMAGED:
        pallet.fed = k + 1
        if not fits(match.machines[slot.machine].kind, pallet.state):
            pallet.state, pallet.waited = DAMAGED, 0
            load.spoiled += 1
    elif slot.kind == EXIT:
        pallet.state = DELIVERED
        deliver(match, k, p, s // (2 * SHELVES))


@kernel
def deliver(match: Factory, k: int, p: int, side: int) -> None:
    """Count pallet p, which robot k has just set down in the exit of a side, as delivered."""
    pallet, robot = match.pallets[p], match.robots[k]
    pallet.state = DELIVERED
    match.delivered[robot.team] += 1
    match.loads[k].delivered += 1
    points = match.rules.rush_points if pallet.rush else 1
    robot.score += points
    if match.rules.party:
        match.points[robot.team] += points
    ship(match, robot.team, side)


@kernel
def age_pallets(match: Factory) -> None:
    """One tick of the waiting time of pallets; damaged ones are replaced when it is over."""
    for p in range(PALLETS):
        pallet = match.pallets[p]
        if not pallet.exists:
            continue
        if pallet.state == DAMAGED:
            pallet.waited += 1
            if pallet.waited >= match.rules.replace:
                replace_damaged(match, p)
        elif pallet.place == IN_SLOT and (pallet.at >= MACHINE_SLOTS or pallet.state == DELIVERED):
            pallet.waited += 1


@kernel
def replace_damaged(match: Factory, p: int) -> None:
    """Turn a damaged pallet into a raw one at the entry, or waiting for it; in party into the next order."""
    if match.rules.party:
        order(match, p)
        return
    pallet = match.pallets[p]
    pallet.state, pallet.steps = RAW, 0
    s = free_shelf(match, side_of(match, p), ENTRY)
    if s >= 0:
        move(match, p, IN_SLOT, s)
    else:
        move(match, p, WAITING, side_of(match, p))


@kernel
def check_people(match: Factory, k: int) -> None:
    """Freeze robot k when it drives over a person, once per touch."""
    robot, load, rules = match.robots[k], match.loads[k], match.rules
    if load.frozen:
        load.frozen -= 1
    reach = match.radius + rules.worker_radius
    for w in range(WORKERS):
        worker = match.workers[w]
        dx, dy = robot.x - worker.x, robot.y - worker.y
        distance2 = dx * dx + dy * dy
        if distance2 < reach * reach:
            drives = robot.linear > rules.driving or robot.linear < -rules.driving
            if drives and not worker.touched[k]:
                worker.touched[k] = 1
                load.hits += 1
                load.frozen = rules.freeze
        elif worker.touched[k] and distance2 > (reach + APART) * (reach + APART):
            worker.touched[k] = 0


@kernel
def steer(match: Factory, k: int) -> None:
    """Request the speeds that result from robot k's stick and turbo; zero while it is frozen."""
    rules, robot, action = match.rules, match.robots[k], match.actions[k]
    if match.loads[k].frozen:
        stop(robot)
        return
    speed = rules.speed
    use_turbo(robot, action.turbo, rules.turbo_drain, rules.turbo_refill)
    if robot.boosting:
        speed *= rules.turbo_factor
    if match.mud_count and in_mud(match, robot.x, robot.y):
        speed *= SLOW
    robot.requested_linear = action.linear * speed
    robot.requested_angular = action.angular * rules.turn_rate
