"""Features of the Q-learner: three directions relative to the robot's heading, each as one of 16 sectors.

They are the directions of the opponent, of the closest inner wall and of the closest incoming bullet. Sector 0 is
centred straight ahead, numbers increase clockwise, and NONE marks an absent object: 16 x 17 x 17 states.
"""

from math import atan2, pi, sqrt, tau

from pigaming_app.games.pitanks.state import OWN_BULLETS, PiTanks
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel, kernel_with_loops
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import ROBOTS, Robot

SECTORS = 16
NONE = 16  # no wall left standing, or no incoming bullet
PLACES = SECTORS + 1
STATES = SECTORS * PLACES * PLACES
WIDE = tau / SECTORS  # width of a sector, rad
FAR = 1e18  # px or px^2, farther than anything
EDGE = 1e-3  # share of a sector, at either end, within which a rough angle does not tell its number


@kernel
def state(opponent: int, wall: int, bullet: int) -> int:
    """Index of a state; opponent in 0..15, wall and bullet in 0..16."""
    return (opponent * PLACES + wall) * PLACES + bullet


@kernel
def opponent_of(state: int) -> int:
    """Sector of the opponent in a state."""
    return state // (PLACES * PLACES)


@kernel
def wall_of(state: int) -> int:
    """Sector of the closest inner wall in a state, or NONE."""
    return state // PLACES % PLACES


@kernel
def bullet_of(state: int) -> int:
    """Sector of the closest incoming bullet in a state, or NONE."""
    return state % PLACES


@kernel
def exact_sector(dx: float, dy: float, heading: float) -> int:
    """Sector of the offset (dx, dy), px, for a robot with this heading, rad."""
    return int(turn_to(atan2(dy, dx) - heading) / WIDE + (SECTORS + 0.5)) % SECTORS


def quick_sector(dx: float, dy: float, heading: float) -> int:
    """`exact_sector`, with the angle by a polynomial that is right to 1e-5 rad (C. Hastings, 1955) where that tells."""
    wide, high = abs(dx), abs(dy)
    if wide == high:  # perhaps no way at all, which has no ratio
        return exact_sector(dx, dy, heading)
    ratio = high / wide if high < wide else wide / high
    square = ratio * ratio
    series = -0.3302995 + square * (0.1801410 + square * (-0.0851330 + square * 0.0208351))
    angle = ratio * (0.9998660 + square * series)
    if high > wide:
        angle = 0.5 * pi - angle
    if dx < 0.0:
        angle = pi - angle
    if dy < 0.0:
        angle = -angle
    place = (angle - heading) * (SECTORS / tau) + (3.0 * SECTORS + 0.5)
    number = int(place)
    return number % SECTORS if EDGE < place - number < 1.0 - EDGE else exact_sector(dx, dy, heading)


@kernel_with_loops(quick_sector)
def sector(dx: float, dy: float, heading: float) -> int:
    """`exact_sector`, in less time where it is compiled."""
    return exact_sector(dx, dy, heading)


@kernel
def nearest_opponent(match: PiTanks, seat: int) -> int:
    """Seat of the nearest robot of another team, which the learner treats as its only opponent; -1 if none."""
    robot = match.robots[seat]
    best, least = -1, FAR
    for j in range(ROBOTS):
        other = match.robots[j]
        if other.present and other.team != robot.team:
            dx, dy = other.x - robot.x, other.y - robot.y
            away = dx * dx + dy * dy
            if away < least:
                best, least = j, away
    return best


@kernel
def situation(match: PiTanks, seat: int, opponent: int, incoming: int) -> int:
    """State of the robot on `seat` with regard to the seat `opponent`.

    `incoming`: 1: only approaching bullets count; 0: all bullets of other teams.
    """
    robot, other = match.robots[seat], match.robots[opponent]
    ahead = sector(other.x - robot.x, other.y - robot.y, robot.heading)
    return state(ahead, wall_sector(match, robot), bullet_sector(match, robot, incoming))


@kernel
def wall_sector(match: PiTanks, robot: Robot) -> int:
    """Sector of the closest point of any standing inner wall, or NONE."""
    to_x, to_y, least = 0.0, 0.0, FAR
    for i in range(match.wall_count):
        wall = match.walls[i]
        if wall.health:
            dx, dy = offset_from_wall(wall, robot.x, robot.y)
            gap = sqrt(dx * dx + dy * dy) - wall.half
            if gap < least:
                to_x, to_y, least = -dx, -dy, gap
    return sector(to_x, to_y, robot.heading) if least < FAR else NONE


@kernel
def bullet_sector(match: PiTanks, robot: Robot, incoming: int) -> int:
    """Sector of the closest bullet of another team, or NONE.

    `incoming`: 1: only approaching ones, whose offset times velocity (dot product) is below 0.
    """
    to_x, to_y, least = 0.0, 0.0, FAR
    for k in range(ROBOTS):
        owner = match.robots[k]
        if not owner.present or owner.team == robot.team:
            continue
        for i in range(k * OWN_BULLETS, (k + 1) * OWN_BULLETS):
            bullet = match.bullets[i]
            if bullet.alive:
                dx, dy = bullet.x - robot.x, bullet.y - robot.y
                away = dx * dx + dy * dy
                if away < least and not (incoming and dx * bullet.vx + dy * bullet.vy >= 0.0):
                    to_x, to_y, least = dx, dy, away
    return sector(to_x, to_y, robot.heading) if least < FAR else NONE
