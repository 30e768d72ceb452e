"""Robot Race, back to the track: when FIRE asks for it, where a robot is put, and that the rules move none."""

from math import hypot, pi

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.games.match import Match
from pigaming_app.games.race.course import CoursePosition, locate, point_at
from pigaming_app.games.race.recovery import BACK, BACKWARD_TICKS, STILL_TICKS
from pigaming_app.games.race.state import MISSED_LINE, OFF_COURSE, STUCK, WRONG_WAY
from pigaming_app.sim.contact import BERTH
from pigaming_app.sim.world import HZ
from tests.games.race.test_party import put
from tests.games.rails import IN_ORDER, Rails, Ride
from tests.matches import Stick, run, setup_of

TRACKS = arenas("race")


def race(variant="standard", track="classic", plant=None):
    setup = setup_of("race", ["idle"] * 4, track, 10.0, IN_ORDER, variant, 3)
    return Match(setup, plant) if plant else Match(setup)


def under_way(match, seat=0, way=300.0):
    """Put a robot `way` px past its own line, after crossing it, and stop it there. Returns it with its racer."""
    state = match.state
    racer = state.racers[seat]
    own = state.lines[racer.line].along
    for step in (-12.0, 12.0, 200.0, way):
        put(match, seat, own + step)
        match.tick()
    assert (racer.passed, racer.lost) == (1, 0)
    return state.robots[seat], racer


def press(match, seat=0):
    """One press of FIRE, and a tick for the plant's new pose to be judged."""
    match.sit(seat, Stick(0.0, fire=1))
    match.tick()
    match.sit(seat, Stick(0.0))


def along_of(match, seat=0):
    place, robot = CoursePosition(), match.state.robots[seat]
    locate(match.state.course, robot.x, robot.y, place)
    return place


@pytest.mark.parametrize("variant", ["standard", "party"])
def test_off_the_course_fire_puts_it_a_little_before_where_it_left(variant):
    match = race(variant)
    robot, racer = under_way(match)
    left = racer.place.along
    robot.x, robot.y = 800.0, 430.0
    match.tick()
    assert racer.lost == OFF_COURSE
    robot.linear = 200.0
    press(match)
    place = along_of(match)
    assert place.along == pytest.approx(left - BACK, abs=1.0)
    assert abs(place.aside) < 0.5
    assert (robot.linear, robot.angular, robot.recover) == (0.0, 0.0, 0)
    match.tick()
    assert racer.lost == 0


def test_on_the_course_fire_does_nothing_in_standard():
    match = race()
    robot, _ = under_way(match)
    before = robot.x, robot.y, robot.heading
    press(match)
    assert (robot.x, robot.y, robot.heading) == pytest.approx(before)
    assert robot.recover == 0


def test_facing_the_wrong_way_counts_after_half_a_second_and_is_turned_round():
    match = race()
    robot, racer = under_way(match)
    straight = robot.heading
    robot.heading = (robot.heading + pi) % (2 * pi)
    for tick in range(BACKWARD_TICKS):
        assert racer.lost == 0, tick
        match.tick()
    assert racer.lost == WRONG_WAY
    press(match)
    assert abs((robot.heading - straight + pi) % (2 * pi) - pi) < 0.7


def test_a_robot_that_pushes_without_moving_is_stuck():
    match = race()
    robot, racer = under_way(match)
    match.sit(0, Stick(1.0))
    x, y = robot.x, robot.y
    for _ in range(STILL_TICKS + 2):
        robot.x, robot.y, robot.linear = x, y, 0.0
        match.tick()
    assert racer.lost == STUCK
    match.sit(0, Stick(0.0))
    match.tick()
    assert racer.lost == 0, "a robot that rests is not stuck"


def test_after_a_missed_line_it_is_put_before_where_it_left_its_way_and_the_lap_goes_on():
    ride = Ride(present=(0,))
    one, two, three, _ = (line.along for line in ride.lines)
    racer, robot = ride.racers[0], ride.state.robots[0]
    ride.along(0, one - 30.0, two - 100.0)
    ride.along(0, two - 100.0, two + 100.0, aside=140.0)
    ride.along(0, two + 100.0, three + 30.0)
    assert racer.lost == MISSED_LINE
    press(ride.match)
    assert robot.recover == 1
    left = two  # beside the course, round the end of the line
    assert (robot.recover_x, robot.recover_y) == pytest.approx(point_at(ride.course, left - BACK, 0.0), abs=20.0)
    ride.along(0, left - BACK, three + 30.0)
    assert (racer.missed, racer.passed, robot.recover) == (0, 3, 0)


def test_it_is_never_put_before_the_last_line_that_counts():
    match = race()
    robot, racer = under_way(match, way=30.0)
    robot.x, robot.y = 800.0, 430.0
    match.tick()
    press(match)
    own = match.state.lines[racer.line].along
    assert own < along_of(match).along < own + 40.0
    match.sit(0, Stick(1.0))
    run(match, HZ)
    assert (racer.passed, racer.missed) == (1, 0)


def test_it_is_put_beside_nobody():
    match = race()
    robot, racer = under_way(match)
    left = racer.place.along
    put(match, 1, left - BACK)
    put(match, 2, left - BACK - 80.0)
    robot.x, robot.y = 800.0, 430.0
    match.tick()
    press(match)
    others = [match.state.robots[i] for i in (1, 2, 3)]
    assert min(hypot(robot.x - other.x, robot.y - other.y) for other in others) >= BERTH
    assert along_of(match).along < left - BACK - 80.0


def test_if_no_place_is_free_it_waits_for_one():
    match = race()
    robot, racer = under_way(match, way=30.0)
    own = match.state.lines[racer.line].along
    put(match, 1, own + 15.0)
    robot.x, robot.y = 800.0, 430.0
    match.tick()
    press(match)
    assert robot.recover == 1
    assert hypot(robot.x - 800.0, robot.y - 430.0) < 5.0
    put(match, 1, own + 600.0)
    match.tick()
    match.tick()
    assert robot.recover == 0
    assert racer.lost == 0 or along_of(match).on


def test_a_real_robot_is_asked_and_not_moved_until_it_is_back():
    """A plant that leaves the request alone, as real robots do."""
    match = race(plant=Rails())
    state = match.state
    robot, racer = state.robots[0], state.racers[0]
    own = state.lines[racer.line].along
    for step in (-12.0, 12.0, 40.0, 75.0, 110.0, 145.0, 180.0):
        match.plant.poses[0] = (*point_at(state.course, own + step, 0.0), 0.0)
        match.tick()
    match.plant.poses[0] = (800.0, 430.0, 0.0)
    match.tick()
    press(match)
    for _ in range(20):
        match.tick()
        assert (robot.x, robot.y, robot.recover) == (800.0, 430.0, 1)
    match.plant.poses[0] = (robot.recover_x, robot.recover_y, robot.recover_heading)
    match.tick()
    match.tick()
    assert (robot.recover, racer.lost) == (0, 0)


def test_a_finisher_asks_for_nothing():
    match = race()
    robot, racer = under_way(match)
    racer.finished, racer.finish = 1, float(match.state.tick)
    robot.x, robot.y = 800.0, 430.0
    match.tick()
    press(match)
    assert (racer.lost, robot.recover) == (0, 0)
