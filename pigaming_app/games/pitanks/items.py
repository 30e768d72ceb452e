"""PiTanks: pick-ups and mines."""

from pigaming_app.games.pitanks.scoring import score
from pigaming_app.games.pitanks.state import MINES, OWN_MINES, PICKUPS, POWERS, PiTanks
from pigaming_app.sim.grid import BLOCKED
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.rng import uniform
from pigaming_app.sim.world import CELL, COLUMNS, ROBOTS, ROWS

KINDS = len(POWERS)


@kernel
def lay_mine(match: PiTanks, k: int) -> int:
    """Lay a mine at the position of robot k. Returns 0 if it already has OWN_MINES of them."""
    robot = match.robots[k]
    for i in range(k * OWN_MINES, (k + 1) * OWN_MINES):
        mine = match.mines[i]
        if not mine.alive:
            mine.alive, mine.age = match.rules.mine_life, 0
            mine.x, mine.y = robot.x, robot.y
            return 1
    return 0


@kernel
def update_mines(match: PiTanks) -> None:
    """One tick of all mines: they arm, explode under an opponent, and expire."""
    rules = match.rules
    reach = match.radius + rules.mine_radius
    for i in range(MINES):
        mine = match.mines[i]
        if not mine.alive:
            continue
        mine.alive -= 1
        mine.age += 1
        if mine.age < rules.mine_arming:
            continue
        owner = i // OWN_MINES
        for j in range(ROBOTS):
            robot = match.robots[j]
            if not robot.present or robot.team == match.robots[owner].team or match.tanks[j].protected:
                continue
            dx, dy = robot.x - mine.x, robot.y - mine.y
            if mine.alive and dx * dx + dy * dy < reach * reach:
                mine.alive = 0
                score(match, owner, j)


@kernel
def update_pickups(match: PiTanks) -> None:
    """One tick of all pick-ups: they appear, are collected by touch, and expire."""
    rules = match.rules
    reach = match.radius + rules.pickup_reach
    match.next_pickup -= 1
    if match.next_pickup <= 0:
        match.next_pickup = rules.pickup_every
        drop_pickup(match)
    for pickup in match.pickups:
        if not pickup.alive:
            continue
        pickup.alive -= 1
        for j in range(ROBOTS):
            robot = match.robots[j]
            dx, dy = robot.x - pickup.x, robot.y - pickup.y
            if robot.present and pickup.alive and dx * dx + dy * dy < reach * reach:
                pickup.alive = 0
                match.tanks[j].powers[pickup.kind] = rules.power_life


@kernel
def drop_pickup(match: PiTanks) -> None:
    """Put a random pick-up on a free node, away from robots and other pick-ups, unless PICKUPS of them exist."""
    free = -1
    for i in range(PICKUPS):
        if not match.pickups[i].alive:
            free = i
    if free < 0:
        return
    for _ in range(8):
        column = 2 + int(uniform(match) * (COLUMNS - 4))
        row = 2 + int(uniform(match) * (ROWS - 4))
        x, y = column * CELL, row * CELL
        if not match.grid[row * COLUMNS + column] & BLOCKED and is_isolated(match, x, y):
            pickup = match.pickups[free]
            pickup.kind = int(uniform(match) * KINDS)
            pickup.alive = match.rules.pickup_life
            pickup.x, pickup.y = x, y
            return


@kernel
def is_isolated(match: PiTanks, x: float, y: float) -> int:
    """1 if no pick-up is within 300 px of (x, y), no robot within 200 px, and no lit one within `lit_distance`."""
    for k in range(ROBOTS):
        robot = match.robots[k]
        dx, dy = robot.x - x, robot.y - y
        gap = match.rules.lit_distance if match.tanks[k].lit else 200.0
        if robot.present and dx * dx + dy * dy < gap * gap:
            return 0
    for pickup in match.pickups:
        dx, dy = pickup.x - x, pickup.y - y
        if pickup.alive and dx * dx + dy * dy < 300.0 * 300.0:
            return 0
    return 1
