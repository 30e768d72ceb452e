"""PiTanks by the party rules: points, knock-out, protection, light, bounty, finale and overtime."""

from math import cos, hypot, pi, sin
from types import SimpleNamespace

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.games.pitanks.observation import PiTanksObservation, PiTanksSenses, observe
from pigaming_app.games.pitanks.rules import judge
from pigaming_app.games.pitanks.state import MINE, OWN_BULLETS, OWN_MINES, SHIELD
from pigaming_app.games.replay import decode, encode, verify
from pigaming_app.sim.rng import uniform
from pigaming_app.sim.world import DT, HEIGHT, HZ, RADIUS, WIDTH
from tests.floor import pitanks
from tests.games.pitanks.test_rules import scores, ticks
from tests.matches import finished, match_of, run

LENGTH = 2 * RADIUS
KNOCKOUT, PROTECTION = 40, 100  # ticks
THREE = [(400.0, 450.0, 0.0), (800.0, 450.0, pi), (1200.0, 450.0, pi)]
BEFORE_FINALE = 20 * HZ  # ticks from the end


def party(poses=THREE[:2], walls=(), **more):
    match = pitanks(poses, walls, variant="party", **more)
    match.next_pickup = 1_000_000
    return match


def hit(match, shooter, victim, place=0):
    """A bullet of `shooter` meets `victim` within the next tick, from above."""
    robot = match.robots[victim]
    bullet = match.bullets[shooter * OWN_BULLETS + place]
    bullet.alive, bullet.fresh, bullet.bounces = 1, 0, 0
    bullet.x, bullet.y, bullet.vx, bullet.vy = robot.x, robot.y - 48.0, 0.0, 560.0


# -------------------------------------------------------------------------------------------------------------- a hit


def test_a_hit_is_a_point_and_costs_none():
    match = party()
    hit(match, 0, 1)
    ticks(match, 1)
    assert scores(match) == [1, 0, 0, 0]
    assert (match.tanks[0].hits, match.tanks[1].taken) == (1, 1)
    assert (match.last_hit, match.last_shooter, match.last_victim, match.last_points) == (1, 0, 1, 1)


@pytest.mark.parametrize("speed", [-260.0, 0.0, 260.0])
def test_a_knock_out_reverses_by_about_one_length_and_obeys_no_input(speed):
    match = party([(400.0, 450.0, 0.0), (800.0, 450.0, 0.0)])
    victim = match.robots[1]
    victim.linear = speed
    hit(match, 0, 1)
    ticks(match, 1)
    x, heading, rolled = victim.x, victim.heading, speed * 0.08  # which a stop from this speed takes
    match.actions[1].linear = match.actions[1].angular = 1.0
    match.actions[1].turbo = 1
    for _ in range(KNOCKOUT - 1):
        ticks(match, 1, fire=[1])
        assert victim.requested_linear < 0.0
        assert (victim.requested_angular, victim.boosting) == (0.0, 0)
    assert x - victim.x + rolled == pytest.approx(LENGTH, abs=12.0)
    assert victim.heading == heading
    assert match.tanks[1].shots == 0
    ticks(match, 1, fire=[1])
    assert match.tanks[1].shots == 1
    assert victim.requested_linear > 0.0


def test_the_protection_outlasts_the_knock_out_and_no_hit_scores_while_it_lasts():
    match = party()
    counted = []
    for tick in range(2 * PROTECTION + 10):
        hit(match, 0, 1)
        before = match.robots[0].score
        ticks(match, 1)
        if match.robots[0].score > before:
            counted.append(tick)
        assert not match.tanks[1].knocked_out or match.tanks[1].protected
    assert counted == [0, PROTECTION, 2 * PROTECTION]


def test_a_shield_takes_the_hit_without_a_knock_out():
    match = party()
    match.tanks[1].powers[SHIELD] = 100
    hit(match, 0, 1)
    ticks(match, 1)
    assert scores(match) == [0, 0, 0, 0]
    assert match.tanks[1].knocked_out == match.last_hit == 0


def test_a_mine_knocks_out_too():
    match = party()
    mine = match.mines[0 * OWN_MINES]
    mine.alive, mine.age, mine.x, mine.y = 100, HZ, 800.0, 450.0
    ticks(match, 1)
    assert scores(match) == [1, 0, 0, 0]
    assert match.tanks[1].knocked_out == KNOCKOUT
    match.tanks[1].powers[MINE] = 100
    ticks(match, KNOCKOUT - 1, fire=[1])
    assert match.tanks[1].powers[MINE], "it lays no mine either"


@pytest.mark.parametrize("degrees", range(0, 360, 30))
def test_a_knocked_out_robot_never_drives_into_a_wall(degrees):
    box = [(340, 390, 460, 390), (460, 390, 460, 510), (460, 510, 340, 510), (340, 510, 340, 390)]
    walls = [tuple(400.0 + (v - 400.0) * 2.0 if i % 2 == 0 else 450.0 + (v - 450.0) * 2.0 for i, v in enumerate(line))
             for line in box]  # fmt: skip
    match = party([(1400.0, 450.0, 0.0), (400.0, 450.0, degrees * pi / 180)], walls, health=-1)
    for _ in range(4 * PROTECTION):
        hit(match, 0, 1)
        ticks(match, 1)
        inside = 120.0 - 15.0 - RADIUS
        assert abs(match.robots[1].x - 400.0) <= inside + 1e-9
        assert abs(match.robots[1].y - 450.0) <= inside + 1e-9
    assert match.robots[0].score == 4


def test_two_robots_may_hit_each_other_in_one_tick():
    match = party()
    hit(match, 0, 1)
    hit(match, 1, 0)
    ticks(match, 1)
    assert scores(match) == [1, 1, 0, 0]
    assert match.tanks[0].knocked_out == match.tanks[1].knocked_out == KNOCKOUT


# ------------------------------------------------------------------------------------------------------------ the light


def test_a_robot_is_lit_after_four_seconds_until_it_leaves_its_circle():
    match = party()
    ticks(match, 4 * HZ)
    assert [tank.lit for tank in match.tanks] == [0, 0, 0, 0]
    ticks(match, 1)
    assert [tank.lit for tank in match.tanks] == [1, 1, 0, 0]
    match.actions[0].linear = 1.0
    while match.tanks[0].lit:
        assert match.robots[0].x - 400.0 <= LENGTH + 6.0
        ticks(match, 1)
    assert match.robots[0].x - 400.0 > LENGTH
    assert match.tanks[1].lit


def test_driving_in_a_small_circle_is_staying_and_a_longer_way_is_not():
    match = party()
    match.actions[0].linear, match.actions[0].angular = 0.3, 1.0  # on a circle of 26 px
    match.actions[1].linear, match.actions[1].angular = 1.0, 1.0  # of 87 px
    ticks(match, 5 * HZ)
    assert (match.tanks[0].lit, match.tanks[1].lit) == (1, 0)


def test_a_knock_out_does_not_count_as_staying():
    match = party([(400.0, 450.0, 0.0), (36.0, 450.0, 0.0)])  # its back at the outer wall
    ticks(match, HZ)
    hit(match, 0, 1)
    ticks(match, 1)
    camped = match.tanks[1].camped
    ticks(match, KNOCKOUT - 1)
    assert match.tanks[1].camped == camped
    ticks(match, 10)
    assert match.tanks[1].camped == camped + 10


def test_pickups_keep_away_from_a_lit_robot():
    match = party()
    nearest = {0: 9e9, 1: 9e9}
    for lit in nearest:
        for _ in range(300):
            for pickup in match.pickups:
                pickup.alive = 0
            match.next_pickup, match.tanks[0].lit = 1, lit
            match.tanks[0].camped = 10_000 * lit
            ticks(match, 1)
            for pickup in match.pickups:
                if pickup.alive:
                    nearest[lit] = min(nearest[lit], hypot(pickup.x - 400.0, pickup.y - 450.0))
            match.tick = 1
    assert 200.0 <= nearest[0] < 300.0
    assert nearest[1] >= 500.0


# ------------------------------------------------------------------------------------------------- bounty and finale


@pytest.mark.parametrize(("leads_by", "points"), [(4, 1), (5, 2)])
def test_a_leader_by_more_than_four_is_worth_two(leads_by, points):
    match = party(THREE)
    match.robots[1].score, match.robots[2].score = 5 + leads_by, 5
    ticks(match, 1)
    hit(match, 0, 1)
    ticks(match, 1)
    assert match.robots[0].score == points
    assert match.last_points == points
    hit(match, 1, 2)
    ticks(match, 1)
    assert match.robots[1].score == 5 + leads_by + 1, "the others are worth one"


def test_both_robots_of_a_leading_team_are_worth_two():
    match = party([*THREE, (1200.0, 100.0, 0.0)], teams=(0, 0, 1, 1))
    match.robots[2].score = 5
    ticks(match, 1)
    assert [tank.bounty for tank in match.tanks] == [0, 0, 1, 1]


def test_the_last_twenty_seconds_count_double():
    match = party(THREE)
    for before, points in ((1, 1), (0, 2)):
        match.tick = match.rules.ticks - BEFORE_FINALE - before
        match.tanks[1].protected, match.robots[0].score = 0, 0
        hit(match, 0, 1)
        ticks(match, 1)
        assert match.robots[0].score == points
    match.robots[1].score, match.robots[0].score, match.tanks[1].protected = 10, 0, 0
    ticks(match, 1)
    hit(match, 0, 1)
    ticks(match, 1)
    assert match.robots[0].score == 4


# ------------------------------------------------------------------------------------------------------------ overtime


def level(points, minutes=0.05):
    """A match on its last regular tick, with these points."""
    match = party([*THREE, (1200.0, 100.0, 0.0)][: len(points)], minutes=minutes)
    match.tick = match.rules.ticks - 1
    for robot, score in zip(match.robots, points, strict=False):
        robot.score = score
    return match


def test_a_sole_leader_wins_on_time():
    match = ticks(level([3, 2, 2]), 1)
    assert match.over
    assert match.tick == match.rules.ticks


def test_a_level_match_goes_on_for_thirty_seconds_and_is_then_a_tie():
    match = ticks(level([3, 3, 2]), 30 * HZ)
    assert not match.over
    ticks(match, 1)
    assert match.over
    assert match.tick == match.rules.ticks + 30 * HZ
    assert scores(match) == [3, 3, 2, 0]


def test_the_next_hit_of_a_leader_ends_it_and_counts_one():
    match = ticks(level([3, 3, 2]), 1)
    hit(match, 1, 2)
    ticks(match, 1)
    assert match.over
    assert scores(match) == [3, 4, 2, 0]


def test_the_hit_of_another_scores_nothing_but_knocks_out():
    match = ticks(level([3, 3, 2]), 1)
    hit(match, 2, 0)
    ticks(match, 1)
    assert not match.over
    assert scores(match) == [3, 3, 2, 0]
    assert match.tanks[0].knocked_out == KNOCKOUT
    assert (match.tanks[2].hits, match.last_points) == (1, 0)


def test_in_overtime_everybody_fires_three_bullets_every_fifth_of_a_second():
    match = ticks(level([3, 3, 2]), 1)
    for pause, shots in ((1, 3), (9, 3), (1, 6)):
        ticks(match, pause, fire=(0, 1, 2))
        assert [tank.shots for tank in match.tanks] == [shots, shots, shots, 0]


def test_a_mutual_hit_of_two_leaders_leaves_the_third_behind():
    match = ticks(level([3, 3, 3]), 1)
    hit(match, 0, 1)
    hit(match, 1, 0)
    ticks(match, 1)
    assert not match.over
    hit(match, 2, 0)
    match.tanks[0].protected = 0
    ticks(match, 1)
    assert scores(match) == [4, 4, 3, 0]


def test_a_match_tells_overtime_and_its_time():
    match = match_of("pitanks", "idle idle", minutes=0.05, variant="party")
    while not match.overtime:
        assert match.seconds_left == pytest.approx(3.0 - match.seconds)
        match.tick()
    assert match.seconds == pytest.approx(3.0)
    assert match.seconds_left == pytest.approx(30.0)
    finished(match)
    assert match.seconds == pytest.approx(33.0)
    assert match.seconds_left == 0.0
    assert match.outcome().winners == ()
    assert verify(decode(encode(match), "overtime"))


def test_a_hit_that_ends_the_match_leaves_time():
    match = run(match_of("pitanks", "idle idle", minutes=0.05, variant="party"), 200)
    hit(match.state, 0, 1)
    match.tick()
    assert match.over
    assert match.outcome().winners == (0,)
    assert match.seconds_left == pytest.approx(3.0 + 30.0 - match.seconds)


def test_brains_see_light_knock_out_bounty_finale_and_overtime():
    match = party(THREE)
    match.robots[1].score, match.tanks[2].lit = 5, 1
    hit(match, 1, 0)
    ticks(match, 1)
    obs = PiTanksObservation()
    observe(match, 0, PiTanksSenses(), obs)
    assert (obs.knocked_out, obs.others[0].bounty, obs.others[0].worth, obs.others[1].worth) == (KNOCKOUT, 1, 2, 1)
    assert (obs.finale, obs.overtime) == (0, 0)
    match = ticks(level([3, 3, 2], minutes=0.5), 1)
    observe(match, 2, PiTanksSenses(), obs)
    assert (obs.finale, obs.overtime, obs.seconds_left) == pytest.approx((0, 1, 30.0))
    assert [other.worth for other in obs.others[1:]] == [0, 0]
    observe(match, 0, PiTanksSenses(), obs)
    assert obs.others[0].worth == 1


# ------------------------------------------------------------------------------------------------------- whole matches


@pytest.mark.parametrize("arena", arenas("pitanks"))
def test_points_are_those_of_the_hits_and_robots_keep_out_of_walls(arena):
    match = match_of("pitanks", ["random"] * 4, arena, 0.5, 2, "party")
    total = hits = 0
    while not match.over:
        protected = [tank.protected for tank in match.state.tanks]
        match.tick()
        state = match.state
        made = sum(tank.hits for tank in state.tanks) - hits
        gained, hits = sum(scores(state)) - total, hits + made
        total += gained
        double = state.rules.ticks - BEFORE_FINALE <= state.tick - 1 < state.rules.ticks
        assert (
            made * (2 if double else 1) <= gained <= 2 * made * (2 if double else 1) or state.tick > state.rules.ticks
        )
        for tank, before in zip(state.tanks, protected, strict=True):
            assert before <= 1 or tank.protected == before - 1, "no hit counts on a protected robot"
        for robot in state.robots:
            assert RADIUS <= robot.x <= WIDTH - RADIUS
            assert RADIUS <= robot.y <= HEIGHT - RADIUS
    assert sum(tank.taken for tank in match.state.tanks) == hits > 0


def test_the_order_of_the_seats_does_not_matter():
    """The same fight with reversed seats has reversed scores, lights, knock-outs and bounties."""
    poses = [(500.0, 450.0, 0.0), (700.0, 452.0, pi), (610.0, 350.0, pi / 2), (595.0, 560.0, -pi / 2)]
    there, back = party(poses, minutes=0.2), party(poses[::-1], minutes=0.2)
    luck = SimpleNamespace(random=5)
    turns = [0.0] * 4
    while not there.over:
        for seat in range(4):
            if there.tick % 20 == 0:
                turns[seat] = 2.0 * uniform(luck) - 1.0
            for match, place in ((there, seat), (back, 3 - seat)):
                match.actions[place].angular, match.actions[place].fire = turns[seat], 1
        judge(there)
        judge(back)
        for seat, robot in enumerate(there.robots):  # contact is not what is tested here
            twin = back.robots[3 - seat]
            assert (twin.requested_linear, twin.requested_angular) == (robot.requested_linear, robot.requested_angular)
            robot.heading += robot.requested_angular * DT
            robot.x += 0.2 * robot.requested_linear * DT * cos(robot.heading)
            robot.y += 0.2 * robot.requested_linear * DT * sin(robot.heading)
            twin.x, twin.y, twin.heading = robot.x, robot.y, robot.heading
        assert scores(there) == scores(back)[::-1]
        for name in ("knocked_out", "protected", "lit", "bounty", "barred"):
            assert [getattr(t, name) for t in there.tanks] == [getattr(t, name) for t in back.tanks][::-1]
        assert (there.tick, there.over) == (back.tick, back.over)
    assert sum(scores(there)) > 10
