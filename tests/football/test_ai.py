"""The footballer: it scores, keeps, plays alike on either side, and each level beats the one below."""

from itertools import pairwise
from math import hypot
from random import Random

import pytest

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.learning.league import duel
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import BRAINS, make_brain
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_football.overlaps import is_free
from tests.cases import one_in
from tests.football.pitch import ARENAS, goals_of, match, put_ball, put_robot, setup
from tests.matches import run

AS_PLAYED = 2.0  # minutes
needs_numba = pytest.mark.skipif(not can_compile(), reason="needs the extra train")


def with_brains(football, **brains):
    for seat, name in brains.items():
        football.sit(int(seat[1:]), make_brain("football", name, 5))
    return football


@pytest.mark.parametrize("level", one_in(2, LEVELS))
def test_alone_every_level_finds_the_goal(level):
    """In nine minutes of ten: the lowest two are hasty, but nobody is in a hurry without an opponent."""
    scored, own = [], []
    for seed in range(20):
        football = match(present=(0,), seed=seed)
        football.sit(0, make_brain("football", level, seed))
        run(football, 60 * 50)
        scored.append(goals_of(football.state, 0))
        own.append(football.state.players[0].own_goals)
    assert sum(goals > 0 for goals in scored) >= 18
    assert sum(own) <= len(own)


@pytest.mark.parametrize("cases", [24, pytest.param(60, marks=[pytest.mark.long, pytest.mark.again])])
@pytest.mark.parametrize("arena", ARENAS)
def test_alone_it_reaches_a_ball_wherever_it_lies(arena, cases):
    """Also one that lies against a bumper or in a corner, and from wherever it stands."""
    chance, slow = Random(2), []
    for case in range(cases):
        football = with_brains(match(arena, present=(case % 2,)), **{f"p{case % 2}": "hand3"})
        state = football.state
        x, y = chance.uniform(36.0, 1564.0), chance.uniform(36.0, 864.0)
        while in_wall(state, x, y):
            x, y = chance.uniform(36.0, 1564.0), chance.uniform(36.0, 864.0)
        put_robot(state, case % 2, x, y, heading=chance.uniform(0.0, 6.2))
        lies_against_something(state, chance)
        state.ball.out = 0
        at = state.ball.x, state.ball.y
        while not state.ball.touched and state.tick < 500:
            football.tick()
        if not state.ball.touched:
            slow.append((x, y, *at))
    assert not slow


@pytest.mark.parametrize(
    ("pose", "ball"),
    [
        ((459.0, 591.0, 1.79), (800.0, 700.0)),
        ((457.0, 609.0, 1.59), (800.0, 700.0)),
        ((480.0, 352.0, 1.2), (1200.0, 170.0)),
    ],
)
def test_it_keeps_to_one_way_round_a_bumper_and_the_ball_behind_it(pose, ball):
    """Both ways are about as long, and it has to turn round the ball on either."""
    football = with_brains(match("bumpers", present=(1,)), p1="hand3")
    state = football.state
    put_robot(state, 1, pose[0], pose[1], heading=pose[2])
    put_ball(state, *ball)
    state.ball.out = 0
    while not state.ball.touched and state.tick < 350:
        football.tick()
    assert state.ball.touched == 2


def lies_against_something(state, chance):
    """Put the ball down at random, against a wall, but not behind that of a corner."""
    while True:
        x, y = chance.uniform(22.0, 1578.0), chance.uniform(22.0, 878.0)
        gaps = [hypot(*offset_from_wall(wall, x, y)) - wall.half for wall in state.walls[: state.wall_count]]
        if is_free(state, x, y) and min(gaps) < 23.0 and min(x, 1600.0 - x) + min(y, 900.0 - y) > 130.0:
            put_ball(state, x, y)
            return


def test_a_keeper_stops_what_an_empty_goal_lets_in():
    conceded = {}
    for keeper in (False, True):
        conceded[keeper] = 0
        for y in (380.0, 410.0, 450.0, 490.0, 520.0):
            football = with_brains(match(present=(0, 2) if keeper else ()), **({"p0": "level5"} if keeper else {}))
            state = football.state
            state.ball.out = 0
            if keeper:
                put_robot(state, 0, 90.0, 450.0, heading=1.57)
                put_robot(state, 2, 1200.0, 800.0)
            put_ball(state, 900.0, 450.0, -700.0, 700.0 * (y - 450.0) / 900.0)
            run(football, 120)
            conceded[keeper] += goals_of(state, 1) + (state.goals if not keeper else 0)
    assert conceded[False] == 5
    assert conceded[True] <= 1


@pytest.mark.long
@pytest.mark.again
@needs_numba
@pytest.mark.parametrize("arena", ARENAS)
def test_a_team_that_plays_together_does_not_leave_its_goal_empty(arena):
    """A second before a goal, one of those who conceded it is within 450 px of their goal's middle."""
    setups = [setup(arena, minutes=3.0, seed=seed) for seed in range(15)]
    batch = Batch(setups, [BRAINS["football"]["level5"]] * 4, True)
    before: list[list[list[tuple[float, float]]]] = []  # by sample, match and seat
    conceded = empty = 0
    goals = [0] * len(setups)
    for _ in range(3 * 60 * 5):
        batch.play(10)
        places = [[(float(robot["x"]), float(robot["y"])) for robot in row["robots"]] for row in batch.matches]
        before = [*before[-5:], places]
        for i, row in enumerate(batch.matches):
            if row["goals"] > goals[i] and len(before) == 6:
                side = int(row["goal_side"])
                conceded += 1
                empty += all(hypot(x - 1600.0 * side, y - 450.0) > 450.0 for x, y in before[0][i][side::2])
            goals[i] = int(row["goals"])
    assert conceded > 30
    assert empty <= 0.1 * conceded


def test_nobody_stands_still_for_long():
    """In a minute of a match between two teams somebody always drives, and the ball comes nearly everywhere."""
    football = with_brains(match(minutes=1.0), p0="level5", p1="level5", p2="level5", p3="level5")
    rest, longest, parts = 0, 0, set()
    while not football.over:
        football.tick()
        state = football.state
        rest = 0 if any(abs(robot.linear) > 20.0 for robot in state.robots) else rest + 1
        longest = max(longest, rest)
        parts.add((int(state.ball.x / 400.0), int(state.ball.y / 450.0)))
    assert longest < 100
    assert len(parts) >= 6


@needs_numba
@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize(("lower", "upper"), [*pairwise(LEVELS)])
def test_each_level_beats_the_one_below(lower, upper):
    result = duel("football", upper, lower, 100, 1, AS_PLAYED)
    assert result.wins / (result.wins + result.losses) >= 0.65


@needs_numba
@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize("level", ["level1", "level3", "level5"])
@pytest.mark.parametrize("arena", ["classic", "bumpers", "small_goals"])
def test_sides_are_even_and_goals_neither_rare_nor_cheap(arena, level):
    setups = [setup(arena, minutes=AS_PLAYED, seed=seed) for seed in range(100)]
    batch = Batch(setups, [BRAINS["football"][level]] * 4, True)
    batch.play(round((AS_PLAYED + 1.0) * 3000))
    points = [[sum(int(row["robots"][k]["score"]) for k in side) for side in ((0, 2), (1, 3))] for row in batch.matches]
    wins = [sum(one > other for one, other in points), sum(one < other for one, other in points)]
    assert 2.0 <= sum(int(row["goals"]) for row in batch.matches) / len(points) <= 8.0
    assert abs(wins[0] - wins[1]) <= 3.0 * sum(wins) ** 0.5, "three standard deviations of a fair coin"
