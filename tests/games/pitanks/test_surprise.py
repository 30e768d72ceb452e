"""Arenas from a seed."""

from itertools import pairwise
from math import hypot

import pytest

from pigaming_app.games.arenas import load
from pigaming_app.games.pitanks.surprise import PAIRS, PASSAGE
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.world import HEIGHT, WIDTH

SEEDS = range(60)


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
