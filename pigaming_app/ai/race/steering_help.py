"""Steering help in Robot Race: a person's stick, blended with the stick that follows the fastest line.

The share of the line is small in the middle of the course and large near its edge, and large for a stick that turns a
robot still farther from the course when it strays. It grows with the forward stick, so that a released stick stays
released. Along the course, reverse slows a rolling robot down and drives back one that stands, and a turn without
forward stick rolls on, so that whoever presses keys at random gets round; across it, both are as they are. The way back
to a missed line is never changed.
"""

from math import atan2, cos, sin, sqrt

from pigaming_app.ai.brain.driving import SteeringHelp
from pigaming_app.games.race.course import CoursePosition, locate
from pigaming_app.games.race.observation import TrackPoint, observe_mark
from pigaming_app.games.race.state import Race
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record

LOOK = 130.0  # px along the course to the point of the line that is steered for
SOON = 0.3  # s, prediction of where a robot comes near the edge
LATE = 0.05  # s, latency of the motors
CENTRE_SHARE, EDGE_SHARE = 0.2, 0.9  # of the line's stick
NEAR = 80.0  # px inside the edge at which the share begins to grow
INSIDE = 45.0  # px between the edge and the line that is steered for, as the fastest line touches the edge
SLOWEST = 0.45  # of full speed, to which it slows down before a bend
ALONG = 0.9  # rad between robot and course, below which a robot drives along it
STRAY = 0.45  # rad between robot and course from which a turn away from it counts less, none at ALONG
ROLL = 1.0  # forward stick of a turn along the course
COAST, ROLLING = 0.5, 0.15  # forward stick of reverse along it, and share of full speed from which a robot rolls
BACK = 0.3  # share of the reverse stick of a robot that stands there
TURNED = 1.75  # rad between robot and course above which a person is turning round and is left alone


@record
class CourseAhead:
    """What the help looks at in a tick; nothing of it lasts."""

    here: CoursePosition
    soon: CoursePosition
    mark: TrackPoint


def helped_stick(match: Race, seat: int, linear: float, angular: float) -> tuple[float, float]:
    """The stick of `seat`, both axes in [-1, 1], after the help in this tick. Reads the match only."""
    return steer(match, seat, linear, angular, CourseAhead())


@kernel
def steer(match: Race, seat: int, linear: float, angular: float, course: CourseAhead) -> tuple[float, float]:
    """The same as a kernel, with a record to look with."""
    robot, racer, place, soon = match.robots[seat], match.racers[seat], course.here, course.soon
    if racer.missed or racer.finished:
        return linear, angular
    locate(match.course, robot.x, robot.y, place)
    turned = turn_to(robot.heading - atan2(place.tangent_y, place.tangent_x))
    off = abs(turned)
    if off < ALONG and linear <= 0.0:
        back = -COAST if robot.linear > ROLLING * match.rules.speed else BACK
        linear = back * linear if linear < 0.0 else ROLL * abs(angular)
    if linear <= 0.0 or off > TURNED:
        return linear, angular
    ideal_linear, ideal_angular = _stick_to_line(match, seat, place, course.mark)
    locate(
        match.course,
        robot.x + SOON * robot.linear * cos(robot.heading),
        robot.y + SOON * robot.linear * sin(robot.heading),
        soon,
    )
    stray = min(1.0, max(0.0, (off - STRAY) / (ALONG - STRAY))) if turned * angular > 0.0 else 0.0
    share = linear * max(_share(place), _share(soon), stray)
    ahead = min(linear, ideal_linear)
    return linear + share * (ahead - linear), angular + share * (ideal_angular - angular)


@kernel
def _share(place: CoursePosition) -> float:
    """Share of the line's stick at full forward stick, by the distance to the edge."""
    inside = place.half - abs(place.aside)
    near = min(1.0, max(0.0, 1.0 - inside / NEAR))
    return CENTRE_SHARE + near * (EDGE_SHARE - CENTRE_SHARE)


@kernel
def _stick_to_line(match: Race, seat: int, place: CoursePosition, mark: TrackPoint) -> tuple[float, float]:
    """The stick for the arc to the fastest line LOOK px ahead: highest forward stick and turn.

    Source of pure pursuit: Coulter, CMU-RI-TR-92-01, 1992.
    """
    robot, rules = match.robots[seat], match.rules
    observe_mark(match, place.along + LOOK, mark)
    heading = robot.heading + LATE * robot.angular
    room = max(0.0, mark.half - INSIDE)
    shift = max(-room, min(room, mark.ideal)) - mark.ideal
    if mark.narrow:
        shift = max(mark.low, min(mark.high, mark.ideal + shift)) - mark.ideal
    x, y = mark.x + shift * mark.right_x, mark.y + shift * mark.right_y
    dx = x - robot.x - LATE * robot.linear * cos(heading)
    dy = y - robot.y - LATE * robot.linear * sin(heading)
    bearing = turn_to(atan2(dy, dx) - heading)
    if abs(bearing) > 1.2:
        return SLOWEST, 1.0 if bearing > 0.0 else -1.0
    bend = 2.0 * sin(bearing) / (sqrt(dx * dx + dy * dy) + 1.0)  # curvature, rad/px
    full = rules.speed * (rules.turbo_factor if robot.boosting else 1.0)
    permitted = rules.turn_rate / (abs(bend) * full + 1e-9)
    ahead = max(SLOWEST, min(1.0, permitted))
    return ahead, max(-1.0, min(1.0, bend * ahead * full / rules.turn_rate))


HELP = SteeringHelp(CourseAhead, steer)
