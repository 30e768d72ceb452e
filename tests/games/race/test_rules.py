"""Robot Race, rule by rule, with robots on rails or on wheels."""

from math import pi

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.games.race.course import point_at
from pigaming_app.games.registry import games
from pigaming_app.sim.world import DT, HZ
from tests.games.rails import IN_ORDER, Ride
from tests.matches import Stick, finished, match_of, run

TRACKS = arenas("race")


def race(brains=("idle",) * 4, arena="classic", laps=3, minutes=10.0, seed=IN_ORDER):
    """A race on wheels."""
    return match_of("race", brains, arena, minutes, seed, "standard", laps)


# -------------------------------------------------------------------------------------------------------------- ground


def test_robots_drive_1_25_times_as_fast_as_elsewhere():
    match = race()
    match.sit(0, Stick())
    robot = match.state.robots[0]
    robot.x, robot.y, robot.heading = 600.0, 116.0, 0.0  # the straight at the top
    run(match, HZ)
    assert robot.linear == pytest.approx(1.25 * 260.0, rel=1e-4)


def test_mud_slows_to_a_third_on_the_tick_the_centre_leaves_the_course_and_not_after_it_is_back():
    ride = Ride(present=(0,))
    ride.match.sit(0, Stick())
    line, robot, edge = ride.lines[0], ride.state.robots[0], 0.5
    right = (line.bx - line.ax, line.by - line.ay)
    width = (right[0] ** 2 + right[1] ** 2) ** 0.5
    for away, speed in ((-edge, 325.0), (edge, 325.0 / 3), (-edge, 325.0)):
        ride.put(0, line.bx + away * right[0] / width, line.by + away * right[1] / width)
        ride.match.tick()
        assert robot.requested_linear == pytest.approx(speed)


def test_mud_slows_driving_back_and_turbo_too_and_no_turning():
    ride = Ride(present=(0,))
    ride.match.sit(0, Stick(-1.0, 1.0, 1))
    ride.put(0, 800, 430)
    ride.match.tick()
    robot = ride.state.robots[0]
    assert not ride.racers[0].place.on
    assert robot.requested_linear == pytest.approx(-325.0 * 1.3 / 3)
    assert robot.requested_angular == pytest.approx(3.0)


def test_turbo_is_a_meter_of_two_seconds():
    match = race()
    match.sit(0, Stick(0.0, 0.0, 1))
    robot = match.state.robots[0]
    burnt = 0
    while robot.boosting or not burnt:
        match.tick()
        burnt += robot.boosting
    assert burnt == pytest.approx(2 * HZ, abs=1)
    match.sit(0, Stick(0.0, 0.0, 0))
    run(match, 4 * HZ)
    assert robot.turbo == pytest.approx(1.0)


# --------------------------------------------------------------------------------------------------------------- lines


def test_a_missed_line_is_named_and_must_be_gone_back_to():
    """A robot bypasses line 2: crossing line 3 reveals it, and the lap does not count."""
    ride = Ride(present=(0,))
    one, two, three, _ = (line.along for line in ride.lines)
    racer = ride.racers[0]
    ride.along(0, one - 30.0, two - 100.0)
    ride.along(0, two - 100.0, two + 100.0, aside=140.0)
    assert racer.missed == 0, "no line counts as missed before a later one is crossed"
    ride.along(0, two + 100.0, three + 30.0)
    assert racer.missed == 2
    ride.along(0, three + 30.0, one + ride.course.length + 30.0)
    assert (racer.void, ride.state.robots[0].score, racer.missed) == (1, 0, 2)
    ride.along(0, one + ride.course.length + 30.0, two + ride.course.length + 30.0)
    assert (racer.missed, racer.passed) == (0, 2)
    ride.along(0, two + 30.0, one + ride.course.length + 30.0)
    assert ride.state.robots[0].score == 1


# --------------------------------------------------------------------------------------------------------------- times


def tick_at(ride, seat, along):
    """Advance one tick that ends there."""
    ride.put(seat, *point_at(ride.course, along, 0.0))
    ride.match.tick()


def test_times_are_interpolated_within_the_tick():
    """From 2 px before the line to 6 px behind it in one tick: the crossing is after a quarter of the tick."""
    ride = Ride(present=(0,), laps=1)
    own = ride.lines[0].along
    tick_at(ride, 0, own - 10.0)
    tick_at(ride, 0, own - 2.0)
    began = ride.state.tick
    tick_at(ride, 0, own + 6.0)
    racer = ride.racers[0]
    assert racer.lap_start == pytest.approx(began - 1 + 0.25, abs=0.01)
    ride.along(0, own + 6.0, own + ride.course.length - 6.0)
    tick_at(ride, 0, own - 6.0)
    ended = ride.state.tick
    tick_at(ride, 0, own + 2.0)
    assert racer.finished
    assert racer.finish == pytest.approx(ended - 1 + 0.75, abs=0.01)
    assert racer.last_lap == racer.best_lap == racer.laps[0] == pytest.approx(ended - began + 0.5, abs=0.02)
    assert games()["race"].times(ride.state, 0) == pytest.approx((racer.laps[0] * DT,))


def test_the_time_of_the_race_counts_from_go_not_from_the_line():
    ride = Ride(present=(0,), laps=1)
    run(ride.match, 100)
    ride.lap(0)
    racer = ride.racers[0]
    assert racer.finish > 100 + racer.laps[0]


def test_splits_are_timed_at_every_line_and_compared_with_the_best_lap():
    ride = Ride(present=(1,), laps=9)
    racer = ride.racers[1]
    one, two, three, four = (ride.lines[i].along for i in (1, 2, 3, 0))
    length = ride.course.length
    ride.along(1, one - 30.0, two + 30.0)
    assert racer.splits[0] == 0
    assert racer.splits[1] == pytest.approx((two - one) / 8.0, rel=0.03)
    assert racer.delta_at == 0, "there is nothing to compare with yet"
    ride.along(1, two + 30.0, one + length + 30.0)
    assert racer.best_splits[1:3] == pytest.approx([(two - one) / 8.0, (three - one) / 8.0], rel=0.03)
    assert racer.splits == [0, 0, 0, 0]
    first = racer.best_lap
    run(ride.match, 50)
    ride.along(1, one + 30.0, two + 30.0)
    assert racer.delta == pytest.approx(50, abs=2)
    assert racer.delta_at == pytest.approx(ride.state.tick, abs=6)
    ride.along(1, two + 30.0, one + length + 30.0)
    assert racer.last_lap == pytest.approx(first + 50, abs=3)
    assert racer.delta == pytest.approx(50, abs=3)
    assert (racer.best_lap, racer.best_splits[1]) == (first, pytest.approx((two - one) / 8.0, rel=0.03))
    assert four < length


# --------------------------------------------------------------------------------------------------------------- order


def test_the_order_goes_by_progress_between_the_lines_too():
    ride = Ride()
    for seat, way in enumerate((100.0, 300.0, 200.0, 0.0)):
        own = ride.lines[seat].along
        ride.along(seat, own - 30.0, own + way)
    ride.match.tick()
    assert [racer.rank for racer in ride.racers] == [3, 1, 2, 4]
    assert [racer.progress for racer in ride.racers] == pytest.approx([100, 300, 200, 0], abs=9)


def test_at_the_start_all_are_level_and_the_seats_decide():
    match = race()
    assert [racer.rank for racer in match.state.racers] == [1, 2, 3, 4]
    match.tick()
    assert [racer.rank for racer in match.state.racers] == [1, 2, 3, 4]
    assert {racer.progress for racer in match.state.racers} == {-55.0}


def test_distance_past_a_missed_line_is_no_progress():
    ride = Ride(present=(0, 1))
    one, two, three, _ = (line.along for line in ride.lines)
    ride.along(0, one - 30.0, two - 100.0)
    ride.along(0, two - 100.0, two + 100.0, aside=140.0)
    ride.along(0, two + 100.0, three + 60.0)
    assert ride.racers[0].missed
    assert two - one - 12.0 < ride.racers[0].progress <= two - one


@pytest.mark.parametrize("track", TRACKS)
def test_progress_grows_all_the_way_and_shrinks_all_the_way_back(track):
    ride = Ride(track, present=(3,), laps=9)
    own, racer = ride.lines[3].along, ride.racers[3]
    ride.along(3, own - 50.0, own - 40.0)
    for goal in range(-30, int(2.5 * ride.course.length), 60):
        ride.along(3, own + goal - 60, own + goal)
        assert racer.progress == pytest.approx(goal, abs=ride.course.step)
    for goal in range(int(2.4 * ride.course.length), int(ride.course.length), -60):
        ride.along(3, own + goal + 60, own + goal)
        assert racer.progress == pytest.approx(goal, abs=ride.course.step)


def test_finishers_rank_by_time_then_the_others_by_progress():
    ride = Ride(laps=1)
    ride.lap(2)
    ride.lap(0)
    ride.along(3, ride.lines[3].along - 30.0, ride.lines[3].along + 500.0)
    ride.match.tick()
    assert [racer.rank for racer in ride.racers] == [2, 4, 1, 3]
    outcome = ride.match.outcome()
    assert [row.seat for row in outcome.rows] == [2, 0, 3, 1]
    assert [row.place for row in outcome.rows] == [1, 2, 3, 4]
    assert outcome.winners == (2,)
    first, second, third, _ = outcome.rows
    assert first.stats["total"] < second.stats["total"]
    assert third.stats == {"laps": 0, "best": 0, "total": 0}
    assert set(first.records) == {"lap", "race"}
    assert first.records["race"] == round(1000 * first.stats["total"])
    assert third.records == {}
    assert first.times == pytest.approx((first.stats["best"],))
    assert tuple(first.stats) == games()["race"].columns


def test_a_best_lap_without_a_finish_is_a_feat_of_its_own():
    ride = Ride(present=(0,), laps=2)
    ride.lap(0)
    assert set(games()["race"].records(ride.state, 0)) == {"lap"}


# ----------------------------------------------------------------------------------------------------------- wrong way


def test_driving_against_the_way_counts_until_it_ends():
    match = race(("idle", "off", "off", "off"))
    match.sit(0, Stick(-1.0))
    racer = match.state.racers[0]
    run(match, 40)
    assert 25 < racer.wrong <= 40
    match.sit(0, Stick(1.0))
    run(match, 20)
    assert racer.wrong == 0


def test_going_back_to_a_missed_line_is_not_the_wrong_way():
    ride = Ride(present=(0,))
    one, two, three, _ = (line.along for line in ride.lines)
    ride.along(0, one - 30.0, two - 100.0)
    ride.along(0, two - 100.0, two + 100.0, aside=140.0)
    ride.along(0, two + 100.0, three + 60.0)
    ride.state.robots[0].linear = 300.0
    x, y = point_at(ride.course, three, 0.0)
    tangent = ride.rails.poses[0][2]
    for _ in range(30):
        ride.put(0, x, y, (tangent + pi) % (2 * pi))
        ride.match.tick()
    assert ride.racers[0].missed == 2
    assert ride.racers[0].wrong == 0


# ----------------------------------------------------------------------------------------------------------------- end


def test_the_others_race_on_for_thirty_seconds_after_the_first():
    ride = Ride(laps=1)
    ride.lap(1)
    first = ride.state.first
    assert first == pytest.approx(ride.racers[1].finish, abs=1)
    finished(ride.match)
    assert ride.state.tick - first == pytest.approx(30 * HZ, abs=1)


def test_when_all_have_finished_it_is_over_at_once():
    ride = Ride(present=(0, 2), laps=1)
    ride.lap(0)
    assert not ride.match.over
    own = ride.lines[2].along
    ride.along(2, own - 30.0, own + ride.course.length - 10.0)
    assert not ride.match.over
    ride.along(2, own + ride.course.length - 10.0, own + ride.course.length + 8.0)
    assert ride.match.over


def test_the_clock_ends_a_race_in_which_nobody_finishes():
    match = finished(race(minutes=0.1))
    assert match.state.tick == 6 * HZ
    assert match.outcome().winners == (), "nobody got anywhere: all are level"


def test_a_finisher_rolls_on_for_a_second_and_a_half_and_then_stops():
    ride = Ride(present=(0, 1), laps=1)
    ride.match.sit(0, Stick(1.0, 0.5, 1))
    ride.lap(0)
    robot, racer = ride.state.robots[0], ride.racers[0]
    assert racer.finished
    assert robot.requested_linear > 0
    while robot.requested_linear:
        ride.match.tick()
    assert ride.state.tick - racer.finish == pytest.approx(1.5 * HZ, abs=2)
    assert (robot.requested_angular, robot.boosting) == (0, 0)


def test_driving_after_the_finish_does_not_count():
    ride = Ride(present=(0, 1), laps=1)
    ride.lap(0)
    finish = ride.racers[0].finish
    ride.lap(0)
    assert (ride.state.robots[0].score, ride.racers[0].finish, ride.racers[0].passed) == (1, finish, 5)


@pytest.mark.parametrize("laps", [1, 3, 9])
def test_one_to_nine_laps_can_be_chosen(laps):
    assert laps in games()["race"].default.goals
    ride = Ride(present=(0, 1), laps=laps)
    for lap in range(laps):
        assert not ride.racers[0].finished
        ride.lap(0)
        assert ride.state.robots[0].score == lap + 1
    assert ride.racers[0].finished
    assert len(games()["race"].times(ride.state, 0)) == laps


def test_the_default_is_three_laps():
    assert Ride(laps=0).state.rules.laps == games()["race"].default.default_goal == 3


@pytest.mark.parametrize("seats", [("hand3", "off", "off", "off"), ("off", "hand2", "hand1", "off")])
def test_empty_seats_leave_their_lines_but_nothing_else(seats):
    match = finished(race(seats, laps=1))
    assert len(match.state.lines) == 4
    assert {row.seat for row in match.outcome().rows} == {i for i, brain in enumerate(seats) if brain != "off"}
    assert all(row.stats["total"] > 0 for row in match.outcome().rows)
