"""Steering help: it keeps a forward-driving novice on the course, and leaves every other stick alone."""

from collections import deque
from math import atan2, pi
from statistics import mean

import pytest

from pigaming_app.ai.brain.kind import BrainPlayer, HumanPlayer
from pigaming_app.ai.game_ai import HELPED_POINT, HELPED_TURN, POINT, TURN
from pigaming_app.ai.people.models import MASHER
from pigaming_app.ai.race.steering_help import helped_stick
from pigaming_app.ai.registry import AIS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.race.course import locate, point_at, segment_at
from pigaming_app.sim.action import quantise, set_action
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import ROBOTS
from pigaming_app.ui.input.events import StickState
from tests.cases import one_in
from tests.matches import match_of

TRACKS = arenas("race")


class Novice:
    """Steers fully left or right for the middle of the course, as seen `late` ticks ago; `late` 0: never steers."""

    def __init__(self, late=0, helped=True):
        self.helped = helped
        self.turns = deque([0.0] * late)

    def think(self, state, seat):
        angular = self.steered(state, seat) if self.turns else 0.0
        linear, angular = helped_stick(state, seat, 1.0, angular) if self.helped else (1.0, angular)
        set_action(state.actions[seat], linear, angular, 0, 0)

    def steered(self, state, seat):
        robot, course = state.robots[seat], state.course
        x, y = point_at(course, (state.racers[seat].place.along + 130.0) % course.length, 0.0)
        bearing = turn_to(atan2(y - robot.y, x - robot.x) - robot.heading)
        self.turns.append(1.0 if bearing > 0.12 else -1.0 if bearing < -0.12 else 0.0)
        return self.turns.popleft()


def alone(track="classic", laps=1):
    return match_of("race", "human", track, 2.0, 1, "standard", laps)


def ticks_in_mud(match, novice, ticks=1000):
    match.sit(0, novice)
    muddy = 0
    while not match.over and match.state.tick < ticks:
        match.tick()
        muddy += not match.state.racers[0].place.on
    return muddy


def placed(along, aside, turn=0.0):
    """A race whose robot stands `aside` px right of the middle, turned by `turn` rad from the course, at full speed."""
    match = alone()
    state, robot = match.state, match.state.robots[0]
    course = state.course
    k, _ = segment_at(course, along)
    robot.x, robot.y = point_at(course, along, aside)
    robot.heading = turn + atan2(course.ys[k + 1] - course.ys[k], course.xs[k + 1] - course.xs[k])
    robot.linear = state.rules.speed
    locate(course, robot.x, robot.y, state.racers[0].place)
    return state


@pytest.mark.parametrize("track", one_in(2, TRACKS))
@pytest.mark.parametrize("late", [0, 18])
def test_a_novice_with_help_laps_without_touching_the_mud(track, late):
    match = alone(track)
    assert ticks_in_mud(match, Novice(late)) == 0
    assert match.state.robots[0].score == 1


def test_the_same_novice_without_help_spends_a_quarter_of_the_time_in_the_mud():
    assert ticks_in_mud(alone(), Novice(18, helped=False), 600) > 150


@pytest.mark.parametrize("stick", [(0.0, 0.0), (0.0, 1.0), (0.0, -0.5), (-1.0, 0.3), (-0.2, 0.0)])
@pytest.mark.parametrize("aside", [0.0, 95.0, 160.0])
def test_across_the_course_nothing_changes_without_the_forward_stick(stick, aside):
    assert helped_stick(placed(400.0, aside, 1.2), 0, *stick) == stick


@pytest.mark.parametrize("aside", [0.0, 95.0, 160.0])
def test_a_released_stick_stays_released(aside):
    assert helped_stick(placed(400.0, aside), 0, 0.0, 0.0) == (0.0, 0.0)


def test_along_the_course_reverse_slows_down_and_a_turn_rolls_on():
    linear, angular = helped_stick(placed(600.0, 0.0), 0, -1.0, 0.3)
    assert 0.3 < linear <= 0.5
    assert angular > 0.0
    linear, angular = helped_stick(placed(600.0, 0.0), 0, 0.0, -1.0)
    assert 0.8 < linear <= 1.0
    assert angular < 0.0


def test_who_stands_along_the_course_drives_back_slowly():
    state = placed(400.0, 0.0)
    state.robots[0].linear = 0.0
    assert helped_stick(state, 0, -1.0, 0.3) == pytest.approx((-0.3, 0.3))


def test_who_strays_cannot_turn_still_farther_away_but_back():
    away, back = (helped_stick(placed(600.0, 0.0, 0.85), 0, 1.0, turn)[1] for turn in (1.0, -1.0))
    assert away < 0.0
    assert back < -0.8


@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize("track", TRACKS)
def test_keys_at_random_get_half_as_far_with_help_as_a_beginner_without(track):
    """Laps in two minutes, mean of four races, beside three robots of level 1."""
    everybody = (("masher", True), ("masher", False), ("beginner", False))
    laps = {one: mean(driven(track, *one, seed) for seed in range(4)) for one in everybody}
    assert laps["masher", True] > 0.5 * laps["beginner", False]
    assert laps["masher", False] < 0.2


class Helped:
    """One of the people, with or without help."""

    def __init__(self, brain, helped):
        self.brain, self.helped = brain, helped

    def think(self, state, seat):
        self.brain.think(state, seat)
        action = state.actions[seat]
        if self.helped:
            linear, angular = helped_stick(state, seat, action.linear, action.angular)
            set_action(action, linear, angular, action.fire, action.turbo)


def driven(track, name, helped, seed):
    match = match_of("race", [name, *["level1"] * 3], track, 10.0, seed, "standard", 9)
    match.sit(0, Helped(BrainPlayer(MASHER, ROBOTS * seed) if name == MASHER.name else match.brains[0], helped))
    racer = match.state.racers[0]
    while match.seconds < 120.0 and not racer.finished:
        match.tick()
    return racer.progress / match.state.course.length * 120.0 / match.seconds


def test_the_help_is_weak_in_the_middle_and_strong_at_the_edge():
    """On a straight, with the stick towards the left edge."""
    turns = [helped_stick(placed(600.0, aside), 0, 1.0, -1.0)[1] for aside in (0.0, -60.0, -95.0)]
    assert turns == sorted(turns)
    assert turns[0] < -0.5
    assert turns[2] > -0.2


def test_the_help_fades_with_the_forward_stick():
    changes = [abs(helped_stick(placed(600.0, -90.0), 0, linear, -0.5)[1] + 0.5) for linear in (0.01, 0.5, 1.0)]
    assert changes == sorted(changes)
    assert changes[0] < 0.02


@pytest.mark.parametrize("turn", [pi, 2.2, -2.2])
def test_a_person_who_turns_round_is_left_alone(turn):
    assert helped_stick(placed(600.0, 90.0, turn), 0, 1.0, 0.4) == (1.0, 0.4)


@pytest.mark.parametrize("field", ["missed", "finished"])
def test_the_way_back_to_a_line_and_the_finish_are_left_alone(field):
    state = placed(600.0, 90.0)
    setattr(state.racers[0], field, 1)
    assert helped_stick(state, 0, 1.0, 0.4) == (1.0, 0.4)


def test_the_stick_stays_in_its_range_and_the_race_is_not_changed():
    for along in range(0, 3600, 200):
        state = placed(float(along), -90.0, 0.6)
        before = digest(state)
        for angular in (-1.0, 0.0, 1.0):
            linear, turn = helped_stick(state, 0, 1.0, angular)
            assert 0.0 < linear <= 1.0
            assert -1.0 <= turn <= 1.0
        assert digest(state) == before


def test_a_helped_person_drives_by_the_helped_stick_of_the_style():
    state, stick = placed(600.0, -90.0), StickState(0.5, 0.75, False, True)
    for name, style in ((HELPED_TURN, AIS["race"].driving[TURN]), (HELPED_POINT, AIS["race"].driving[POINT])):
        HumanPlayer(lambda: stick, AIS["race"].driving[name]).think(state, 0)
        action = state.actions[0]
        expected = helped_stick(state, 0, *style(state, 0, stick))
        assert (action.linear, action.angular) == tuple(map(quantise, expected))
        assert (action.linear, action.angular) != tuple(map(quantise, style(state, 0, stick)))
        assert (action.fire, action.turbo) == (0, 1)
