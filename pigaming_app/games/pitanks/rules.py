"""Rules of PiTanks: hit the others, don't get hit.

Every hit you make scores a point, every hit you take costs one; team mates add their points up. Nobody is out: when the
time is up, the most points win. Bullets stop at walls; an inner wall takes five and is gone. They pass through you and
your team mates. After a hit you blink and cannot be hit again for three quarters of a second. Turbo makes you faster
while its meter lasts. Pick-ups: a shield, which takes the next hit for you; speed; rapid fire; three bullets at once;
bullets that bounce off walls; a mine, which your next shot lays behind you.

In `party` and `pickups` a gun holds five shots and loads one after the other, three times as fast with rapid fire, but
not while you blink.

By the party rules being hit costs no point, but knocks you out for a moment, in which you roll back. Stay in one place
and you are lit. A leader far ahead is worth more, the last 20 s count double, and if the leaders are level at the end,
all fire fast, three bullets at once, and the next hit wins.
"""

from math import cos, sin

from pigaming_app.games.pitanks.items import lay_mine, update_mines, update_pickups
from pigaming_app.games.pitanks.scoring import is_decided, is_overtime, mark_leaders, score
from pigaming_app.games.pitanks.spotlight import update_spotlights
from pigaming_app.games.pitanks.state import (
    MINE,
    OUTER,
    OWN_BULLETS,
    POWERS,
    RAPID,
    RICOCHET,
    SPEED,
    TRIPLE,
    Bullet,
    PiTanks,
    PiTanksRules,
    Tank,
)
from pigaming_app.sim.grid import NEAR_UNIT, node_at, wall_on_grid
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robot import stop, stop_all, use_turbo
from pigaming_app.sim.sweep import ROUNDING, bounds_contact, disc_contact, offset_from_wall, wall_contact
from pigaming_app.sim.things.mud import SLOW, in_mud
from pigaming_app.sim.world import DT, HEIGHT, ROBOTS, WIDTH, Wall

ALL_POWERS = len(POWERS)
TOUCH = 1e-6  # px from an outer wall within which a bullet touches it


@kernel
def judge(match: PiTanks) -> None:
    """One tick of the rules: shots, bullets, mines and pick-ups, then the requested speeds."""
    if match.over:
        stop_all(match)
        return
    for k in range(ROBOTS):
        if match.robots[k].present:
            count_down(match.rules, match.tanks[k])
            use_gun(match, k)
    if move_bullets(match):
        resolve_hits(match)
    if match.rules.pickups:
        update_mines(match)
        update_pickups(match)
    if match.rules.camping:
        update_spotlights(match)
    for k in range(ROBOTS):
        if match.robots[k].present:
            steer(match, k)
    match.tick += 1
    if match.tick >= match.rules.ticks and is_decided(match):
        match.over = 1
    if match.rules.bounty_lead or match.rules.overtime:
        mark_leaders(match)
    if is_overtime(match):
        arm_all(match)


@kernel
def count_down(rules: PiTanksRules, tank: Tank) -> None:
    """One tick of a tank's timers: gun cooldown, knock-out, protection, powers, magazine."""
    if tank.knocked_out:
        tank.knocked_out -= 1
    if tank.cooldown:
        tank.cooldown -= 1
    if tank.protected:
        tank.protected -= 1
    for power in range(ALL_POWERS):
        if tank.powers[power]:
            tank.powers[power] -= 1
    if tank.spent:
        if not tank.protected:
            tank.spent = max(0, tank.spent - (rules.rapid_loading if tank.powers[RAPID] else 1))
        is_empty = tank.spent > (rules.magazine - 1) * rules.loading
        if is_empty and not tank.cooldown:
            tank.cooldown = 1


@kernel
def arm_all(match: PiTanks) -> None:
    """Give everybody rapid fire and three bullets at once, for as long as this is called every tick."""
    for tank in match.tanks:
        tank.powers[RAPID] = tank.powers[TRIPLE] = match.rules.power_life


@kernel
def steer(match: PiTanks, k: int) -> None:
    """Request the speeds that result from robot k's stick, turbo and powers; or the recoil, if it is knocked out."""
    rules, robot, action = match.rules, match.robots[k], match.actions[k]
    if match.tanks[k].knocked_out:
        stop(robot)
        robot.requested_linear = -rules.recoil * match.tanks[k].knocked_out / rules.knockout
        return
    speed = rules.speed
    if rules.turbo:
        use_turbo(robot, action.turbo, rules.turbo_drain, rules.turbo_refill)
        if robot.boosting:
            speed *= rules.turbo_factor
    if match.tanks[k].powers[SPEED]:
        speed *= rules.speed_factor
    if match.mud_count and in_mud(match, robot.x, robot.y):
        speed *= SLOW
    robot.requested_linear = action.linear * speed
    robot.requested_angular = action.angular * rules.turn_rate


# ------------------------------------------------------------------------------------------------------------ bullets


@kernel
def use_gun(match: PiTanks, k: int) -> None:
    """Fire, or lay a mine, if robot k's button is pressed and its gun is ready."""
    rules, tank = match.rules, match.tanks[k]
    if not match.actions[k].fire or tank.cooldown or tank.knocked_out:
        return
    if tank.powers[MINE] and lay_mine(match, k):
        tank.powers[MINE] = 0
        tank.cooldown = rules.cooldown
        return
    max_alive = rules.boosted_alive if tank.powers[RAPID] or tank.powers[TRIPLE] else rules.bullets_alive
    heading, bounces = match.robots[k].heading, rules.bounces if tank.powers[RICOCHET] else 0
    if not fire_bullet(match, k, max_alive, heading, bounces):
        return
    if tank.powers[TRIPLE]:
        fire_bullet(match, k, max_alive, heading - rules.triple_spread, bounces)
        fire_bullet(match, k, max_alive, heading + rules.triple_spread, bounces)
    tank.cooldown = rules.rapid_cooldown if tank.powers[RAPID] else rules.cooldown
    if rules.magazine:
        tank.spent += rules.loading


@kernel
def fire_bullet(match: PiTanks, k: int, max_alive: int, heading: float, bounces: int) -> int:
    """Fire a bullet of robot k, unless it has `max_alive` already. Returns 1 if fired."""
    free, alive = -1, 0
    for i in range(k * OWN_BULLETS, (k + 1) * OWN_BULLETS):
        if match.bullets[i].alive:
            alive += 1
        elif free < 0:
            free = i
    if free < 0 or alive >= max_alive:
        return 0
    bullet, robot, speed = match.bullets[free], match.robots[k], match.rules.bullet_speed
    bullet.alive, bullet.fresh, bullet.bounces = 1, 1, bounces
    bullet.x, bullet.y = robot.x, robot.y
    bullet.vx, bullet.vy = speed * cos(heading), speed * sin(heading)
    match.tanks[k].shots += 1
    return 1


@kernel
def move_bullets(match: PiTanks) -> int:
    """Move every bullet to its position at the end of the tick and record its hit, without damage. Returns the hits.

    All bullets meet robots and walls as they were at the beginning of the tick, so that their order is irrelevant.
    """
    muzzle = match.rules.muzzle / match.rules.bullet_speed
    strikes = 0
    for k in range(ROBOTS):
        if not match.robots[k].present:
            continue
        for i in range(k * OWN_BULLETS, (k + 1) * OWN_BULLETS):
            bullet = match.bullets[i]
            if bullet.alive:
                move_bullet(match, k, bullet, DT + muzzle if bullet.fresh else DT)
                if bullet.struck:
                    strikes += 1
    return strikes


@kernel
def move_bullet(match: PiTanks, k: int, bullet: Bullet, seconds: float) -> None:
    """Move a bullet of robot k to its first contact, or by its full displacement."""
    x, y, radius = bullet.x, bullet.y, match.rules.bullet_radius
    dx, dy = bullet.vx * seconds, bullet.vy * seconds
    first = bounds_contact(x, y, dx, dy, WIDTH, HEIGHT, radius)
    struck = OUTER if first <= 1.0 else 0
    left, right = (x, x + dx) if dx > 0.0 else (x + dx, x)
    top, bottom = (y, y + dy) if dy > 0.0 else (y + dy, y)
    if bullet.fresh or match.grid[node_at(x, y)] >= NEAR_UNIT:
        slack = match.radius - radius - ROUNDING  # the walls' bounding boxes include a robot's radius
        west, east, north, south = left + slack, right - slack, top + slack, bottom - slack
        for i in range(match.wall_count):
            wall = match.walls[i]
            if west < wall.right and east > wall.left and north < wall.bottom and south > wall.top and wall.health:
                t = wall_contact(x, y, dx, dy, wall, radius)
                if t < first and (t > 0.0 or moves_into(wall, x, y, dx, dy)):
                    first, struck = t, -1 - i
    reach = match.radius + radius
    for j in range(ROBOTS):
        robot = match.robots[j]
        if (
            robot.present
            and left - reach < robot.x < right + reach
            and top - reach < robot.y < bottom + reach
            and robot.team != match.robots[k].team
        ):
            t = disc_contact(x, y, dx, dy, robot.x, robot.y, reach)
            if t < first:
                first, struck = t, 1 + j
    if struck:
        bullet.x = clamp(x + first * dx, radius, WIDTH - radius)
        bullet.y = clamp(y + first * dy, radius, HEIGHT - radius)
    else:
        bullet.x, bullet.y = x + dx, y + dy
    bullet.struck, bullet.when, bullet.fresh = struck, first, 0


@kernel
def moves_into(wall: Wall, x: float, y: float, dx: float, dy: float) -> bool:
    """True if a bullet that touches a wall at (x, y) moves into it; one that has just bounced moves away."""
    nx, ny = offset_from_wall(wall, x, y)
    return bool(dx * nx + dy * ny < 0.0 or (nx == 0.0 and ny == 0.0))


@kernel
def clamp(value: float, low: float, high: float) -> float:
    """The nearest number in [low, high]."""
    return low if value < low else high if value > high else value


@kernel
def resolve_hits(match: PiTanks) -> None:
    """Apply the hits of this tick: score, damage walls, bounce."""
    for k in range(ROBOTS):
        if not match.robots[k].present:
            continue
        for i in range(k * OWN_BULLETS, (k + 1) * OWN_BULLETS):
            bullet = match.bullets[i]
            if not bullet.alive or not bullet.struck:
                continue
            if bullet.struck > 0 and bullet.struck != OUTER:
                bullet.alive = 0
                hit_robot(match, k, bullet.struck - 1, i)
            elif bullet.bounces:
                bounce(match, bullet)
            else:
                bullet.alive = 0
                if bullet.struck < 0:
                    hit_wall(match, match.walls[-1 - bullet.struck])
    for bullet in match.bullets:
        bullet.struck = 0


@kernel
def hit_wall(match: PiTanks, wall: Wall) -> None:
    """Take one health from a wall, and remove it from the grid at zero."""
    if wall.health > 0:
        wall.health -= 1
        if wall.health == 0:
            wall_on_grid(match, wall, -1)


@kernel
def bounce(match: PiTanks, bullet: Bullet) -> None:
    """Reflect a bullet off the surface that it hit; in a corner of the arena, off both."""
    bullet.bounces -= 1
    if bullet.struck == OUTER:
        edge = match.rules.bullet_radius + TOUCH
        if (bullet.x <= edge and bullet.vx < 0.0) or (bullet.x >= WIDTH - edge and bullet.vx > 0.0):
            bullet.vx = -bullet.vx
        if (bullet.y <= edge and bullet.vy < 0.0) or (bullet.y >= HEIGHT - edge and bullet.vy > 0.0):
            bullet.vy = -bullet.vy
        return
    nx, ny = offset_from_wall(match.walls[-1 - bullet.struck], bullet.x, bullet.y)
    n2 = nx * nx + ny * ny
    approach = bullet.vx * nx + bullet.vy * ny
    if n2 > 0.0 and approach < 0.0:
        bullet.vx -= 2.0 * approach / n2 * nx
        bullet.vy -= 2.0 * approach / n2 * ny


@kernel
def hit_robot(match: PiTanks, k: int, victim: int, shot: int) -> None:
    """Score bullet `shot` of robot k on robot `victim`, unless protected, shielded, or hit earlier in the tick."""
    tank = match.tanks[victim]
    if match.rules.protection:
        if tank.protected:
            return
        for other in match.bullets:
            if other.struck == victim + 1 and other.when < match.bullets[shot].when:
                return
    if score(match, k, victim):
        match.tanks[k].landed += 1
