"""The arenas are fair, and a wrong file names the key and the reason."""

import pytest

from pigaming_app.games.arenas import arenas, load, parse
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.things.spec import ThingSpec, Use, written
from tests.football.pitch import ARENAS


def test_there_are_three():
    assert sorted(arenas("football")) == sorted(ARENAS)
    assert arenas("football")[0] == "classic"


@pytest.mark.parametrize("name", ARENAS)
def test_either_half_is_the_other_one_turned_and_mirrored(name):
    arena = load("football", name)
    ends = {frozenset({(w.ax, w.ay), (w.bx, w.by)}): w.half for w in arena.walls}
    for turn in (lambda x, y: (1600 - x, 900 - y), lambda x, y: (1600 - x, y), lambda x, y: (x, 900 - y)):
        assert {frozenset(turn(*end) for end in wall): half for wall, half in ends.items()} == ends
        assert {turn(*spot) for spot in arena.plan.drops} == set(arena.plan.drops)
        assert {turn(s.x, s.y) for s in arena.starts} == {(s.x, s.y) for s in arena.starts}
    for mine, yours in ((0, 1), (2, 3)):  # a robot against a robot starts alike
        one, other = arena.starts[mine], arena.starts[yours]
        assert (one.x + other.x, one.y + other.y) == (1600, 900)


GOOD = load("football", "classic").source


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("width = 240", "width = 40", "goal.width: 40 px, but 120 to 500 are possible"),
        ("width = 240", "height = 270", "goal.height: unknown key"),
        ("[goal]\nwidth = 240", "", "goal: a table is missing"),
        ("at = [800, 450]", "at = [700, 450]", "drop: the first must be at [800, 450], the middle"),
        ("at = [400, 450]", "at = [5, 450]", "drop[2].at: a ball at (5, 450) would lie in a wall"),
        ("at = [400, 450]", "at = [800, 500]", "drop[2].at: nearer than 120 px to another drop point"),
        ("[[drop]]\nat = [400, 450]", "[[spot]]\nat = [400, 450]", "spot: unknown key"),
    ],
)
def test_a_wrong_file_names_key_and_reason(old, new, reason):
    assert old in GOOD
    with pytest.raises(ArenaError, match=r"x\.toml: ") as raised:
        parse("football", GOOD.replace(old, new, 1), "x.toml")
    assert reason in str(raised.value)


def test_too_few_drop_points_are_refused():
    with pytest.raises(ArenaError, match="5 free points, but 6 to 12 are needed"):
        parse("football", GOOD.split("[[drop]]\nat = [400, 200]")[0], "x.toml")


def test_drop_points_below_things_are_left_out():
    box = ThingSpec(Use.WALL, ((770.0, 140.0), (830.0, 140.0), (830.0, 200.0), (770.0, 200.0)), 4.0)
    arena = parse("football", GOOD + written((box,)), "x.toml")
    assert len(arena.plan.drops) == len(load("football", "classic").plan.drops) - 1
    assert (800.0, 170.0) not in arena.plan.drops
