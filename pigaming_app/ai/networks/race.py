"""Robot Race as a network sees it: 118 inputs, and four heads of choices.

The course ahead is given as points of the fastest line in the robot's own frame, 25 to 450 px ahead, closer together
where the next decision matters. Other robots are sorted by distance. What lies on the course in `party` is given along
the course and across it, relative to the robot.
"""

from math import cos, sin, sqrt
from typing import Annotated

from pigaming_app.ai.networks.encoding import Encoding, Inputs, NetworkSenses, nearest_robot, saturating, whole
from pigaming_app.games.race.course import CoursePosition, locate, segment_at
from pigaming_app.games.race.observation import SIGHT, SLICKS, CourseFeature, observe_features, observe_next_line
from pigaming_app.games.race.state import OIL, SHIELD, TURBO, Race
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.world import ROBOTS, Robot

GROUPS = (
    ("motion", 5),
    ("powers", 7),
    ("place", 7),
    ("way", 5),
    ("course", 48),
    ("first", 9),
    ("second", 9),
    ("third", 9),
    ("oil", 6),
    ("pad", 3),
    ("box", 3),
    ("race", 7),
)
MOTION, POWERS, PLACE, WAY, COURSE, OTHERS, OILS, PAD, BOX, RACE, SIZE = (
    0, 5, 12, 19, 24, 72, 99, 105, 108, 111, 118
)  # first input of each group  # fmt: skip
OTHER = 9  # inputs for each of the others
HEADS = (("drive", 5), ("turn", 9), ("fire", 2), ("turbo", 2))
DRIVES = (-0.5, 0.3, 0.6, 0.8, 1.0)  # positions of the stick
TURNS = (-1.0, -0.5, -0.25, -0.1, 0.0, 0.1, 0.25, 0.5, 1.0)  # a full turn is 17 degrees a decision

AHEAD = (25.0, 60.0, 100.0, 150.0, 210.0, 280.0, 360.0, 450.0)  # px along the course
FASTEST = 550.0  # px/s, with turbo on a boost pad
NEAR = 400.0  # px, within which others are seen


@record
class RaceNetworkSenses(NetworkSenses):
    """Parameters of the observation, and scratch space."""

    aside: float  # px right of the middle of the course
    past: float  # px past the next line; negative: before it
    return_x: float  # waypoint on the way back before that line
    return_y: float
    place: CoursePosition
    oils: Annotated[list[CourseFeature], SLICKS]
    pad: CourseFeature
    box: CourseFeature


@kernel
def encode(match: Race, seat: int, senses: RaceNetworkSenses, inputs: Inputs) -> None:
    """Fill in the inputs of one seat."""
    for i in range(SIZE):
        inputs[i] = 0.0
    robot, place = match.robots[seat], senses.place
    ahead_x, ahead_y = cos(robot.heading), sin(robot.heading)
    locate(match.course, robot.x, robot.y, place)
    along = place.along
    encode_self(match, seat, inputs)
    encode_place(match, seat, senses, ahead_x, ahead_y, inputs)
    encode_course(match, robot, along, ahead_x, ahead_y, inputs)
    encode_others(match, seat, senses, ahead_x, ahead_y, inputs)
    if match.rules.party:
        observe_features(match, along, place, senses)
        for i in range(SLICKS):
            encode_feature(senses.oils[i], senses.aside, OILS + 3 * i, inputs)
        encode_feature(senses.pad, senses.aside, PAD, inputs)
        encode_feature(senses.box, senses.aside, BOX, inputs)


@kernel
def encode_self(match: Race, seat: int, inputs: Inputs) -> None:
    """The own robot, its powers and the state of the race."""
    robot, racer, rules = match.robots[seat], match.racers[seat], match.rules
    inputs[MOTION] = whole(robot.linear / FASTEST)
    inputs[MOTION + 1] = whole(robot.angular / rules.turn_rate)
    inputs[MOTION + 2], inputs[MOTION + 3] = whole(robot.turbo), whole(robot.boosting)
    inputs[MOTION + 4] = whole(10.0 * robot.turbo)
    if rules.party:
        inputs[POWERS] = whole(1.0 if racer.item == TURBO else 0.0)
        inputs[POWERS + 1] = whole(1.0 if racer.item == SHIELD else 0.0)
        inputs[POWERS + 2] = whole(1.0 if racer.item == OIL else 0.0)
        inputs[POWERS + 3], inputs[POWERS + 4] = whole(racer.shield / rules.shield_life), whole(racer.spin / rules.spin)
        inputs[POWERS + 5], inputs[POWERS + 6] = whole(racer.surge / rules.item_surge), whole(racer.slip)
    left = rules.laps * match.course.length - racer.progress
    inputs[RACE] = whole(left / (5.0 * match.course.length))
    inputs[RACE + 1] = whole(left / 800.0)
    inputs[RACE + 2] = whole((racer.rank - 1) / (ROBOTS - 1))
    inputs[RACE + 3] = whole(rules.party)
    inputs[RACE + 4] = whole(rules.mud)
    inputs[RACE + 5] = whole(racer.finished)
    inputs[RACE + 6] = whole(1.0 if match.first else 0.0)


@kernel
def encode_place(
    match: Race, seat: int, senses: RaceNetworkSenses, ahead_x: float, ahead_y: float, inputs: Inputs
) -> None:
    """The place across the course, and the way back to a missed line or out of trouble."""
    robot, racer, place = match.robots[seat], match.racers[seat], senses.place
    senses.aside = place.aside
    inputs[PLACE] = whole(place.aside / 200.0)
    inputs[PLACE + 1], inputs[PLACE + 2] = (
        whole((place.half - place.aside) / 100.0),
        whole((place.half + place.aside) / 100.0),
    )
    inputs[PLACE + 3] = whole(place.on)
    inputs[PLACE + 4] = whole(ahead_x * place.tangent_x + ahead_y * place.tangent_y)
    inputs[PLACE + 5] = whole(place.tangent_x * ahead_y - place.tangent_y * ahead_x)
    k, _ = segment_at(match.course, place.along)
    inputs[PLACE + 6] = whole((place.aside - match.ideal[k]) / 100.0)
    observe_next_line(match, seat, place.along, senses)
    inputs[WAY + 4] = whole(1.0 if racer.lost else 0.0)
    inputs[WAY] = whole(1.0 if racer.missed else 0.0)
    inputs[WAY + 1] = whole(senses.past / 100.0)
    if senses.past > 0.0:
        dx, dy = senses.return_x - robot.x, senses.return_y - robot.y
        distance = sqrt(dx * dx + dy * dy) + 1e-9
        inputs[WAY + 2] = whole((ahead_x * dx + ahead_y * dy) / distance)
        inputs[WAY + 3] = whole((ahead_x * dy - ahead_y * dx) / distance)


@kernel
def encode_course(match: Race, robot: Robot, along: float, ahead_x: float, ahead_y: float, inputs: Inputs) -> None:
    """Points of the fastest line ahead: where, direction, distance to the edges, and the speed of that line."""
    course = match.course
    n = COURSE
    for i in range(len(AHEAD)):
        k, share = segment_at(course, along + AHEAD[i])
        after = k + 1 if k + 1 < course.count else 0
        x, y, ideal, half = course.xs[k], course.ys[k], match.ideal[k], course.half[k]
        ex, ey = course.xs[after] - x, course.ys[after] - y
        across = ideal / course.step
        dx, dy = x + share * ex - across * ey - robot.x, y + share * ey + across * ex - robot.y
        inputs[n] = whole((ahead_x * dx + ahead_y * dy) / 450.0)
        inputs[n + 1] = whole((ahead_x * dy - ahead_y * dx) / (1.2 * AHEAD[i] + 40.0))
        inputs[n + 2] = whole((ahead_x * ey - ahead_y * ex) / course.step)
        inputs[n + 3] = whole((half - ideal) / 200.0)
        inputs[n + 4] = whole((half + ideal) / 200.0)
        if match.narrow:
            inputs[n + 3] = whole((match.high[k] - ideal) / 200.0)
            inputs[n + 4] = whole((ideal - match.low[k]) / 200.0)
        inputs[n + 5] = whole(match.pace[k])
        n += 6


@kernel
def encode_others(
    match: Race, seat: int, senses: RaceNetworkSenses, ahead_x: float, ahead_y: float, inputs: Inputs
) -> None:
    """The other robots, the nearest first."""
    told = 0
    for place in range(ROBOTS - 1):
        j = nearest_robot(match, seat, told, NEAR * NEAR)
        if j < 0:
            break
        told |= 1 << j
        encode_other(match, seat, j, senses, ahead_x, ahead_y, OTHERS + OTHER * place, inputs)


@kernel
def encode_other(
    match: Race, seat: int, j: int, senses: RaceNetworkSenses, ahead_x: float, ahead_y: float, k: int, inputs: Inputs
) -> None:
    """Robot j, from input k on."""
    me, robot, racer = match.robots[seat], match.robots[j], match.racers[j]
    heading = robot.heading - senses.delay * robot.angular
    vx, vy = robot.linear * cos(heading), robot.linear * sin(heading)
    true_x, true_y = robot.x - me.x - senses.delay * vx, robot.y - me.y - senses.delay * vy
    dx, dy = true_x - senses.error * true_y, true_y + senses.error * true_x
    distance = sqrt(dx * dx + dy * dy)
    inputs[k] = whole(1.0 - distance / NEAR)
    inputs[k + 1] = whole((ahead_x * dx + ahead_y * dy) / NEAR)
    inputs[k + 2] = whole((ahead_x * dy - ahead_y * dx) / 200.0)
    inputs[k + 3] = whole((ahead_x * vx + ahead_y * vy - me.linear) / 325.0)
    inputs[k + 4] = whole((ahead_x * vy - ahead_y * vx) / 325.0)
    inputs[k + 5] = whole((racer.place.aside - senses.aside) / 100.0)
    inputs[k + 6] = whole(saturating((racer.progress - match.racers[seat].progress) / 200.0))
    inputs[k + 7] = whole(racer.finished)
    inputs[k + 8] = whole(1.0 if racer.spin else 0.0)


@kernel
def encode_feature(feature: CourseFeature, aside: float, k: int, inputs: Inputs) -> None:
    """Something on the course ahead, from input k on."""
    if feature.present:
        inputs[k] = whole(1.0)
        inputs[k + 1] = whole(1.0 - feature.ahead / SIGHT)
        inputs[k + 2] = whole((feature.aside - aside) / 100.0)


@kernel
def act(match: Race, seat: int, choices: list[int]) -> None:
    """Stick and buttons from the choices of the four heads. FIRE counts as it goes down, so it is never held."""
    fire = 1 if choices[2] and not match.racers[seat].fire_held else 0
    set_action(match.actions[seat], DRIVES[choices[0]], TURNS[choices[1]], fire, choices[3])


ENCODING = Encoding("race", GROUPS, HEADS, encode, act, RaceNetworkSenses)
