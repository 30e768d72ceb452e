"""What the Q-learner sees: three directions, each as one of 16 sectors, relative to its own heading.

Where the opponent is, where the closest inner wall is, where the closest incoming bullet is. Sector 0 is centred
straight ahead and they go on clockwise; NONE says that there is no such thing. Together: 16 x 17 x 17 states.
"""

from math import atan2, sqrt, tau
from typing import Any

from pigaming_app.games.pitanks.state import OWN_BULLETS
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import ROBOTS

SECTORS = 16
NONE = 16  # no wall stands any more; no bullet comes
PLACES = SECTORS + 1
STATES = SECTORS * PLACES * PLACES
WIDE = tau / SECTORS  # rad


@kernel
def state(opponent: int, wall: int, bullet: int) -> int:
    """The number of a state; the opponent in 0..15, wall and bullet in 0..16."""
    return (opponent * PLACES + wall) * PLACES + bullet


@kernel
def opponent_of(state: int) -> int:
    """In which sector the opponent is in a state."""
    return state // (PLACES * PLACES)


@kernel
def wall_of(state: int) -> int:
    """In which sector the closest inner wall is in a state, or NONE."""
    return state // PLACES % PLACES


@kernel
def bullet_of(state: int) -> int:
    """From which sector the closest incoming bullet comes in a state, or NONE."""
    return state % PLACES


@kernel
def sector(dx: float, dy: float, heading: float) -> int:
    """The sector of what lies (dx, dy) px away from a robot with this heading."""
    return int(turn_to(atan2(dy, dx) - heading) / WIDE + (SECTORS + 0.5)) % SECTORS


@kernel
def nearest_opponent(match: Any, seat: int) -> int:
    """The seat of the nearest robot of another team: in a field of several, "the" opponent; -1 if there is none."""
    robot = match.robots[seat]
    best, least = -1, 1e18
    for j in range(ROBOTS):
        other = match.robots[j]
        if other.present and other.team != robot.team:
            dx, dy = other.x - robot.x, other.y - robot.y
            away = dx * dx + dy * dy
            if away < least:
                best, least = j, away
    return best


@kernel
def situation(match: Any, seat: int, opponent: int, incoming: int) -> int:
    """The state in which the robot on `seat` is, with the one on the seat `opponent` as its opponent.

    `incoming`: 1: only bullets count that come nearer; 0: all of the other teams'.
    """
    robot, other = match.robots[seat], match.robots[opponent]
    ahead = sector(other.x - robot.x, other.y - robot.y, robot.heading)
    return state(ahead, wall_sector(match, robot), bullet_sector(match, robot, incoming))


@kernel
def wall_sector(match: Any, robot: Any) -> int:
    """Where the closest point of any inner wall that still stands lies."""
    where, least = NONE, 1e18
    for i in range(match.wall_count):
        wall = match.walls[i]
        if wall.health:
            dx, dy = offset_from_wall(wall, robot.x, robot.y)
            gap = sqrt(dx * dx + dy * dy) - wall.half
            if gap < least:
                least = gap
                where = sector(-dx, -dy, robot.heading)
    return where


@kernel
def bullet_sector(match: Any, robot: Any, incoming: int) -> int:
    """Where the closest bullet of another team is; `incoming`: that comes nearer, position times velocity below 0."""
    where, least = NONE, 1e18
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
                    least = away
                    where = sector(dx, dy, robot.heading)
    return where
