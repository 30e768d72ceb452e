"""The race brain: lap times by strength, overtaking, and recovery from any position."""

import re
from collections import deque
from math import hypot, pi

import pytest

from pigaming_app.ai.learning.league import duel
from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas, load, parse
from pigaming_app.games.race.course import point_at
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import DT, HZ
from tests.bench.reference_lap import MIXTURES, STUCK, STUCK_PX, TARGETS
from tests.cases import one_in
from tests.games.rails import IN_ORDER
from tests.matches import finished, match_of, run

TRACKS = arenas("race")
REFERENCE = {"classic": 9.25, "hairpin": 10.71, "kidney": 9.34, "technical": 11.26}  # s, of tests.bench.reference_lap


def race(brains, track="classic", seed=IN_ORDER, laps=3):
    return match_of("race", brains, track, 10.0, seed, "standard", laps)


def the_other_way_round(track):
    """The track driven in the opposite direction, with new lines."""
    source = load("race", track).source
    head, *corners = source.split("[[corner]]")
    turned = "[[corner]]".join([head, *(corner.rstrip() + "\n\n" for corner in reversed(corners))])
    return parse("race", re.sub(r"lines = .*", "lines = [0.1, 0.35, 0.6, 0.85]", turned), "turned.toml")


def alone(strength, track="classic", laps=3):
    return race((strength, "off", "off", "off"), track, laps=laps)


@pytest.mark.parametrize("track", one_in(2, TRACKS))
@pytest.mark.parametrize("strength", TARGETS)
def test_each_strength_is_as_fast_as_it_is_meant_to_be(strength, track):
    """Flying laps without turbo against the fastest possible lap without turbo."""
    match = alone(strength, track, laps=5)
    match.state.robots[0].turbo = match.state.rules.turbo_refill = 0.0
    finished(match)
    laps = match.game.times(match.state, 0)[1:]
    low, high = TARGETS[strength]
    assert low <= REFERENCE[track] / (sum(laps) / len(laps)) <= high


@pytest.mark.parametrize("track", TRACKS)
def test_turbo_is_used_well(track):
    match = finished(alone("hand3", track))
    assert REFERENCE[track] / match.game.times(match.state, 0)[1] > 1.02


@pytest.mark.parametrize("track", TRACKS)
def test_a_hard_driver_stays_on_the_course(track):
    match = alone("hand3", track, laps=2)
    while not match.over:
        match.tick()
        assert match.state.racers[0].place.on


@pytest.mark.parametrize("track", one_in(4, TRACKS))
def test_courses_can_be_driven_anticlockwise(track):
    brains = ("hand3", "hand2", "hand1", "hand3")
    match = race(brains, the_other_way_round(track), laps=2)
    while not match.over:
        match.tick()
        assert not any(racer.missed for racer in match.state.racers)
    assert all(racer.finished for racer in match.state.racers)
    best = match.game.stats(match.state, 0)["best"]
    assert best == pytest.approx(REFERENCE[track] / 1.09, rel=0.06)


@pytest.mark.parametrize("mixture", MIXTURES)
@pytest.mark.parametrize("track", one_in(4, TRACKS))
def test_nobody_misses_a_line_or_is_stuck_and_all_finish(track, mixture):
    match = race(mixture, track, seed=11)
    trails = [deque[tuple[float, float]](maxlen=STUCK) for _ in range(4)]
    while not match.over:
        match.tick()
        for robot, racer, action, trail in zip(
            match.state.robots, match.state.racers, match.state.actions, trails, strict=True
        ):
            assert not racer.missed
            if action.linear == 0.0 or racer.finished:
                trail.clear()
                continue
            trail.append((robot.x, robot.y))
            if len(trail) == STUCK:
                x, y = trail[0]
                assert max(hypot(a - x, b - y) for a, b in trail) >= STUCK_PX
    assert all(racer.finished for racer in match.state.racers)


@pytest.mark.parametrize("strength", TARGETS)
def test_every_strength_thinks_without_changing_anything_but_its_action(strength):
    match = race((strength,) * 4)
    brain = make_brain("race", strength, 1)
    action = match.state.actions[0]
    before = digest(match.state)
    brain.think(match.state, 0)
    action.linear = action.angular = 0.0
    action.fire = action.turbo = 0
    assert digest(match.state) == before


def test_hard_beats_easy():
    result = duel("race", "hand3", "hand1", matches=4, seed=100, minutes=10.0, variant="standard", fast=False)
    assert result.wins == 4


# ----------------------------------------------------------------------------------------------------------- in the way


@pytest.mark.parametrize("track", TRACKS)
def test_it_drives_round_robots_that_stand_on_the_course(track):
    match = finished(race(("hand3", "idle", "idle", "idle"), track))
    free = finished(alone("hand3", track))
    assert match.state.racers[0].finish < 1.2 * free.state.racers[0].finish


@pytest.mark.parametrize(("slower", "faster"), [("hand1", "hand3"), ("hand2", "hand3"), ("hand1", "hand2")])
def test_it_overtakes_whoever_is_slower(slower, faster):
    """The slower one starts a line ahead. On a free course the faster one would win by at least 8 s."""
    match = race((slower, "off", "off", faster), laps=9)
    ahead, behind = match.state.racers[0], match.state.racers[3]
    finished(match)
    assert ((ahead.finish or match.state.tick) - behind.finish) * DT > 4.0


# ---------------------------------------------------------------------------------------------------------- recovering


def goes_on(match, seat=0, seconds=8.0):
    """True if a robot drives at least 300 px along the course within `seconds`."""
    before = match.state.racers[seat].progress
    run(match, round(seconds * HZ))
    return match.state.racers[seat].progress > before + 300.0


@pytest.mark.parametrize("strength", TARGETS)
@pytest.mark.parametrize("heading", one_in(2, [0.0, 0.5 * pi, pi, 1.5 * pi]))
def test_it_gets_free_whichever_way_it_stands_in_a_corner(strength, heading):
    match = alone(strength)
    match.tick()
    robot = match.state.robots[0]
    robot.x, robot.y, robot.heading = 1564.0, 36.0, heading
    assert goes_on(match, seconds=10.0)


@pytest.mark.parametrize("track", TRACKS)
def test_it_turns_round_when_it_faces_the_wrong_way(track):
    match = run(alone("hand2", track), 2 * HZ)
    robot = match.state.robots[0]
    robot.heading = (robot.heading + pi) % (2 * pi)
    assert goes_on(match)
    assert match.state.racers[0].wrong == 0


@pytest.mark.parametrize(("track", "past"), [*zip(TRACKS, [30.0, 200.0, 700.0, 200.0], strict=True)])
def test_it_goes_back_to_a_line_that_it_has_been_carried_over(track, past):
    """As when a person who has missed a line hands over."""
    match = alone("hand3", track, laps=1)
    state = match.state
    while state.racers[0].passed < 1:
        match.tick()
    state.robots[0].x, state.robots[0].y = point_at(
        state.course, (state.lines[1].along + past) % state.course.length, 0.0
    )
    finished(match, 60.0)
    assert state.racers[0].finished
    assert state.racers[0].void == 0


@pytest.mark.parametrize(
    ("track", "place"), [*zip(TRACKS, [(800, 430), (400, 300), (1200, 600), (800, 430)], strict=True)]
)
def test_it_finds_its_way_from_the_middle_of_the_infield(track, place):
    match = run(alone("hand1", track, laps=1), 3 * HZ)
    match.state.robots[0].x, match.state.robots[0].y = place
    finished(match, 120.0)
    assert match.state.racers[0].finished


# ------------------------------------------------------------------------------------------------------------- variety


def test_no_two_races_of_equal_drivers_are_alike():
    ends = set()
    for seed in range(4):
        match = finished(race(("hand3", "hand3", "off", "off"), seed=seed, laps=1))
        ends.add(tuple(round(racer.finish, 1) for racer in match.state.racers))
    assert len(ends) == 4


def test_the_weaker_make_mistakes_and_the_strongest_none():
    muddy = {}
    for name in ("hand1", "hand3"):
        match, muddy[name] = race((name, "off", "off", "off"), "kidney", laps=5), 0
        while not match.over:
            match.tick()
            muddy[name] += not match.state.racers[0].place.on
    assert muddy["hand3"] == 0
    assert muddy["hand1"] > 10


def test_drivers_use_what_party_offers_and_all_finish():
    match = match_of("race", ["hand3"] * 4, seed=5, variant="party", goal=2)
    used = dict.fromkeys(("surge", "slip", "item"), 0)
    while not match.over:
        match.tick()
        for racer in match.state.racers:
            for name in used:
                used[name] += getattr(racer, name) > 0
    assert all(racer.finished for racer in match.state.racers)
    assert all(count > 20 for count in used.values())
