"""The Q-learner: features, rewards, updates and choice of moves."""

from dataclasses import replace
from math import cos, exp, pi, sin, tau
from random import Random

import pytest

from pigaming_app.ai.learning.q_learner import (
    is_behind,
    learn,
    learn_last,
    observe_action,
    observe_transition,
    reward,
    temperature,
    update,
)
from pigaming_app.ai.learning.training import fresh_table, training_setup
from pigaming_app.ai.qlearning.features import (
    NONE,
    SECTORS,
    STATES,
    WIDE,
    bullet_of,
    exact_sector,
    nearest_opponent,
    opponent_of,
    quick_sector,
    sector,
    situation,
    state,
    wall_of,
)
from pigaming_app.ai.qlearning.recipe import RECIPES, Recipe, RecipeNumbers, RecipeRecord
from pigaming_app.ai.qlearning.table import (
    ACTIONS,
    MOVES,
    PAIRS,
    LearnerMind,
    QTable,
    max_value,
    move_probabilities,
    reset,
    sample_move,
    set_recipe,
    think,
)
from pigaming_app.ai.reward_line import with_line
from pigaming_app.ai.reward_quantities import HIT, QUANTITIES, WEIGHTED
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.sim.action import set_action
from pigaming_app.sim.record import digest, fields_of

FIRE = MOVES.index((0.0, 0.0, 1))
DRIVE = MOVES.index((1.0, 0.0, 0))


def standing(*poses):
    """A match of two with its robots at these (x, y, heading)."""
    match = Match(training_setup(1)).state
    for robot, (x, y, heading) in zip(match.robots, poses, strict=False):
        robot.x, robot.y, robot.heading = x, y, heading
    return match


def without_walls(match):
    for wall in match.walls:
        wall.health = 0
    return match


def taught(recipe=RECIPES[1]):
    """An empty table with a recipe."""
    table = fresh_table(1)
    set_recipe(table, recipe)
    return table


# ------------------------------------------------------------------------------------------ features


def test_there_are_as_many_states_and_actions_as_published():
    assert STATES == 16 * 17 * 17
    assert PAIRS == STATES * 18
    assert len(set(MOVES)) == 18
    assert {state(o, w, b) for o in range(16) for w in range(17) for b in range(17)} == set(range(STATES))
    assert (opponent_of(state(5, 16, 3)), wall_of(state(5, 16, 3)), bullet_of(state(5, 16, 3))) == (5, 16, 3)


@pytest.mark.parametrize("k", range(SECTORS))
@pytest.mark.parametrize("heading", [0.0, 1.0, 6.2])
def test_sector_0_is_centred_straight_ahead_and_they_go_on_clockwise(k, heading):
    for off in (-0.49, 0.0, 0.49):
        bearing = heading + (k + off) * tau / 16
        assert sector(100.0 * cos(bearing), 100.0 * sin(bearing), heading) == k


def test_the_quick_sector_is_the_exact_one_at_every_edge_and_in_between():
    chance, headings = Random(1), [0.0, 1.0, pi, 6.2, tau - 1e-9]
    offsets = [(chance.uniform(-1600.0, 1600.0), chance.uniform(-900.0, 900.0)) for _ in range(1000)]
    offsets += [
        (1.0, 0.0),
        (-1.0, 0.0),
        (-1.0, -0.0),
        (0.0, 1.0),
        (0.0, -1.0),
        (-0.0, 1.0),
        (1e-9, 1e3),
        (7.0, 7.0),
        (0.0, 0.0),
    ]
    for heading in headings:
        for k in range(SECTORS):
            edge = heading + (k + 0.5) * WIDE
            nearby = [edge + sign * 10.0**power for sign in (-1, 1) for power in range(-16, 0)]
            offsets += [(500.0 * cos(bearing), 500.0 * sin(bearing)) for bearing in nearby]
        for dx, dy in offsets:
            assert quick_sector(dx, dy, heading) == exact_sector(dx, dy, heading), (dx, dy, heading)


def test_it_sees_the_opponent_the_closest_wall_and_the_closest_bullet_that_comes_nearer():
    match = standing((430.0, 300.0, 0.0), (430.0, 700.0, 0.0))  # the wall from (300, 200) to (300, 400) is behind it
    bullet = match.bullets[8]  # the first of seat 1
    bullet.alive, bullet.x, bullet.y, bullet.vx = 1, 630.0, 300.0, -560.0
    near = match.bullets[9]
    near.alive, near.x, near.y, near.vy = 1, 430.0, 200.0, -560.0  # nearer, but it flies away
    own = match.bullets[0]
    own.alive, own.x, own.y, own.vx = 1, 500.0, 300.0, -560.0
    here = situation(match, 0, 1, 1)
    assert (opponent_of(here), wall_of(here), bullet_of(here)) == (4, 8, 0)
    match.robots[0].heading = pi / 2
    here = situation(match, 0, 1, 1)
    assert (opponent_of(here), wall_of(here), bullet_of(here)) == (0, 4, 12)


def test_bullets_that_fly_away_are_seen_only_where_all_are():
    match = standing((430.0, 300.0, 0.0), (430.0, 700.0, 0.0))
    bullet = match.bullets[8]
    bullet.alive, bullet.x, bullet.y, bullet.vy = 1, 430.0, 200.0, -560.0
    assert [bullet_of(situation(match, 0, 1, incoming)) for incoming in (1, 0)] == [NONE, 12]


def test_what_is_not_there_is_none():
    here = situation(without_walls(standing((300.0, 300.0, 0.0), (900.0, 300.0, pi))), 0, 1, 1)
    assert (opponent_of(here), wall_of(here), bullet_of(here)) == (0, NONE, NONE)


def test_a_wall_that_is_shot_away_is_no_longer_the_closest():
    match = standing((430.0, 300.0, 0.0), (430.0, 700.0, 0.0))
    before = wall_of(situation(match, 0, 1, 1))
    match.walls[0].health = 0
    assert before == 8
    assert wall_of(situation(match, 0, 1, 1)) == 1  # now the end of another one at (580, 380), 28 degrees to the right


def test_among_several_the_nearest_of_another_team_is_the_opponent():
    seats = (Seat("q1", 0), Seat("q1", 1)) * 2
    match = Match(Setup("pitanks", "classic", seats, 1.0, 1, "classic")).state
    for robot, x in zip(match.robots, (100.0, 900.0, 200.0, 500.0), strict=True):
        robot.x, robot.y = x, 300.0
    assert nearest_opponent(match, 0) == 3
    match.robots[3].present = 0
    assert nearest_opponent(match, 0) == 1
    match.robots[1].present = 0
    assert nearest_opponent(match, 0) == -1


# ------------------------------------------------------------------------------------------ rewards


def act(match, linear, fire):
    action = match.actions[0]
    set_action(action, linear, 0.0, fire, 0)
    return action


def worth_of(match, linear, fire, recipe):
    """Reward of seat 0 for an action in the present state, whatever follows."""
    seen, table = [0.0] * len(QUANTITIES), taught(recipe)
    observe_action(match, 0, 1, situation(match, 0, 1, 1), act(match, linear, fire), recipe, seen)
    return reward(table, seen)


def shot(match, recipe=RECIPES[1], linear=1.0):
    """Reward of seat 0 for a shot in the present state."""
    return worth_of(match, linear, 1, recipe)


def worth_behind(before, after, recipe):
    """What the opponent's place after a decision costs."""
    return recipe.behind * is_behind(before, after, recipe)


def test_a_shot_at_an_opponent_in_plain_sight_is_worth_10():
    assert shot(without_walls(standing((300.0, 300.0, 0.0), (900.0, 300.0, pi)))) == 10.0


def test_a_shot_that_does_not_look_at_the_opponent_costs_1():
    assert shot(without_walls(standing((300.0, 300.0, 1.0), (900.0, 300.0, pi)))) == -1.0


def test_a_shot_towards_the_closest_wall_is_worth_nothing():
    assert shot(standing((200.0, 300.0, 0.0), (1500.0, 300.0, pi))) == 0.0  # the wall at x = 300 is ahead


def test_a_shot_at_an_opponent_behind_some_other_wall_is_worth_nothing_unless_looking_its_way_is_enough():
    match = standing((400.0, 450.0, 0.0), (1500.0, 450.0, pi))  # the closest wall is behind, another one between
    assert shot(match) == 0.0
    assert shot(match, replace(RECIPES[1], in_sight=0)) == 10.0


def test_a_button_held_down_while_the_gun_cools_counts_unless_only_real_shots_do():
    match = without_walls(standing((300.0, 300.0, 0.0), (900.0, 300.0, pi)))
    match.tanks[0].cooldown = 3
    assert shot(match) == 10.0
    assert shot(match, replace(RECIPES[1], loaded=1)) == 0.0


@pytest.mark.parametrize(("number", "worth"), [(1, 0.0), (2, -10.0)])
def test_standing_still_costs_10_by_the_second_table_alone(number, worth):
    match = standing((300.0, 300.0, 1.0), (900.0, 300.0, pi))
    recipe = RECIPES[number]
    assert worth_of(match, 0.0, 0, recipe) == worth
    assert worth_of(match, -1.0, 0, recipe) == 0.0


def test_who_pushes_a_wall_is_still_only_where_moving_counts():
    match = standing((300.0, 300.0, 1.0), (900.0, 300.0, pi))
    for speed, moving, worth in ((0.0, 0, 0.0), (0.0, 1, -10.0), (-200.0, 1, 0.0)):
        match.robots[0].linear = speed
        recipe = replace(RECIPES[2], moving=moving)
        assert worth_of(match, -1.0, 0, recipe) == worth


def test_an_opponent_that_gets_behind_costs_1_once_by_the_first_table_and_every_time_by_the_second():
    for ahead in range(SECTORS):
        for wall in range(NONE + 1):
            there, away = state(ahead, wall, NONE), state(0, wall, NONE)
            exposed = 4 <= ahead <= 12 and wall != ahead
            assert worth_behind(away, there, RECIPES[1]) == (-1.0 if exposed else 0.0)
            assert worth_behind(there, there, RECIPES[1]) == 0.0
            assert worth_behind(there, there, RECIPES[2]) == (-1.0 if exposed else 0.0)
            assert worth_behind(there, away, RECIPES[2]) == 0.0


@pytest.mark.parametrize(("behind", "thesis", "ours"), [(False, -1.0, -1.0), (True, 0.0, -1.0)])
def test_losing_the_wall_at_its_back_costs_a_robot_1_only_where_exposure_counts(behind, thesis, ours):
    """The wall from (300, 200) to (300, 400) covers its back until it falls, or it turns its back as that falls."""
    match = standing((430.0, 300.0, 0.0 if behind else pi), (100.0, 300.0, 0.0))
    before = situation(match, 0, 1, 1)
    assert (opponent_of(before), wall_of(before)) == ((8, 8) if behind else (0, 0))
    match.walls[0].health, match.robots[0].heading = 0, 0.0
    after = situation(match, 0, 1, 1)
    assert opponent_of(after) == 8 != wall_of(after)
    assert worth_behind(before, after, replace(RECIPES[1], exposure=0)) == thesis
    assert worth_behind(before, after, RECIPES[1]) == ours
    for exposure in (0, 1):
        recipe = replace(RECIPES[1], exposure=exposure)
        assert worth_behind(after, after, recipe) == 0.0
        assert worth_behind(after, after, replace(recipe, behind_always=1)) == -1.0


def test_the_ends_of_behind_are_knobs():
    front, narrow = state(3, NONE, NONE), replace(RECIPES[1], behind_from=5, behind_to=11)
    for recipe, ends in ((RECIPES[1], {4, 12}), (narrow, {5, 11})):
        costs = [ahead for ahead in range(SECTORS) if worth_behind(front, state(ahead, NONE, NONE), recipe)]
        assert {costs[0], costs[-1]} == ends
        assert len(costs) == costs[-1] - costs[0] + 1


def test_what_counts_as_ahead_and_a_wall_ahead_are_knobs():
    match = without_walls(standing((300.0, 300.0, 0.35), (900.0, 300.0, pi)))  # one sector to the left
    assert [shot(match, replace(RECIPES[1], look=look)) for look in (0, 1)] == [-1.0, 10.0]
    match.robots[0].heading = 0.8  # two
    assert shot(match, replace(RECIPES[1], look=1)) == -1.0
    match = standing((200.0, 300.0, 0.0), (270.0, 300.0, pi))  # on this side of the wall at x = 300
    assert [shot(match, replace(RECIPES[1], off_wall=off_wall)) for off_wall in (1, 0)] == [0.0, 10.0]


def test_a_line_is_rewarded_with_what_is_seen():
    """By Python's own arithmetic, of a decision whose quantities are known by hand."""
    line = "10*hit-miss-3*behind+2*still-turned+fired-7*taken-(distance/99 if fired else 0)"
    match, mind = without_walls(standing((300.0, 300.0, 0.0), (900.0, 300.0, pi))), LearnerMind()
    recipe = with_line(RECIPES[2], line, QUANTITIES, WEIGHTED)
    action = match.actions[0]
    set_action(action, 0.0, 1.0, 1, 0)
    match.tanks[0].taken = 4
    mind.state = situation(match, 0, 1, 1)
    observe_action(match, 0, 1, mind.state, action, recipe, mind.seen)
    match.tanks[0].taken, match.robots[0].heading = 6, pi  # hit twice, and turned away
    observe_transition(match, 0, mind, situation(match, 0, 1, 1), recipe)
    seen = {"hit": 1, "miss": 0, "behind": 1, "still": 1, "turned": 1, "fired": 1, "taken": 2, "distance": 600.0}
    assert dict(zip(QUANTITIES, mind.seen, strict=True)) == seen
    assert reward(taught(recipe), mind.seen) == pytest.approx(eval(line, {}, seen))


@pytest.mark.parametrize(
    "wrong", [{"gamma": 1.0}, {"period": 0}, {"cold": 0.0}, {"hit": float("nan")}, {"in_sight": 2}]
)
def test_a_recipe_nothing_can_be_learned_with_is_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Recipe(**wrong)


def test_a_kernel_reads_the_same_numbers_as_a_recipe_has():
    assert [field.name for field in fields_of(RecipeRecord)] == list(vars(RecipeNumbers()))


# ------------------------------------------------------------------------------------------ learning


def experience(table, state, move, worth, here):
    mind = LearnerMind()
    mind.state, mind.move, mind.seen[HIT] = state, move, worth / table.knobs.hit
    update(table, mind, here)


def test_the_first_visit_overwrites_and_later_ones_average():
    table = taught()
    x, y = state(0, NONE, NONE), state(1, NONE, NONE)
    for worth, mean in ((10.0, 10.0), (4.0, 7.0), (1.0, 5.0)):
        experience(table, x, FIRE, worth, y)
        assert table.q[x * ACTIONS + FIRE] == pytest.approx(mean)
    assert table.n[x * ACTIONS + FIRE] == 3
    assert (table.experiences, table.pairs, table.states) == (3, 1, 1)


def test_what_follows_counts_by_gamma():
    table = taught()
    x, y = state(2, NONE, NONE), state(0, NONE, NONE)
    experience(table, y, FIRE, 10.0, x)
    experience(table, x, DRIVE, -1.0, y)
    assert table.q[x * ACTIONS + DRIVE] == pytest.approx(-1.0 + 0.6 * 10.0)


@pytest.mark.long
def test_rewards_of_10_for_ever_tend_to_25():
    """10 / (1 - 0.6): each visit averages over all targets so far, so Q approaches slowly and from below."""
    table = taught()
    x = state(0, NONE, NONE)
    worths = []
    for _ in range(100_000):
        experience(table, x, FIRE, 10.0, x)
        worths.append(table.q[x * ACTIONS + FIRE])
    assert worths == sorted(worths)
    assert 24.5 < worths[-1] < 25.0


@pytest.mark.parametrize(
    ("experiences", "heat"), [(0, 0.5), (50_000, 0.26), (99_999, 0.0200048), (100_000, 0.02), (480_000, 0.02)]
)
def test_the_temperature_falls_in_a_straight_line(experiences, heat):
    table = taught()
    table.experiences = experiences
    assert temperature(table) == pytest.approx(heat)


@pytest.mark.parametrize(("experiences", "heat"), [(0, 0.5), (99_999, 0.5), (100_000, 0.02)])
def test_whole_numbers_as_in_the_thesis_make_it_fall_in_one_step(experiences, heat):
    table = taught(replace(RECIPES[1], ramp=0))
    table.experiences = experiences
    assert temperature(table) == pytest.approx(heat)


def test_the_roulette_draws_by_exp_of_q_over_t():
    table = taught()
    table.q[FIRE], table.q[DRIVE] = 0.5, 0.25
    odds = [exp(q / 0.5) for q in table.q[:ACTIONS]]
    drawn = [0] * ACTIONS
    for _ in range(20_000):
        drawn[sample_move(table, 0, 0.5, table, [0.0] * ACTIONS)] += 1
    for count, share, wish in zip(drawn, odds, move_probabilities(table, 0, 0.5), strict=True):
        assert share / sum(odds) == pytest.approx(wish)
        assert count / 20_000 == pytest.approx(wish, abs=0.012)  # 4 standard deviations are 0.0094


@pytest.mark.parametrize("heat", [0.5, 0.02])
def test_powers_and_the_highest_value_are_those_of_their_definitions_to_the_bit(heat):
    table, chance = taught(), Random(2)
    for _ in range(200):
        table.q[:ACTIONS] = row = [
            chance.choice([0.0, 0.0, 10.0, -1.0, chance.gauss(0.0, 5.0)]) for _ in range(ACTIONS)
        ]
        odds = [0.0] * ACTIONS
        sample_move(table, 0, heat, table, odds)
        assert max_value(table, 0) == max(row)
        assert odds == [exp((q - max(row)) / heat) for q in row]


def test_q_of_25_at_the_lowest_temperature_overflows_nothing():
    table = taught()
    table.q[:ACTIONS] = [25.0 if a == DRIVE else -25.0 for a in range(ACTIONS)]
    assert {sample_move(table, 0, 0.02, table, [0.0] * ACTIONS) for _ in range(100)} == {DRIVE}


def test_both_robots_learn_into_one_table_ten_times_a_second():
    match = Match(training_setup(1, minutes=0.1)).state
    table, minds = taught(), (LearnerMind(), LearnerMind())
    game = Match(training_setup(1)).game
    while not match.over:
        for seat in (0, 1) if match.tick % table.knobs.period == 0 else ():
            learn(match, seat, minds[seat], table)
        game.judge(match)
    assert table.experiences == 2 * (60 - 1)
    for seat in (0, 1):
        learn_last(match, seat, minds[seat], table)
    assert table.experiences == sum(table.n) == 2 * 60
    assert sum(n > 0 for n in table.n) == table.pairs


def test_a_player_draws_at_the_last_temperature_and_changes_nothing_but_its_action():
    match, table, mind = Match(training_setup(1)).state, taught(), LearnerMind()
    reset(mind, 1)
    here = situation(match, 0, 1, 1)
    table.q[here * ACTIONS + FIRE] = table.q[here * ACTIONS + DRIVE] = 1.0
    known, before = digest(table), digest(match)
    moves = set()
    for _ in range(50):
        think(match, 0, mind, table)
        moves.add(mind.move)
    assert moves == {FIRE, DRIVE}  # equal values are equally likely: a draw, not the first maximum
    assert digest(table) == known
    set_action(match.actions[0], 0.0, 0.0, 0, 0)
    assert digest(match) == before


def test_a_table_is_a_record():
    assert isinstance(fresh_table(3), QTable)
    assert fresh_table(3).random != fresh_table(4).random
