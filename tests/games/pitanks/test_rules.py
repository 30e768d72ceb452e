"""PiTanks, rule by rule, in matches set up by hand: shots, hits, walls, protection and pick-ups."""

from itertools import pairwise
from math import cos, hypot, pi, sin
from types import SimpleNamespace

import pytest

from pigaming_app.games.pitanks.rules import judge
from pigaming_app.games.pitanks.state import (
    MINE,
    OWN_BULLETS,
    OWN_MINES,
    POWERS,
    RAPID,
    RICOCHET,
    SHIELD,
    SPEED,
    TRIPLE,
)
from pigaming_app.sim.contact import drive
from pigaming_app.sim.rng import uniform
from pigaming_app.sim.world import DT, HZ, RADIUS
from tests.floor import pitanks

FACING = [(400.0, 450.0, 0.0), (800.0, 450.0, pi)]  # 400 px apart
FLIGHT = (400.0 - RADIUS - 6.0 - 64.0) / 560.0  # s from the muzzle to contact


def ticks(match, count, fire=()):
    """Advance the match; the seats in `fire` hold the button."""
    for _ in range(count):
        for seat, action in enumerate(match.actions):
            action.fire = int(seat in fire)
        judge(match)
        drive(match)
    return match


def alive(match, seat=0):
    return [b for b in match.bullets[seat * OWN_BULLETS : (seat + 1) * OWN_BULLETS] if b.alive]


def put_bullet(match, seat, x, y, heading, place=0, bounces=0):
    """Put a bullet of a seat in flight."""
    bullet = match.bullets[seat * OWN_BULLETS + place]
    bullet.alive, bullet.x, bullet.y, bullet.bounces = 1, x, y, bounces
    bullet.vx, bullet.vy = 560.0 * cos(heading), 560.0 * sin(heading)
    return bullet


def scores(match):
    return [robot.score for robot in match.robots]


# ------------------------------------------------------------------------------------------------------------ one shot


def test_a_shot_begins_at_the_muzzle_and_flies_560_px_a_second():
    match = pitanks([FACING[0], (1500.0, 800.0, 0.0)])
    ticks(match, 1, fire=[0])
    (bullet,) = alive(match)
    assert bullet.x - 400.0 == pytest.approx(64.0 + 560.0 * DT)
    ticks(match, HZ // 2)
    assert bullet.x - 400.0 == pytest.approx(64.0 + 560.0 * (DT + 0.5))
    assert bullet.y == 450.0


def test_a_hit_is_a_point_made_and_one_taken_after_the_time_of_flight():
    match = pitanks(FACING)
    ticks(match, 1, fire=[0])
    played = 1
    while not match.robots[0].score and played < 200:
        ticks(match, 1)
        played += 1
    assert played == int(FLIGHT / DT) + 1
    assert scores(match) == [1, -1, 0, 0]
    assert (match.tanks[0].hits, match.tanks[0].landed, match.tanks[0].shots) == (1, 1, 1)
    assert match.tanks[1].taken == 1
    assert not alive(match)


def test_an_absent_robot_is_not_hit_and_does_not_shoot():
    match = pitanks(FACING)
    match.robots[1].present = 0
    ticks(match, HZ, fire=[0, 1])
    assert scores(match) == [0, 0, 0, 0]
    assert not alive(match, 1)


# --------------------------------------------------------------------------------------------------- walls wear away


def test_a_wall_is_gone_after_five_bullets_and_the_sixth_passes():
    match = pitanks([FACING[0], (800.0, 450.0, 0.0)], [(600.0, 300.0, 600.0, 600.0)])
    for shot in range(5):
        assert match.walls[0].health == 5 - shot
        ticks(match, 1, fire=[0])
        ticks(match, HZ - 1)
    assert match.walls[0].health == 0
    assert scores(match) == [0, 0, 0, 0]
    assert not any(match.grid[row * 33 + 12] for row in range(5, 14))
    ticks(match, 1, fire=[0])
    ticks(match, HZ)
    assert scores(match) == [1, -1, 0, 0]


def test_a_solid_wall_takes_any_number():
    match = pitanks([FACING[0], (800.0, 450.0, 0.0)], [(600.0, 300.0, 600.0, 600.0)], health=-1)
    ticks(match, 10 * HZ, fire=[0])
    assert match.walls[0].health == -1
    assert scores(match) == [0, 0, 0, 0]


def test_two_bullets_of_one_tick_both_stop_at_a_wall_that_takes_one_more():
    """All bullets meet the walls as they were at the beginning of the tick: neither passes behind the other."""
    match = pitanks([FACING[0], (800.0, 450.0, 0.0), (400.0, 600.0, 0.0)], [(600.0, 300.0, 600.0, 600.0)], health=1)
    one = put_bullet(match, 0, 578.0, 450.0, 0.0)
    other = put_bullet(match, 2, 570.0, 450.0, 0.0)
    ticks(match, 1)
    assert (one.alive, other.alive) == (0, 0)
    assert match.walls[0].health == 0
    assert scores(match) == [0, 0, 0, 0]


# ------------------------------------------------------------------------------------------------ protection and mates


def test_after_a_hit_three_quarters_of_a_second_protect():
    """A bullet is at the victim on every tick: the second one counts 0.75 s (rounded up) after the first."""
    match = pitanks(FACING)
    counted = []
    for tick in range(HZ * 2):
        put_bullet(match, 0, 770.0, 450.0, 0.0)
        before = match.robots[0].score
        ticks(match, 1)
        if match.robots[0].score > before:
            counted.append(tick)
    gaps = [(later - sooner) * DT for sooner, later in pairwise(counted)]
    assert gaps == pytest.approx([0.76, 0.76])


def test_a_protected_robot_stops_bullets_all_the_same():
    match = pitanks(FACING)
    match.tanks[1].protected = 10
    bullet = put_bullet(match, 0, 750.0, 450.0, 0.0)
    ticks(match, 1)
    assert not bullet.alive
    assert scores(match) == [0, 0, 0, 0]


def three():
    """The robot on seat 1 between those on 0 and 2."""
    return [(400.0, 450.0, 0.0), (800.0, 450.0, pi), (1200.0, 450.0, pi)]


@pytest.mark.parametrize("ahead", [0, 2])
def test_of_two_bullets_in_one_tick_the_first_to_arrive_counts(ahead):
    match = pitanks(three())
    put_bullet(match, 0, 758.0 - (2.0 if ahead == 0 else 8.0), 450.0, 0.0)
    put_bullet(match, 2, 842.0 + (2.0 if ahead == 2 else 8.0), 450.0, pi)
    ticks(match, 1)
    expected = [0, -1, 0, 0]
    expected[ahead] = 1
    assert scores(match) == expected


def test_classic_counts_both():
    match = pitanks(three(), variant="classic")
    put_bullet(match, 0, 750.0, 450.0, 0.0)
    put_bullet(match, 2, 850.0, 450.0, pi)
    ticks(match, 1)
    assert scores(match) == [1, -2, 1, 0]


def test_bullets_pass_team_mates_and_their_owner():
    match = pitanks(three(), teams=(0, 0, 1, 1))
    ticks(match, 1, fire=[0])
    bullet = match.bullets[0]
    ticks(match, round((900.0 - bullet.x) / 560.0 / DT))
    assert bullet.alive
    assert bullet.x > 850.0
    ticks(match, HZ)
    assert scores(match) == [1, 0, -1, 0]


# ------------------------------------------------------------------------------------------------------------- the gun


def test_the_gun_is_ready_again_after_half_a_second():
    match = pitanks([(100.0, 450.0, 0.0), (800.0, 100.0, 0.0)])
    shots = []
    for tick in range(2 * HZ):
        before = match.tanks[0].shots
        ticks(match, 1, fire=[0])
        if match.tanks[0].shots > before:
            shots.append(tick)
    assert shots == [0, 25, 50, 75]


def test_at_most_five_bullets_are_alive():
    match = pitanks([(100.0, 100.0, 0.0), (800.0, 800.0, 0.0)])
    most = 0
    for _ in range(10 * HZ):
        match.tanks[0].cooldown = 0
        ticks(match, 1, fire=[0])
        most = max(most, len(alive(match)))
    assert most == 5
    assert match.tanks[0].shots > 5


def test_turbo_is_30_percent_faster_while_the_meter_lasts():
    match = pitanks([(200.0, 450.0, 0.0), (800.0, 100.0, 0.0)])
    match.actions[0].linear, match.actions[0].turbo = 1.0, 1
    ticks(match, HZ)
    assert match.robots[0].requested_linear == pytest.approx(1.3 * 260.0)
    ticks(match, 2 * HZ)
    assert match.robots[0].requested_linear == pytest.approx(260.0)


def test_classic_has_neither_turbo_nor_protection_nor_pickups():
    match = pitanks(FACING, variant="classic")
    match.actions[0].linear, match.actions[0].turbo = 1.0, 1
    ticks(match, 1)
    assert match.robots[0].requested_linear == 260.0
    match.actions[0].linear = 0.0
    for _ in range(3):
        put_bullet(match, 0, 770.0, 450.0, 0.0)
        ticks(match, 1)
    assert scores(match) == [3, -3, 0, 0]
    ticks(match, 30 * HZ)
    assert not any(pickup.alive for pickup in match.pickups)


# ------------------------------------------------------------------------------------------------------------ pick-ups


def holding(power, poses=FACING, walls=(), **more):
    match = pitanks(poses, walls, variant="pickups", **more)
    match.tanks[0].powers[power] = 8 * HZ
    match.next_pickup = 1_000_000
    return match


@pytest.mark.parametrize("kind", range(6), ids=POWERS)
@pytest.mark.parametrize(("variant", "seconds"), [("party", 8), ("pickups", 5)])
def test_a_pickup_is_taken_by_touch_and_lasts(variant, seconds, kind):
    match = pitanks(FACING, variant=variant)
    pickup = match.pickups[0]
    pickup.alive, pickup.kind, pickup.x, pickup.y = 100, kind, 400.0 + RADIUS + 39.0, 450.0
    ticks(match, 1)
    assert pickup.alive == 0
    assert match.tanks[0].powers[kind] == seconds * HZ
    ticks(match, seconds * HZ)
    assert match.tanks[0].powers[kind] == 0


def test_pickups_appear_on_free_floor_and_never_more_than_three():
    match = pitanks([(100.0, 100.0, 0.0), (1500.0, 800.0, 0.0)], [(600.0, 300.0, 600.0, 600.0)], variant="pickups")
    seen = set()
    for _ in range(60 * HZ):
        ticks(match, 1)
        for pickup in match.pickups:
            if pickup.alive:
                seen.add((pickup.x, pickup.y, pickup.kind))
                assert all(hypot(robot.x - pickup.x, robot.y - pickup.y) > 76 for robot in match.robots[:2])
                assert abs(pickup.x - 600.0) >= 50 or not 250 <= pickup.y <= 650
    assert 7 <= len(seen) <= 9  # one every 7 s, the first after 3.5 s


def test_a_pickup_vanishes_after_twelve_seconds():
    match = pitanks(FACING, variant="pickups")
    match.next_pickup = 1
    ticks(match, 1)
    (pickup,) = [pickup for pickup in match.pickups if pickup.alive]
    match.next_pickup = 1_000_000
    ticks(match, 12 * HZ - 2)
    assert pickup.alive
    ticks(match, 1)
    assert not pickup.alive


def test_a_shield_takes_the_next_hit():
    match = holding(SHIELD, [FACING[1], FACING[0]])
    for expected in ([0, 0, 0, 0], [-1, 1, 0, 0]):
        ticks(match, 1, fire=[1])
        ticks(match, HZ)
        assert scores(match) == expected
        assert match.tanks[0].powers[SHIELD] == 0
    assert (match.tanks[1].shots, match.tanks[1].landed) == (2, 1)


def test_speed_is_a_quarter_more_and_goes_with_turbo():
    match = holding(SPEED)
    match.actions[0].linear = 1.0
    ticks(match, 1)
    assert match.robots[0].requested_linear == pytest.approx(1.25 * 260.0)
    match.actions[0].turbo = 1
    ticks(match, 1)
    assert match.robots[0].requested_linear == pytest.approx(1.25 * 1.3 * 260.0)


def test_rapid_fires_five_times_a_second_and_has_eight_bullets():
    match = holding(RAPID, [(100.0, 100.0, 0.0), (800.0, 800.0, 0.0)])
    ticks(match, HZ, fire=[0])
    assert match.tanks[0].shots == 5
    ticks(match, HZ, fire=[0])
    assert len(alive(match)) == 8


def test_triple_fires_three_bullets_in_a_fan():
    match = holding(TRIPLE, [(400.0, 450.0, 0.0), (1500.0, 800.0, 0.0)])
    ticks(match, 1, fire=[0])
    ways = sorted(bullet.vy / 560.0 for bullet in alive(match))
    assert ways == pytest.approx([-sin(0.21), 0.0, sin(0.21)])


def test_a_ricochet_bounces_twice_and_stops_at_the_third_wall():
    corridor = [(400.0, 300.0, 1000.0, 300.0), (400.0, 600.0, 1000.0, 600.0)]
    match = holding(RICOCHET, [(700.0, 450.0, pi / 2), (1500.0, 100.0, 0.0)], corridor)
    ticks(match, 1, fire=[0])
    bullet, ways = match.bullets[0], list[bool]()
    while bullet.alive and len(ways) < 500:
        ways.append(bullet.vy > 0)
        ticks(match, 1)
    assert sum(a != b for a, b in pairwise(ways)) == 2
    assert bullet.x == pytest.approx(700.0)
    assert [wall.health for wall in match.walls[:2]] == [5, 4]


def test_a_bounce_leaves_at_the_angle_at_which_it_came():
    match = holding(RICOCHET, [(200.0, 800.0, 0.0), (1500.0, 100.0, 0.0)])
    bullet = put_bullet(match, 0, 800.0, 30.0, -pi / 3, bounces=1)
    ticks(match, 5)
    assert (bullet.vx, bullet.vy) == pytest.approx((560.0 * cos(pi / 3), 560.0 * sin(pi / 3)))
    slope = [(600.0, 300.0, 900.0, 600.0)]
    match = holding(RICOCHET, [(200.0, 800.0, 0.0), (1500.0, 100.0, 0.0)], slope)
    bullet = put_bullet(match, 0, 750.0, 350.0, pi / 2, bounces=1)
    ticks(match, 10)
    assert (bullet.vx, bullet.vy) == pytest.approx((560.0, 0.0), abs=1e-6)


def test_a_ricochet_still_hits_round_a_corner_but_not_its_owner():
    match = holding(RICOCHET, [(800.0, 450.0, -pi / 2), (800.0, 750.0, 0.0)])
    ticks(match, 1, fire=[0])
    ticks(match, 3 * HZ)
    assert scores(match) == [1, -1, 0, 0]


def test_the_next_shot_lays_a_mine_and_the_one_after_is_a_bullet():
    match = holding(MINE)
    ticks(match, 1, fire=[0])
    assert match.mines[0].alive
    assert (match.mines[0].x, match.mines[0].y) == (400.0, 450.0)
    assert match.tanks[0].powers[MINE] == 0
    assert match.tanks[0].shots == 0
    ticks(match, HZ, fire=[0])
    assert match.tanks[0].shots == 2


def lay(match, seat, x, y):
    mine = match.mines[seat * OWN_MINES]
    mine.alive, mine.age, mine.x, mine.y = 30 * HZ, 0, x, y
    return mine


def test_a_mine_arms_within_a_second_and_goes_off_under_an_opponent():
    match = holding(SHIELD)
    mine = lay(match, 0, 800.0, 450.0 + RADIUS + 21.0)
    ticks(match, HZ - 1)
    assert mine.alive
    ticks(match, 1)
    assert not mine.alive
    assert scores(match) == [1, -1, 0, 0]
    assert match.tanks[0].landed == 0  # no shot landed


def test_a_mine_spares_its_owner_team_mates_and_protected_robots():
    match = holding(SHIELD, three(), teams=(0, 0, 1, 1))
    mines = [lay(match, 0, 400.0, 450.0), match.mines[1]]
    mines[1].alive, mines[1].x, mines[1].y = 30 * HZ, 800.0, 450.0
    ticks(match, 2 * HZ)
    assert all(mine.alive for mine in mines)
    mines[1].x = 1200.0
    match.tanks[2].protected = 10
    ticks(match, 9)
    assert mines[1].alive
    ticks(match, 1)
    assert not mines[1].alive
    assert scores(match) == [1, 0, -1, 0]


def test_a_mine_vanishes_after_thirty_seconds():
    match = holding(SHIELD)
    mine = lay(match, 0, 100.0, 100.0)
    ticks(match, 30 * HZ - 1)
    assert mine.alive
    ticks(match, 1)
    assert not mine.alive


# ------------------------------------------------------------------------------------------------------ the whole match


def test_the_match_is_over_on_the_right_tick_and_stays_as_it_is():
    match = pitanks(FACING, minutes=0.05)
    ticks(match, 149, fire=[0])
    assert not match.over
    ticks(match, 1, fire=[0])
    assert match.over
    held = scores(match)
    match.actions[0].linear = 1.0
    ticks(match, HZ, fire=[0, 1])
    assert match.tick == 150
    assert match.robots[0].requested_linear == 0.0
    assert scores(match) == held


def wild(match, luck, count):
    for tick in range(count):
        if tick % 10 == 0:
            for action in match.actions:
                action.linear = float(int(uniform(luck) * 3) - 1)
                action.angular = float(int(uniform(luck) * 3) - 1)
                action.turbo = int(uniform(luck) * 2)
        ticks(match, 1, fire=range(4))
        yield


@pytest.mark.parametrize("variant", ["pickups", "plain", "classic"])
def test_scores_add_up_to_zero_whatever_happens(variant):
    poses = [(500.0, 450.0, 0.0), (700.0, 450.0, pi), (600.0, 350.0, pi / 2), (600.0, 550.0, -pi / 2)]
    match = pitanks(poses, [(300.0, 200.0, 300.0, 700.0)], variant=variant)
    for _ in wild(match, SimpleNamespace(random=3), 30 * HZ):
        assert sum(scores(match)) == 0
        for robot, tank in zip(match.robots, match.tanks, strict=True):
            assert robot.score == tank.hits - tank.taken
            assert tank.landed <= tank.shots
    assert any(scores(match))
