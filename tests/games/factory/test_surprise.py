"""Floors from a seed."""

import pytest

from pigaming_app.games.arenas import parse
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.games.factory.surprise import WALLS, surprise
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor.model.problems import problems
from pigaming_app.sim.world import HEIGHT, WIDTH
from tests.cases import repeated
from tests.matches import finished, match_of


def check(seed: int) -> int:
    """Check a floor; returns its number of walls."""
    source = surprise(seed)
    drawing = drawing_of(source)
    assert not problems(games()["factory"], drawing)
    arena = parse("factory", source, "a.toml")
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
    walls = drawing.of("wall")
    assert len(walls) % 2 == 0
    return len(walls)


def deliver(seed: int) -> None:
    """Two robots of the planner, one of either team, deliver one pallet each within the time."""
    match = finished(match_of("factory", "level5 level5", f"surprise-{seed}", goal=2))
    assert match.state.winner


def test_floors_are_playable_fair_and_differ() -> None:
    walls = {check(seed) for seed in range(12)}
    assert len(walls) > 1
    assert len({surprise(seed).split("\n", 3)[3] for seed in range(12)}) == 12
    assert surprise(3) == surprise(3)


@pytest.mark.parametrize("seed", [1, 15])
def test_the_planner_delivers(seed: int) -> None:
    """On the floor of seed 15, either of two slots of the exit is nearer by turns on the way round a machine."""
    deliver(seed)


@pytest.mark.long
@pytest.mark.parametrize("first", repeated(range(0, 1000, 200)))
def test_a_thousand_seeds_can_be_played(first: int) -> None:
    assert {check(seed) for seed in range(first, first + 200)} == {2 * count for count in range(WALLS + 1)}
    for seed in range(first, first + 200, 25):
        deliver(seed)
