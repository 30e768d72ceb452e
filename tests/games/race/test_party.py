"""Robot Race, `party`: the common start, slipstream, boost pads, items and oil."""

from collections import Counter
from math import atan2, cos, hypot, sin, tau

import pytest

from pigaming_app.games.arenas import arenas, parse
from pigaming_app.games.match import Match
from pigaming_app.games.race.course import point_at
from pigaming_app.games.race.furniture import BEHIND, SPACE, grid
from pigaming_app.games.race.party import DROP, draw_item
from pigaming_app.games.race.state import NO_ITEM, OIL, SHIELD, TURBO
from pigaming_app.sim.world import HZ, RADIUS
from tests.games.rails import Rails
from tests.matches import Stick, match_of, run, setup_of

TRACKS = arenas("race")


def race(track="classic", seed=1, brains=("idle",) * 4, laps=5, arena=None, plant=None):
    """A party race of robots that stand still."""
    setup = setup_of("race", brains, track, 10.0, seed, "party", laps)
    return Match(setup, plant, arena) if plant else Match(setup, arena=arena)


def put(match, seat, along, aside=0.0):
    """Put a robot on the course, heading along it."""
    state, robot = match.state, match.state.robots[seat]
    course = state.course
    robot.x, robot.y = point_at(course, along % course.length, aside)
    ahead = point_at(course, (along + 5.0) % course.length, aside)
    x, y = ahead[0] - robot.x, ahead[1] - robot.y
    robot.heading = atan2(y, x) % tau
    return robot, state.racers[seat]


# --------------------------------------------------------------------------------------------------------------- start


@pytest.mark.parametrize("track", TRACKS)
def test_all_start_behind_one_line_two_by_two(track):
    match = race(track)
    state = match.state
    assert {racer.line for racer in state.racers} == {match.arena.plan.common}
    gaps = sorted(round(-racer.progress) for racer in state.racers)
    assert gaps[0] == pytest.approx(BEHIND, abs=2)
    assert gaps[1] == pytest.approx(gaps[0], abs=2)
    assert gaps[3] == pytest.approx(gaps[2], abs=2)
    for i, robot in enumerate(state.robots):
        assert state.racers[i].place.on
        assert all(
            hypot(robot.x - other.x, robot.y - other.y) >= 2 * RADIUS + SPACE
            for other in state.robots
            if other is not robot
        )


def test_a_grid_in_a_narrow_bend_is_drawn_out_until_nobody_touches():
    match = race("technical")
    course = match.arena.plan.course
    for k in range(0, 320, 8):
        poses = grid(course, k * course.step)
        assert min(hypot(a.x - b.x, a.y - b.y) for a in poses for b in poses if a is not b) >= 2 * RADIUS + SPACE


def test_every_seat_gets_every_place_equally_often():
    places = [Counter[int]() for _ in range(4)]
    for seed in range(48):
        for seat, racer in enumerate(race(seed=seed).state.racers):
            places[seat][racer.rank] += 1
    assert all(4 <= places[seat][rank] <= 22 for seat in range(4) for rank in range(1, 5))


def test_two_robots_start_in_the_front_row():
    for seed in range(12):
        state = race(seed=seed, brains=("idle", "off", "off", "idle")).state
        assert {state.racers[0].rank, state.racers[3].rank} == {1, 2}


@pytest.mark.parametrize("track", TRACKS)
def test_pads_and_boxes_lie_on_the_course_away_from_the_lines(track):
    state = race(track).state
    things = [*state.pads, *state.boxes]
    for thing in things:
        gaps = [abs(thing.along - line.along) for line in state.lines]
        assert min(min(gap, state.course.length - gap) for gap in gaps) > 100.0
        assert abs(thing.aside) < 75.0
    assert len({(round(thing.x), round(thing.y)) for thing in things}) == len(things)


def test_standard_has_nothing_of_it():
    state = match_of("race", ["idle"] * 4, variant="standard").state
    assert not state.rules.party
    assert state.rules.mud == pytest.approx(1 / 3)
    assert all(pad.along == 0.0 for pad in state.pads)
    assert len({racer.line for racer in state.racers}) == 4


def test_a_lap_of_everybody_ends_at_the_common_line():
    match = race(plant=Rails())
    state = match.state
    own = state.lines[state.racers[2].line].along
    for step in range(int((state.course.length + 140) / 8.0)):
        x, y = point_at(state.course, (own - 60.0 + 8.0 * step) % state.course.length, 0.0)
        match.plant.poses[2] = (x, y, 0.0)
        match.tick()
    assert (state.racers[2].passed, state.robots[2].score, state.racers[2].missed) == (5, 1, 0)


# --------------------------------------------------------------------------------------------------------------- speed


def test_mud_halves_the_speed():
    match = race()
    match.sit(0, Stick())
    robot = match.state.robots[0]
    robot.x, robot.y = 800.0, 430.0
    match.tick()
    assert not match.state.racers[0].place.on
    assert robot.requested_linear == pytest.approx(325.0 / 2)


def test_a_boost_pad_gives_a_surge_on_it_and_for_a_while_after():
    match = race()
    match.sit(0, Stick())
    pad, rules = match.state.pads[0], match.state.rules
    robot, racer = put(match, 0, pad.along, pad.aside)
    match.tick()
    assert robot.requested_linear == pytest.approx(325.0 * rules.surge_factor)
    put(match, 0, pad.along + 120.0, pad.aside)
    surging = 0
    while racer.surge:
        match.tick()
        surging += 1
    assert surging == rules.pad_surge - 1
    match.tick()
    assert robot.requested_linear == pytest.approx(325.0)


def draft(match, behind, ahead, gap, aside=0.0):
    """One tick of robot `behind` in the track of robot `ahead`; returns what its meter gained."""
    along = 3000.0
    robot, _ = put(match, behind, along, aside)
    other, _ = put(match, ahead, along + gap)
    robot.linear = other.linear = 300.0
    robot.turbo = 0.5
    match.tick()
    return robot.turbo - 0.5


def test_a_slipstream_refills_turbo_and_most_for_the_last():
    match, gains = race(), {}
    rules = match.state.rules
    assert draft(match, 0, 1, rules.slip_reach + 40.0) == pytest.approx(rules.turbo_refill)
    for seat in range(4):
        match = race()
        gain = draft(match, seat, (seat + 1) % 4, 150.0)
        racer = match.state.racers[seat]
        assert racer.slip
        gains[racer.rank] = gain - rules.turbo_refill
    assert all(gain == pytest.approx(rank * rules.slip_refill) for rank, gain in gains.items())
    assert len(gains) > 1


def test_there_is_no_slipstream_beside_in_front_or_at_rest():
    rules = race().state.rules
    assert draft(race(), 0, 1, 150.0, aside=80.0) == pytest.approx(rules.turbo_refill)
    assert draft(race(), 0, 1, -150.0) == pytest.approx(rules.turbo_refill)
    match = race()
    draft(match, 0, 1, 150.0)
    match.state.robots[0].linear = 20.0
    match.tick()
    assert not match.state.racers[0].slip


# --------------------------------------------------------------------------------------------------------------- items


def test_a_box_gives_one_item_and_comes_back():
    match = race()
    state = match.state
    box = state.boxes[0]
    _, racer = put(match, 1, box.along, box.aside)
    match.tick()
    item = racer.item
    assert item in (TURBO, SHIELD, OIL)
    assert box.pause == state.rules.box_pause
    run(match, state.rules.box_pause)
    assert box.pause == 0
    match.tick()
    assert (racer.item, box.pause) == (item, 0), "a robot with an item leaves the box alone"


def test_of_two_robots_at_a_box_the_nearer_takes_it():
    match = race()
    box = match.state.boxes[0]
    put(match, 0, box.along - 45.0, box.aside)
    put(match, 1, box.along + 30.0, box.aside)
    match.tick()
    assert match.state.racers[1].item
    assert not match.state.racers[0].item


def test_the_leader_gets_no_turbo_and_the_last_mostly():
    state = race().state
    drawn = {rank: Counter(draw_item(state, rank) for _ in range(2000)) for rank in (1, 4)}
    assert drawn[1][TURBO] == 0
    assert drawn[4][TURBO] > 1200
    assert drawn[1][OIL] > 500
    assert drawn[1][SHIELD] > 500


def test_fire_uses_the_item_once_for_each_press():
    match = race()
    robot, racer = put(match, 0, 3000.0)
    match.sit(0, Stick(0.0, fire=1))
    racer.item, robot.turbo = TURBO, 0.1
    match.tick()
    assert (racer.item, robot.turbo) == (NO_ITEM, 1.0)
    assert racer.surge > 0
    racer.item = SHIELD
    match.tick()
    assert racer.item == SHIELD, "FIRE is still down"
    match.sit(0, Stick(0.0))
    match.tick()
    match.sit(0, Stick(0.0, fire=1))
    match.tick()
    assert racer.item == NO_ITEM
    assert racer.shield == match.state.rules.shield_life


def slick(match, seat=0, along=3000.0):
    """Drop oil and return it."""
    robot, racer = put(match, seat, along)
    racer.item, racer.fire_held = OIL, 0
    match.sit(seat, Stick(0.0, fire=1))
    match.tick()
    match.sit(seat, Stick(0.0))
    (oil,) = [oil for oil in match.state.oils if oil.alive == match.state.rules.oil_life]
    assert hypot(oil.x - robot.x, oil.y - robot.y) == pytest.approx(DROP, abs=1.0)
    return oil


def test_oil_is_dropped_behind_and_makes_a_robot_spin_once_round():
    match = race()
    oil = slick(match)
    match.sit(1, Stick(1.0))
    robot, racer = match.state.robots[1], match.state.racers[1]
    robot.x, robot.y = oil.x, oil.y - 10.0
    match.state.robots[0].x = 40.0
    match.tick()
    assert racer.spin == match.state.rules.spin - 1
    assert not oil.alive
    turned = 0.0
    while racer.spin:
        assert abs(robot.requested_angular) == match.state.rules.spin_rate
        assert robot.requested_linear < 100.0
        match.tick()
        turned += abs(robot.angular) / HZ
    assert turned == pytest.approx(6.0, abs=0.6)
    assert racer.lost == 0


def test_a_shield_uses_oil_up_without_a_spin():
    match = race()
    oil = slick(match)
    racer = match.state.racers[1]
    racer.shield = 100
    match.state.robots[1].x, match.state.robots[1].y = oil.x, oil.y
    match.tick()
    assert (racer.spin, racer.shield, oil.alive) == (0, 0, 0)


def test_a_third_slick_replaces_the_oldest():
    match = race()
    for along in (2600.0, 3000.0, 3300.0):
        newest = slick(match, along=along)
        run(match, 5)
    alive = [oil for oil in match.state.oils if oil.alive]
    assert len(alive) == 2
    assert newest in alive


def test_oil_dries():
    match = race()
    oil = slick(match)
    run(match, match.state.rules.oil_life)
    assert not oil.alive


def test_a_track_file_needs_nothing_for_party():
    source = race().arena.source.replace("width = 200", "width = 150")
    match = race(arena=parse("race", source, "narrow.toml"))
    for robot in match.state.robots:
        assert RADIUS <= robot.x <= 1600 - RADIUS
        assert RADIUS <= robot.y <= 900 - RADIUS
        assert cos(robot.heading) ** 2 + sin(robot.heading) ** 2 == pytest.approx(1.0)
