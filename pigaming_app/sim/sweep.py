"""Swept collision tests: the first contact of a moving circle, or of a line of sight.

Times of contact are fractions of the displacement, 0 at its start, 1 at its end; FAR: no contact. A moving circle is
treated as a point moving past the obstacle expanded by the circle's radius (Minkowski sum).
"""

from math import sqrt

from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import Capsule, World

FAR = 2.0
ROUNDING = 1e-6  # px, of a distance


@kernel
def disc_contact(x: float, y: float, dx: float, dy: float, cx: float, cy: float, reach: float) -> float:
    """Time at which a point moving from (x, y) by (dx, dy) comes within `reach` of (cx, cy); 0 if it starts there.

    The smaller root of |p + t d - c|^2 = reach^2.
    """
    px, py = x - cx, y - cy
    c = px * px + py * py - reach * reach
    if c <= 0.0:
        return 0.0
    b = px * dx + py * dy
    a = dx * dx + dy * dy
    if b >= 0.0 or a == 0.0:
        return FAR
    discriminant = b * b - a * c
    if discriminant < 0.0:
        return FAR
    t = (-b - sqrt(discriminant)) / a
    return t if t <= 1.0 else FAR


@kernel
def wall_contact(x: float, y: float, dx: float, dy: float, wall: Capsule, radius: float) -> float:
    """Time at which a circle moving from (x, y) by (dx, dy) touches a wall: two discs and the strip between them."""
    reach = wall.half + radius
    ex, ey = wall.bx - wall.ax, wall.by - wall.ay
    length2 = ex * ex + ey * ey
    px, py = x - wall.ax, y - wall.ay
    if length2 == 0.0:
        return disc_contact(x, y, dx, dy, wall.ax, wall.ay, reach)
    length = sqrt(length2)
    across = (ex * py - ey * px) / length  # signed distance from the wall's line
    along = (ex * px + ey * py) / length2  # 0 at a, 1 at b
    down = (ex * dy - ey * dx) / length
    forth = (ex * dx + ey * dy) / length2
    if -reach < across < reach and 0.0 <= along <= 1.0:
        return 0.0
    first = FAR
    if down != 0.0:
        t = ((reach if across > 0.0 else -reach) - across) / down
        if 0.0 <= t <= 1.0 and 0.0 <= along + t * forth <= 1.0:
            first = t
    t = disc_contact(x, y, dx, dy, wall.ax, wall.ay, reach)
    if t < first:
        first = t
    t = disc_contact(x, y, dx, dy, wall.bx, wall.by, reach)
    if t < first:
        first = t
    return first


@kernel
def offset_from_wall(wall: Capsule, x: float, y: float) -> tuple[float, float]:
    """The vector (dx, dy) from the nearest point of a wall's centre line to a point."""
    ex, ey = wall.bx - wall.ax, wall.by - wall.ay
    px, py = x - wall.ax, y - wall.ay
    length2 = ex * ex + ey * ey
    t = 0.0
    if length2 > 0.0:
        t = (px * ex + py * ey) / length2
        if t < 0.0:
            t = 0.0
        elif t > 1.0:
            t = 1.0
    return px - t * ex, py - t * ey


@kernel
def bounds_contact(x: float, y: float, dx: float, dy: float, width: float, height: float, radius: float) -> float:
    """Time at which a circle that starts inside the outer walls touches one; never FAR if it would end beyond one."""
    first = FAR
    if dx > 0.0 and x + dx >= width - radius:
        first = (width - radius - x) / dx
    elif dx < 0.0 and x + dx <= radius:
        first = (radius - x) / dx
    t = FAR
    if dy > 0.0 and y + dy >= height - radius:
        t = (height - radius - y) / dy
    elif dy < 0.0 and y + dy <= radius:
        t = (radius - y) / dy
    if t < first:
        first = t
    if first < 0.0:
        return 0.0
    return first if first <= 1.0 or first == FAR else 1.0


@kernel
def is_clear(world: World, x: float, y: float, to_x: float, to_y: float, radius: float) -> int:
    """1 if a circle can move from one point to the other without touching an inner wall. Radius 0: line of sight."""
    dx, dy = to_x - x, to_y - y
    left, right = (x, to_x) if dx > 0.0 else (to_x, x)
    top, bottom = (y, to_y) if dy > 0.0 else (to_y, y)
    slack = world.radius - radius  # the walls' bounding boxes include a robot's radius
    left += slack
    right -= slack
    top += slack
    bottom -= slack
    length = sqrt(dx * dx + dy * dy)
    for i in range(world.wall_count):
        wall = world.walls[i]
        if (
            wall.health
            and left <= wall.right
            and right >= wall.left
            and top <= wall.bottom
            and bottom >= wall.top
            and not is_aside(x, y, dx, dy, wall, (wall.half + radius + ROUNDING) * length)
            and wall_contact(x, y, dx, dy, wall, radius) <= 1.0
        ):
            return 0
    return 1


@kernel
def is_aside(x: float, y: float, dx: float, dy: float, wall: Capsule, reach: float) -> bool:
    """True if a wall is on one side of the line from (x, y) along (dx, dy), `reach` / |(dx, dy)| or more px from it."""
    a, b = dx * (wall.ay - y) - dy * (wall.ax - x), dx * (wall.by - y) - dy * (wall.bx - x)
    return bool((a > reach and b > reach) or (a < -reach and b < -reach))
