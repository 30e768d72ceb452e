"""Arenas, tracks and floors from a seed: valid, playable, alike for both sides, and different."""

from collections.abc import Callable
from itertools import pairwise
from math import hypot
from typing import NamedTuple

import pytest

from pigaming_app.games.arenas import load, parse
from pigaming_app.games.drawing.values import Drawing, drawing_of
from pigaming_app.games.factory.surprise import WALLS
from pigaming_app.games.factory.surprise import surprise as factory
from pigaming_app.games.pitanks.surprise import PAIRS, PASSAGE
from pigaming_app.games.pitanks.surprise import surprise as pitanks
from pigaming_app.games.race.surprise import HALVES
from pigaming_app.games.race.surprise import surprise as race
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor.model.problems import problems
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.world import HEIGHT, WIDTH
from tests.cases import repeated
from tests.matches import finished, match_of

SEEDS = range(60)
FAR = 3000.0  # px that a robot drives in a minute that it does not spend in a corner


# ------------------------------------------------------------------------------------------- what each game promises


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


def lap(seed: int) -> None:
    """The hand-written driver finishes two laps alone."""
    assert finished(match_of("race", "level3", f"surprise-{seed}", 2.0, 1, "standard", 2)).state.racers[0].finished


def deliver(seed: int) -> None:
    """Two robots of the planner, one of either team, deliver one pallet each within the time."""
    assert finished(match_of("factory", "planner planner", f"surprise-{seed}", goal=2)).state.winner


def corners(drawing: Drawing) -> int:
    """The corners of a track, whose halves are each other turned round, and so are its lines."""
    found = [(*part.get("at"), part.get("radius"), part.get("width")) for part in drawing.of("corner")]  # type: ignore[misc]
    turned = [(WIDTH - x, HEIGHT - y, *rest) for x, y, *rest in found]
    half = len(found) // 2
    assert found == turned[half:] + turned[:half]
    lines = drawing.of("track")[0].get("lines")
    assert isinstance(lines, tuple)
    assert all(abs(lines[k + 2] - lines[k] - 0.5) < 2e-4 for k in range(2))  # type: ignore[operator]
    return len(found)


def floor_walls(drawing: Drawing) -> int:
    """The walls of a floor, on which starts, slots and machines are mirrored, or turned round, for the other team."""
    arena = parse("factory", drawing.text(), "a.toml")
    sides = {}
    for name, places in {
        "starts": [[(start.x, start.y) for start in arena.starts[team::2]] for team in (0, 1)],
        "slots": [[(slot.x, slot.y) for slot in arena.plan.slots[:16] if slot.team == team] for team in (0, 1)],
        "machines": [[(machine.x, machine.y) for machine in arena.plan.machines[side::2]] for side in (0, 1)],
    }.items():
        ours, theirs = (sorted(some) for some in places)
        mirrored = sorted((WIDTH - x, y) for x, y in ours) == theirs
        turned = sorted((WIDTH - x, HEIGHT - y) for x, y in ours) == theirs
        sides[name] = mirrored, turned
    assert any(all(found) for found in zip(*sides.values(), strict=True)), sides
    return len(drawing.of("wall"))


class Kind(NamedTuple):
    """Arenas of a game: their sources, a match on one, the size of one that is fair, and all sizes there are."""

    surprise: Callable[[int], str]
    play: Callable[[int], None]
    size: Callable[[Drawing], int]
    sizes: set[int] | None


KINDS = {
    "pitanks": Kind(pitanks, fight, lambda drawing: len(drawing.of("wall")), None),
    "race": Kind(race, lap, corners, {2 * half for half in range(HALVES[0], HALVES[1] + 1)}),
    "factory": Kind(factory, deliver, floor_walls, {2 * count for count in range(WALLS + 1)}),
}


def size_of(game: str, seed: int) -> int:
    """The size of an arena, after a check."""
    drawing = drawing_of(KINDS[game].surprise(seed))
    assert not problems(games()[game], drawing)
    return KINDS[game].size(drawing)


# ----------------------------------------------------------------------------------------------------------- all games


@pytest.mark.parametrize("game", KINDS)
def test_arenas_are_playable_fair_and_differ(game: str) -> None:
    surprise = KINDS[game].surprise
    assert len({size_of(game, seed) for seed in range(12)}) > 1
    assert len({surprise(seed).split("\n", 3)[3] for seed in range(12)}) == 12
    assert surprise(3) == surprise(3)


@pytest.mark.parametrize(("game", "seed"), [("race", 0), ("race", 1), ("factory", 1), ("factory", 15)])
def test_a_match_is_possible(game: str, seed: int) -> None:
    """On the floor of seed 15, either of two slots of the exit is nearer by turns on the way round a machine."""
    KINDS[game].play(seed)
    assert load(game, f"surprise-{seed}").name == f"surprise-{seed}"


@pytest.mark.long
@pytest.mark.parametrize("first", repeated(range(0, 1000, 100)))
@pytest.mark.parametrize("game", repeated(KINDS))
def test_a_thousand_seeds_can_be_played(game: str, first: int) -> None:
    sizes = {size_of(game, seed) for seed in range(first, first + 100)}
    assert KINDS[game].sizes in (None, sizes)
    for seed in range(first, first + 100, 25):
        KINDS[game].play(seed)


def test_wrong_names_are_unknown_arenas() -> None:
    for game, name in (("pitanks", "surprise-"), ("race", "surprise-1234567890"), ("factory", "surprise-x")):
        with pytest.raises(ArenaError, match="no such arena"):
            load(game, name)


# ------------------------------------------------------------------------------------------------------------- PiTanks


def test_walls_look_the_same_from_both_ends_and_let_robots_pass() -> None:
    arenas = [load("pitanks", f"surprise-{seed}") for seed in SEEDS]  # raises where a start has no way to the others
    assert all(len(arena.walls) >= 2 for arena in arenas)
    assert 12 <= max(len(arena.walls) for arena in arenas) <= 2 * max(PAIRS)
    assert len({arena.source.split("\n\n", 1)[1] for arena in arenas}) == len(arenas)
    assert all(one.walls != after.walls for one, after in pairwise(arenas))
    assert {arena.starts[0].x for arena in arenas} == {110.0}
    assert {arena.starts[0].y for arena in arenas} == {110.0, 450.0}
    for arena in arenas:
        ends = {(wall.ax, wall.ay, wall.bx, wall.by, wall.half, wall.health) for wall in arena.walls}
        assert ends == {(WIDTH - ax, HEIGHT - ay, WIDTH - bx, HEIGHT - by, *rest) for ax, ay, bx, by, *rest in ends}
        walls = [((wall.ax, wall.ay), (wall.bx, wall.by), wall.half) for wall in arena.walls]
        for k, (*some, half) in enumerate(walls):
            for *others, other_half in walls[:k]:
                near = min(hypot(ax - bx, ay - by) for ax, ay in some for bx, by in others)
                assert near == 0 or near >= half + other_half + PASSAGE
