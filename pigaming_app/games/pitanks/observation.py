"""PiTanks: a brain's observation of a match, as named numbers relative to its own seat.

Bearings are relative to the robot's own heading, in (-pi, pi], clockwise positive. Poses of others are extrapolated
back by `delay` seconds; the own pose is not delayed.
"""

from math import atan2, cos, sin, sqrt
from typing import Annotated

from pigaming_app.games.pitanks.scoring import is_finale, is_overtime, lead, worth
from pigaming_app.games.pitanks.state import MINE, OWN_BULLETS, SHIELD, PiTanks
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.flow_field import Route, update_route
from pigaming_app.sim.grid import BLOCKED, node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.sweep import is_clear
from pigaming_app.sim.world import HEIGHT, ROBOTS, WIDTH, Robot

OTHERS = ROBOTS - 1
BESIDE = 22.0  # px between a robot in cover and the wall


@record
class PiTanksSenses:
    """Parameters of the observation of one seat, and its route."""

    delay: float  # s, age of the poses of others
    route: Route
    cover: int = 1  # 0: cover is left out


@record
class PiTanksOther:
    """Another robot, in seat order after the own seat. Includes team mates."""

    present: int
    mate: int
    x: float
    y: float
    distance: float
    bearing: float
    aim: float  # bearing at which a bullet fired now would meet it
    facing: float  # its heading, relative to the direction from it to the observer; 0: it faces the observer
    clear: int  # 1: a bullet would meet no inner wall
    protected: int
    score: int
    knocked_out: int  # ticks left
    lit: int
    bounty: int  # points that a hit on it is worth in addition
    worth: int = 1  # points that a hit of the observer on it would score now


@record
class PiTanksObservation:
    """The observation of one seat. Positions and distances in px."""

    x: float
    y: float
    heading: float
    linear: float
    angular: float
    turn_rate: float
    lead: int  # own team's score less the best other team's
    seconds_left: float
    loaded: int  # 1: the gun is ready
    turbo: float
    protected: int
    shield: int
    mine: int
    others: Annotated[list[PiTanksOther], OTHERS]
    cover: int  # 1: cover from the nearest opponent exists; the position is behind the nearest such inner wall
    cover_x: float
    cover_y: float
    cover_distance: float
    threat: float  # s until the first bullet hits, if nobody moves; 9: none
    threat_bearing: float  # direction from which it comes
    threat_side: float  # px by which its path misses this robot's centre; positive: the robot is right of the path
    prize: int  # 1: a pick-up exists; the nearest one
    prize_x: float
    prize_y: float
    prize_distance: float
    waypoint_x: float  # waypoint of the route
    waypoint_y: float
    waypoint_bearing: float
    waypoint_distance: float
    goal_distance: float  # straight-line
    straight: int  # 1: the straight line to the goal is clear
    knocked_out: int  # ticks left
    camped: int  # ticks within `PiTanksRules.camp_radius`
    lit: int
    bounty: int
    finale: int  # 1: hits count double
    overtime: int  # 1: regular time is over; `seconds_left` is that of the overtime


@kernel
def observe(match: PiTanks, seat: int, senses: PiTanksSenses, obs: PiTanksObservation) -> None:
    """Fill in the observation of one seat."""
    robot = match.robots[seat]
    observe_self(match, seat, obs)
    nearest = -1
    for i in range(OTHERS):
        j = (seat + 1 + i) % ROBOTS
        other = obs.others[i]
        observe_other(match, seat, j, senses.delay, other)
        if other.present and not other.mate and (nearest < 0 or other.distance < obs.others[nearest].distance):
            nearest = i
    obs.lead = lead(match, seat)
    obs.cover = 0
    if nearest >= 0 and senses.cover:
        observe_cover(match, robot, obs.others[nearest].x, obs.others[nearest].y, obs)
    observe_surroundings(match, seat, senses, obs)


@kernel
def observe_self(match: PiTanks, seat: int, obs: PiTanksObservation) -> None:
    """Fill in the seat's own robot, and the time left."""
    robot, tank = match.robots[seat], match.tanks[seat]
    obs.x, obs.y, obs.heading = robot.x, robot.y, robot.heading
    obs.linear, obs.angular, obs.turn_rate = robot.linear, robot.angular, match.rules.turn_rate
    obs.finale, obs.overtime = 1 if is_finale(match) else 0, 1 if is_overtime(match) else 0
    obs.seconds_left = (match.rules.ticks + obs.overtime * match.rules.overtime - match.tick) * 0.02
    obs.loaded = 0 if tank.cooldown else 1
    obs.turbo, obs.protected = robot.turbo, tank.protected
    obs.shield, obs.mine = tank.powers[SHIELD], tank.powers[MINE]
    obs.knocked_out, obs.camped, obs.lit, obs.bounty = tank.knocked_out, tank.camped, tank.lit, tank.bounty


@kernel
def observe_surroundings(match: PiTanks, seat: int, senses: PiTanksSenses, obs: PiTanksObservation) -> None:
    """Fill in the first bullet that would hit, the nearest pick-up and the waypoint."""
    robot = match.robots[seat]
    observe_threat(match, seat, robot, senses.delay, obs)
    obs.prize = 0
    if match.rules.pickups:
        observe_pickup(match, robot, obs)
    observe_waypoint(match, robot, senses, obs)


@kernel
def observe_other(match: PiTanks, seat: int, j: int, delay: float, other: PiTanksOther) -> None:
    """Fill in robot j, as observed by robot `seat`."""
    robot, seen, tank = match.robots[seat], match.robots[j], match.tanks[j]
    other.present, other.mate = seen.present, 1 if seen.team == robot.team else 0
    if not seen.present:
        return
    vx, vy = locate_other(robot, seen, delay, other)
    way = aim_at_other(match, robot, vx, vy, delay, other)
    other.facing = turn_to(seen.heading - delay * seen.angular - way - 3.141592653589793)
    other.clear = is_clear(match, robot.x, robot.y, seen.x, seen.y, match.rules.bullet_radius)
    other.protected, other.knocked_out = tank.protected, tank.knocked_out
    other.lit, other.bounty, other.worth = tank.lit, tank.bounty, worth(match, seat, j)
    other.score = seen.score


@kernel
def locate_other(robot: Robot, seen: Robot, delay: float, other: PiTanksOther) -> tuple[float, float]:
    """Fill in position and distance of the robot `seen`. Returns its velocity, px/s."""
    vx, vy = seen.linear * cos(seen.heading), seen.linear * sin(seen.heading)
    other.x, other.y = seen.x - delay * vx, seen.y - delay * vy
    dx, dy = other.x - robot.x, other.y - robot.y
    other.distance = sqrt(dx * dx + dy * dy)
    return vx, vy


@kernel
def aim_at_other(match: PiTanks, robot: Robot, vx: float, vy: float, delay: float, other: PiTanksOther) -> float:
    """Fill in bearing and aim of a robot that `locate_other` has located. Returns the direction to it, rad."""
    dx, dy = other.x - robot.x, other.y - robot.y
    way = atan2(dy, dx)
    other.bearing = turn_to(way - robot.heading)
    flight_time = other.distance / match.rules.bullet_speed + delay
    other.aim = turn_to(atan2(dy + flight_time * vy, dx + flight_time * vx) - robot.heading)
    return way


@kernel
def observe_cover(match: PiTanks, robot: Robot, from_x: float, from_y: float, obs: PiTanksObservation) -> None:
    """Fill in the nearest position at which an inner wall hides this robot from (from_x, from_y)."""
    nearest2 = 1e9
    for i in range(match.wall_count):
        wall = match.walls[i]
        if not wall.health:
            continue
        mx, my = 0.5 * (wall.ax + wall.bx), 0.5 * (wall.ay + wall.by)
        ex, ey = wall.bx - wall.ax, wall.by - wall.ay
        length = sqrt(ex * ex + ey * ey)
        if length < 1.0:
            continue
        gap = wall.half + match.radius + BESIDE
        nx, ny = -ey / length * gap, ex / length * gap
        if nx * (mx - from_x) + ny * (my - from_y) < 0.0:
            nx, ny = -nx, -ny
        x, y = mx + nx, my + ny
        dx, dy = x - robot.x, y - robot.y
        distance2 = dx * dx + dy * dy
        if (
            distance2 < nearest2
            and match.radius < x < WIDTH - match.radius
            and match.radius < y < HEIGHT - match.radius
            and not match.grid[node_at(x, y)] & BLOCKED
        ):
            nearest2 = distance2
            obs.cover, obs.cover_x, obs.cover_y = 1, x, y
    if obs.cover:
        obs.cover_distance = sqrt(nearest2)


@kernel
def observe_threat(match: PiTanks, seat: int, robot: Robot, delay: float, obs: PiTanksObservation) -> None:
    """Fill in the first bullet that would hit if nobody moved; those fired less than `delay` ago are not visible."""
    first, first_side, at = 9.0, 0.0, -1
    x, y, speed = robot.x, robot.y, match.rules.bullet_speed
    reach, speed2 = match.radius + match.rules.bullet_radius, speed * speed
    for k in range(ROBOTS):
        owner = match.robots[k]
        if not owner.present or owner.team == robot.team:
            continue
        for i in range(k * OWN_BULLETS, (k + 1) * OWN_BULLETS):
            bullet = match.bullets[i]
            if not bullet.alive:
                continue
            px, py = x - bullet.x, y - bullet.y
            ahead = (px * bullet.vx + py * bullet.vy) / speed2
            if ahead <= 0.0 or ahead >= first:
                continue
            side = (bullet.vx * py - bullet.vy * px) / speed
            if -reach < side < reach:
                ox, oy = bullet.x - owner.x, bullet.y - owner.y
                if ox * ox + oy * oy >= delay * delay * speed2:
                    first, first_side, at = ahead, side, i
    obs.threat, obs.threat_side, obs.threat_bearing = first, first_side, 0.0
    if at >= 0:
        obs.threat_bearing = turn_to(atan2(-match.bullets[at].vy, -match.bullets[at].vx) - robot.heading)


@kernel
def observe_pickup(match: PiTanks, robot: Robot, obs: PiTanksObservation) -> None:
    """Fill in the nearest pick-up."""
    nearest2 = 1e9
    for pickup in match.pickups:
        dx, dy = pickup.x - robot.x, pickup.y - robot.y
        distance2 = dx * dx + dy * dy
        if pickup.alive and distance2 < nearest2:
            nearest2 = distance2
            obs.prize, obs.prize_x, obs.prize_y = 1, pickup.x, pickup.y
    if obs.prize:
        obs.prize_distance = sqrt(nearest2)


@kernel
def observe_waypoint(match: PiTanks, robot: Robot, senses: PiTanksSenses, obs: PiTanksObservation) -> None:
    """Fill in the waypoint and goal of the route."""
    route = senses.route
    if not route.active:
        obs.waypoint_bearing, obs.waypoint_distance, obs.goal_distance, obs.straight = 0.0, 0.0, 0.0, 1
        return
    update_route(match, route, robot.x, robot.y)
    obs.waypoint_x, obs.waypoint_y, obs.straight = route.waypoint_x, route.waypoint_y, route.straight
    dx, dy = route.waypoint_x - robot.x, route.waypoint_y - robot.y
    obs.waypoint_distance = sqrt(dx * dx + dy * dy)
    obs.waypoint_bearing = turn_to(atan2(dy, dx) - robot.heading)
    dx, dy = route.goal_x - robot.x, route.goal_y - robot.y
    obs.goal_distance = sqrt(dx * dx + dy * dy)
