"""PiTanks as a network sees it: 128 inputs, and four heads of choices.

Directions are given as cosine and sine relative to the own heading. The other robots are sorted by how much they matter
now, so that the first of them is nearly always the one to fight. The weakest levels see one opponent at a time, each in
its turn, so that nobody is hunted. Aiming errors are measured in angular sizes of the target, since a degree matters
far away and hardly at close range.
"""

from math import cos, sin, sqrt
from typing import Annotated

from pigaming_app.ai.networks.encoding import PERIOD, Encoding, Inputs, NetworkSenses, encode_room, saturating, whole
from pigaming_app.ai.networks.pitanks_things import (
    RANGE,
    encode_bullets,
    encode_mine,
    encode_pickup,
    encode_wall,
    first_wall,
)
from pigaming_app.games.pitanks.scoring import is_finale, is_overtime, lead
from pigaming_app.games.pitanks.state import OWN_BULLETS, PiTanks
from pigaming_app.sim.action import set_action
from pigaming_app.sim.flow_field import Route, descend, free_node, update_route
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import CELL, COLUMNS, HEIGHT, HZ, ROBOTS, SOLID, WIDTH, Robot

GROUPS = (
    ("motion", 5),
    ("gun", 8),
    ("powers", 6),
    ("score", 8),
    ("place", 4),
    ("way", 8),
    ("first", 17),
    ("second", 17),
    ("third", 17),
    ("pickup", 3),
    ("bullets", 15),
    ("mine", 3),
    ("room", 12),
    ("rules", 3),
    ("habits", 2),
)
MOTION, GUN, POWERS, SCORE, PLACE, WAY, OTHERS, PICKUP, BULLETS, MINE, ROOM, RULES, HABITS, SIZE = (
    0, 5, 13, 19, 27, 31, 39, 90, 93, 108, 111, 123, 126, 128
)  # first input of each group  # fmt: skip
OTHER = 17  # inputs for each of the others
HEADS = (("drive", 3), ("turn", 7), ("fire", 2), ("turbo", 2))
TURNS = (-1.0, -0.36, -0.11, 0.0, 0.11, 0.36, 1.0)  # positions of the stick; a full turn is 17 degrees a decision

HIDDEN = 400.0  # px by which a robot out of sight counts as farther away
MATE = 5000.0  # px; team mates come last
TURN = 10_000.0  # px by which a turn more counts as farther away
RAYS, STEPS = 12, 8  # directions in which it looks for room, and steps in each
JUMP = 100.0  # px between two looks, farther than any robot drives: it was put back
FURTHER = 3  # nodes down the field at which the further way points, whatever lies in between
COS30, SIN30 = 0.8660254037844386, 0.5


@record
class PiTanksNetworkSenses(NetworkSenses):
    """Parameters of the observation, the poses at the last look, and the route to the nearest opponent."""

    clears: int  # bit j: robot j is in the line of fire
    looked: int  # tick after the last look, 0 before the first
    x: Annotated[list[float], ROBOTS]  # px
    y: Annotated[list[float], ROBOTS]
    vx: Annotated[list[float], ROBOTS]  # px/s, since the look before
    vy: Annotated[list[float], ROBOTS]
    route: Route
    target: int  # 1 + seat of the opponent whose turn it is; 0: none yet
    until: int  # tick at which that turn ends
    taken: int  # hits that this opponent had taken when that turn began
    had: Annotated[list[int], ROBOTS]  # turns of each seat


@kernel
def encode(match: PiTanks, seat: int, senses: PiTanksNetworkSenses, inputs: Inputs) -> None:
    """Fill in the inputs of one seat."""
    for i in range(SIZE):
        inputs[i] = 0.0
    me = match.robots[seat]
    ahead_x, ahead_y = cos(me.heading), sin(me.heading)
    encode_self(match, seat, inputs)
    thrift = 0.0 if is_overtime(match) else senses.thrift  # two that save their shots would never end it
    inputs[HABITS], inputs[HABITS + 1] = whole(thrift), whole(2.0 * senses.delay)
    inputs[PLACE] = whole(2.0 * me.x / WIDTH - 1.0)
    inputs[PLACE + 1] = whole(2.0 * me.y / HEIGHT - 1.0)
    inputs[PLACE + 2], inputs[PLACE + 3] = whole(ahead_x), whole(ahead_y)
    track(match, senses)
    encode_others(match, seat, senses, ahead_x, ahead_y, inputs)
    encode_bullets(match, seat, senses.delay, ahead_x, ahead_y, BULLETS, inputs)
    if match.rules.pickups:
        encode_pickup(match, me, ahead_x, ahead_y, PICKUP, inputs)
        encode_mine(match, me, ahead_x, ahead_y, MINE, inputs)
    encode_room(match, me, ahead_x, ahead_y, RAYS, STEPS, COS30, SIN30, ROOM, inputs)
    encode_wall(match, me, RANGE * ahead_x, RANGE * ahead_y, GUN + 4, inputs)


@kernel
def encode_self(match: PiTanks, seat: int, inputs: Inputs) -> None:
    """The own robot, the score and the rules."""
    me, tank, rules = match.robots[seat], match.tanks[seat], match.rules
    inputs[MOTION] = whole(me.linear / 400.0)
    inputs[MOTION + 1] = whole(me.angular / rules.turn_rate)
    inputs[MOTION + 2], inputs[MOTION + 3] = whole(me.turbo), whole(me.boosting)
    inputs[MOTION + 4] = whole(tank.knocked_out / (rules.knockout + 1.0))
    alive = 0
    for i in range(seat * OWN_BULLETS, (seat + 1) * OWN_BULLETS):
        alive += match.bullets[i].alive
    inputs[GUN], inputs[GUN + 1] = whole(tank.cooldown / rules.cooldown), whole(0.0 if tank.cooldown else 1.0)
    inputs[GUN + 2], inputs[GUN + 3] = whole(tank.protected / 37.0), whole(alive / rules.bullets_alive)
    for power in range(6):
        if tank.powers[power]:
            inputs[POWERS + power] = whole(tank.powers[power] / rules.power_life)
    ahead = lead(match, seat)
    inputs[SCORE], inputs[SCORE + 1] = whole(saturating(0.5 * ahead)), whole(saturating(0.1 * ahead))
    inputs[SCORE + 2] = whole((rules.ticks - match.tick) / (120.0 * HZ))
    inputs[SCORE + 3] = whole(1.0 if is_finale(match) else 0.0)
    inputs[SCORE + 4] = whole(1.0 if is_overtime(match) else 0.0)
    inputs[SCORE + 5] = whole(tank.camped / (rules.camping + 1.0) if rules.camping else 0.0)
    inputs[SCORE + 6], inputs[SCORE + 7] = whole(tank.lit), whole(tank.bounty)
    inputs[RULES] = whole(rules.protection / 37.0)
    inputs[RULES + 1] = whole(1.0 if rules.knockout else 0.0)
    inputs[RULES + 2] = whole(rules.pickups)


@kernel
def track(match: PiTanks, senses: PiTanksNetworkSenses) -> None:
    """The velocities of all robots, from their displacement since the last look, as a camera measures them.

    The speed of a robot's motors says nothing about one that pushes against a wall.
    """
    elapsed = match.tick + 1 - senses.looked
    if elapsed == 0:
        return
    tracked = senses.looked > 0 and 0 < elapsed <= 2 * PERIOD
    senses.looked = match.tick + 1
    for j in range(ROBOTS):
        robot = match.robots[j]
        dx, dy = robot.x - senses.x[j], robot.y - senses.y[j]
        if tracked and dx * dx + dy * dy < JUMP * JUMP:
            senses.vx[j], senses.vy[j] = dx * HZ / elapsed, dy * HZ / elapsed
        else:
            senses.vx[j], senses.vy[j] = robot.linear * cos(robot.heading), robot.linear * sin(robot.heading)
        senses.x[j], senses.y[j] = robot.x, robot.y


@kernel
def encode_others(
    match: PiTanks, seat: int, senses: PiTanksNetworkSenses, ahead_x: float, ahead_y: float, inputs: Inputs
) -> None:
    """The other robots, the most pressing first, and the way to the nearest opponent."""
    me, radius = match.robots[seat], match.rules.bullet_radius
    senses.clears = 0
    target, target2 = -1, 1e18
    for i in range(1, ROBOTS):
        j = (seat + i) % ROBOTS
        robot = match.robots[j]
        if not robot.present:
            continue
        if is_clear(match, me.x, me.y, robot.x, robot.y, radius):
            senses.clears |= 1 << j
        dx, dy = robot.x - me.x, robot.y - me.y
        distance2 = dx * dx + dy * dy
        if robot.team != me.team and distance2 < target2:
            target, target2 = j, distance2
    told = 0
    if senses.turns and target >= 0:
        target = take_turns(match, seat, senses)
        dx, dy = match.robots[target].x - me.x, match.robots[target].y - me.y
        target2 = dx * dx + dy * dy
        for j in range(ROBOTS):
            if match.robots[j].team != me.team and j != target:
                told |= 1 << j
    for place in range(ROBOTS - 1):
        best, least = -1, 1e18
        for i in range(1, ROBOTS):
            j = (seat + i) % ROBOTS
            robot = match.robots[j]
            if robot.present and not (told >> j) & 1:
                dx, dy = robot.x - me.x, robot.y - me.y
                cost = sqrt(dx * dx + dy * dy)
                if not (senses.clears >> j) & 1:
                    cost += HIDDEN
                if robot.team == me.team:
                    cost += MATE
                if cost < least:
                    best, least = j, cost
        if best < 0:
            break
        told |= 1 << best
        encode_other(match, seat, best, senses, ahead_x, ahead_y, OTHERS + OTHER * place, inputs)
    if target < 0:
        return
    route = senses.route
    route.active, route.goal_x, route.goal_y = 1, match.robots[target].x, match.robots[target].y
    update_route(match, route, me.x, me.y)
    if not (senses.clears >> target) & 1:
        dx, dy = match.robots[target].x - me.x, match.robots[target].y - me.y
        wall, _ = first_wall(match, me.x, me.y, dx, dy)
        inputs[GUN + 7] = whole(1.0 if wall >= 0 and match.walls[wall].health == SOLID else 0.0)
    towards(me, route.waypoint_x, route.waypoint_y, ahead_x, ahead_y, WAY, inputs)
    length, further_x, further_y = sqrt(target2), route.goal_x, route.goal_y
    if not route.straight:
        node = free_node(match, me.x, me.y)
        length = CELL * route.reach[node]
        for _ in range(FURTHER):
            node = descend(route, node)
        further_x, further_y = node % COLUMNS * CELL, node // COLUMNS * CELL
    towards(me, further_x, further_y, ahead_x, ahead_y, WAY + 3, inputs)
    inputs[WAY + 6], inputs[WAY + 7] = whole(route.straight), whole(length / 1600.0 - 1.0)


@kernel
def take_turns(match: PiTanks, seat: int, senses: PiTanksNetworkSenses) -> int:
    """The opponent whose turn it is. Its turn ends when it is hit, or when the time of the turn is over.

    The next is the opponent that has had the fewest turns, never the same again while there are others; of several one
    in sight, then the nearest. There must be an opponent.
    """
    me = match.robots[seat]
    last: int = senses.target - 1
    if last >= 0:
        is_opponent = match.robots[last].present and match.robots[last].team != me.team
        if is_opponent and match.tick < senses.until and match.tanks[last].taken == senses.taken:
            return last
    best, least = last, 1e18
    for j in range(ROBOTS):
        robot = match.robots[j]
        if not robot.present or robot.team == me.team:
            continue
        dx, dy = robot.x - me.x, robot.y - me.y
        cost = sqrt(dx * dx + dy * dy) + TURN * senses.had[j]
        if not (senses.clears >> j) & 1:
            cost += 0.5 * TURN
        if j == last:
            cost += 1e9
        if cost < least:
            best, least = j, cost
    senses.target, senses.taken, senses.until = best + 1, match.tanks[best].taken, match.tick + int(senses.turns * HZ)
    senses.had[best] += 1
    return best


@kernel
def towards(me: Robot, x: float, y: float, ahead_x: float, ahead_y: float, k: int, inputs: Inputs) -> None:
    """Direction and distance of a point, in three inputs from k on."""
    dx, dy = x - me.x, y - me.y
    distance = sqrt(dx * dx + dy * dy) + 1e-9
    inputs[k] = whole((ahead_x * dx + ahead_y * dy) / distance)
    inputs[k + 1] = whole((ahead_x * dy - ahead_y * dx) / distance)
    inputs[k + 2] = whole(distance / 400.0)


@kernel
def encode_other(
    match: PiTanks,
    seat: int,
    j: int,
    senses: PiTanksNetworkSenses,
    ahead_x: float,
    ahead_y: float,
    k: int,
    inputs: Inputs,
) -> None:
    """Robot j, from input k on."""
    me, robot, tank = match.robots[seat], match.robots[j], match.tanks[j]
    heading = robot.heading - senses.delay * robot.angular
    towards_x, towards_y = cos(heading), sin(heading)
    vx, vy = senses.vx[j], senses.vy[j]
    true_x, true_y = robot.x - me.x - senses.delay * vx, robot.y - me.y - senses.delay * vy
    dx, dy = true_x - senses.error * true_y, true_y + senses.error * true_x
    distance = sqrt(dx * dx + dy * dy) + 1e-9
    reach = match.radius + match.rules.bullet_radius
    size = reach / (distance + reach)
    flight = distance / match.rules.bullet_speed + senses.delay
    aim_x, aim_y = dx + flight * vx, dy + flight * vy
    aim = sqrt(aim_x * aim_x + aim_y * aim_y) + 1e-9
    aim_cos, aim_sin = (ahead_x * aim_x + ahead_y * aim_y) / aim, (ahead_x * aim_y - ahead_y * aim_x) / aim
    facing_cos = -(towards_x * dx + towards_y * dy) / distance
    facing_sin = (towards_x * dy - towards_y * dx) / distance
    inputs[k], inputs[k + 1] = whole(1.0), whole(1.0 if robot.team == me.team else 0.0)
    inputs[k + 2], inputs[k + 3] = whole(distance / 800.0 - 1.0), whole(size)
    inputs[k + 4] = whole((ahead_x * dx + ahead_y * dy) / distance)
    inputs[k + 5] = whole((ahead_x * dy - ahead_y * dx) / distance)
    inputs[k + 6], inputs[k + 7] = whole(in_sizes(aim_cos, aim_sin, size)), whole(aim_sin)
    inputs[k + 8], inputs[k + 9] = whole(facing_cos), whole(facing_sin)
    inputs[k + 10] = whole(in_sizes(facing_cos, facing_sin, size))
    inputs[k + 11] = whole((senses.clears >> j) & 1)
    inputs[k + 12], inputs[k + 13] = whole(tank.protected / 37.0), whole(1.0 if tank.knocked_out else 0.0)
    inputs[k + 14] = whole((ahead_x * vx + ahead_y * vy) / 400.0)
    inputs[k + 15] = whole((ahead_x * vy - ahead_y * vx) / 400.0)
    inputs[k + 16] = whole(0.5 * (tank.lit + tank.bounty))


@kernel
def in_sizes(along: float, across: float, size: float) -> float:
    """An angle in thirds of an angular size, from its cosine and sine; beyond a quarter turn the nearer limit."""
    if along > 0.0:
        return across / (3.0 * size)
    return 1.0 if across > 0.0 else -1.0


@kernel
def act(match: PiTanks, seat: int, choices: list[int]) -> None:
    """Stick and buttons from the choices of the four heads."""
    set_action(match.actions[seat], choices[0] - 1.0, TURNS[choices[1]], choices[2], choices[3])


ENCODING = Encoding("pitanks", GROUPS, HEADS, encode, act, PiTanksNetworkSenses)
