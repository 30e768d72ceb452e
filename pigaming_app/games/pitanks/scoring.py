"""PiTanks: the points of a hit, the knock-out, the bounty, the finale and the overtime."""

from pigaming_app.games.pitanks.state import SHIELD, PiTanks
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import ROBOTS


@kernel
def score(match: PiTanks, k: int, victim: int) -> int:
    """Score a hit of robot k on robot `victim`. Returns 1 if it counts, 0 if a shield absorbs it."""
    rules, tank = match.rules, match.tanks[victim]
    tank.protected = rules.protection
    if tank.powers[SHIELD]:
        tank.powers[SHIELD] = 0
        return 0
    points = worth(match, k, victim)
    match.robots[k].score += points
    match.tanks[k].hits += 1
    match.robots[victim].score -= rules.penalty
    tank.taken += 1
    if rules.knockout:
        tank.knocked_out = rules.knockout
        match.last_hit, match.last_shooter, match.last_victim, match.last_points = match.tick + 1, k, victim, points
    return 1


@kernel
def worth(match: PiTanks, k: int, victim: int) -> int:
    """Points that a hit of robot k on robot `victim` scores in this tick."""
    if match.tanks[k].barred:
        return 0
    points: int = 1 + match.tanks[victim].bounty
    return 2 * points if is_finale(match) else points


@kernel
def is_finale(match: PiTanks) -> bool:
    """True in the last `PiTanksRules.finale` ticks of the regular time."""
    rules = match.rules
    return bool(rules.ticks - rules.finale <= match.tick < rules.ticks)


@kernel
def is_overtime(match: PiTanks) -> bool:
    """True from the end of the regular time to the end of the match."""
    return bool(match.tick >= match.rules.ticks and not match.over)


@kernel
def mark_leaders(match: PiTanks) -> None:
    """Set bounty and bar of every robot for the next tick. Its own hits do not change them: no seat is preferred."""
    overtime = is_overtime(match)
    for k in range(ROBOTS):
        ahead = lead(match, k) if match.robots[k].present else 0
        match.tanks[k].bounty = 1 if match.rules.bounty_lead and ahead > match.rules.bounty_lead else 0
        match.tanks[k].barred = 1 if overtime and ahead < 0 else 0


@kernel
def is_decided(match: PiTanks) -> bool:
    """True if one team alone leads, or no time of the overtime is left."""
    decided = match.tick >= match.rules.ticks + match.rules.overtime
    for k in range(ROBOTS):
        decided |= bool(match.robots[k].present and lead(match, k) > 0)
    return decided


@kernel
def lead(match: PiTanks, seat: int) -> int:
    """Score of the seat's team less that of the best other team."""
    own, best = 0, -1000000
    for j in range(ROBOTS):
        robot = match.robots[j]
        if not robot.present:
            continue
        total = 0
        for mate in match.robots:
            if mate.present and mate.team == robot.team:
                total += mate.score
        if robot.team == match.robots[seat].team:
            own = total
        elif total > best:
            best = total
    return own - best
