"""Contacts of the ball: the first one on its way, and its bounce. Spin is ignored.

Source: D. Baraff, "Fast contact force computation for nonpenetrating rigid bodies", SIGGRAPH 1994, section 2; the sweep
is that of `sim/sweep.py`.
"""

from pigaming_app.api.rules import HEIGHT, ROBOTS, WIDTH, disc_contact, first_wall, kernel, offset_from_wall

from .state import LEFT, MIDDLE, RIGHT, Ball, Football

SLOP = 1e-6  # px, for rounding
NEVER = 2.0  # time of a contact that is none, as of `disc_contact`
X_RIM, Y_RIM, LINE, POST, WALL, ROBOT = 1, 2, 3, 10, 100, 200  # obstacles; the last three count upwards from here


@kernel
def first_contact(match: Football, dx: float, dy: float, left: float, holder: int) -> tuple[int, float]:
    """The first obstacle, 0 for none, of the ball moving by (dx, dy) in the last `left` share of a tick, and the time.

    Its holder is none. An obstacle that the ball touches already counts only if it moves into it.
    """
    ball = match.ball
    x, y, radius = ball.x, ball.y, match.rules.radius
    hit, first = rim_contact(match, x, y, dx, dy)
    i, t = first_wall(match, x, y, dx, dy, radius)
    if t < first:
        hit, first = WALL + i, t
    for k in range(ROBOTS):
        robot, player = match.robots[k], match.players[k]
        if robot.present and k + 1 != holder:
            rx, ry = robot.x - player.dx * left, robot.y - player.dy * left
            ux, uy = dx - player.dx * left, dy - player.dy * left
            t = disc_contact(x, y, ux, uy, rx, ry, match.radius + radius)
            if t < first and (t > 0.0 or ux * (x - rx) + uy * (y - ry) < 0.0):
                hit, first = ROBOT + k, t
    return hit, first


@kernel
def rim_contact(match: Football, x: float, y: float, dx: float, dy: float) -> tuple[int, float]:
    """First contact with the rim, a post, or the line of a goal (of the ball's centre), as `first_contact`."""
    radius, half = match.rules.radius, match.mouth
    hit, first = 0, NEVER
    if radius <= x <= WIDTH - radius and radius < x + dx < WIDTH - radius and radius < y + dy < HEIGHT - radius:
        return hit, first  # from within, since the pitch is convex
    if dy < 0.0 and y + dy <= radius:
        t = (radius - y) / dy
        hit, first = Y_RIM, t if t > 0.0 else 0.0
    elif dy > 0.0 and y + dy >= HEIGHT - radius:
        t = (HEIGHT - radius - y) / dy
        hit, first = Y_RIM, t if t > 0.0 else 0.0
    for side in (LEFT, RIGHT):
        line = 0.0 if side == LEFT else WIDTH
        inwards = 1.0 if side == LEFT else -1.0
        if (x + dx - line) * inwards > radius:
            continue
        if dx * inwards < 0.0:
            t = (line + inwards * radius - x) / dx
            if t < 0.0:
                t = 0.0
            if t < first and abs(y + dy * t - MIDDLE) >= half:
                hit, first = X_RIM, t
            t = (line - x) / dx
            if t < 0.0:
                t = 0.0
            if t <= 1.0 and t < first and abs(y + dy * t - MIDDLE) < half:
                hit, first = LINE, t
        for post in (0, 1):
            py = MIDDLE + half if post else MIDDLE - half
            t = disc_contact(x, y, dx, dy, line, py, radius)
            if t < first and (t > 0.0 or dx * (x - line) + dy * (y - py) < 0.0):
                hit, first = POST + 2 * side + post, t
    return hit, first


@kernel
def bounce_off(match: Football, hit: int) -> None:
    """Reflect the ball off rim, post or wall."""
    ball = match.ball
    if hit == X_RIM:
        reflect(ball, 1.0 if ball.x < 0.5 * WIDTH else -1.0, 0.0, 0.0, 0.0, match.rules.bounce)
    elif hit == Y_RIM:
        reflect(ball, 0.0, 1.0 if ball.y < MIDDLE else -1.0, 0.0, 0.0, match.rules.bounce)
    elif hit < WALL:
        side, post = (hit - POST) // 2, (hit - POST) % 2
        nx, ny = ball.x - (0.0 if side == LEFT else WIDTH), ball.y - (MIDDLE + match.mouth * (2 * post - 1))
        reflect(ball, nx, ny, 0.0, 0.0, match.rules.bounce)
    else:
        nx, ny = offset_from_wall(match.walls[hit - WALL], ball.x, ball.y)
        reflect(ball, nx, ny, 0.0, 0.0, match.rules.bounce)


@kernel
def reflect(ball: Ball, nx: float, ny: float, ux: float, uy: float, restitution: float) -> None:
    """Reflect the ball off an obstacle with velocity (ux, uy); (nx, ny), of any length, points from it to the ball.

    Newton's law of impact: separating speed = restitution * approaching speed.
    """
    length2 = nx * nx + ny * ny
    approach = (ball.vx - ux) * nx + (ball.vy - uy) * ny
    if approach < 0.0 and length2 > 0.0:
        ball.vx -= (1.0 + restitution) * approach / length2 * nx
        ball.vy -= (1.0 + restitution) * approach / length2 * ny


@kernel
def touch(ball: Ball, k: int) -> None:
    """Record that robot k has touched the ball."""
    if ball.touched != k + 1:
        ball.before, ball.touched = ball.touched, k + 1
