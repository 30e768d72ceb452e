"""The network's inputs, checked against matches; alike on either side; its rewards; and the one that ships."""

from math import cos, hypot, pi, sin

import pytest

from pigaming_app.ai.explanations.registry import thoughts_of
from pigaming_app.ai.learning.league import duel
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.networks.files import brain_of
from pigaming_app.ai.networks.policy import Handicap
from pigaming_app.ai.registry import AIS, BRAINS, make_brain
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.record import digest
from pigaming_football.ai import NET
from pigaming_football.network import BALL, ENCODING, FAR, FEET, GOALS, MATCH, OTHER, OTHERS, PLACE, SIZE
from pigaming_football.training import FIELD, LEAD, LOST, NEARNESS, TASK, TIED, WON
from tests.ai.networks.random_network import random_network
from tests.football.pitch import match, put_ball, put_robot, setup, state
from tests.matches import match_of, run

needs_numba = pytest.mark.skipif(not can_compile(), reason="needs the extra train")


def inputs_of(football, seat, **habits):
    """What a network on a seat sees, -1 to 1."""
    senses, inputs = ENCODING.senses(), [0.0] * SIZE
    for name, value in habits.items():
        setattr(senses, name, value)
    ENCODING.encode(football, seat, senses, inputs)
    assert all(-UNIT <= value <= UNIT and value == int(value) for value in inputs)
    return [value / UNIT for value in inputs]


def test_everything_is_seen_where_it_is():
    football = match_of("football", ["hand3"] * 4, "bumpers", 2.0, 4, "party")
    found, side = {"held": 0, "free": 0, "out": 0}, (1.0, -1.0)
    while football.state.tick < 2500:
        football.tick()
        now, seat = football.state, football.state.tick % 4
        if now.tick % 7:
            continue
        me, ball, seen = now.robots[seat], now.ball, inputs_of(now, seat)
        c, s = cos(me.heading), sin(me.heading)

        def place(distance, along, across, me=me, c=c, s=s):
            return me.x + distance * (along * c - across * s), me.y + distance * (along * s + across * c)

        x, y = place(200.0 / seen[BALL + 2] - 200.0, *seen[BALL : BALL + 2])
        assert hypot(x - ball.x, y - ball.y) < 0.02 * hypot(ball.x - me.x, ball.y - me.y) + 3.0
        assert seen[PLACE] == pytest.approx(side[seat % 2] * (me.x / 800.0 - 1.0), abs=0.01)
        assert seen[FEET] == (ball.holder == seat + 1)
        away = [hypot(robot.x - me.x, robot.y - me.y) for robot in now.robots]
        mates, others = ([k for k in range(4) if k != seat and k % 2 == team] for team in (seat % 2, 1 - seat % 2))
        order = (*mates, *sorted(others, key=away.__getitem__))
        for k, j in zip(range(OTHERS, OTHERS + 3 * OTHER, OTHER), order, strict=True):
            x, y = place(FAR * (1.0 - seen[k + 4]), *seen[k + 1 : k + 3])
            if away[j] < 1.9 * FAR:
                assert hypot(x - now.robots[j].x, y - now.robots[j].y) < 12.0
        goal_x = 1600.0 if seat % 2 == 0 else 0.0
        x, y = place(800.0 * (1.0 - seen[GOALS + 2]), *seen[GOALS : GOALS + 2])
        if seen[GOALS + 2] > -1.0:
            assert hypot(x - goal_x, y - 450.0) < 10.0
        found["held" if ball.holder else "out" if ball.out else "free"] += 1
    assert all(found.values()), found


def test_a_pitch_turned_by_half_a_circle_looks_the_same_from_the_other_side():
    poses = ((300.0, 200.0, 0.4), (1100.0, 600.0, 2.9), (700.0, 700.0, -1.3), (1300.0, 300.0, 3.5))
    one, other = state("bumpers"), state("bumpers")
    for k, (x, y, heading) in enumerate(poses):
        put_robot(one, k, x, y, heading=heading)
        put_robot(other, k ^ 1, 1600.0 - x, 900.0 - y, heading=heading + pi)
        one.players[k].dx, one.players[k].dy = 2.0, -1.0
        other.players[k ^ 1].dx, other.players[k ^ 1].dy = -2.0, 1.0
    put_ball(one, 520.0, 330.0, 300.0, -120.0)
    put_ball(other, 1080.0, 570.0, -300.0, 120.0)
    one.robots[0].score, other.robots[1].score = 2, 2
    for k in range(4):
        assert inputs_of(one, k) == pytest.approx(inputs_of(other, k ^ 1), abs=1.5 / UNIT)
    assert inputs_of(one, 0)[MATCH] == -inputs_of(one, 1)[MATCH] > 0.0


def test_late_eyes_see_ball_and_robots_where_they_were():
    football = state()
    put_robot(football, 0, 400.0, 450.0)
    put_robot(football, 1, 800.0, 450.0)
    football.players[1].dy = 4.0  # 200 px/s
    put_ball(football, 600.0, 450.0, 0.0, 500.0)
    seen, late = inputs_of(football, 0), inputs_of(football, 0, delay=0.2)
    assert seen[BALL + 1] == 0.0
    assert late[BALL + 1] == pytest.approx(-100.0 / hypot(200.0, 100.0), abs=0.01)
    assert late[OTHERS + OTHER + 2] == pytest.approx(-40.0 / hypot(400.0, 40.0), abs=0.01)


def test_rewards_are_those_of_the_own_side():
    football = state()
    for x, better in ((300.0, 1), (800.0, None), (1300.0, 0)):
        put_ball(football, x, 450.0)
        gauges = [[0.0] * 6 for _ in range(4)]
        for seat in range(4):
            TASK.gauge(football, seat, None, gauges[seat])
        assert gauges[0] == gauges[2]
        assert gauges[0][FIELD] == pytest.approx(-gauges[1][FIELD])
        if better is not None:
            assert gauges[better][FIELD] > 0.2
        assert 0.0 <= gauges[0][NEARNESS] <= 1.0
    football.robots[3].score = 1
    football.over = 1
    gauges = [[0.0] * 6, [0.0] * 6]
    for seat in (0, 1):
        TASK.gauge(football, seat, None, gauges[seat])
    assert [one[LEAD] for one in gauges] == [-1, 1]
    assert [one[WON] - one[LOST] for one in gauges] == [-1.0, 1.0]
    assert not any(one[TIED] for one in gauges)


@needs_numba
@pytest.mark.again  # both bodies: test_every_game.py; networks: ai/networks
@pytest.mark.long
def test_both_bodies_play_the_same_match_to_the_last_bit():
    one, two = (brain_of(random_network(seed, "football", handicap=Handicap(0.1, 0.1, 0.8))) for seed in (1, 2))
    setups = [setup(arena, variant=variant) for arena, variant in (("bumpers", "party"), ("small_goals", "cup"))]
    plain, fast = (Batch(setups, [one, two, BRAINS["football"]["hand3"], NET], fast) for fast in (False, True))
    for batch in (plain, fast):
        batch.play(400)
    assert [digest(row) for row in fast.matches] == [digest(football) for football in plain.matches]
    for rows, minds in zip(fast.minds, plain.minds, strict=True):
        assert [digest(row) for row in rows] == [digest(mind) for mind in minds]


def test_the_network_that_ships_is_offered_and_explains_itself():
    assert "net" in AIS["football"].rivals
    football = match()
    football.sit(0, make_brain("football", "net", 1))
    run(football, 120)
    told = thoughts_of(football, 0)
    assert told is not None
    assert told.heads.keys() == {"drive", "turn", "kick", "turbo"}
    assert {sight.kind for sight in told.percepts}


@pytest.mark.again
@needs_numba
@pytest.mark.long
@pytest.mark.parametrize("arena", ["classic", "bumpers", "small_goals"])
def test_the_network_that_ships_beats_level_5(arena):
    result = duel("football", "net", "level5", 60, 1, 2.0, arena)
    assert result.wins >= 54
