"""Robot Race, as a player would hear it: first round the course so many times wins.

Everybody has a start and finish line of their own; the lines of the others are checkpoints. Cross all four in their
order and in the right direction, beginning with your own, else the lap does not count: a missed line must be gone back
to. Driving back over a line counts nothing and takes nothing away. Off the course is mud: a third of the speed. Turbo
makes you faster while its meter lasts. When the first has finished, the others have half a minute to do so too; who has
not is ranked by how far they came.
"""

from math import cos, floor, sin
from typing import Any

from pigaming_app.games.race.course import distance_ahead, locate
from pigaming_app.games.race.state import LINES
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robot import stop, stop_all, use_turbo
from pigaming_app.sim.world import ROBOTS

AGAINST = 40.0  # px/s from which driving against the way counts


@kernel
def judge(match: Any) -> None:
    """One tick of the rules: where everybody is, what they have crossed, who leads, then the speeds they ask for."""
    if match.over:
        stop_all(match)
        return
    for k in range(ROBOTS):
        if match.robots[k].present:
            track_progress(match, k)
    for k in range(ROBOTS):
        if match.robots[k].present:
            match.racers[k].rank = rank(match, k)
            steer(match, k)
    match.tick += 1
    if ended(match):
        match.over = 1


@kernel
def track_progress(match: Any, k: int) -> None:
    """See where robot k is, and what it has crossed on its way there."""
    robot, racer = match.robots[k], match.racers[k]
    locate(match.course, robot.x, robot.y, racer.place)
    if not racer.finished:
        dx, dy = robot.x - racer.last_x, robot.y - racer.last_y
        if dx * dx + dy * dy <= match.rules.carried * match.rules.carried:
            for i in range(LINES):
                share = crossing(match.lines[i], racer.last_x, racer.last_y, robot.x, robot.y)
                if share > 0.0:
                    cross_forward(match, k, i, match.tick - 1 + share)
                elif share < 0.0:
                    cross_backward(racer, k, i)
    racer.last_x, racer.last_y = robot.x, robot.y
    racer.progress = progress(match, k)
    if racer.place.on:
        with_way = cos(robot.heading) * racer.place.tangent_x + sin(robot.heading) * racer.place.tangent_y
        against = robot.linear * with_way < 0.0 and abs(robot.linear) > AGAINST
        racer.wrong = racer.wrong + 1 if against and not racer.missed else 0


# -------------------------------------------------------------------------------------------------------------- lines


@kernel
def crossing(line: Any, x: float, y: float, to_x: float, to_y: float) -> float:
    """How much of the way from (x, y) had been driven at the line, in (0, 1]; negative: over it backwards; 0: not.

    What lies on the line itself counts as behind it, so that nothing is ever crossed twice in the same direction.
    """
    ex, ey = line.bx - line.ax, line.by - line.ay
    after = (to_x - line.ax) * ey - (to_y - line.ay) * ex
    before = (x - line.ax) * ey - (y - line.ay) * ex
    if (before < 0.0) == (after < 0.0):
        return 0.0
    share = before / (before - after)
    across: float = (x + share * (to_x - x) - line.ax) * ex + (y + share * (to_y - y) - line.ay) * ey
    if across < 0.0 or across > ex * ex + ey * ey:
        return 0.0
    return float(share if after >= 0.0 else share - 2.0)


@kernel
def cross_forward(match: Any, k: int, i: int, when: float) -> None:
    """Robot k has crossed line i in the right direction: the next one, one it had gone back over, or a wrong one.

    The line crossed last, again, is a wrong one too: the robot has come round without the others.
    """
    racer = match.racers[k]
    expected = (k + racer.passed) % LINES
    if i == expected:
        pass_line(match, k, when)
    elif racer.back and i == (expected - racer.back) % LINES:
        racer.back -= 1
    elif racer.passed:
        racer.missed, racer.back = 1 + expected, 0
        if i == k:
            racer.void += 1


@kernel
def cross_backward(racer: Any, k: int, i: int) -> None:
    """Robot k has crossed line i in the wrong direction: nothing is undone, but the way back is remembered."""
    if i == (k + racer.passed - 1 - racer.back) % LINES:
        racer.back += 1


@kernel
def pass_line(match: Any, k: int, when: float) -> None:
    """Robot k has crossed the line that was next."""
    racer = match.racers[k]
    racer.missed, racer.back = 0, 0
    i = racer.passed % LINES
    racer.passed += 1
    if i:
        racer.splits[i] = when - racer.lap_began
        if racer.best_lap > 0.0:
            racer.delta, racer.delta_at = racer.splits[i] - racer.best_splits[i], match.tick
        return
    if racer.passed > 1:
        end_lap(match, k, when)
    racer.lap_began = when
    for j in range(LINES):
        racer.splits[j] = 0.0


@kernel
def end_lap(match: Any, k: int, when: float) -> None:
    """Robot k is back at its own line, with all the others behind it."""
    racer, robot = match.racers[k], match.robots[k]
    lap = when - racer.lap_began
    racer.laps[robot.score], racer.last_lap = lap, lap
    robot.score += 1
    if racer.best_lap > 0.0:
        racer.delta, racer.delta_at = lap - racer.best_lap, match.tick
    if racer.best_lap == 0.0 or lap < racer.best_lap:
        racer.best_lap = lap
        for j in range(LINES):
            racer.best_splits[j] = racer.splits[j]
    if robot.score == match.rules.laps:
        racer.finished, racer.finish = 1, when
        if not match.first:
            match.first = match.tick


# -------------------------------------------------------------------------------------------------------------- order


@kernel
def progress(match: Any, k: int) -> float:
    """How far robot k has come: between the line that lies behind it and the next, whatever it has driven round.

    To 1/64 px, so that rounding decides no order.
    """
    racer, length = match.racers[k], match.course.length
    own = match.lines[k].along
    if racer.finished:
        return float(match.rules.laps * length)
    behind = racer.passed - 1 - racer.back
    here, ahead = match.lines[(k + behind) % LINES].along, match.lines[(k + behind + 1) % LINES].along
    gap = distance_ahead(match.course, here, ahead)
    way = distance_ahead(match.course, here, racer.place.along)
    if way > gap:
        way = gap if racer.missed or way - gap < length - way else 0.0
    laps = behind // LINES
    came: float = laps * length + distance_ahead(match.course, own, here) + way
    return floor(came * 64.0 + 0.5) / 64.0


@kernel
def rank(match: Any, k: int) -> int:
    """1 more than there are robots before this one; of equals the first seat is before."""
    place = 1
    for j in range(ROBOTS):
        if match.robots[j].present and j != k and before(match.racers[j], match.racers[k], j < k):
            place += 1
    return place


@kernel
def before(one: Any, other: Any, if_equal: bool) -> bool:
    """Whether one racer is before the other."""
    if one.finished != other.finished:
        return bool(one.finished > other.finished)
    if one.finished and one.finish != other.finish:
        return bool(one.finish < other.finish)
    if one.progress != other.progress:
        return bool(one.progress > other.progress)
    return if_equal


# ------------------------------------------------------------------------------------------------------------ driving


@kernel
def steer(match: Any, k: int) -> None:
    """Ask for the speeds that robot k's stick, its turbo and the ground give."""
    rules, robot, action, racer = match.rules, match.robots[k], match.actions[k], match.racers[k]
    if racer.finished and match.tick - racer.finish > rules.roll_on:
        stop(robot)
        return
    speed = rules.speed
    use_turbo(robot, action.turbo, rules.turbo_drain, rules.turbo_refill)
    if robot.boosting:
        speed *= rules.turbo_factor
    if not racer.place.on:
        speed *= rules.mud
    robot.ask_linear = action.linear * speed
    robot.ask_angular = action.angular * rules.turn_rate


@kernel
def ended(match: Any) -> bool:
    """Whether everybody has finished, or the time for it is up."""
    late = match.first and match.tick - match.first >= match.rules.patience
    racing = 0
    for k in range(ROBOTS):
        if match.robots[k].present and not match.racers[k].finished:
            racing += 1
    return bool(late or not racing or match.tick >= match.rules.ticks)
