"""Places in which the ball overlaps nothing, and the ways to them.

A ball between robots and a wall that leave no room for it first gives way (`give_way`), else lies at the nearest free
place that no wall separates from it (`nearest_free`).
"""

from math import cos, sin, sqrt

from pigaming_app.api.rules import HEIGHT, ROBOTS, WIDTH, is_clear, kernel, offset_from_wall

from .contacts import SLOP, reflect, touch
from .state import DT, LEFT, MIDDLE, RIGHT, Ball, Football

ROUNDS = 8  # in which a ball gives way
RING, RINGS, ANGLES = 10.0, 24, 24  # px between, and number of, the circles on which a free place is sought


@kernel
def give_way(match: Football) -> int:
    """Push the ball straight out of what it overlaps, a few times in turn. 1 if it is free then."""
    ball, radius = match.ball, match.rules.radius
    for _ in range(ROUNDS):
        for k in range(ROBOTS):
            robot, player = match.robots[k], match.players[k]
            if robot.present and push_out(ball, ball.x - robot.x, ball.y - robot.y, match.radius + radius):
                touch(ball, k)
                reflect(ball, ball.x - robot.x, ball.y - robot.y, player.dx / DT, player.dy / DT, 0.0)
        for i in range(match.wall_count):
            wall = match.walls[i]
            if wall.health:
                nx, ny = offset_from_wall(wall, ball.x, ball.y)
                if push_out(ball, nx, ny, wall.half + radius):
                    reflect(ball, nx, ny, 0.0, 0.0, 0.0)
        push_inside(match)
        if is_free(match, ball.x, ball.y):
            return 1
    return 0


@kernel
def push_out(ball: Ball, nx: float, ny: float, reach: float) -> int:
    """Move the ball along (nx, ny), its offset from an obstacle, until that is `reach` px long. 1 if it was shorter."""
    gap2 = nx * nx + ny * ny
    if gap2 >= reach * reach or gap2 == 0.0:
        return 0
    gap = sqrt(gap2)
    ball.x += nx / gap * (reach - gap)
    ball.y += ny / gap * (reach - gap)
    return 1


@kernel
def push_inside(match: Football) -> None:
    """Move the ball back from rim and posts, but not out of a goal."""
    ball, radius = match.ball, match.rules.radius
    ball.y = min(max(ball.y, radius), HEIGHT - radius)
    if abs(ball.y - MIDDLE) >= match.mouth:
        ball.x = min(max(ball.x, radius), WIDTH - radius)
    for side in (LEFT, RIGHT):
        for post in (-1.0, 1.0):
            push_out(ball, ball.x - (0.0 if side == LEFT else WIDTH), ball.y - MIDDLE - post * match.mouth, radius)


@kernel
def is_free(match: Football, x: float, y: float) -> int:
    """1 if a ball at (x, y) overlaps neither rim, posts, walls nor robots."""
    radius, half = match.rules.radius, match.mouth
    if not radius - SLOP <= y <= HEIGHT - radius + SLOP:
        return 0
    if not radius - SLOP <= x <= WIDTH - radius + SLOP:
        aside = abs(y - MIDDLE)
        if not (aside < half and 0.0 <= x <= WIDTH):
            return 0
        nx, ny = min(x, WIDTH - x), half - aside
        if nx * nx + ny * ny < (radius - SLOP) * (radius - SLOP):
            return 0
    reach = match.radius + radius - SLOP
    for robot in match.robots:
        if robot.present:
            dx, dy = x - robot.x, y - robot.y
            if dx * dx + dy * dy < reach * reach:
                return 0
    for i in range(match.wall_count):
        wall = match.walls[i]
        if wall.health and wall.left < x < wall.right and wall.top < y < wall.bottom:
            dx, dy = offset_from_wall(wall, x, y)
            reach = wall.half + radius - SLOP
            if dx * dx + dy * dy < reach * reach:
                return 0
    return 1


@kernel
def nearest_free(match: Football, x: float, y: float) -> int:
    """Put the ball at the free place nearest to (x, y), on the pitch and not behind a wall. 0 if none is near."""
    ball, radius = match.ball, match.rules.radius
    for ring in range(RINGS):
        for i in range(ANGLES if ring else 1):
            angle = i * 6.283185307179586 / ANGLES
            at_x, at_y = x + RING * ring * cos(angle), y + RING * ring * sin(angle)
            if (
                radius <= at_x <= WIDTH - radius
                and is_free(match, at_x, at_y)
                and is_clear(match, x, y, at_x, at_y, 0.0)
            ):
                ball.x, ball.y = at_x, at_y
                return 1
    return 0
