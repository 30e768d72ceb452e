"""Effort follows the score within its bounds, and what depends on it follows the effort."""

from itertools import pairwise
from typing import Any

import pytest

from pigaming_app.ai.brain.effort import AUTO, CHANGE, MOST, Effort, between, follow, margin
from pigaming_app.ai.brain.kind import BrainPlayer
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import AIS, find_brain, make_brain
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import ROBOTS
from tests.matches import match_of

AUTO_GAMES = [game for game, ai in AIS.items() if ai.auto]


def scored(game, points):
    match = match_of(game, ["idle"] * 4, minutes=1.0)
    for robot, score in zip(match.state.robots, points, strict=True):
        robot.score = score
    return match.state


@pytest.mark.parametrize(
    ("points", "ahead"),
    [((6, 0, 3, 0), (5.0, -3.0, 1.0, -3.0)), ((0, 0, 0, 0), (0.0,) * 4), ((-9, 0, 0, 0), (-9.0, 3.0, 3.0, 3.0))],
)
def test_the_margin_is_to_the_mean_of_the_others(points, ahead):
    state = scored("pitanks", points)
    assert [margin(state, seat) for seat in range(4)] == pytest.approx(list(ahead))


def test_a_team_has_the_points_of_both():
    state = scored("football", (2, 1, 1, 0))
    assert [margin(state, seat) for seat in range(4)] == [2.0, -2.0, 2.0, -2.0]


def test_who_is_alone_has_no_margin():
    state = scored("pitanks", (5, 0, 0, 0))
    for robot in state.robots[1:]:
        robot.present = 0
    assert margin(state, 0) == 0.0


def test_effort_rises_behind_and_falls_ahead_and_stays_within_its_bounds():
    effort = Effort()
    effort.now, effort.least, effort.most = 0.5, 0.3, 0.8
    follow(effort, -2.0, 10.0)
    assert effort.now == pytest.approx(0.5 + 20.0 * CHANGE)
    follow(effort, 4.0, 5.0)
    assert effort.now == pytest.approx(0.5)
    follow(effort, -50.0, 1.0)
    assert effort.now == pytest.approx(0.5 + MOST * CHANGE), "of a great lead, a few points count"
    follow(effort, -6.0, 1000.0)
    assert effort.now == 0.8
    follow(effort, 6.0, 1000.0)
    assert effort.now == 0.3


def test_starts_are_in_even_steps_and_each_reaches_the_next():
    efforts = [make_brain("pitanks", name, 1).mind.effort for name in AUTO]
    assert [8 * effort.now for effort in efforts] == pytest.approx(range(9))
    assert all(later.least <= before.most for before, later in pairwise(efforts))


@pytest.mark.parametrize("game", AUTO_GAMES)
def test_the_ends_play_as_the_brains_between_which_they_are(game):
    """With its effort held at an end, a brain of Auto plays tick for tick as the easy or the hard brain itself."""
    ai = AIS[game]
    assert ai.auto
    for name, effort, end in (("auto1", 0.0, ai.auto[0]), ("auto9", 1.0, ai.auto[1])):
        matches = [match_of(game, [name] * 4, minutes=0.2, seed=5), match_of(game, ["idle"] * 4, minutes=0.2, seed=5)]
        for seat, player in enumerate(matches[0].brains):
            mind = vars(player)["mind"]
            mind.effort.least = mind.effort.most = effort
            matches[1].sit(seat, BrainPlayer(end, 5 * ROBOTS + seat))
        for match in matches:
            for _ in range(500):
                match.tick()
        assert digest(matches[0].state) == digest(matches[1].state), (game, name)


@pytest.mark.parametrize("game", AUTO_GAMES)
def test_a_match_changes_the_strength_of_its_robots(game):
    """Robots of Auto, one of which is given a lead that it cannot lose, end weaker, the others stronger."""
    match = match_of(game, ["auto5"] * 4, minutes=0.3, seed=2)
    for _ in range(400):
        match.tick()
        for seat, robot in enumerate(match.state.robots):
            robot.score = 0 if seat or game == "race" else 5
        if game == "race":
            match.state.racers[0].progress = 5000.0
    now: list[Any] = [vars(brain)["mind"].effort.now for brain in match.brains]
    teams = [robot.team for robot in match.state.robots]
    assert [effort < 0.5 for effort in now] == [team == teams[0] for team in teams], now


def test_brains_that_differ_in_more_than_numbers_are_refused():
    with pytest.raises(ValueError, match="not of one kind"):
        between(find_brain("pitanks", "hand1"), find_brain("pitanks", "level1"))
    planner, easier = find_brain("factory", "planner"), find_brain("factory", "level1")
    with pytest.raises(ValueError, match="only single numbers may differ"):
        between(planner, easier)


@pytest.mark.parametrize("game", AUTO_GAMES)
def test_the_lobby_offers_none_of_them(game):
    assert not {*AUTO} & {*AIS[game].rivals, *AIS[game].brains}
    assert all(find_brain(game, name).name == name for name in AUTO)


@pytest.mark.again
@pytest.mark.long
@pytest.mark.skipif(not can_compile(), reason="needs the extra train")
@pytest.mark.parametrize("game", AUTO_GAMES)
def test_they_play_alike_in_both_bodies(game):
    match = match_of(game, ["auto1", "auto4", "auto6", "auto9"], minutes=0.4, seed=4)
    kinds = [find_brain(game, name) for name in ("auto1", "auto4", "auto6", "auto9")]
    batches = [Batch([match.setup], kinds, fast) for fast in (False, True)]
    for batch in batches:
        batch.play(1200)
    assert digest(batches[0].ended()[0]) == digest(batches[1].ended()[0])
