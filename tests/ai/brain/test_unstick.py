"""The recovery reflex: players with a table never stay stuck in a match, and it is off in measurements."""

from dataclasses import replace

import pytest

from pigaming_app.ai.brain.kind import BrainKind, BrainPlayer
from pigaming_app.ai.brain.unstick import PUSHING, Reflex
from pigaming_app.ai.learning import training
from pigaming_app.ai.qlearning.recipe import RECIPES
from pigaming_app.ai.qlearning.table import MOVES, Learned, LearnerMind, Move, player
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.match import Match
from pigaming_app.sim.world import HZ
from tests.ai.pitanks.stuck import stuck
from tests.cases import one_in
from tests.matches import finished, match_of

AHEAD = Move(1.0, 0.0, 0)


def single_minded(move: Move, reflex: bool) -> BrainKind:
    """A player whose table prefers the same move in every state."""
    table = training.fresh_table(1)
    for name, value in {"period": 5, "cold": 0.02}.items():
        setattr(table.knobs, name, value)
    table.q[MOVES.index(move) :: len(MOVES)] = [10.0] * (len(table.q) // len(MOVES))
    return player("single", Learned(table), reflex)


def driven(reflex: bool, variant: str = "classic") -> list[tuple[float, float]]:
    """Positions at the end of each second of half a minute, with the opponent standing still far away."""
    match = Match(replace(training.training_setup(1, minutes=0.5), variant=variant))
    match.sit(0, BrainPlayer(single_minded(AHEAD, reflex), 1))
    places = []
    while not match.over:
        match.tick()
        if match.state.tick % HZ == 0:
            places.append((match.state.robots[0].x, match.state.robots[0].y))
    return places


def test_without_the_reflex_a_headstrong_robot_pushes_against_a_wall_for_ever():
    places = driven(reflex=False)
    assert len({(round(x), round(y)) for x, y in places[10:]}) == 1


def test_with_the_reflex_it_gets_about():
    places = driven(reflex=True, variant="plain")
    assert max(x for x, _ in places) - min(x for x, _ in places) > 300.0
    held = [a for a, b, c in zip(places, places[1:], places[2:], strict=False) if a == b == c]
    assert len(held) <= len(places) // 3


@pytest.mark.parametrize(("variant", "leaves"), [("pickups", True), ("plain", True), ("classic", False)])
def test_whoever_waits_for_nobody_goes_out_in_the_end_but_not_by_the_rules_of_the_measured_results(variant, leaves):
    match = match_of("pitanks", "q1 idle", minutes=0.2, variant=variant)
    match.sit(0, BrainPlayer(single_minded(Move(0.0, 0.0, 0), reflex=True), 1))
    before = match.state.robots[0].x
    finished(match)
    assert (abs(match.state.robots[0].x - before) > 20.0) == leaves


def test_by_the_rules_of_the_measured_results_it_only_comes_off_the_wall_now_and_then():
    ends = [x for x, _ in driven(reflex=True)[10:]]
    assert 10.0 < max(ends) - min(ends) < 60.0


def test_whoever_gets_on_never_feels_it():
    assert PUSHING / HZ > 1.0  # one second of pushing a movable object must not trigger it
    match = Match(training.training_setup(1, minutes=0.02))
    brain = BrainPlayer(single_minded(AHEAD, reflex=True), 1)
    match.sit(0, brain)
    finished(match)
    assert match.state.actions[0].linear == 1.0
    assert brain.mind.reflex.left == 0


def test_it_is_on_for_seats_alone():
    def switched(kind: BrainKind) -> int:
        mind = LearnerMind()
        kind.reset(mind, 1)
        return mind.reflex.on

    assert Reflex().on == 0
    assert [switched(BRAINS["pitanks"][name]) for name in ("q1", "q2")] == [1, 1]
    course = training.TableTraining(RECIPES[1], 1, fast=False, minutes=0.1)
    assert switched(course.checkpoint().kind) == 0
    assert course._ones[0].reflex.on == 0


@pytest.mark.parametrize("arena", one_in(5, arenas("pitanks")))
def test_nobody_with_a_table_is_stuck(arena):
    for seed in (1, 2):
        assert stuck(arena, seed, ("q1", "q2", "off", "off"), "pickups") == []
        assert stuck(arena, seed, ("q2", "hand2", "q1", "classic"), "pickups") == []
