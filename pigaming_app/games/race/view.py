"""What a brain sees of a race: named numbers, as from the robot's own seat.

Bearings are relative to the own heading, in (-pi, pi], clockwise positive; ways along the course are in px, forwards
positive. Others are seen as they were `delay` seconds ago, by their speed; the own pose is never delayed.
"""

from math import atan2, cos, sin, sqrt
from typing import Annotated, Any

from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.course import Place, leg, locate, spot, way_round
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.world import ROBOTS

OTHERS = ROBOTS - 1
MARKS = 4


@record
class Eyes:
    """What shapes the view of one seat."""

    delay: float  # s by which others are seen late
    place: Place  # for working things out


@record
class Mark:
    """A point of the fastest line, so many tenths of a second ahead at full speed."""

    bearing: float
    distance: float
    pace: float  # speed there, as a share of full speed
    ideal: float  # px aside of the centre line
    half: float  # px from the centre line to the edges


@record
class Other:
    """Another robot, in the order of the seats after one's own."""

    present: int
    x: float
    y: float
    distance: float
    bearing: float
    ahead: float  # px along the course, the short way round
    aside: float  # px from the centre line
    speed: float  # px/s along the course
    sideways: float  # px/s across it, to the right
    finished: int


@record
class View:
    """What one seat sees."""

    x: float
    y: float
    heading: float
    linear: float
    angular: float
    speed: float  # full speed, px/s
    turn_rate: float
    turbo: float
    boosting: int
    along: float  # share of the way round
    aside: float
    half: float
    on: int
    lean: float  # heading, relative to the way of the course
    ideal: float  # where the fastest line is, px aside of the centre line
    left: float  # px to the finish
    overshot: float  # px by which it is past a line that it has not crossed, 0: none
    rank: int
    finished: int
    marks: Annotated[list[Mark], MARKS]
    others: Annotated[list[Other], OTHERS]


@kernel
def see(match: Any, seat: int, eyes: Any, view: Any) -> None:
    """Fill the view of one seat."""
    robot, racer, rules = match.robots[seat], match.racers[seat], match.rules
    course, place = match.course, eyes.place
    locate(course, robot.x, robot.y, place)
    view.x, view.y, view.heading = robot.x, robot.y, robot.heading
    view.linear, view.angular = robot.linear, robot.angular
    view.speed, view.turn_rate = rules.speed, rules.turn_rate
    view.turbo, view.boosting = robot.turbo, robot.boosting
    view.along, view.aside = place.along / course.length, place.aside
    view.half, view.on = place.half, place.on
    view.lean = turn_to(robot.heading - atan2(place.tangent_y, place.tangent_x))
    k, _ = leg(course, place.along)
    view.ideal = match.ideal[k]
    view.left = rules.laps * course.length - racer.progress
    view.overshot = overshot(match, seat, place.along)
    view.rank, view.finished = racer.rank, racer.finished
    for i in range(MARKS):
        see_mark(match, robot, place.along + (i + 1) * 0.1 * rules.speed, view.marks[i])
    along = place.along
    for i in range(OTHERS):
        see_other(match, robot, (seat + 1 + i) % ROBOTS, along, eyes, view.others[i])


@kernel
def see_mark(match: Any, robot: Any, along: float, mark: Any) -> None:
    """A point of the fastest line."""
    k, _ = leg(match.course, along)
    mark.pace, mark.ideal, mark.half = match.pace[k], match.ideal[k], match.course.half[k]
    x, y = spot(match.course, along, mark.ideal)
    dx, dy = x - robot.x, y - robot.y
    mark.distance = sqrt(dx * dx + dy * dy)
    mark.bearing = turn_to(atan2(dy, dx) - robot.heading)


@kernel
def see_other(match: Any, robot: Any, j: int, along: float, eyes: Any, other: Any) -> None:
    """Robot j as `robot`, at `along`, sees it."""
    seen, place = match.robots[j], eyes.place
    other.present = seen.present
    if not seen.present:
        return
    vx, vy = seen.linear * cos(seen.heading), seen.linear * sin(seen.heading)
    other.x, other.y = seen.x - eyes.delay * vx, seen.y - eyes.delay * vy
    dx, dy = other.x - robot.x, other.y - robot.y
    other.distance = sqrt(dx * dx + dy * dy)
    other.bearing = turn_to(atan2(dy, dx) - robot.heading)
    locate(match.course, other.x, other.y, place)
    ahead = way_round(match.course, along, place.along)
    other.ahead = ahead - match.course.length if ahead > 0.5 * match.course.length else ahead
    other.aside = place.aside
    other.speed = vx * place.tangent_x + vy * place.tangent_y
    other.sideways = vy * place.tangent_x - vx * place.tangent_y
    other.finished = match.racers[j].finished


@kernel
def overshot(match: Any, seat: int, along: float) -> float:
    """The px by which a robot is past the line that it must cross next."""
    racer = match.racers[seat]
    if racer.finished:
        return 0.0
    behind = racer.passed - 1 - racer.back
    here = match.lines[(seat + behind) % ROBOTS].along
    ahead = match.lines[(seat + behind + 1) % ROBOTS].along
    gap, way = way_round(match.course, here, ahead), way_round(match.course, here, along)
    if way > gap and (racer.missed or way - gap < match.course.length - way):
        return way - gap
    return 0.0
