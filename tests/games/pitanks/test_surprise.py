"""Arenas from a seed."""

from itertools import pairwise
from math import hypot

import pytest

from pigaming_app.games.arenas import load
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.games.pitanks.surprise import PAIRS, PASSAGE, surprise
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor.model.problems import problems
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.world import HEIGHT, WIDTH
from tests.cases import repeated
from tests.matches import match_of

SEEDS = range(60)
FAR = 3000.0  # px that a robot drives in a minute that it does not spend in a corner


def fight(seed: int) -> None:
    """Four hand-written opponents drive about for a minute and hit each other."""
    match = match_of("pitanks", ["level3"] * 4, f"surprise-{seed}", 1.0, 1, "plain")
    ways, places = [0.0] * 4, [(robot.x, robot.y) for robot in match.state.robots]
    while not match.over:
        match.tick()
        for i, robot in enumerate(match.state.robots):
            ways[i] += hypot(robot.x - places[i][0], robot.y - places[i][1])
            places[i] = robot.x, robot.y
    assert min(ways) > FAR
    assert any(robot.score for robot in match.state.robots)


def test_every_seed_makes_a_playable_arena() -> None:
    arenas = [load("pitanks", f"surprise-{seed}") for seed in SEEDS]  # raises where a start has no way to the others
    assert all(len(arena.walls) >= 2 for arena in arenas)
    assert 12 <= max(len(arena.walls) for arena in arenas) <= 2 * max(PAIRS)
    assert len({arena.source.split("\n\n", 1)[1] for arena in arenas}) == len(arenas)
    assert {arena.starts[0].x for arena in arenas} == {110.0}
    assert {arena.starts[0].y for arena in arenas} == {110.0, 450.0}


def test_arenas_look_the_same_from_both_ends() -> None:
    for seed in SEEDS:
        walls = load("pitanks", f"surprise-{seed}").walls
        ends = {(wall.ax, wall.ay, wall.bx, wall.by, wall.half, wall.health) for wall in walls}
        turned = {(WIDTH - ax, HEIGHT - ay, WIDTH - bx, HEIGHT - by, *rest) for ax, ay, bx, by, *rest in ends}
        assert ends == turned


def test_robots_pass_between_walls_that_do_not_touch() -> None:
    for seed in SEEDS:
        walls = load("pitanks", f"surprise-{seed}").walls
        ends = [((wall.ax, wall.ay), (wall.bx, wall.by), wall.half) for wall in walls]
        for k, (*some, half) in enumerate(ends):
            for *others, other_half in ends[:k]:
                near = min(hypot(ax - bx, ay - by) for ax, ay in some for bx, by in others)
                assert near == 0 or near >= half + other_half + PASSAGE


def test_the_seed_decides() -> None:
    for seed, after in pairwise(SEEDS):
        assert load("pitanks", f"surprise-{seed}").source == load("pitanks", f"surprise-{seed}").source
        assert load("pitanks", f"surprise-{seed}").walls != load("pitanks", f"surprise-{after}").walls


def test_wrong_names_are_unknown_arenas() -> None:
    for game, name in (("pitanks", "surprise-"), ("race", "surprise-1234567890"), ("factory", "surprise-x")):
        with pytest.raises(ArenaError, match="no such arena"):
            load(game, name)


@pytest.mark.long
@pytest.mark.parametrize("first", repeated(range(0, 1000, 200)))
def test_a_thousand_seeds_can_be_played(first: int) -> None:
    for seed in range(first, first + 200):
        assert not problems(games()["pitanks"], drawing_of(surprise(seed)))
    for seed in range(first, first + 200, 25):
        fight(seed)
