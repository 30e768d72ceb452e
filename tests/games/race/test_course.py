"""Courses: location along them, and invalid files, which are refused with key and reason."""

import re
from itertools import product
from math import cos, hypot, pi, sin
from random import Random
from statistics import median

import pytest

from pigaming_app import ASSETS
from pigaming_app.ai.learning.line_ups import LineUps
from pigaming_app.games.arenas import arenas, default_goal, load, parse, shipped_arenas
from pigaming_app.games.race.circuit import Corner, course_of
from pigaming_app.games.race.course import POINTS, CoursePosition, distance_ahead, locate, point_at
from pigaming_app.games.race.start import VARIANTS
from pigaming_app.games.setup import make_setup
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import DT
from tests.games.rails import place_on
from tests.matches import setup_of

TRACKS = arenas("race")
RING = (  # a ring of straights of 400 and 200 px, and quarter circles of 150 px
    Corner(300, 200, 150, 160),
    Corner(1000, 200, 150, 160),
    Corner(1000, 700, 150, 160),
    Corner(300, 700, 150, 160),
)


def test_a_ring_is_as_long_as_its_straights_and_arcs():
    course = course_of(RING)
    assert course.length == pytest.approx(2 * 400 + 2 * 200 + 2 * pi * 150, abs=0.1)
    assert (course.xs[0], course.ys[0]) == pytest.approx((300, 350)), "it begins where the arc of corner 1 does"
    assert course.half == pytest.approx([80.0] * POINTS)


def test_points_lie_equally_far_apart_on_straights_and_arcs():
    course = course_of(RING)
    for k in range(POINTS):
        x, y = course.xs[k], course.ys[k]
        if 450 < x < 850:
            off = min(abs(y - 200), abs(y - 700))
        elif 350 < y < 550:
            off = min(abs(x - 300), abs(x - 1000))
        else:
            off = min(abs(hypot(x - a, y - b) - 150) for a in (450, 850) for b in (350, 550))
        assert off < 0.05
        step = hypot(course.xs[(k + 1) % POINTS] - x, course.ys[(k + 1) % POINTS] - y)
        assert step == pytest.approx(course.step, abs=0.05)


def test_a_width_becomes_the_next_without_a_step():
    course = course_of((RING[0], RING[1]._replace(width=260), *RING[2:]))
    assert 110 < max(course.half) < 130
    assert all(abs(course.half[k] - course.half[k - 1]) < 0.2 * course.step for k in range(POINTS))


def test_a_place_on_a_straight_and_in_a_bend():
    course, place = course_of(RING), CoursePosition()
    locate(course, 500.0, 230.0, place)  # on the upper straight, driven to the right
    assert (place.along, place.aside) == pytest.approx((pi / 2 * 150 + 50, 30), abs=0.1)
    assert (place.tangent_x, place.tangent_y, place.half, place.on) == pytest.approx((1, 0, 80, 1))
    locate(course, 500.0, 119.0, place)
    assert (place.aside, place.on) == pytest.approx((-81, 0))
    a = 1.25 * pi  # half way round the first bend, 20 px to the left of the line
    locate(course, 450 + 170 * cos(a), 350 + 170 * sin(a), place)
    assert (place.along, place.aside) == pytest.approx((pi / 4 * 150, -20), abs=0.2)


def test_the_way_round_wraps():
    course = course_of(RING)
    assert distance_ahead(course, 100.0, 50.0) == pytest.approx(course.length - 50)
    assert point_at(course, course.length + 10.0, 0.0) == pytest.approx(point_at(course, 10.0, 0.0))
    assert point_at(course, -10.0, 5.0) == pytest.approx(point_at(course, course.length - 10.0, 5.0))


@pytest.mark.parametrize("track", TRACKS)
def test_locations_agree_with_exhaustive_search(track):
    """On the course both positions agree; off the course both agree that it is off."""
    course, place, random = load("race", track).plan.course, CoursePosition(), Random(track)
    on = 0
    for _ in range(250):
        x, y = random.uniform(36, 1564), random.uniform(36, 864)
        along, beyond = place_on(course, x, y)
        locate(course, x, y, place)
        if abs(beyond) > 0.05:
            assert place.on == (beyond < 0)
        if beyond < -0.05:
            on += 1
            assert place.half - abs(place.aside) == pytest.approx(-beyond, abs=0.05)
            away = min(distance_ahead(course, along, place.along), distance_ahead(course, place.along, along))
            assert away < 0.02 * POINTS * course.step / 50, "the same place, or one as near"
    assert on > 50


@pytest.mark.parametrize("track", TRACKS)
def test_a_spot_of_the_course_is_found_again(track):
    course, place, random = load("race", track).plan.course, CoursePosition(), Random(track)
    for _ in range(500):
        along, aside = random.uniform(0, course.length - 1e-6), random.uniform(-70, 70)
        x, y = point_at(course, along, aside)
        locate(course, x, y, place)
        assert place.on
        away = min(distance_ahead(course, along, place.along), distance_ahead(course, place.along, along))
        assert away < course.step, "within the leg, or where two legs meet"
        assert hypot(*(a - b for a, b in zip(point_at(course, place.along, place.aside), (x, y), strict=True))) < 6.0


@pytest.mark.parametrize("track", TRACKS)
def test_places_change_smoothly_all_the_way_round(track):
    course, place = load("race", track).plan.course, CoursePosition()
    for aside in (-60.0, 0.0, 60.0):
        last = None
        for i in range(2000):
            locate(course, *point_at(course, i * course.length / 2000, aside), place)
            if last is not None:
                moved = min(distance_ahead(course, last, place.along), distance_ahead(course, place.along, last))
                assert moved < 2 * course.step
            last = place.along


# -------------------------------------------------------------------------------------------------------- broken files


def good():
    return (ASSETS / "arenas" / "race" / "classic.toml").read_text(encoding="utf-8")


def broken(change):
    """A valid file with one change (old, new), at its first occurrence."""
    old, new = change
    source = good()
    assert old in source
    return source.replace(old, new, 1)


CORNER = "[[corner]]\nat = [{}, {}]\nradius = {}\nwidth = 150\n"
HEAD = '[title]\nen = "A"\npt = "A"\n[track]\nlines = [0.1, 0.3, 0.5, 0.7]\n'


@pytest.mark.parametrize(
    ("change", "key", "reason"),
    [
        (("[track]\nlines", "[track]\nlane = 1\nlines"), "track.lane", "unknown key; possible are lines, laps"),
        (("lines = [", "lines = [0.1, "), "track.lines", "a list of 4 numbers is needed"),
        (("lines = [0.", "lines = [1."), "track.lines[1]", "but 0 to 1 are possible"),
        (("lines = [", "lines = [1, 0.2, 0.4, 0.6] # "), "track.lines", "write 0"),
        (("lines = [", "lines = [0.5, 0.2, 0.6, 0.8] # "), "track.lines", "in the order of the way round"),
        (("lines = [", "lines = [0.2, 0.2, 0.6, 0.8] # "), "track.lines[1]", "at least 300 px are needed"),
        (("lines = [", "lines = [0.2, 0.4, 0.6, 0.65] # "), "track.lines[3]", "at least 300 px are needed"),
        (("[track]", "[road]"), "road", "unknown key"),
        (("at = [112, 116]", "at = [112]"), "corner[1].at", "a point [x, y] is needed"),
        (("at = [112, 116]", "at = [112, 950]"), "corner[1].at", "outside the arena"),
        (("at = [112, 116]", "at = [92, 116]"), "corner", "lies outside the arena"),
        (("radius = 215", "radius = 30"), "corner[1].radius", "but 40 to 2000 are possible"),
        (("radius = 215", "radius = 90"), "corner[1].radius", "at least half the width, 100"),
        (("radius = 215", "radius = 700"), "corner[1].radius", "need"),
        (("radius = 215", 'radius = "wide"'), "corner[1].radius", "not a number"),
        (("width = 200", "width = 140"), "corner[1].width", "but 150 to 400 are possible"),
        (("width = 200", "wide = 200"), "corner[1].wide", "unknown key"),
    ],
)
def test_a_broken_file_is_refused_in_one_line(change, key, reason):
    refused(broken(change), key, reason)


@pytest.mark.parametrize(
    ("corners", "key", "reason"),
    [
        ([(300, 200, 100), (1000, 200, 100)], "corner", "at least 3 are needed"),
        ([(300, 200, 100), (300, 200, 100), (900, 700, 100)], "corner[1].at", "same point as its neighbour"),
        ([(300, 200, 80), (1300, 200, 80), (200, 200, 80)], "corner[2].at", "turns back on itself"),
        (  # a clover leaf with three narrow leaves
            [
                (911, 792, 85),
                (689, 792, 85),
                (722, 495, 80),
                (448, 375, 85),
                (559, 182, 85),
                (800, 360, 80),
                (1041, 182, 85),
                (1152, 375, 85),
                (878, 495, 80),
            ],
            "corner",
            "three stretches of the course meet near (800, 450)",
        ),
        (  # a figure of eight
            [(200, 200, 100), (1400, 700, 100), (1400, 200, 100), (200, 700, 100)],
            "corner",
            "lies over itself near (6",
        ),
    ],
)
def test_a_course_that_cannot_be_driven_is_refused(corners, key, reason):
    refused(HEAD + "".join(CORNER.format(*corner) for corner in corners), key, reason)


def test_a_file_without_lines_is_refused():
    refused(HEAD.partition("[track]")[0] + "".join(CORNER.format(*c[:3]) for c in RING), "track", "a table is missing")


def refused(source, key, reason):
    with pytest.raises(ArenaError) as caught:
        parse("race", source, "broken.toml")
    line = str(caught.value)
    assert line.startswith(f"broken.toml: {key}: ")
    assert reason in line
    assert "\n" not in line


def test_there_are_four_tracks_and_the_first_is_classic():
    assert TRACKS[0] == "classic"
    assert len(TRACKS) >= 4


@pytest.mark.parametrize("track", TRACKS)
def test_lines_go_from_edge_to_edge_and_robots_wait_55_px_behind_them(track):
    arena = load("race", track)
    course, place = arena.plan.course, CoursePosition()
    for line, start in zip(arena.plan.lines, arena.starts, strict=True):
        locate(course, start.x, start.y, place)
        assert distance_ahead(course, place.along, line) == pytest.approx(55, abs=0.1)
        assert place.aside == pytest.approx(0, abs=0.1)
        assert (cos(start.heading), sin(start.heading)) == pytest.approx((place.tangent_x, place.tangent_y), abs=1e-6)


@pytest.mark.parametrize("track", shipped_arenas("race"))
def test_the_laps_of_a_match_follow_its_track(track):
    (laps,) = re.findall(r"^laps = (\d)$", load("race", track).source, re.MULTILINE)
    for variant in ("standard", "party"):
        assert make_setup("race", ["idle"] * 2, track, None, 1, variant, None, ["idle"]).goal == int(laps)
    assert make_setup("race", ["idle"] * 2, track, None, 1, None, None, ["idle"], 7).goal == 7


def test_other_tracks_have_the_laps_of_the_rules():
    goals = [make_setup("race", ["idle"] * 2, "surprise-5", None, 1, one, None, ["idle"]).goal for one in VARIANTS]
    assert dict(zip(VARIANTS, goals, strict=True)) == {"standard": 3, "draft": 3, "party": 5}


@pytest.mark.again
@pytest.mark.long
@pytest.mark.skipif(not can_compile(), reason="needs numba")
@pytest.mark.parametrize(("track", "variant"), [*product(shipped_arenas("race"), VARIANTS)])
def test_a_child_alone_drives_a_default_race_in_60_to_90_s(track, variant):
    """Medians of its models, so that one in mud for a minute does not count."""
    goal = default_goal("race", variant, track)
    setups = [setup_of("race", "beginner", track, 10.0, seed, variant, goal) for seed in range(60)]
    ends = LineUps("race", ["beginner"], True).played(setups)
    assert 60.0 <= median(end.racers[0].finish * DT for end in ends) <= 90.0
