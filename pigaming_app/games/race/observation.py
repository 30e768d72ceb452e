"""Robot Race: a brain's observation of a match, as named numbers relative to its own seat.

Bearings are relative to the robot's own heading, in (-pi, pi], clockwise positive; distances along the course are in
px, forward positive. Positions of others are extrapolated back by `delay` seconds; the own pose is not delayed.
"""

from math import atan2, cos, sin, sqrt
from typing import Annotated, Protocol

from pigaming_app.games.race.course import Course, CoursePosition, distance_ahead, locate, point_at, segment_at
from pigaming_app.games.race.laps import stretch
from pigaming_app.games.race.party import is_last
from pigaming_app.games.race.passages import clear_aside
from pigaming_app.games.race.state import Race
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.world import ROBOTS, Robot

OTHERS = ROBOTS - 1
BACK = 160.0  # px, longest step on the way back to a missed line
PACE = 40.0  # px of lookahead for the pace of the fastest line
PASSAGE = 8  # points of the course before a point, which count for the passage to it
SIGHT = 400.0  # px along the course, within which features are observed
SLICKS = 2
RUN_UP = 70.0  # px before a line, as a run-up to cross it


@record
class RaceSenses:
    """Parameters of the observation of one seat."""

    delay: float  # s, age of the poses of others
    look: float  # lookahead along the course, px
    place: CoursePosition  # scratch space


@record
class TrackPoint:
    """A point of the fastest line."""

    x: float
    y: float
    right_x: float  # unit vector across the course, to the right
    right_y: float
    ideal: float  # px aside of the centre line
    half: float  # px from the centre line to the edges
    narrow: int  # 1: things stand there, and from here to there robots pass between these two offsets, px
    low: float
    high: float


@record
class RaceOther:
    """Another robot, in seat order after the own seat."""

    present: int
    x: float
    y: float
    distance: float
    bearing: float
    ahead: float  # px along the course, by the shorter way round
    aside: float  # px from the centre line
    speed: float  # px/s along the course
    sideways: float  # px/s across it, to the right
    finished: int


@record
class CourseFeature:
    """Something that lies on the course ahead."""

    present: int  # 1: there is one within SIGHT
    ahead: float  # px along the course
    aside: float  # px right of the centre line


@record
class RaceObservation:
    """The observation of one seat."""

    x: float
    y: float
    heading: float
    linear: float
    angular: float
    speed: float  # full speed, px/s
    turn_rate: float
    turbo: float  # charge of the meter, 0..1
    turbo_factor: float  # of speed, while it is on
    boosting: int
    along: float  # fraction of the lap
    aside: float
    half: float
    on: int
    heading_error: float  # heading relative to the course
    ideal: float  # offset of the fastest line from the centre line here, px
    pace: float  # lowest speed on that line within the next PACE px, as a share of full speed
    turn: float  # sine of the angle by which the course turns within twice the lookahead, positive to the right
    left: float  # px to the finish
    past: float  # px by which it is past its next line; negative: before it
    return_x: float  # waypoint on the way back before that line
    return_y: float
    rank: int
    finished: int
    ahead: TrackPoint  # at the lookahead distance
    others: Annotated[list[RaceOther], OTHERS]
    lost: int  # as in Racer: FIRE asks for the way back
    boosts: int  # 1: slipstream and boost pads work for it, and the fields below are in use
    item: int
    shield: int
    spin: int
    slip: int
    surge: int
    oils: Annotated[list[CourseFeature], SLICKS]  # the nearest, nearest first
    pad: CourseFeature  # the nearest
    box: CourseFeature  # the nearest that is there; of two side by side the one less far to the side


class RoadView(Protocol):
    """The part of an observation that is about the next line and the features of the course."""

    aside: float
    past: float
    return_x: float
    return_y: float
    oils: list[CourseFeature]
    pad: CourseFeature
    box: CourseFeature


@kernel
def observe(match: Race, seat: int, senses: RaceSenses, obs: RaceObservation) -> None:
    """Fill in the observation of one seat."""
    robot, racer, rules = match.robots[seat], match.racers[seat], match.rules
    course, place = match.course, senses.place
    locate(course, robot.x, robot.y, place)
    along = place.along
    obs.x, obs.y, obs.heading = robot.x, robot.y, robot.heading
    obs.linear, obs.angular = robot.linear, robot.angular
    obs.speed, obs.turn_rate = rules.speed, rules.turn_rate
    obs.turbo, obs.turbo_factor, obs.boosting = robot.turbo, rules.turbo_factor, robot.boosting
    obs.along, obs.aside = along / course.length, place.aside
    obs.half, obs.on = place.half, place.on
    obs.heading_error = turn_to(robot.heading - atan2(place.tangent_y, place.tangent_x))
    obs.left = rules.laps * course.length - racer.progress
    obs.rank, obs.finished = racer.rank, racer.finished
    observe_track(match, place, senses.look, obs)
    observe_mark(match, along + senses.look, obs.ahead)
    observe_next_line(match, seat, along, obs)
    for i in range(OTHERS):
        observe_other(match, robot, (seat + 1 + i) % ROBOTS, along, senses, obs.others[i])
    obs.lost, obs.boosts = racer.lost, 1 if rules.party or (rules.draft and is_last(match, seat)) else 0
    if obs.boosts:
        obs.item, obs.shield, obs.spin = racer.item, racer.shield, racer.spin
        obs.slip, obs.surge = racer.slip, racer.surge
        observe_features(match, along, senses.place, obs)


@kernel
def observe_track(match: Race, place: CoursePosition, look: float, obs: RaceObservation) -> None:
    """Fill in the fastest line at this position, and the turn of the course ahead."""
    course = match.course
    k, _ = segment_at(course, place.along)
    obs.ideal, obs.pace = match.ideal[k], match.pace[k]
    for i in range(k + 1, k + 1 + int(PACE / course.step)):
        pace = match.pace[i % course.count]
        if pace < obs.pace:
            obs.pace = pace
    x, y = segment_direction(course, k + int(2.0 * look / course.step))
    obs.turn = place.tangent_x * y - place.tangent_y * x


@kernel
def segment_direction(course: Course, k: int) -> tuple[float, float]:
    """Direction of the segment from point k, of approximately unit length."""
    a = k % course.count
    b = (k + 1) % course.count
    return (course.xs[b] - course.xs[a]) / course.step, (course.ys[b] - course.ys[a]) / course.step


@kernel
def observe_mark(match: Race, along: float, mark: TrackPoint) -> None:
    """Fill in the point of the fastest line at `along` px."""
    course = match.course
    k, share = segment_at(course, along)
    after = k + 1 if k + 1 < course.count else 0
    ax, ay = course.xs[k], course.ys[k]
    ex, ey = course.xs[after] - ax, course.ys[after] - ay
    way = sqrt(ex * ex + ey * ey)
    mark.right_x, mark.right_y = -ey / way, ex / way
    mark.ideal = match.ideal[k] + share * (match.ideal[after] - match.ideal[k])
    mark.half = course.half[k]
    mark.x = ax + share * ex + mark.ideal * mark.right_x
    mark.y = ay + share * ey + mark.ideal * mark.right_y
    mark.narrow = match.narrow
    if match.narrow:
        observe_passage(match, k, mark)


@kernel
def observe_passage(match: Race, last: int, mark: TrackPoint) -> None:
    """Fill in the passage up to the point `last` of the course."""
    count = match.course.count
    k = (last - PASSAGE + count) % count
    mark.low, mark.high = match.low[k], match.high[k]
    for _ in range(PASSAGE):
        k = k + 1 if k + 1 < count else 0
        low, high = match.low[k], match.high[k]
        if low > mark.high or high < mark.low:
            return
        mark.low = low if low > mark.low else mark.low
        mark.high = high if high < mark.high else mark.high


@kernel
def observe_next_line(match: Race, seat: int, along: float, obs: RoadView) -> None:
    """Fill in the distance past the robot's next line, and the waypoint back to it."""
    racer, course = match.racers[seat], match.course
    here, gap = stretch(match, racer)
    way = distance_ahead(course, here, along)
    obs.past = way - gap
    if way > gap and not racer.missed and way - gap > course.length - way:  # not yet at the last one
        obs.past = way - course.length - gap
    if racer.finished:
        obs.past = -course.length
    back = obs.past + RUN_UP if obs.past > 0.0 else RUN_UP
    before = along - (back if back < BACK else BACK)
    obs.return_x, obs.return_y = point_at(course, before, clear_aside(match, before))


@kernel
def observe_other(match: Race, robot: Robot, j: int, along: float, senses: RaceSenses, other: RaceOther) -> None:
    """Fill in robot j, as observed by `robot` at `along` px."""
    seen, place = match.robots[j], senses.place
    other.present = seen.present
    if not seen.present:
        return
    vx, vy = seen.linear * cos(seen.heading), seen.linear * sin(seen.heading)
    other.x, other.y = seen.x - senses.delay * vx, seen.y - senses.delay * vy
    dx, dy = other.x - robot.x, other.y - robot.y
    other.distance = sqrt(dx * dx + dy * dy)
    other.bearing = turn_to(atan2(dy, dx) - robot.heading)
    locate(match.course, other.x, other.y, place)
    ahead = distance_ahead(match.course, along, place.along)
    other.ahead = ahead - match.course.length if ahead > 0.5 * match.course.length else ahead
    other.aside = place.aside
    other.speed = vx * place.tangent_x + vy * place.tangent_y
    other.sideways = vy * place.tangent_x - vx * place.tangent_y
    other.finished = match.racers[j].finished


@kernel
def observe_features(match: Race, along: float, place: CoursePosition, obs: RoadView) -> None:
    """Fill in oil, boost pad and item box ahead."""
    course, aside = match.course, obs.aside
    obs.pad.present, obs.box.present = 0, 0
    for pad in match.pads:
        note(obs.pad, distance_ahead(course, along, pad.along), pad.aside, aside)
    for box in match.boxes:
        if match.rules.party and not box.pause:
            note(obs.box, distance_ahead(course, along, box.along), box.aside, aside)
    for slick in obs.oils:
        slick.present = 0
    for oil in match.oils:
        if oil.alive:
            locate(course, oil.x, oil.y, place)
            ahead = distance_ahead(course, along, place.along)
            if obs.oils[0].present and ahead < obs.oils[0].ahead:
                obs.oils[1].present, obs.oils[1].ahead = 1, obs.oils[0].ahead
                obs.oils[1].aside, obs.oils[0].present = obs.oils[0].aside, 0
                note(obs.oils[0], ahead, place.aside, aside)
            else:
                note(obs.oils[1 if obs.oils[0].present else 0], ahead, place.aside, aside)


@kernel
def note(feature: CourseFeature, ahead: float, aside: float, own: float) -> None:
    """Fill in a feature if none nearer is there; of two equally far ahead, the one nearer to `own` px aside."""
    if ahead > SIGHT or (feature.present and feature.ahead < ahead):
        return
    if not feature.present or ahead < feature.ahead or abs(aside - own) < abs(feature.aside - own):
        feature.present, feature.ahead, feature.aside = 1, ahead, aside
