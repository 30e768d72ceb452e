"""Tracks from a seed."""

import pytest

from pigaming_app.games.arenas import load
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.games.race.surprise import HALVES, surprise
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor.model.problems import problems
from pigaming_app.sim.world import HEIGHT, WIDTH
from tests.cases import repeated
from tests.matches import finished, match_of


def check(seed: int) -> int:
    """Check a track; returns its number of corners."""
    drawing = drawing_of(surprise(seed))
    assert not problems(games()["race"], drawing)
    corners = [(*part.get("at"), part.get("radius"), part.get("width")) for part in drawing.of("corner")]  # type: ignore[misc]
    turned = [(WIDTH - x, HEIGHT - y, *rest) for x, y, *rest in corners]
    half = len(corners) // 2
    assert corners[:half] == turned[half:]
    assert corners[half:] == turned[:half]
    lines = drawing.of("track")[0].get("lines")
    assert isinstance(lines, tuple)
    assert all(abs(lines[k + 2] - lines[k] - 0.5) < 2e-4 for k in range(2))  # type: ignore[operator]
    return len(corners)


def lap(seed: int) -> None:
    """The hand-written driver finishes two laps alone."""
    match = finished(match_of("race", "level3", f"surprise-{seed}", 2.0, 1, "standard", 2))
    assert match.state.racers[0].finished


def test_tracks_are_valid_symmetric_and_differ() -> None:
    sizes = {check(seed) for seed in range(12)}
    assert len(sizes) > 1
    assert len({surprise(seed).split("\n", 3)[3] for seed in range(12)}) == 12
    assert surprise(3) == surprise(3)


@pytest.mark.parametrize("seed", range(2))
def test_a_lap_is_possible(seed: int) -> None:
    lap(seed)
    assert load("race", f"surprise-{seed}").name == f"surprise-{seed}"


@pytest.mark.long
@pytest.mark.parametrize("first", repeated(range(0, 1000, 200)))
def test_a_thousand_seeds_can_be_played(first: int) -> None:
    sizes = {check(seed) for seed in range(first, first + 200)}
    assert sizes == {2 * half for half in range(HALVES[0], HALVES[1] + 1)}
    for seed in range(first, first + 200, 25):
        lap(seed)
