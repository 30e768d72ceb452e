"""Robot Race: crossings of lines, lap times and splits, and the distance covered."""

from math import floor

from pigaming_app.games.race.course import distance_ahead
from pigaming_app.games.race.state import LINES, Race, Racer, TimingLine
from pigaming_app.sim.kernel import kernel


@kernel
def crossing(line: TimingLine, x: float, y: float, to_x: float, to_y: float) -> float:
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
def cross_forward(match: Race, k: int, i: int, when: float) -> None:
    """Process a forward crossing of line i by robot k: its next line, one it had gone back over, or a wrong one.

    The line that it crossed last is a wrong one too: the robot has gone round without crossing the others.
    """
    racer = match.racers[k]
    expected = (racer.line + racer.passed) % LINES
    if i == expected:
        pass_line(match, k, when)
    elif racer.lines_reversed and i == (expected - racer.lines_reversed) % LINES:
        racer.lines_reversed -= 1
    elif racer.passed:
        racer.missed, racer.lines_reversed = 1 + expected, 0
        if i == racer.line:
            racer.void += 1


@kernel
def cross_backward(racer: Racer, i: int) -> None:
    """Process a racer's backward crossing of line i: it counts lines to be crossed again, and undoes nothing."""
    if i == (racer.line + racer.passed - 1 - racer.lines_reversed) % LINES:
        racer.lines_reversed += 1


@kernel
def pass_line(match: Race, k: int, when: float) -> None:
    """Process robot k's crossing of its next line: split time, or the end of a lap."""
    racer = match.racers[k]
    racer.missed, racer.lines_reversed = 0, 0
    racer.left = match.lines[(racer.line + racer.passed) % LINES].along
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
def end_lap(match: Race, k: int, when: float) -> None:
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


@kernel
def stretch(match: Race, racer: Racer) -> tuple[float, float]:
    """The line that the racer crossed last, px along the course, and the distance from it to its next line, px."""
    behind = racer.line + racer.passed - 1 - racer.lines_reversed
    here: float = match.lines[behind % LINES].along
    return here, distance_ahead(match.course, here, match.lines[(behind + 1) % LINES].along)


@kernel
def way_driven(match: Race, racer: Racer) -> float:
    """Distance from the racer's last line to the last place on its way, px: none if that place is not past the line."""
    here, gap = stretch(match, racer)
    way = distance_ahead(match.course, here, racer.left)
    return way if way <= gap else 0.0


@kernel
def progress(match: Race, k: int) -> float:
    """Distance that robot k has covered, px, between its last line and the next; off its way, up to where it left it.

    Rounded to 1/64 px, so that rounding errors do not affect the order.
    """
    racer, length = match.racers[k], match.course.length
    own = match.lines[racer.line].along
    if racer.finished:
        return float(match.rules.laps * length)
    here, gap = stretch(match, racer)
    way = distance_ahead(match.course, here, racer.place.along)
    if way > gap:
        way = way_driven(match, racer)
    laps = (racer.passed - 1 - racer.lines_reversed) // LINES
    covered: float = laps * length + distance_ahead(match.course, own, here) + way
    return floor(covered * 64.0 + 0.5) / 64.0
