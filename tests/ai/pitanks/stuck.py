"""Robots that are stuck: they hold their sticks and do not move."""

from collections import deque
from math import hypot

from pigaming_app.sim.world import HZ
from tests.matches import match_of

STUCK_SECONDS, STUCK_PX = 3.0, 10.0


def stuck(arena, seed, strengths, variant):
    """(seat, second, x, y) whenever a seat held its stick for 3 s and moved less than 10 px.

    Against an opponent that is in contact it may push for long: such times do not count.
    """
    match = match_of("pitanks", strengths, arena, 1.0, seed, variant)
    trails = [deque[tuple[float, float]](maxlen=round(STUCK_SECONDS * HZ)) for _ in range(4)]
    times = []
    while not match.over:
        match.tick()
        robots = match.state.robots
        for seat, trail in enumerate(trails):
            robot = robots[seat]
            if not robot.present:
                continue
            crowded = any(
                other is not robot and other.present and hypot(other.x - robot.x, other.y - robot.y) < 80.0
                for other in robots
            )
            if match.state.actions[seat].linear == 0.0 or crowded:
                trail.clear()
                continue
            trail.append((robot.x, robot.y))
            if len(trail) == trail.maxlen:
                x, y = trail[0]
                if max(hypot(a - x, b - y) for a, b in trail) < STUCK_PX:
                    times.append((seat, match.seconds, round(robot.x), round(robot.y)))
                    trail.clear()
    return times
