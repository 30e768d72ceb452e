"""Robot Race, back to the track: a robot that has lost its way asks to be put back on the course.

It is lost off the course, facing the wrong way, after missing a line, or stuck. The rules move no robot: they request a
pose (`Robot.recover`), which a simulated plant fulfils at once and a real robot drives to. It lies on the middle of the
course, or beside the thing that stands there, a little before the place where the robot left its way, and past the last
line that counts, so that no line has to be crossed twice. It is never further along than the robot has driven.
"""

from math import atan2, cos, sin

from pigaming_app.games.race.course import distance_ahead, point_at, segment_at
from pigaming_app.games.race.laps import stretch, way_driven
from pigaming_app.games.race.passages import BESIDE, clear_aside, in_passage
from pigaming_app.games.race.state import MISSED_LINE, OFF_COURSE, STUCK, WRONG_WAY, Race, Racer
from pigaming_app.sim.angles import turn_to, wrap
from pigaming_app.sim.contact import is_free
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import HZ

BACKWARD = -0.2  # cosine of the angle to the course, below which a robot faces the wrong way
BACKWARD_TICKS = HZ // 2  # until that counts as lost
STILL = 25.0  # px, within which a robot that drives gets nowhere
STILL_TICKS = round(1.2 * HZ)
STICK = 0.3  # deflection from which the stick drives
BACK = 80.0  # px from the place where the robot left the course to the requested pose
MARGIN = 15.0  # px, least distance past the last line, as far as the robot has driven it
STEP, STEPS = 24.0, 10  # px between tried poses, and their number, while robots stand there
ARRIVED = 60.0  # px from the requested pose, within which a robot that drives there has arrived


@kernel
def detect_lost(match: Race, k: int) -> None:
    """Set `lost` of robot k, and `left`, the last place on its way."""
    robot, racer = match.robots[k], match.racers[k]
    here, gap = stretch(match, racer)
    way = distance_ahead(match.course, here, racer.place.along)
    if not racer.missed and way <= gap and (racer.place.on or drives_beside(match, racer, way)):
        racer.left = racer.place.along
    with_way = cos(robot.heading) * racer.place.tangent_x + sin(robot.heading) * racer.place.tangent_y
    racer.backward = racer.backward + 1 if with_way < BACKWARD and not racer.spin else 0
    dx, dy = robot.x - racer.still_x, robot.y - racer.still_y
    racer.still += 1
    if racer.spin or abs(match.actions[k].linear) < STICK or dx * dx + dy * dy > STILL * STILL:
        racer.still, racer.still_x, racer.still_y = 0, robot.x, robot.y
    racer.lost = 0
    if racer.finished:
        return
    if racer.missed:
        racer.lost = MISSED_LINE
    elif not racer.place.on and not in_passage(match, racer.place):
        racer.lost = OFF_COURSE
    elif racer.backward >= BACKWARD_TICKS:
        racer.lost = WRONG_WAY
    elif racer.still >= STILL_TICKS:
        racer.lost = STUCK


@kernel
def drives_beside(match: Race, racer: Racer, way: float) -> bool:
    """True if a robot in the mud still drives along the course that it has left, and does not cut across."""
    step = way - way_driven(match, racer)
    near: bool = abs(racer.place.aside) - racer.place.half < BESIDE
    return near and -match.rules.carried < step < match.rules.carried


@kernel
def update_request(match: Race, k: int) -> None:
    """Move the requested pose to where no robot stands; withdraw it once robot k is back."""
    robot, racer, course = match.robots[k], match.racers[k], match.course
    here, _ = stretch(match, racer)
    driven = way_driven(match, racer)
    least = driven if driven < MARGIN else MARGIN
    way = driven - BACK
    for _ in range(STEPS):
        way = way if way > least else least
        along = (here + way) % course.length
        x, y = point_at(course, along, clear_aside(match, along))
        if way == least or is_free(match, k, x, y):
            break
        way -= STEP
    segment, _ = segment_at(course, along)
    after = segment + 1 if segment + 1 < course.count else 0
    heading = atan2(course.ys[after] - course.ys[segment], course.xs[after] - course.xs[segment])
    robot.recover_x, robot.recover_y, robot.recover_heading = x, y, wrap(heading)
    dx, dy = x - robot.x, y - robot.y
    arrived = dx * dx + dy * dy < ARRIVED * ARRIVED and abs(turn_to(heading - robot.heading)) < 1.0
    if arrived or not racer.lost:
        robot.recover = 0
