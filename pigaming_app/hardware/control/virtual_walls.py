"""Virtual walls for real robots: nothing holds a real disc back but its own motors, so its speed is clipped in time.

Towards a wall it may drive at most GAMMA times the gap that is left, each second: so it comes to rest before the wall
and never has to brake hard. Two robots share the gap between them. Turning is free, and in a wall, or outside the
arena, it may only get out. Where the robot is known to be is never changed.
"""

from collections.abc import Sequence
from math import cos, sin, sqrt
from typing import Any, NamedTuple

from pigaming_app.sim.plant import Pose, Twist
from pigaming_app.sim.robot import LAG, RADIUS
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import HEIGHT, WIDTH

GAMMA = 4.0  # per s: speed for a gap, with a pose that is predicted (HARDWARE.md)
SHARED = 0.5 * GAMMA  # between two robots, each of which may come nearer
SPARE = 4.0  # px before a wall at which it counts as reached: what a pose may be wrong by


class SpeedLimit(NamedTuple):
    """Towards (nx, ny), a unit vector, a robot may not drive faster than `speed` px/s."""

    nx: float
    ny: float
    speed: float


def coasting(pose: Pose, motion: Twist, lag: float) -> Pose:
    """Where a robot that moves so comes to rest if it is told to stop: that is where walls must be looked for.

    With first-order motors it still goes on by speed times lag; clipping by the gap from there never overshoots,
    however long the lag: its closed loop s^2 lag + s (1 + GAMMA lag) + GAMMA has no complex roots.
    """
    x, y, heading = pose
    way, turn = motion[0] * lag, motion[1] * lag
    middle = heading + 0.5 * turn
    return x + way * cos(middle), y + way * sin(middle), heading + turn


def limits(world: Any, x: float, y: float, others: Sequence[tuple[float, float]] = ()) -> list[SpeedLimit]:
    """What holds a robot at (x, y) back: the arena's edges, the walls that still stand, the others' centres."""
    found = [
        _limit(-1.0, 0.0, x - RADIUS),
        _limit(1.0, 0.0, WIDTH - RADIUS - x),
        _limit(0.0, -1.0, y - RADIUS),
        _limit(0.0, 1.0, HEIGHT - RADIUS - y),
    ]
    for i in range(world.wall_count):
        wall = world.walls[i]
        if not wall.health:
            continue
        dx, dy = offset_from_wall(wall, x, y)
        gap = sqrt(dx * dx + dy * dy)
        if gap < 1e-6:  # on the middle line of a wall: across it is the way out, whichever side
            continue
        found.append(_limit(-dx / gap, -dy / gap, gap - wall.half - RADIUS))
    for other_x, other_y in others:
        dx, dy = other_x - x, other_y - y
        gap = sqrt(dx * dx + dy * dy)
        if gap > 1e-6:
            found.append(_limit(dx / gap, dy / gap, gap - 2.0 * RADIUS, SHARED))
    return found


def clipped(pose: Pose, asked: Twist, held: Sequence[SpeedLimit], lag: float = LAG) -> Twist:
    """What is left of a twist under these limits: less speed along the heading, the turn as it is asked for.

    A turn counts as far as it goes before the motors have answered, so that a robot that swings its nose into a wall
    has slowed down by then.
    """
    linear, angular = asked
    sign = 1.0 if linear > 0.0 else -1.0
    ways = []
    for share in (0.0, 0.5, 1.0):
        heading = pose[2] + share * lag * angular
        ways.append((sign * cos(heading), sign * sin(heading)))
    speed = abs(linear)
    for limit in held:
        closing = max(limit.nx * wx + limit.ny * wy for wx, wy in ways)
        if closing * speed > limit.speed + 1e-9:
            speed = limit.speed / closing
    return sign * speed if speed else 0.0, angular


def _limit(nx: float, ny: float, gap: float, rate: float = GAMMA) -> SpeedLimit:
    return SpeedLimit(nx, ny, max(0.0, rate * (gap - SPARE)))
