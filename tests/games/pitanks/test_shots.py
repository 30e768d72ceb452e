"""Bullets against an exact oracle for their first contact; and bouncing bullets stay in the arena.

The oracle shares no code with the rules. The distance from a point moving on a straight line to a capsule is convex, so
ternary search finds the nearest approach, and bisection the first contact before it.
"""

from math import atan2, cos, hypot, pi, sin
from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.pitanks.rules import judge, move_bullets, use_gun
from pigaming_app.games.pitanks.state import OUTER, OWN_BULLETS, RICOCHET, TRIPLE
from pigaming_app.sim.contact import drive
from pigaming_app.sim.world import DT, HEIGHT, RADIUS, WIDTH
from tests.floor import from_segment, pitanks

BULLET, SPEED, MUZZLE = 6.0, 560.0, 64.0  # px, px/s, px: the published rules
NEVER = 2.0
DOUBT = 1e-8  # contacts closer than this in share of the way, or px from grazing, have no certain order
NOWHERE = (-9e3, -9e3, -9e3, -9e3, 1.0)  # a capsule that nothing reaches


# ---------------------------------------------------------------------------------------------------------- the oracle


def contacts(ways, capsules):
    """Time of first contact of each displacement (x, y, dx, dy) with each of its capsules (ax, ay, bx, by, reach).

    `ways` (n, 4), `capsules` (n, m, 5); NEVER without contact. Also returns by how many px each nearest approach hits.
    """
    x, y, dx, dy = (ways[:, None, i] for i in range(4))
    ax, ay, bx, by, reach = (capsules[:, :, i] for i in range(5))
    ex, ey = bx - ax, by - ay
    length2 = np.maximum(ex * ex + ey * ey, 1e-300)

    def gap(t):
        px, py = x + t * dx - ax, y + t * dy - ay
        along = np.clip((px * ex + py * ey) / length2, 0.0, 1.0)
        return np.hypot(px - along * ex, py - along * ey) - reach

    low, high = np.zeros(reach.shape), np.ones(reach.shape)
    for _ in range(80):
        a, b = low + (high - low) / 3.0, high - (high - low) / 3.0
        nearer = gap(a) <= gap(b)
        low, high = np.where(nearer, low, a), np.where(nearer, b, high)
    nearest = np.where(gap(1.0) <= gap(low), 1.0, low)
    deep = -gap(nearest)
    low, high = np.zeros(reach.shape), nearest
    for _ in range(60):
        middle = 0.5 * (low + high)
        touches = gap(middle) <= 0.0
        low, high = np.where(touches, low, middle), np.where(touches, middle, high)
    return np.where(deep >= 0.0, np.where(gap(0.0) <= 0.0, 0.0, high), NEVER), deep


def at_bounds(x, y, dx, dy):
    """Time at which a bullet touches an outer wall, as a fraction of its displacement."""
    sides = ((BULLET - x, dx), (WIDTH - BULLET - x, dx), (BULLET - y, dy), (HEIGHT - BULLET - y, dy))
    shares = [room / way for room, way in sides if way and room * way >= 0.0 and abs(room) <= abs(way)]
    return min(shares, default=NEVER)


class Shots:
    """Shots and their results by the rules, for comparison with the oracle in one batch."""

    def __init__(self):
        self.ways, self.capsules, self.names, self.found, self.where = [], [], [], [], []

    def play(self, match):
        """Fire, advance one tick, and record every bullet's displacement, its possible obstacles, and its hit."""
        for k in range(4):
            use_gun(match, k)
        ways = []
        for i, bullet in enumerate(match.bullets):
            if bullet.alive:
                seconds = DT + (MUZZLE / SPEED if bullet.fresh else 0.0)
                ways.append((i, (bullet.x, bullet.y, bullet.vx * seconds, bullet.vy * seconds)))
        move_bullets(match)
        for i, way in ways:
            bullet = match.bullets[i]
            self.ways.append(way)
            names, capsules = stops(match, i // OWN_BULLETS)
            self.names.append(names)
            self.capsules.append(capsules)
            self.found.append(bullet.struck)
            self.where.append((bullet.x, bullet.y))

    def wrong(self):
        """(number of shots that differ from the oracle, number of unambiguous shots)."""
        most = max(len(capsules) for capsules in self.capsules)
        capsules = np.array([[*one, *[NOWHERE] * (most - len(one))] for one in self.capsules])
        shares, deep = contacts(np.array(self.ways), capsules)
        differ, certain = [], 0
        for way, names, row, depths, found, (x, y) in zip(
            self.ways, self.names, shares, deep, self.found, self.where, strict=True
        ):
            order = sorted([*zip(row, names, strict=False), (at_bounds(*way), OUTER), (1.0 + DOUBT, 0)])
            (share, name), (second, _) = order[:2]
            if second - share < DOUBT or any(abs(depth) < DOUBT for depth in depths):
                continue
            certain += 1
            share = min(share, 1.0)
            off = hypot(way[0] + share * way[2] - x, way[1] + share * way[3] - y)
            if name != found or off > 1e-5:
                differ.append((way, name, found, off))
        return differ, certain


def stops(match, seat):
    """The possible obstacles of a bullet of a seat: (value of `bullet.struck`, capsule)."""
    names, capsules = [], []
    for i, wall in enumerate(match.walls[: match.wall_count]):
        if wall.health:
            names.append(-1 - i)
            capsules.append((wall.ax, wall.ay, wall.bx, wall.by, wall.half + BULLET))
    for j, robot in enumerate(match.robots):
        if robot.present and robot.team != match.robots[seat].team:
            names.append(1 + j)
            capsules.append((robot.x, robot.y, robot.x, robot.y, RADIUS + BULLET))
    return names, capsules


# ------------------------------------------------------------------------------------------------------ what is struck


def crowd(random, walls):
    """Poses of four robots, mostly crowded, clear of walls and of each other, mostly facing another robot."""
    poses: list[tuple[float, float, float]] = []
    x, y = random.uniform(40, WIDTH - 40), random.uniform(40, HEIGHT - 40)
    while len(poses) < 4:
        near = random.random() < 0.8
        px = x + random.uniform(-160, 160) if near else random.uniform(40, WIDTH - 40)
        py = y + random.uniform(-160, 160) if near else random.uniform(40, HEIGHT - 40)
        free = RADIUS <= px <= WIDTH - RADIUS and RADIUS <= py <= HEIGHT - RADIUS
        free = free and all(hypot(px - a, py - b) >= 2 * RADIUS - 2.0 for a, b, _ in poses)
        if free and all(from_segment(px, py, *wall) >= RADIUS + 15.0 for wall in walls):
            poses.append((px, py, 0.0))
    aims = []
    for i, (px, py, _) in enumerate(poses):
        ax, ay, _ = poses[(i + random.randrange(1, 4)) % 4]
        spread = random.choice((0.1, 0.6, pi))
        aims.append((px, py, (atan2(ay - py, ax - px) + random.uniform(-spread, spread)) % (2 * pi)))
    return aims


def stroke(random):
    """A random wall."""
    x, y, way, length = (
        random.uniform(0, WIDTH),
        random.uniform(0, HEIGHT),
        random.uniform(0, 2 * pi),
        random.uniform(5, 500),
    )
    return x, y, x + length * cos(way), y + length * sin(way)


@pytest.mark.parametrize(
    "teams", [pytest.param((0, 1, 2, 3), id="alone"), pytest.param((0, 1, 0, 1), id="pairs", marks=pytest.mark.long)]
)
def test_the_first_contact_of_a_shot_agrees_with_an_exact_oracle(teams):
    """Thousands of shots, mostly at point-blank range, single and triple, and bullets in flight, among walls."""
    random, shots = Random(8), Shots()
    for _ in range(220):
        walls = [stroke(random) for _ in range(6)]
        match = pitanks(crowd(random, walls), walls, teams=teams, health=2)
        for tank in match.tanks:
            tank.powers[TRIPLE] = 40 * random.randrange(2)
        for k in range(4):
            match.actions[k].fire = 1
        for tick in range(4):
            shots.play(match)
            for bullet in match.bullets:
                bullet.alive, bullet.struck = int(bullet.alive and not bullet.struck), 0
            for robot in match.robots:
                robot.requested_linear = random.choice((-260.0, 338.0))
            drive(match)
            for tank in match.tanks:
                tank.cooldown = tick % 2
    differ, certain = shots.wrong()
    assert not differ, f"{len(differ)} of {certain}"
    assert certain > 3000
    assert certain > 0.999 * len(shots.ways)


@pytest.mark.parametrize("arena", arenas("pitanks"))
def test_in_the_arenas_too(arena):
    """Robots at random positions in the shipped arenas."""
    random, shots = Random(9), Shots()
    lines = [(wall.ax, wall.ay, wall.bx, wall.by) for wall in load("pitanks", arena).walls]
    for _ in range(40):
        match = pitanks(crowd(random, lines), lines)
        for k in range(4):
            match.actions[k].fire = 1
        shots.play(match)
    differ, certain = shots.wrong()
    assert not differ, f"{len(differ)} of {certain}"
    assert certain > 130


@settings(max_examples=100, deadline=None)
@given(
    st.floats(0.0, 2 * pi),
    st.floats(2 * RADIUS - 2.0, 140.0),
    st.floats(-pi, pi),
    st.floats(-60.0, 120.0),
    st.floats(0.0, pi),
    st.sampled_from((5.0, 15.0, 40.0)),
)
def test_at_point_blank_with_a_wall_beside_the_victim(way, gap, aside, off, lean, half):
    """The shooter is at (800, 450), the victim `gap` px away; a wall lies `off` px beyond the shooter's hull."""
    x, y = 800.0 + gap * cos(way), 450.0 + gap * sin(way)
    from_wall = RADIUS + half + abs(off)
    mx, my = 800.0 + from_wall * cos(way + lean), 450.0 + from_wall * sin(way + lean)
    ux, uy = -200.0 * sin(way + lean), 200.0 * cos(way + lean)
    wall = (mx - ux, my - uy, mx + ux, my + uy)
    match = pitanks([(800.0, 450.0, (way + 0.4 * aside) % (2 * pi)), (x, y, 0.0)], [wall], half=half)
    match.actions[0].fire, match.tanks[0].powers[TRIPLE] = 1, 1
    shots = Shots()
    shots.play(match)
    assert not shots.wrong()[0]


# --------------------------------------------------------------------------------------------------- bouncing bullets


def ricochet(match, x, y, way, bounces):
    """A bouncing bullet of the first robot, in flight."""
    bullet = match.bullets[0]
    bullet.alive, bullet.x, bullet.y, bullet.bounces = 1, x, y, bounces
    bullet.vx, bullet.vy = SPEED * cos(way), SPEED * sin(way)
    return bullet


def clear_of(walls, x, y, room):
    """True if a point is at least `room` px from the centre line of every wall."""
    return all(from_segment(x, y, *wall) >= room for wall in walls)


def bounces_inside(match, walls, half, bullet, ticks):
    """Advance the match; asserts on each tick that the bullet is in free space at full speed. Returns the bounces."""
    left = bullet.bounces
    for _ in range(ticks):
        judge(match)
        assert BULLET <= bullet.x <= WIDTH - BULLET
        assert BULLET <= bullet.y <= HEIGHT - BULLET
        assert clear_of(walls, bullet.x, bullet.y, half + BULLET - 1e-6)
        assert hypot(bullet.vx, bullet.vy) == pytest.approx(SPEED)
        if not bullet.alive:
            break
    return left - bullet.bounces


@pytest.mark.parametrize("half", [5.0, 15.0, 40.0])
def test_a_bouncing_bullet_stays_in_the_arena_and_out_of_walls(half):
    """Walls that cross and graze the edge, and gaps to the edge narrower than a bullet."""
    random, bounces = Random(half), 0
    for _ in range(25):
        walls = [stroke(random) for _ in range(8)]
        for _ in range(4):
            gap, x = half + random.uniform(0.0, 2 * BULLET), random.uniform(300, 1300)
            walls.append((x, gap, x + random.uniform(-200, 200), gap + random.uniform(0.0, 300.0)))
        match = pitanks([(120.0, 110.0, 0.0)], walls, health=-1, half=half, minutes=5.0)
        x = y = 0.0
        while not (x >= BULLET and y >= BULLET and clear_of(walls, x, y, half + BULLET)):
            x, y = random.uniform(BULLET, WIDTH - BULLET), random.uniform(BULLET, HEIGHT - BULLET)
        bullet = ricochet(match, x, y, random.uniform(0, 2 * pi), 400)
        bounces += bounces_inside(match, walls, half, bullet, 400)
    assert bounces > 150


@pytest.mark.parametrize("degrees", [225, 224.9, 200, 181, 269])
@pytest.mark.parametrize("corner", [(0, 0), (1, 0), (0, 1), (1, 1)])
def test_in_a_corner_it_turns_back(corner, degrees):
    """At most two bounces, and it flies away near the diagonal."""
    way = degrees * pi / 180
    match = pitanks([(800.0, 450.0, 0.0)], minutes=5.0)
    x, y = (20.0, WIDTH - 20.0)[corner[0]], (20.0, HEIGHT - 20.0)[corner[1]]
    bullet = ricochet(match, x, y, 0.0, 8)
    bullet.vx = SPEED * cos(way) * (-1 if corner[0] else 1)
    bullet.vy = SPEED * sin(way) * (-1 if corner[1] else 1)
    assert bounces_inside(match, [], 15.0, bullet, 60) <= 2
    assert bullet.alive


@pytest.mark.parametrize("degrees", range(1, 90, 8))
def test_in_a_wedge_it_comes_out_again(degrees):
    """Two walls at 20 degrees: it leaves after at most nine bounces (180 / 20)."""
    lean = 10 * pi / 180
    arm_x, arm_y = 400.0 * cos(lean), 400.0 * sin(lean)
    walls = [(600.0, 450.0, 600.0 + arm_x, 450.0 - arm_y), (600.0, 450.0, 600.0 + arm_x, 450.0 + arm_y)]
    match = pitanks([(120.0, 110.0, 0.0)], walls, health=-1, minutes=5.0)
    bullet = ricochet(match, 900.0, 450.0, pi + (degrees - 45) * pi / 180, 50)
    bounces = bounces_inside(match, walls, 15.0, bullet, 100)
    assert bullet.alive
    assert bullet.x > 900.0 or bounces <= 9


def test_between_two_walls_just_wider_than_itself_it_goes_to_and_fro():
    """A gap of 12.5 px: no tunnelling, no sticking."""
    walls = [(400.0, 450.0, 1000.0, 450.0), (400.0, 492.5, 1000.0, 492.5)]
    match = pitanks([(120.0, 110.0, 0.0)], walls, health=-1, minutes=5.0)
    bullet = ricochet(match, 500.0, 471.25, pi / 3, 200)
    assert bounces_inside(match, walls, 15.0, bullet, 300) > 100


def test_a_robot_beside_a_wall_that_fires_into_it_sees_the_bullet_come_back():
    """The muzzle is beyond the wall; the bullet reflects off its face."""
    for x, way in ((RADIUS, pi), (WIDTH - RADIUS, 0.0)):
        match = pitanks([(x, 450.0, way), (800.0, 100.0, 0.0)])
        match.tanks[0].powers[RICOCHET], match.actions[0].fire = 400, 1
        judge(match)
        bullet = match.bullets[0]
        assert bounces_inside(match, [], 15.0, bullet, 10) == 0
        assert bullet.bounces == 1
        assert abs(bullet.x - x) > RADIUS


def test_a_bullet_that_leaves_a_wall_it_has_touched_passes_along_it():
    """A bullet that bounced into the angle between a wall and the arena's edge still comes out."""
    walls = [(300.0, 40.0, 900.0, 40.0)]
    match = pitanks([(120.0, 450.0, 0.0)], walls, health=-1, minutes=5.0)
    bullet = ricochet(match, 200.0, 15.0, 0.4, 300)
    bounces_inside(match, walls, 15.0, bullet, 300)
    assert bullet.alive
