"""Goals, own goals, kick-offs, catches, shots, dropped balls, and the golden goal."""

from math import hypot

import pytest

from pigaming_app.games.match import Match, standings
from pigaming_app.sim.contact import drive
from pigaming_football import GAME
from pigaming_football.rules import judge
from tests.football.pitch import ARENAS, goals_of, overlap, put_ball, put_robot, setup, state


def advance(football, ticks, fire=()):
    """Ticks with FIRE down for some seats."""
    for _ in range(ticks):
        for k in range(4):
            football.actions[k].fire = int(k in fire)
        judge(football)
        drive(football)


def shot_at(side, y=450.0, by=0, speed=900.0, **named):
    """A state in which the ball, last touched by a robot, is about to cross the line of a goal."""
    football = state(**named)
    put_ball(football, 40.0 if side == 0 else 1560.0, y, -speed if side == 0 else speed)
    football.ball.touched = by + 1
    return football


@pytest.mark.parametrize(("side", "by"), [(1, 0), (1, 2), (0, 1), (0, 3)])
def test_a_goal_counts_for_the_robot_that_touched_the_ball_last(side, by):
    football = shot_at(side, by=by)
    advance(football, 5)
    assert [robot.score for robot in football.robots] == [int(k == by) for k in range(4)]
    assert [player.goals for player in football.players] == [int(k == by) for k in range(4)]
    assert (football.goals, football.goal_side) == (1, side)


def test_an_own_goal_counts_for_the_other_team():
    football = shot_at(0, by=2)
    advance(football, 5)
    assert (goals_of(football, 0), goals_of(football, 1)) == (0, 1)
    assert football.players[2].own_goals == 1
    assert not any(player.goals for player in football.players)


def test_a_deflected_shot_counts_for_the_shooter():
    football = shot_at(0, by=2)
    football.ball.before = 1 + 3
    advance(football, 5)
    assert football.robots[3].score == 1
    assert football.players[2].own_goals == 1


def test_a_pass_before_a_goal_is_an_assist():
    football = shot_at(1, by=0)
    football.ball.before = 1 + 2
    advance(football, 5)
    assert (football.players[0].goals, football.players[2].assists) == (1, 1)
    football = shot_at(1, by=0)
    football.ball.before = 1 + 1
    advance(football, 5)
    assert not any(player.assists for player in football.players)


def test_alone_nobody_scores_in_the_own_goal():
    football = shot_at(0, by=0, present=(0,))
    advance(football, 5)
    assert (football.goals, football.robots[0].score, football.players[0].own_goals) == (1, 0, 1)


@pytest.mark.parametrize("arena", ARENAS)
@pytest.mark.parametrize("side", [0, 1])
def test_a_ball_beside_the_goal_is_no_goal(arena, side):
    half = state(arena).mouth
    for off in (half - 1.0, half + 1.0, half + 15.0, -half - 5.0):
        football = shot_at(side, 450.0 + off, arena=arena)
        advance(football, 5)
        assert football.goals == 0, "it hits the post"
        assert overlap(football) < 1e-6
    for off in (0.0, half - 23.0, 23.0 - half):
        football = shot_at(side, 450.0 + off, arena=arena)
        advance(football, 5)
        assert football.goals == 1


@pytest.mark.parametrize("side", [0, 1])
def test_the_kick_off_rolls_to_the_team_that_conceded(side):
    football = shot_at(side, by=1 - side)
    advance(football, 5)
    began = football.ball.out
    assert (football.ball.x, football.ball.y) == (800.0, 450.0)
    places = [(robot.x, robot.y) for robot in football.robots]
    advance(football, began)
    assert not football.ball.out
    assert places == [(robot.x, robot.y) for robot in football.robots], "robots play on from where they are"
    assert football.ball.vx == (-220.0 if side == 0 else 220.0)
    advance(football, 100)
    assert (football.ball.x - 800.0) * (1 if side else -1) == pytest.approx(220.0**2 / 400.0, abs=5.0)


def test_the_ball_returns_beside_a_robot_that_stands_in_the_middle():
    football = shot_at(0, by=1)
    put_robot(football, 2, 800.0, 450.0)
    advance(football, 5 + football.rules.celebration)
    assert not football.ball.out
    assert 58.0 <= hypot(football.ball.x - 800.0, football.ball.y - 450.0) < 75.0


def test_fire_catches_the_ball_at_the_front_and_shoots_it_on_release():
    football = state(present=(0,))
    put_robot(football, 0, 400.0, 450.0)
    put_ball(football, 465.0, 450.0)
    advance(football, 1)
    assert football.ball.holder == 0
    advance(football, 30, fire=(0,))
    ball = football.ball
    assert ball.holder == 1
    assert ball.x - football.robots[0].x == pytest.approx(59.0, abs=0.1)
    charge = ball.charge
    advance(football, 1)
    assert ball.holder == 0
    assert ball.vx == pytest.approx(380.0 + 470.0 * (charge + 1) / 40.0)
    assert football.players[0].shots == 1


def test_the_longer_the_charge_the_harder_the_shot():
    speeds = []
    for held in (1, 20, 40, 80):
        football = state(present=(0,))
        put_robot(football, 0, 400.0, 450.0)
        put_ball(football, 465.0, 450.0)
        advance(football, held + 1, fire=(0,))
        advance(football, 1)
        speeds.append(football.ball.vx)
    assert speeds == sorted(speeds)
    assert speeds[0] < 420.0
    assert speeds[2] == speeds[3] == pytest.approx(850.0)


@pytest.mark.parametrize("variant", GAME.variants)
@pytest.mark.parametrize("lead", range(-3, 3))
@pytest.mark.parametrize("own_goal", [False, True])
def test_a_goal_of_the_team_behind_counts_two_but_not_by_the_cup_rules(variant, lead, own_goal):
    """Its own goal counts for the others, who are behind if it leads."""
    football = shot_at(1, by=1 if own_goal else 0, variant=variant)
    football.ball.worth = 1
    football.robots[2 if lead > 0 else 3].score += abs(lead)
    advance(football, 5)
    points = 2 if lead < 0 and variant != "cup" else 1
    assert goals_of(football, 0) - goals_of(football, 1) == lead + points
    assert football.goals == 1


def test_a_ball_held_for_two_seconds_is_shot_and_not_caught_again_before_the_button_was_up():
    football = state(present=(0,))
    put_robot(football, 0, 1200.0, 200.0)
    put_ball(football, 1265.0, 200.0)
    advance(football, 1 + 100, fire=(0,))
    assert football.players[0].shots == 1
    for _ in range(200):
        put_ball(football, 1265.0, 200.0)
        advance(football, 1, fire=(0,))
        assert football.ball.holder == 0
    advance(football, 1)
    put_ball(football, 1265.0, 200.0)
    advance(football, 2, fire=(0,))
    assert football.ball.holder == 1


@pytest.mark.parametrize(("x", "y"), [(535.0, 450.0), (600.0, 385.0), (600.0, 515.0)])
def test_a_ball_behind_or_beside_a_robot_is_not_caught(x, y):
    football = state(present=(0,))
    put_robot(football, 0, 600.0, 450.0)
    put_ball(football, x, y)
    advance(football, 20, fire=(0,))
    assert football.ball.holder == 0


def test_a_fast_ball_is_caught_at_the_front():
    football = state(present=(0,))
    put_robot(football, 0, 400.0, 450.0)
    put_ball(football, 1400.0, 450.0, -5000.0)
    advance(football, 1)
    advance(football, 30, fire=(0,))
    assert football.ball.holder == 1


def test_an_opponent_takes_the_ball_by_bumping_into_it():
    football = state(present=(0, 1))
    put_robot(football, 0, 400.0, 450.0)
    put_ball(football, 465.0, 450.0)
    advance(football, 5, fire=(0,))
    assert football.ball.holder == 1
    put_robot(football, 1, 460.0, 530.0)
    for _ in range(10):
        robot = football.robots[1]
        robot.y -= 5.0
        for k in (0, 1):
            football.actions[k].fire = int(k == 0)
        judge(football)
    assert football.ball.holder == 0
    assert football.ball.touched == 2
    assert football.ball.vy < 0.0


def test_a_robot_that_is_carried_away_loses_the_ball():
    football = state(present=(0,))
    put_robot(football, 0, 400.0, 450.0)
    put_ball(football, 465.0, 450.0)
    advance(football, 5, fire=(0,))
    football.robots[0].x = 1000.0
    advance(football, 1, fire=(0,))
    assert football.ball.holder == 0
    assert football.ball.x == pytest.approx(459.0, abs=1.0)


@pytest.mark.parametrize(("x", "y"), [(60.0, 160.0), (1540.0, 160.0), (900.0, 878.0), (300.0, 22.0)])
def test_a_ball_that_rests_in_reach_of_nobody_is_dropped_at_the_nearest_drop_point(x, y):
    football = state(present=(0, 1))
    put_robot(football, 0, 800.0, 400.0)
    put_robot(football, 1, 800.0, 500.0)
    put_ball(football, x, y)
    advance(football, 249)
    assert not football.ball.out
    advance(football, 2)
    assert football.ball.out
    spots = [(spot.x, spot.y) for spot in football.drops[: football.drop_count]]
    nearest = min(hypot(a - x, b - y) for a, b in spots)
    assert hypot(football.ball.x - x, football.ball.y - y) == pytest.approx(nearest)
    advance(football, 51)
    assert not football.ball.out


def test_a_ball_in_reach_is_left_alone_but_not_for_ever():
    football = state(present=(0, 1))
    put_robot(football, 0, 700.0, 450.0)
    put_ball(football, 780.0, 450.0)
    advance(football, 449)
    assert not football.ball.out
    advance(football, 2)
    assert football.ball.out
    assert hypot(football.ball.x - 780.0, football.ball.y - 450.0) >= 150.0


def test_four_robots_cannot_block_all_drop_points():
    football = state()
    for k in range(4):
        spot = football.drops[k]
        put_robot(football, k, spot.x, spot.y)
    put_ball(football, 900.0, 600.0)
    football.ball.still = football.rules.jammed
    advance(football, 1)
    assert football.ball.out
    assert (football.ball.x, football.ball.y) in [(s.x, s.y) for s in football.drops[4 : football.drop_count]]


@pytest.mark.parametrize("variant", GAME.variants)
def test_the_next_goal_wins_a_level_match(variant):
    football = state(variant=variant)
    football.tick = football.rules.ticks - 1
    advance(football, 10)
    assert not football.over
    assert football.golden_goal
    put_ball(football, 1560.0, 450.0, 900.0)
    football.ball.touched, football.ball.out = 1, 0
    advance(football, 5)
    assert football.over
    assert standings(GAME, football)[1] == (0, 2)


def test_a_match_that_stays_level_ends_as_a_tie_a_minute_later():
    football = state(present=(0, 1))
    football.tick = football.rules.ticks - 1
    advance(football, 3002)
    assert football.over
    assert football.tick == football.rules.ticks + 3000
    assert standings(GAME, football)[1] == ()


def test_a_decided_match_ends_in_time():
    football = state()
    football.robots[1].score = 1
    football.tick = football.rules.ticks - 1
    advance(football, 1)
    assert football.over
    assert not football.golden_goal


def test_a_golden_ball_counts_two_by_the_party_rules_alone():
    worths = {variant: {state(variant=variant, seed=s).ball.worth for s in range(40)} for variant in GAME.variants}
    assert worths == {"standard": {1}, "cup": {1}, "party": {1, 2}}
    football = shot_at(1, by=0, variant="party")
    football.ball.worth = 2
    advance(football, 5)
    assert football.robots[0].score == 2
    assert football.players[0].goals == 1
    football = shot_at(1, by=0, variant="party")
    football.ball.worth, football.robots[1].score = 2, 1
    advance(football, 5)
    assert football.robots[0].score == 2, "also for a team that is behind"


@pytest.mark.parametrize("teams", [(0, 0, 1, 1), (0, 1, 0, 1), (1, 0, 0, 1), (1, 1, 0, 0)])
def test_each_team_starts_before_its_own_goal(teams):
    football = Match(setup(teams=teams)).state
    assert [robot.x < 800.0 for robot in football.robots] == [team == 0 for team in teams]
    assert len({(robot.x, robot.y) for robot in football.robots}) == 4
