"""Pitches from a seed."""

import pytest

from pigaming_app.games.arenas import load
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.games.registry import games
from pigaming_app.scenes.editor.model.problems import problems
from tests.matches import match_of

MINUTES = 5.0


def check(seed: int) -> tuple[int, int]:
    """Check that a pitch looks the same from all sides; returns the width of its goals and its number of walls."""
    arena = load("football", f"surprise-{seed}")
    assert not problems(games()["football"], drawing_of(arena.source)), seed
    ends = {frozenset({(w.ax, w.ay), (w.bx, w.by)}): w.half for w in arena.walls}
    for turn in (lambda x, y: (1600 - x, y), lambda x, y: (x, 900 - y)):
        assert {frozenset(turn(*end) for end in wall): half for wall, half in ends.items()} == ends
        assert {turn(*spot) for spot in arena.plan.drops} == set(arena.plan.drops)
        assert {turn(s.x, s.y) for s in arena.starts} == {(s.x, s.y) for s in arena.starts}
    return 2 * round(arena.plan.mouth), len(arena.walls)


def dropped(seed: int) -> float:
    """Drops anew a minute, in five minutes of four robots; they score."""
    match = match_of("football", ["level5"] * 4, f"surprise-{seed}", MINUTES, seed, "standard")
    drops, was_out, goals = 0, True, 0
    while not match.over:
        match.tick()
        out = match.state.ball.out > 0
        drops += out and not was_out and match.state.goals == goals
        was_out, goals = out, match.state.goals
    assert goals
    return drops / MINUTES


def test_pitches_are_playable_fair_and_differ() -> None:
    found = [check(seed) for seed in range(12)]
    assert len({width for width, _ in found}) > 3
    assert len({walls for _, walls in found}) > 3
    assert dropped(1) < 1.0
    assert load("football", "surprise-3") == load("football", "surprise-3")


@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize("first", range(0, 1000, 100))
def test_a_thousand_seeds_can_be_played(first: int) -> None:
    assert len({check(seed) for seed in range(first, first + 100)}) > 50
    assert sum(dropped(seed) for seed in range(first, first + 100, 25)) / 4 < 0.5
