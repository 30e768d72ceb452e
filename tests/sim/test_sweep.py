"""Swept collision tests against an oracle that moves in small steps and measures distances."""

from math import hypot

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from pigaming_app.sim.sweep import FAR, bounds_contact, disc_contact, is_clear, offset_from_wall, wall_contact
from pigaming_app.sim.world import Wall
from tests.floor import floor

STEPS = 400
PLACE = st.floats(-100.0, 100.0)
WAY = st.floats(-150.0, 150.0)
REACH = st.floats(1.0, 60.0)


def wall(ax, ay, bx, by, half=15.0):
    made = Wall()
    made.ax, made.ay, made.bx, made.by, made.half = ax, ay, bx, by, half
    return made


def from_segment(made, x, y):
    """Distance to the centre line, as a minimum over a fine search (the distance is convex along it)."""

    def gap(t):
        return hypot(x - made.ax - t * (made.bx - made.ax), y - made.ay - t * (made.by - made.ay))

    low, high = 0.0, 1.0
    for _ in range(80):
        a, b = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, b) if gap(a) <= gap(b) else (a, high)
    return min(gap(0.0), gap(1.0), gap(low))


def check(t, gap, reach, way):
    """Assert that t is the time of first contact, where `gap(t)` is the distance at a fraction of the displacement."""
    if t == FAR:
        shares = [i / STEPS for i in range(STEPS + 1)]
        assert min(gap(share) for share in shares) >= reach - 1e-6
        return
    assert 0.0 <= t <= 1.0
    if t == 0.0:
        assert gap(0.0) <= reach + 1e-6
    else:
        assert gap(t) == pytest.approx(reach, abs=1e-5 + 1e-9 * way)
    for i in range(STEPS):
        if i / STEPS < t:
            assert gap(i / STEPS) >= reach - 1e-5


@given(PLACE, PLACE, WAY, WAY, PLACE, PLACE, REACH)
def test_a_disc_is_met_when_the_stepper_meets_it(x, y, dx, dy, cx, cy, reach):
    check(
        disc_contact(x, y, dx, dy, cx, cy, reach),
        lambda t: hypot(x + t * dx - cx, y + t * dy - cy),
        reach,
        hypot(dx, dy),
    )


@settings(max_examples=60, deadline=None)
@given(PLACE, PLACE, WAY, WAY, PLACE, PLACE, PLACE, PLACE, st.floats(5.0, 40.0), st.floats(0.0, 36.0))
def test_a_wall_is_met_when_the_stepper_meets_it(x, y, dx, dy, ax, ay, bx, by, half, radius):
    assume((ax, ay) == (bx, by) or hypot(bx - ax, by - ay) > 1e-3)
    made = wall(ax, ay, bx, by, half)
    check(
        wall_contact(x, y, dx, dy, made, radius),
        lambda t: from_segment(made, x + t * dx, y + t * dy),
        half + radius,
        hypot(dx, dy),
    )


@given(PLACE, PLACE, PLACE, PLACE, PLACE, PLACE)
def test_the_way_off_a_wall_is_the_shortest(x, y, ax, ay, bx, by):
    made = wall(ax, ay, bx, by)
    assert hypot(*offset_from_wall(made, x, y)) == pytest.approx(from_segment(made, x, y), abs=1e-5)


@given(st.floats(10.0, 190.0), st.floats(10.0, 90.0), WAY, WAY)
def test_the_bounds_are_met_where_the_circle_touches_them(x, y, dx, dy):
    t = bounds_contact(x, y, dx, dy, 200.0, 100.0, 10.0)

    def room(share):
        px, py = x + share * dx, y + share * dy
        return min(px, 200.0 - px, py, 100.0 - py) - 10.0

    if t == FAR:
        assert room(1.0) >= -1e-9
    else:
        assert room(t) == pytest.approx(0.0, abs=1e-6)
        assert room(0.99 * t) >= -1e-6


def test_head_on_at_a_wall_stops_the_centre_a_radius_and_a_half_thickness_before_it():
    t = wall_contact(0.0, 50.0, 100.0, 0.0, wall(80.0, 0.0, 80.0, 100.0, half=15.0), 6.0)
    assert 100.0 * t == pytest.approx(80.0 - 15.0 - 6.0)


def test_an_end_of_a_wall_is_round():
    # aimed 21 * sin 30 beside the end's centre: contact is 21 * cos 30 before it
    t = wall_contact(0.0, 10.5, 200.0, 0.0, wall(100.0, 0.0, 100.0, -80.0, half=15.0), 6.0)
    assert 200.0 * t == pytest.approx(100.0 - 21.0 * 0.75**0.5)


def test_moving_away_from_a_disc_never_meets_it():
    assert disc_contact(50.0, 0.0, 100.0, 0.0, 0.0, 0.0, 42.0) == FAR
    assert disc_contact(50.0, 0.0, 0.0, 0.0, 0.0, 0.0, 42.0) == FAR
    assert disc_contact(41.0, 0.0, 100.0, 0.0, 0.0, 0.0, 42.0) == 0.0


def test_a_wall_hides_what_is_behind_it_until_it_is_gone():
    world = floor(walls=[(800.0, 300.0, 800.0, 600.0)])
    assert not is_clear(world, 700.0, 450.0, 900.0, 450.0, 0.0)
    assert is_clear(world, 700.0, 250.0, 900.0, 250.0, 0.0)
    assert not is_clear(world, 700.0, 250.0, 900.0, 250.0, 36.0)
    world.walls[0].health = 0
    assert is_clear(world, 700.0, 450.0, 900.0, 450.0, 36.0)


FLOOR = st.tuples(st.floats(0.0, 1600.0), st.floats(0.0, 900.0))
LINES = st.lists(st.tuples(FLOOR, FLOOR).map(lambda ends: (*ends[0], *ends[1])), min_size=1, max_size=6)


@settings(max_examples=150, deadline=None)
@given(LINES, FLOOR, FLOOR, st.sampled_from([0.0, 6.0, 36.0]))
def test_a_way_is_clear_exactly_if_it_touches_no_wall(walls, start, end, radius):
    world, (x, y), (to_x, to_y) = floor(walls), start, end
    contacts = [wall_contact(x, y, to_x - x, to_y - y, made, radius) for made in world.walls[: len(walls)]]
    assert is_clear(world, x, y, to_x, to_y, radius) == (min(contacts) > 1.0)


@pytest.mark.parametrize("gap", [-1e-5, -1e-8, -1e-12, 0.0, 1e-12, 1e-8, 1e-5])
@pytest.mark.parametrize("end", [400.0, 470.0])  # parallel to the wall, or towards it
def test_a_way_that_grazes_a_wall_is_as_clear_as_its_contact_is_far(gap, end):
    world = floor(walls=[(800.0, 421.0 + gap, 1000.0, 421.0 + gap)])
    for to_y in (end, 2 * 421.0 - end):
        contact = wall_contact(600.0, 400.0, 700.0, to_y - 400.0, world.walls[0], 6.0)
        assert is_clear(world, 600.0, 400.0, 1300.0, to_y, 6.0) == (contact > 1.0)
