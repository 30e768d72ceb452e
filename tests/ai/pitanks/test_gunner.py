"""The hand-written opponents of PiTanks: they attack whatever the score, their strengths are ordered, none is stuck."""

from math import hypot
from random import Random

import pytest

from pigaming_app.ai.learning.league import duel
from pigaming_app.ai.pitanks import gunner
from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.pitanks.observation import PiTanksObservation, observe, observe_self
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.record import digest
from tests.ai.pitanks.stuck import stuck
from tests.cases import one_in, repeated
from tests.matches import match_of, run

HANDS = ("hand1", "hand2", "hand3")


def begun(brains, variant="plain", arena="islands", seed=1):
    return match_of("pitanks", brains, arena, 2.0, seed, variant)


def put(match, *places):
    """Move the robots to these places, facing right."""
    for robot, (x, y) in zip(match.state.robots, places, strict=False):
        robot.x, robot.y, robot.heading = x, y, 0.0


@pytest.mark.parametrize("strength", ["hand1", "hand2", "hand3"])
def test_every_strength_thinks_without_changing_anything_but_its_action(strength):
    match = begun((strength,) * 4, "pickups")
    brain, action = make_brain("pitanks", strength, 1), match.state.actions[0]
    before = digest(match.state)
    for _ in range(gunner.PERIOD):
        brain.think(match.state, 0)
    assert brain.mind.obs.turn_rate > 0.0, "it has decided"
    action.linear = action.angular = 0.0
    action.fire = action.turbo = 0
    assert digest(match.state) == before


@pytest.mark.parametrize("lead", [-3, 0, 3])
def test_it_closes_in_and_fires_whatever_the_score(lead):
    match = begun(("hand2", "idle"))
    put(match, (110.0, 450.0), (1200.0, 450.0))
    match.state.robots[0].score = lead
    run(match, 500)
    assert match.state.tanks[0].hits > 0
    assert hypot(match.state.robots[0].x - 1200.0, match.state.robots[0].y - 450.0) < gunner.REACH


def target_of(change):
    """The seat that a gunner turns to, of two idle ones 350 px and 500 px away, after `change(tank)` of the farther."""
    match = begun(("hand2", "idle", "idle"), "party", "classic")
    put(match, (500.0, 600.0), (850.0, 600.0), (500.0, 100.0))
    mind = match.brains[0].mind
    run(match, 1)
    change(match.state.tanks[2])
    mind.target = -1
    gunner.choose_target(match.state, 0, mind)
    return mind.target + 1


def test_it_goes_for_the_nearest_for_lit_ones_and_for_a_bounty():
    assert target_of(lambda tank: None) == 1
    assert target_of(lambda tank: setattr(tank, "lit", 1)) == 2
    assert target_of(lambda tank: setattr(tank, "bounty", 1)) == 2


def test_it_leaves_a_target_that_cannot_be_hit_but_novices_stay_with_theirs():
    for brain, seat in (("hand3", 2), ("hand1", 1)):
        match, mind = begun((brain, "idle", "idle"), arena="classic"), make_brain("pitanks", brain, 1).mind
        put(match, (500.0, 600.0), (850.0, 600.0), (900.0, 600.0))
        gunner.choose_target(match.state, 0, mind)
        assert mind.target + 1 == 1
        match.state.tanks[1].protected = 75
        gunner.choose_target(match.state, 0, mind)
        assert mind.target + 1 == seat


def test_what_it_leaves_out_changes_neither_its_target_nor_what_it_observes_of_it():
    """The target of the full observation, by the same price, in many random situations."""
    match, luck = begun(("hand2", "idle", "idle", "idle"), "party", "classic"), Random(3)
    mind, tanks, whole = match.brains[0].mind, match.state.tanks, PiTanksObservation()
    targets = set()
    for _ in range(400):
        for robot in match.state.robots:
            robot.x, robot.y, robot.heading = luck.uniform(40, 1560), luck.uniform(40, 860), luck.uniform(0, 6.28)
            robot.linear = luck.uniform(-300, 300)
        match.state.robots[3].team = luck.choice([0, 3])
        tanks[2].lit, tanks[1].protected = luck.choice([0, 0, 1]), luck.choice([0, 60])
        last, mind.state = mind.target, gunner.FIGHT
        observe(match.state, 0, mind.senses, whole)
        costs = [
            gunner.price(other.distance, tanks[1 + i])
            + (0.0 if other.clear else gunner.HIDDEN)
            - (mind.loyalty if i == last else 0.0)
            for i, other in enumerate(whole.others)
            if not other.mate
        ]
        gunner.choose_target(match.state, 0, mind)
        assert mind.target == costs.index(min(costs))
        targets.add(mind.target)
        for name in ("x", "y", "distance", "bearing", "aim", "clear", "protected", "lit", "bounty"):
            assert getattr(mind.obs.others[mind.target], name) == getattr(whole.others[mind.target], name)
    assert targets == {0, 1, 2}


def test_in_the_finale_it_shoots_more_often_and_leaves_pick_ups_alone():
    mind = make_brain("pitanks", "hand2", 1).mind
    obs, mind.target, mind.shot, mind.unseen = mind.obs, 0, mind.swing // 2 + 1, 9
    other = obs.others[0]
    other.distance = 600.0
    obs.prize, obs.prize_distance = 1, 300.0
    assert gunner.rhythm(obs, mind, other) == gunner.SWING_ASIDE
    assert gunner.wants_prize(obs, mind)
    obs.finale = 1
    assert gunner.rhythm(obs, mind, other) == gunner.AIM
    assert not gunner.wants_prize(obs, mind)
    obs.prize_distance = gunner.SNATCH - 1.0
    assert gunner.wants_prize(obs, mind)


def test_hand1_aims_behind_a_moving_target():
    match = begun(("hand1", "idle"), arena="classic")
    put(match, (300.0, 600.0), (700.0, 600.0))
    match.state.robots[1].heading, match.state.robots[1].linear = 1.5707963, 260.0
    aims = []
    for brain in HANDS:
        mind = make_brain("pitanks", brain, 1).mind
        gunner.choose_target(match.state, 0, mind)
        aims.append(gunner.aim(mind, mind.obs.others[0]))
    assert aims[0] < aims[1] < aims[2], "the target drives clockwise"


def test_it_swings_to_the_side_with_room():
    match = begun(("hand3", "idle"), arena="classic")
    put(match, (120.0, 50.0), (520.0, 50.0))  # along the upper wall
    mind = match.brains[0].mind
    observe_self(match.state, 0, mind.obs)
    gunner.choose_target(match.state, 0, mind)
    for weave in (1.0, -1.0):
        mind.weave = weave
        gunner.choose_side(match.state, mind.obs, mind, mind.obs.others[0])
        assert mind.weave == 1.0, "down, away from the wall"


def test_a_knocked_out_robot_neither_fires_nor_counts_as_stuck():
    match = begun(("hand2", "idle"), "party")
    put(match, (300.0, 700.0), (700.0, 700.0))
    mind = match.brains[0].mind
    for _ in range(100):
        match.state.tanks[0].knocked_out = 40
        match.tick()
    assert match.state.tanks[0].shots == 0
    assert (mind.state, mind.stuck_ticks) == (gunner.HUNT, 0)


@pytest.mark.parametrize("arena", one_in(5, arenas("pitanks")))
def test_nobody_is_stuck(arena):
    for variant in ("pickups", "party"):
        assert stuck(arena, 1, ("hand3", "hand2", "hand1", "fsm"), variant) == []
        assert stuck(arena, 2, ("hand2", "hand2", "off", "off"), variant) == []


def test_strengths_are_ordered():
    for better, worse in (("hand3", "hand2"), ("hand2", "hand1"), ("hand1", "random")):
        result = duel("pitanks", better, worse, 6, 100, minutes=1.0, variant="pickups", fast=False)
        assert result.wins > result.losses, (better, worse)


@pytest.mark.long
@pytest.mark.again
@pytest.mark.skipif(not can_compile(), reason="hundreds of matches need numba")
@pytest.mark.parametrize(
    ("arena", "variant"), repeated((arena, variant) for variant in ("party", "pickups") for arena in arenas("pitanks"))
)
def test_strengths_are_far_apart_and_mirror_matches_are_decided(arena, variant):
    """Measured shares are in docs/opponents.md; the bounds leave room for 200 matches."""
    for better, worse, least in (("hand3", "hand2", 0.58), ("hand2", "hand1", 0.65), ("hand1", "random", 0.85)):
        result = duel("pitanks", better, worse, 200, 1, variant=variant, arena=arena)
        assert result.wins >= least * 200, (better, worse)
    for hand in HANDS:
        assert duel("pitanks", hand, hand, 200, 1, variant=variant, arena=arena).ties <= 0.2 * 200
        assert duel("pitanks", hand, "idle", 200, 1, variant=variant, arena=arena).ties <= 0.05 * 200
