"""The ball: never in a wall, a robot or nowhere; through nothing at any speed; off nothing faster than it should be."""

import random
from copy import copy as shallow
from functools import cache
from math import cos, hypot, pi, sin
from random import Random

import pytest

from pigaming_app.sim.arena import WallSpec
from pigaming_app.sim.arena import _add_wall as add_wall
from pigaming_app.sim.contact import drive, in_wall
from pigaming_app.sim.kernel import compiled
from pigaming_app.sim.record import copy, digest, packed
from pigaming_app.sim.world import DT
from pigaming_football.contacts import reflect
from pigaming_football.physics import note_steps
from pigaming_football.rules import judge, move
from pigaming_football.state import Ball, Football
from tests.floor import from_wall
from tests.football.pitch import ARENAS, BALL, ROBOT, overlap, put_ball, put_robot, state

SLOP = 2e-6  # px
ABSURD = 1e7  # px/s: 125 arenas in a tick
SPEEDS = (600.0, 20_000.0, ABSURD)
SEARCHES = [400, pytest.param(3000, marks=pytest.mark.long)]  # random moments
STEP = 16.0  # px of a robot in a tick, along each axis


def number(*limits):
    """A random number within one of these limits on either side of 0; one in ten is a limit or 0 itself."""
    limit = random.choice(limits)
    return random.uniform(-limit, limit) if random.random() < 0.9 else random.choice((-limit, 0.0, limit))


def place(radius) -> tuple[float, float]:
    """A random place where the rim leaves this radius free."""
    x, y = (random.uniform(radius, end - radius) for end in (1600.0, 900.0))
    return x, y


fresh = cache(state)


def in_play(*arguments, **named):
    """As `state`, in a thousandth of a second less: walls and rules are those of other states."""
    football = shallow(fresh(*arguments, **named))
    football.ball = copy(football.ball)
    for name in ("players", "robots", "actions"):
        setattr(football, name, [copy(part) for part in getattr(football, name)])
    return football


def moment():
    """Any moment: robots that have moved, also into the ball, and a ball of any velocity that was free before that."""
    football = in_play(random.choice(ARENAS), variant=random.choice(("standard", "party")))
    for k in range(4):
        x, y = place(ROBOT)
        while in_wall(football, x, y):
            x, y = place(ROBOT)
        put_robot(football, k, x - number(STEP), y - number(STEP))  # first where it was
        football.actions[k].fire = random.randrange(2)
        football.robots[k].heading = random.uniform(0.0, 2.0 * pi)
    put_ball(football, *place(BALL), number(*SPEEDS), number(*SPEEDS))
    while overlap(football) > 0.0:
        football.ball.x, football.ball.y = place(BALL)
    for k in range(4):
        player, robot = football.players[k], football.robots[k]
        x, y = (
            min(max(robot.x + number(STEP), ROBOT), 1600.0 - ROBOT),
            min(max(robot.y + number(STEP), ROBOT), 900.0 - ROBOT),
        )
        if not in_wall(football, x, y):
            robot.x, robot.y = x, y
        assert hypot(robot.x - player.last_x, robot.y - player.last_y) < 26.0
    return football


@pytest.mark.parametrize("count", SEARCHES)
def test_no_ball_is_ever_in_a_wall_or_a_robot(count):
    for _ in range(count):
        football = moment()
        note_steps(football)
        fast = hypot(football.ball.vx, football.ball.vy)
        move(football)
        if not football.ball.out:
            assert overlap(football) <= SLOP
            hits = 12 * 2.0 * 16.0 * 1.5 / DT  # of robots, each at most twice its speed
            assert hypot(football.ball.vx, football.ball.vy) <= fast + hits


def test_no_ball_is_ever_in_a_wall_or_a_robot_whatever_happens():
    """Robots that chase, hold and squeeze the ball, which is hit by something from time to time."""
    for arena in ARENAS:
        chance, football = Random(5), state(arena)
        for tick in range(3000):
            ball = football.ball
            for k in range(4):
                robot, action = football.robots[k], football.actions[k]
                away = (ball.x - robot.x) * sin(robot.heading) - (ball.y - robot.y) * cos(robot.heading)
                action.angular = 1.0 if away < 0.0 else -1.0
                if tick % 40 == 10 * k:
                    action.fire, action.turbo = int(chance.random() < 0.4), int(chance.random() < 0.5)
                    action.linear = chance.choice((1.0, 1.0, -1.0))
            if tick % 100 == 0 and not ball.holder:
                way, speed = chance.uniform(0.0, 2.0 * pi), 10.0 ** chance.uniform(2.0, 7.0)
                ball.vx, ball.vy = speed * cos(way), speed * sin(way)
            judge(football)
            if not ball.out:
                assert overlap(football) <= SLOP, (arena, tick)
            drive(football)
        assert football.goals > 3


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_a_bounce_takes_no_time_and_gives_none(share):
    """Straight at the upper edge: the way before it and the way after it, at its slower speed, are one tick."""
    football, speed = state(present=()), 3000.0
    football.rules.friction = 0.0
    ball = football.ball
    put_ball(football, 800.0, BALL + share * speed * DT, 0.0, -speed)
    note_steps(football)
    move(football)
    slower = 0.75 * speed  # docs/football.md
    assert (ball.x, ball.vy) == pytest.approx((800.0, slower))
    assert ball.y == pytest.approx(BALL + (1.0 - share) * slower * DT, abs=1e-4)


@pytest.mark.parametrize("count", SEARCHES)
def test_no_ball_tunnels_through_a_robot(count):
    """It touches a robot, whatever the speeds, if and only if the ways of the two bring them together."""
    for _ in range(count):
        football = in_play(present=(0,))
        football.rules.friction, football.mouth = 0.0, 0.0  # a goal would hide the touch
        way, distance, off = random.uniform(0.0, 2.0 * pi), random.uniform(58.1, 300.0), random.uniform(-1.5, 1.5)
        speed, dx, dy = abs(number(*SPEEDS)), number(STEP), number(STEP)
        put_robot(football, 0, 800.0 + dx, 450.0 + dy, dx, dy)
        put_ball(football, 800.0 - distance * cos(way), 450.0 - distance * sin(way))
        ball = football.ball
        ball.vx, ball.vy = speed * cos(way + off), speed * sin(way + off)
        ex, ey = ball.vx * DT - dx, ball.vy * DT - dy  # of the ball, seen from the robot
        x, y = ball.x - 800.0, ball.y - 450.0
        free = min(1.0, 100.0 / (speed * DT + 1e-9))  # share of the tick in which it reaches no rim
        t = min(max(-(x * ex + y * ey) / (ex * ex + ey * ey + 1e-12), 0.0), 1.0)
        nearest = hypot(x + t * ex, y + t * ey)
        note_steps(football)
        move(football)
        if nearest < 58.0 - 1e-3:
            assert ball.touched == 1
        elif nearest > 58.0 + 1e-3 and free == 1.0:
            assert ball.touched == 0


@pytest.mark.parametrize("thick", [10, 30, 100])
def test_no_ball_tunnels_through_a_wall(thick):
    for seed in range(30):
        pushed_at_a_wall(seed, thick)


def pushed_at_a_wall(seed, thick):
    """A wall across the whole pitch keeps the ball on its side for ever, with robots that push it against the wall."""
    chance, football = Random(seed), state(present=(0, 2))
    add_wall(football, WallSpec(800.0, 0.0, 800.0, 900.0, thick / 2, -1))
    put_robot(football, 0, 400.0, 300.0)
    put_robot(football, 2, 400.0, 600.0)
    put_ball(football, 600.0, 450.0)
    for tick in range(60):
        ball = football.ball
        if tick % 6 == 0:
            way, speed = chance.uniform(-1.5, 1.5), 10.0 ** chance.uniform(2.0, 7.0)
            ball.vx, ball.vy = speed * cos(way), speed * sin(way)
        for k in (0, 2):  # at a speed of up to 800 px/s towards the ball
            robot = football.robots[k]
            gap = hypot(ball.x - robot.x, ball.y - robot.y)
            x, y = robot.x + 16.0 * (ball.x - robot.x) / gap, robot.y + 16.0 * (ball.y - robot.y) / gap
            if not in_wall(football, x, y):
                robot.x, robot.y = x, y
        note_steps(football)
        move(football)
        if ball.out:
            return  # a goal, or no place for it
        assert ball.x < 800.0 - thick / 2 - BALL + SLOP


def test_a_contact_separates_by_no_more_than_the_restitution():
    for _ in range(1000):
        ball, way, restitution = Ball(), random.uniform(0.0, 2.0 * pi), random.uniform(0.05, 1.0)
        ball.vx, ball.vy = vx, vy = number(*SPEEDS), number(*SPEEDS)
        ux, uy, nx, ny = number(400.0), number(400.0), cos(way), sin(way)
        before, along = (vx - ux) * nx + (vy - uy) * ny, -(vx - ux) * ny + (vy - uy) * nx
        reflect(ball, 58.0 * nx, 58.0 * ny, ux, uy, restitution)
        after, slid = (ball.vx - ux) * nx + (ball.vy - uy) * ny, -(ball.vx - ux) * ny + (ball.vy - uy) * nx
        error = 1e-14 * (abs(vx) + abs(vy) + 1000.0)
        if before >= 0.0:
            assert (ball.vx, ball.vy) == (vx, vy)
        else:
            assert after == pytest.approx(-restitution * before, abs=error)
        assert slid == pytest.approx(along, abs=error)


@pytest.mark.parametrize(("speed", "robot"), [(300.0, 0.0), (300.0, 200.0), (-100.0, 260.0), (3000.0, -100.0)])
def test_a_ball_leaves_a_robot_as_the_restitution_demands(speed, robot):
    football = state(present=(0,))
    football.rules.friction = 0.0
    put_robot(football, 0, 800.0 - robot * DT * 0.5, 450.0, -robot * DT)
    put_ball(football, 800.0 - 58.0 - 0.5 * speed * DT, 450.0, speed)
    note_steps(football)
    move(football)
    assert football.ball.vx == pytest.approx(-robot - 0.5 * (speed + robot))


def test_friction_stops_a_ball_where_mechanics_says():
    football = state(present=())
    put_ball(football, 200.0, 300.0, 500.0)
    for _ in range(400):
        move(football)
    assert football.ball.vx == football.ball.vy == 0.0
    assert football.ball.x - 200.0 == pytest.approx(500.0**2 / (2.0 * 200.0), abs=500.0 * DT)


def test_the_rules_favour_no_side():
    """The moment turned by half a circle goes on as the turned moment."""
    for _ in range(150):
        football, turned = moment(), in_play("classic")
        turned.mouth, turned.rules, turned.wall_count = football.mouth, football.rules, football.wall_count
        turned.walls, turned.grid = football.walls, football.grid
        put_ball(turned, 1600.0 - football.ball.x, 900.0 - football.ball.y, -football.ball.vx, -football.ball.vy)
        for k in range(4):
            other, robot, player = k ^ 1, football.robots[k], football.players[k]
            heading = (robot.heading + pi) % (2.0 * pi)
            put_robot(turned, other, 1600.0 - player.last_x, 900.0 - player.last_y, heading=heading)
            turned.robots[other].x, turned.robots[other].y = 1600.0 - robot.x, 900.0 - robot.y
        for both in (football, turned):
            for action in both.actions:
                action.fire = 0
            note_steps(both)
            move(both)
        assert football.goals == turned.goals
        if not football.ball.out and hypot(football.ball.vx, football.ball.vy) < 5000.0:
            assert turned.ball.x == pytest.approx(1600.0 - football.ball.x, abs=1e-6)
            assert turned.ball.y == pytest.approx(900.0 - football.ball.y, abs=1e-6)


@pytest.mark.parametrize(("x", "y"), [(22.0, 300.0), (500.0, 22.0), (800.0, 878.0), (1578.0, 700.0)])
def test_a_ball_squeezed_against_the_rim_moves_to_the_nearest_free_place(x, y):
    """A robot drives straight at the ball on the rim until it stands where the ball was."""
    football = state(present=(0,))
    put_ball(football, x, y)
    far = 200.0
    dx = (1.0 if x < 100.0 else -1.0) * (x in (22.0, 1578.0))
    dy = (1.0 if y < 100.0 else -1.0) * (x not in (22.0, 1578.0))
    put_robot(football, 0, x + far * dx, y + far * dy)
    longest = 0.0
    while far > 0.0:
        far -= 5.0
        robot, ball = football.robots[0], football.ball
        robot.x, robot.y = min(max(x + far * dx, 36.0), 1564.0), min(max(y + far * dy, 36.0), 864.0)
        at = ball.x, ball.y
        note_steps(football)
        move(football)
        longest = max(longest, hypot(ball.x - at[0], ball.y - at[1]))
        assert not ball.out
        assert overlap(football) <= SLOP
    assert longest < 120.0


def test_a_ball_that_has_no_place_is_dropped_anew():
    """Things that are moved may bury it."""
    football = state(present=())
    put_ball(football, 300.0, 450.0)
    for i in range(8):
        add_wall(football, WallSpec(100.0, 200.0 + 70.0 * i, 600.0, 200.0 + 70.0 * i, 36.0, -1))
    note_steps(football)
    move(football)
    assert football.ball.out > 0
    assert (football.ball.x, football.ball.y) in [(spot.x, spot.y) for spot in football.drops[: football.drop_count]]
    while football.ball.out:
        judge(football)
    assert overlap_of_walls(football) <= SLOP


def overlap_of_walls(football):
    walls = football.walls[: football.wall_count]
    return max(wall.half + BALL - from_wall(wall, football.ball.x, football.ball.y) for wall in walls)


@pytest.mark.again
@pytest.mark.long
def test_both_bodies_move_any_ball_alike():
    chance, every = Random(3), list[Football]()
    while len(every) < 1000:
        football = state(chance.choice(ARENAS))
        for k in range(4):
            x, y = chance.uniform(40.0, 1560.0), chance.uniform(40.0, 860.0)
            put_robot(
                football, k, x, y, chance.uniform(-16.0, 16.0), chance.uniform(-16.0, 16.0), chance.uniform(0, 6.2)
            )
            football.actions[k].fire = chance.randrange(2)
        put_ball(football, chance.uniform(22.0, 1578.0), chance.uniform(22.0, 878.0))
        way, speed = chance.uniform(0.0, 2.0 * pi), 10.0 ** chance.uniform(0.0, 7.0)
        football.ball.vx, football.ball.vy = speed * cos(way), speed * sin(way)
        every.append(football)

    def run(matches, ticks):
        for i in range(len(matches)):
            for _ in range(ticks):
                judge(matches[i])

    rows = packed(every)
    compiled(run)(rows, 20)
    run(every, 20)
    assert [digest(row) for row in rows] == [digest(football) for football in every]
