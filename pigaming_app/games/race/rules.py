"""Rules of Robot Race: the first to complete all laps wins.

Each robot has its own start and finish line; the lines of the others are checkpoints. Cross all four in order and in
the right direction, beginning with your own, or the lap does not count: if you miss a line, you must go back to it.
Driving back over a line gains and costs nothing. Off the course is mud: a third of the speed. Turbo makes you faster
while its meter lasts. After the first has finished, the others have half a minute left; those who do not finish are
ranked by distance.
"""

from math import cos, floor, sin
from typing import Any

from pigaming_app.games.race.course import distance_ahead, locate
from pigaming_app.games.race.state import LINES
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robot import stop, stop_all, use_turbo
from pigaming_app.sim.world import ROBOTS

AGAINST = 40.0  # px/s above which driving against the direction of the course counts


@kernel
def judge(match: Any) -> None:
    """One tick of the rules: positions, crossings, ranks, then the requested speeds."""
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
    if is_over(match):
        match.over = 1


@kernel
def track_progress(match: Any, k: int) -> None:
    """Locate robot k, and process the lines it has crossed since the previous tick."""
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
    """Fraction of the step from (x, y) at which it crosses a line, in (0, 1]; less 2 if backwards; 0: no crossing.

    A point on the line counts as past it, so that no line is crossed twice in the same direction.
    """
    ex, ey = line.bx - line.ax, line.by - line.ay
    after = (to_x - line.ax) * ey - (to_y - line.ay) * ex
    is_ahead = (x - line.ax) * ey - (y - line.ay) * ex
    if (is_ahead < 0.0) == (after < 0.0):
        return 0.0
    share = is_ahead / (is_ahead - after)
    across: float = (x + share * (to_x - x) - line.ax) * ex + (y + share * (to_y - y) - line.ay) * ey
    if across < 0.0 or across > ex * ex + ey * ey:
        return 0.0
    return float(share if after >= 0.0 else share - 2.0)


@kernel
def cross_forward(match: Any, k: int, i: int, when: float) -> None:
    """Process a forward crossing of line i by robot k: its next line, one it had gone back over, or a wrong one.

    The line that it crossed last is a wrong one too: the robot has gone round without crossing the others.
    """
    racer = match.racers[k]
    expected = (k + racer.passed) % LINES
    if i == expected:
        pass_line(match, k, when)
    elif racer.lines_reversed and i == (expected - racer.lines_reversed) % LINES:
        racer.lines_reversed -= 1
    elif racer.passed:
        racer.missed, racer.lines_reversed = 1 + expected, 0
        if i == k:
            racer.void += 1


@kernel
def cross_backward(racer: Any, k: int, i: int) -> None:
    """Process a backward crossing of line i by robot k: it counts lines to be crossed again, and undoes nothing."""
    if i == (k + racer.passed - 1 - racer.lines_reversed) % LINES:
        racer.lines_reversed += 1


@kernel
def pass_line(match: Any, k: int, when: float) -> None:
    """Process robot k's crossing of its next line: split time, or the end of a lap."""
    racer = match.racers[k]
    racer.missed, racer.lines_reversed = 0, 0
    i = racer.passed % LINES
    racer.passed += 1
    if i:
        racer.splits[i] = when - racer.lap_start
        if racer.best_lap > 0.0:
            racer.delta, racer.delta_at = racer.splits[i] - racer.best_splits[i], match.tick
        return
    if racer.passed > 1:
        end_lap(match, k, when)
    racer.lap_start = when
    for j in range(LINES):
        racer.splits[j] = 0.0


@kernel
def end_lap(match: Any, k: int, when: float) -> None:
    """End a lap of robot k: lap times, best lap, and the finish after the last."""
    racer, robot = match.racers[k], match.robots[k]
    lap = when - racer.lap_start
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
    """Distance that robot k has covered, px, clamped between its last line and the next.

    Rounded to 1/64 px, so that rounding errors do not affect the order.
    """
    racer, length = match.racers[k], match.course.length
    own = match.lines[k].along
    if racer.finished:
        return float(match.rules.laps * length)
    behind = racer.passed - 1 - racer.lines_reversed
    here, ahead = match.lines[(k + behind) % LINES].along, match.lines[(k + behind + 1) % LINES].along
    gap = distance_ahead(match.course, here, ahead)
    way = distance_ahead(match.course, here, racer.place.along)
    if way > gap:
        way = gap if racer.missed or way - gap < length - way else 0.0
    laps = behind // LINES
    covered: float = laps * length + distance_ahead(match.course, own, here) + way
    return floor(covered * 64.0 + 0.5) / 64.0


@kernel
def rank(match: Any, k: int) -> int:
    """Rank of robot k, from 1; ties go to the lower seat."""
    place = 1
    for j in range(ROBOTS):
        if match.robots[j].present and j != k and is_ahead(match.racers[j], match.racers[k], j < k):
            place += 1
    return place


@kernel
def is_ahead(racer: Any, other: Any, if_equal: bool) -> bool:
    """True if a racer ranks ahead of the other: by finish time, then by progress."""
    if racer.finished != other.finished:
        return bool(racer.finished > other.finished)
    if racer.finished and racer.finish != other.finish:
        return bool(racer.finish < other.finish)
    if racer.progress != other.progress:
        return bool(racer.progress > other.progress)
    return if_equal


# ------------------------------------------------------------------------------------------------------------ driving


@kernel
def steer(match: Any, k: int) -> None:
    """Request the speeds that result from robot k's stick, turbo and the ground."""
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
    robot.requested_linear = action.linear * speed
    robot.requested_angular = action.angular * rules.turn_rate


@kernel
def is_over(match: Any) -> bool:
    """True if everybody has finished, or a time limit has passed."""
    late = match.first and match.tick - match.first >= match.rules.patience
    racing = 0
    for k in range(ROBOTS):
        if match.robots[k].present and not match.racers[k].finished:
            racing += 1
    return bool(late or not racing or match.tick >= match.rules.ticks)
