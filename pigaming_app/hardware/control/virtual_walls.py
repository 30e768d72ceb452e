"""Virtual walls: clip the speed of real robots in front of walls, the arena's edges and each other.

The speed towards a wall is at most GAMMA times the gap, so a robot comes to rest before it without hard braking. Two
robots share the gap between them. Turning is free; inside a wall or outside the arena only motion out is allowed. Poses
are never corrected.
"""

from collections.abc import Sequence
from math import cos, sin, sqrt
from typing import Any, NamedTuple

from pigaming_app.sim.plant import Pose, Twist
from pigaming_app.sim.robot import LAG
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import HEIGHT, WIDTH

GAMMA = 4.0  # 1/s, speed per gap, with a predicted pose
SHARED = 0.5 * GAMMA  # 1/s, between two robots, each of which may approach
SPARE = 4.0  # px, safety margin for the error of a pose


class SpeedLimit(NamedTuple):
    """Upper limit (px/s) of the speed towards (nx, ny), a unit vector."""

    nx: float
    ny: float
    speed: float


def stopping_pose(pose: Pose, motion: Twist, lag: float) -> Pose:
    """The pose at which a robot comes to rest after a stop command; gaps are measured from there.

    First-order motors coast by speed times lag (s). Clipping by the gap from there never overshoots, for any lag: the
    closed loop s^2 lag + s (1 + GAMMA lag) + GAMMA has no complex roots.
    """
    x, y, heading = pose
    way, turn = motion[0] * lag, motion[1] * lag
    middle = heading + 0.5 * turn
    return x + way * cos(middle), y + way * sin(middle), heading + turn


def speed_limits(
    world: Any, x: float, y: float, others: Sequence[tuple[float, float, float]] = (), margin: float = 0.0
) -> list[SpeedLimit]:
    """Speed limits at (x, y): the arena's edges, the standing walls, and other robots by their centres and margins.

    `margin`: length by which a robot's body is wider than a simulated one, px (see Rig.margin).
    """
    radius = world.radius + margin
    limits = [
        _limit(-1.0, 0.0, x - radius),
        _limit(1.0, 0.0, WIDTH - radius - x),
        _limit(0.0, -1.0, y - radius),
        _limit(0.0, 1.0, HEIGHT - radius - y),
    ]
    for i in range(world.wall_count):
        wall = world.walls[i]
        if not wall.health:
            continue
        dx, dy = offset_from_wall(wall, x, y)
        gap = sqrt(dx * dx + dy * dy)
        if gap < 1e-6:  # on the centre line of a wall: the way out is across, to either side
            continue
        limits.append(_limit(-dx / gap, -dy / gap, gap - wall.half - radius))
    for other_x, other_y, other_margin in others:
        dx, dy = other_x - x, other_y - y
        gap = sqrt(dx * dx + dy * dy)
        if gap > 1e-6:
            limits.append(_limit(dx / gap, dy / gap, gap - radius - world.radius - other_margin, SHARED))
    return limits


def clip_twist(pose: Pose, desired: Twist, limits: Sequence[SpeedLimit], lag: float = LAG) -> Twist:
    """Clip the linear speed of a twist to the limits; the turn rate is unchanged.

    Headings are checked over the turn within one lag of the motors, so that a robot that swings its nose into a wall
    has slowed down by then.
    """
    linear, angular = desired
    sign = 1.0 if linear > 0.0 else -1.0
    ways = []
    for share in (0.0, 0.5, 1.0):
        heading = pose[2] + share * lag * angular
        ways.append((sign * cos(heading), sign * sin(heading)))
    speed = abs(linear)
    for limit in limits:
        closing = max(limit.nx * wx + limit.ny * wy for wx, wy in ways)
        if closing * speed > limit.speed + 1e-9:
            speed = limit.speed / closing
    return sign * speed if speed else 0.0, angular


def _limit(nx: float, ny: float, gap: float, rate: float = GAMMA) -> SpeedLimit:
    return SpeedLimit(nx, ny, max(0.0, rate * (gap - SPARE)))
