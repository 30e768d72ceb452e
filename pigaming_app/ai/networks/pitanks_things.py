"""What lies or flies about in PiTanks, as a network sees it: bullets, pick-up, mine, and walls in the line of fire."""

from math import sqrt

from pigaming_app.ai.networks.encoding import Inputs, whole
from pigaming_app.games.pitanks.state import MINES, OWN_BULLETS, OWN_MINES, PiTanks
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.sweep import is_aside, wall_contact
from pigaming_app.sim.world import ROBOTS, SOLID, Robot

SOON = 1.6  # s; bullets that pass later are left out
PASSING = 130.0  # px; so are those that pass farther away
MINE_NEAR = 250.0  # px
RANGE = 1200.0  # px within which walls in the line of fire count


@kernel
def encode_bullets(
    match: PiTanks, seat: int, delay: float, ahead_x: float, ahead_y: float, k: int, inputs: Inputs
) -> None:
    """The three bullets of opponents that pass soonest, in 15 inputs from k on."""
    me, speed = match.robots[seat], match.rules.bullet_speed
    first, second, third = -1, -1, -1
    first_in, second_in, third_in = SOON, SOON, SOON
    for owner in range(ROBOTS):
        if not match.robots[owner].present or match.robots[owner].team == me.team:
            continue
        for i in range(owner * OWN_BULLETS, (owner + 1) * OWN_BULLETS):
            bullet = match.bullets[i]
            if not bullet.alive:
                continue
            px, py = me.x - bullet.x, me.y - bullet.y
            time = (px * bullet.vx + py * bullet.vy) / (speed * speed)
            if time <= 0.0 or time >= third_in:
                continue
            side = (bullet.vx * py - bullet.vy * px) / speed
            if side <= -PASSING or side >= PASSING:
                continue
            if time < first_in:
                third, third_in, second, second_in, first, first_in = second, second_in, first, first_in, i, time
            elif time < second_in:
                third, third_in, second, second_in = second, second_in, i, time
            else:
                third, third_in = i, time
    if first >= 0:
        encode_bullet(match, me, first, first_in + delay, ahead_x, ahead_y, k, inputs)
    if second >= 0:
        encode_bullet(match, me, second, second_in + delay, ahead_x, ahead_y, k + 5, inputs)
    if third >= 0:
        encode_bullet(match, me, third, third_in + delay, ahead_x, ahead_y, k + 10, inputs)


@kernel
def encode_bullet(
    match: PiTanks, me: Robot, i: int, seconds: float, ahead_x: float, ahead_y: float, k: int, inputs: Inputs
) -> None:
    """Bullet i, which passes in some seconds, from input k on."""
    bullet, speed = match.bullets[i], match.rules.bullet_speed
    side = (bullet.vx * (me.y - bullet.y) - bullet.vy * (me.x - bullet.x)) / speed
    inputs[k], inputs[k + 1] = whole(1.0), whole(1.0 / (1.0 + 3.0 * seconds))
    inputs[k + 2] = whole(side / 60.0)
    inputs[k + 3] = whole(-(ahead_x * bullet.vx + ahead_y * bullet.vy) / speed)
    inputs[k + 4] = whole(-(ahead_x * bullet.vy - ahead_y * bullet.vx) / speed)


@kernel
def encode_pickup(match: PiTanks, me: Robot, ahead_x: float, ahead_y: float, k: int, inputs: Inputs) -> None:
    """The nearest pick-up, in three inputs from k on."""
    to_x, to_y, nearest2 = 0.0, 0.0, 1e18
    for pickup in match.pickups:
        dx, dy = pickup.x - me.x, pickup.y - me.y
        if pickup.alive and dx * dx + dy * dy < nearest2:
            to_x, to_y, nearest2 = dx, dy, dx * dx + dy * dy
    if nearest2 < 1e18:
        distance = sqrt(nearest2) + 1e-9
        inputs[k] = whole((ahead_x * to_x + ahead_y * to_y) / distance)
        inputs[k + 1] = whole((ahead_x * to_y - ahead_y * to_x) / distance)
        inputs[k + 2] = whole(300.0 / (300.0 + distance))


@kernel
def encode_mine(match: PiTanks, me: Robot, ahead_x: float, ahead_y: float, k: int, inputs: Inputs) -> None:
    """The nearest mine of an opponent, in three inputs from k on."""
    to_x, to_y, nearest2 = 0.0, 0.0, MINE_NEAR * MINE_NEAR
    for i in range(MINES):
        mine = match.mines[i]
        if mine.alive and match.robots[i // OWN_MINES].team != me.team:
            dx, dy = mine.x - me.x, mine.y - me.y
            if dx * dx + dy * dy < nearest2:
                to_x, to_y, nearest2 = dx, dy, dx * dx + dy * dy
    if nearest2 < MINE_NEAR * MINE_NEAR:
        distance = sqrt(nearest2) + 1e-9
        inputs[k] = whole((ahead_x * to_x + ahead_y * to_y) / distance)
        inputs[k + 1] = whole((ahead_x * to_y - ahead_y * to_x) / distance)
        inputs[k + 2] = whole(1.0 - distance / MINE_NEAR)


@kernel
def encode_wall(match: PiTanks, me: Robot, dx: float, dy: float, k: int, inputs: Inputs) -> None:
    """The inner wall that a shot along (dx, dy) would hit, in three inputs from k on: nearness, health, solid."""
    wall, when = first_wall(match, me.x, me.y, dx, dy)
    if wall >= 0:
        health = match.walls[wall].health
        inputs[k] = whole(300.0 / (300.0 + when * RANGE))
        inputs[k + 1], inputs[k + 2] = whole(health / 5.0), whole(1.0 if health == SOLID else 0.0)


@kernel
def first_wall(match: PiTanks, x: float, y: float, dx: float, dy: float) -> tuple[int, float]:
    """The first inner wall that a bullet moving by (dx, dy) would hit, -1 if none, and the share of the way to it."""
    radius, first, found = match.rules.bullet_radius, 1.0, -1
    length = sqrt(dx * dx + dy * dy)
    for i in range(match.wall_count):
        wall = match.walls[i]
        if wall.health and not is_aside(x, y, dx, dy, wall, (wall.half + radius) * length):
            when = wall_contact(x, y, dx, dy, wall, radius)
            if when < first:
                first, found = when, i
    return found, first
