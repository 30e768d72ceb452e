"""Football matches for the tests, and an oracle for the ball that shares no code with the rules."""

from math import dist, hypot, isfinite

from pigaming_app.games.arenas import load
from pigaming_app.games.match import Match
from pigaming_football.rules import side_of
from tests.floor import from_wall
from tests.matches import setup_of

BALL, ROBOT = 22.0, 36.0  # px, radii
ARENAS = ("classic", "bumpers", "small_goals")


def setup(arena="classic", present=(0, 1, 2, 3), variant="standard", minutes=2.0, seed=1, teams=(0, 1, 0, 1)):
    brains = ["random" if k in present else "off" for k in range(4)]
    return setup_of("football", brains, arena, minutes, seed, variant, teams=teams)


def match(*arguments, **named):
    return Match(setup(*arguments, **named))


def state(*arguments, **named):
    """A match's state with the ball in play in the middle and all robots out of its way."""
    fresh = match(*arguments, **named).state
    fresh.ball.out = 0
    fresh.ball.anchor_x, fresh.ball.anchor_y = fresh.ball.x, fresh.ball.y
    return fresh


def put_robot(football, k, x, y, dx=0.0, dy=0.0, heading=0.0):
    """Put a robot at (x, y), to which it has come from (x - dx, y - dy) in this tick."""
    robot, player = football.robots[k], football.players[k]
    robot.x, robot.y, robot.heading = x, y, heading
    player.last_x, player.last_y = x - dx, y - dy


def put_ball(football, x, y, vx=0.0, vy=0.0):
    ball = football.ball
    ball.x, ball.y, ball.vx, ball.vy, ball.anchor_x, ball.anchor_y = x, y, vx, vy, x, y


def overlap(football):
    """By how many px the ball is in a wall, in a post, beyond the rim outside the goals, or in a robot; at most."""
    ball, arena = football.ball, load("football", name_of(football))
    assert all(isfinite(number) for number in (ball.x, ball.y, ball.vx, ball.vy))
    depths = [BALL - ball.y, ball.y - (900.0 - BALL), -ball.x, ball.x - 1600.0]
    half = football.mouth
    if abs(ball.y - 450.0) >= half:
        depths += [BALL - ball.x, ball.x - (1600.0 - BALL)]
    depths += [BALL - dist((ball.x, ball.y), (x, 450.0 + s * half)) for x in (0.0, 1600.0) for s in (-1, 1)]
    depths += [ROBOT + BALL - hypot(ball.x - r.x, ball.y - r.y) for r in football.robots if r.present]
    depths += [wall.half + BALL - from_wall(wall, ball.x, ball.y) for wall in arena.walls]
    return max(depths)


def name_of(football):
    """The arena of a state: they differ in their goals."""
    return {120.0: "classic", 145.0: "bumpers", 95.0: "small_goals"}[football.mouth]


def goals_of(football, side):
    return sum(robot.score for robot in football.robots if robot.present and side_of(robot) == side)
