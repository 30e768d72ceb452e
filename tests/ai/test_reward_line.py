"""Reward lines mean what they mean in Python, in both bodies, and nothing else is a line."""

import random
from dataclasses import dataclass, replace
from math import isfinite

import pytest

from pigaming_app.ai.qlearning.recipe import RECIPES, Recipe
from pigaming_app.ai.reward_line import LONGEST, MOST, LineError, line_of, parsed, points, program_of, with_line
from pigaming_app.ai.reward_quantities import QUANTITIES, WEIGHTED

NAMES = "hit", "miss", "behind", "still", "turned", "distance"
KNOBS = NAMES[:4]


@dataclass(frozen=True)
class Weights:
    hit: float = 0.0
    miss: float = 0.0
    behind: float = 0.0
    still: float = 0.0
    rest: str = ""


def worth(text: str, seen: list[float]) -> float:
    return points(program_of(text, NAMES), seen)


def by_python(text: str, seen: list[float]) -> float:
    """The same by Python itself."""
    return float(eval(text, {"min": min, "max": max, "abs": abs}, dict(zip(NAMES, seen, strict=True))))


def drawn(draw: random.Random, deep: int) -> str:
    """A random expression."""
    if deep == 0 or draw.random() < 0.15:
        return draw.choice([*NAMES, f"{draw.randint(0, 9)}", f"{draw.randint(1, 99) / 100}"])
    a, b, c = (drawn(draw, deep - 1) for _ in range(3))
    sign = draw.choice(["<", "<=", ">", ">=", "==", "!="])
    forms = f"{a} + {b}", f"{a} - {b}", f"({a})*({b})", f"-({a})", f"({a}) / 4", f"({a} {sign} {b})"
    calls = f"({a} < {b} <= {c})", f"min({a}, {b}, {c})", f"max({a}, {b})", f"abs({a})", f"({a} if {b} else {c})"
    return draw.choice([*forms, *calls, f"{draw.randint(-10, 10)}*{draw.choice(NAMES)} - {a}"])


def test_a_line_means_what_python_means_by_it() -> None:
    draw, compared = random.Random(7), 0
    for _ in range(3000):
        text = drawn(draw, draw.randint(1, 3))
        seen = [draw.choice([0.0, 1.0, draw.uniform(-5, 5)]) for _ in NAMES]
        try:
            found = worth(text, seen)
        except LineError:
            continue  # too long
        expected = by_python(text, seen)
        assert found == pytest.approx(max(-MOST, min(MOST, expected)))
        compared += 1
    assert compared > 2500


def test_knobs_and_rest_together_mean_the_line_and_give_it_back() -> None:
    draw, split = random.Random(8), 0
    for _ in range(2000):
        text = drawn(draw, draw.randint(1, 3))
        seen = [draw.uniform(-3, 3) for _ in NAMES]
        try:
            recipe = with_line(Weights(), text, NAMES, KNOBS)
        except LineError:
            continue
        again = line_of(recipe, KNOBS)
        linear = sum(getattr(recipe, name) * seen[NAMES.index(name)] for name in KNOBS)
        both = linear + points(program_of(recipe.rest, NAMES), seen)
        expected = by_python(text, seen)
        assert both == pytest.approx(expected, abs=1e-9)
        assert by_python(again, seen) == pytest.approx(expected, abs=1e-9), again
        split += bool(recipe.rest) and recipe != Weights(rest=recipe.rest)
    assert split > 200


@pytest.mark.parametrize(
    ("text", "weights", "rest", "shown"),
    [
        ("10*hit-miss", {"hit": 10.0, "miss": -1.0}, "", "10*hit - miss"),
        ("0.01 * turned * -1 + hit*2 + hit", {"hit": 3.0}, "0.01*turned*-1", "3*hit + 0.01*turned*-1"),
        ("-(hit - 2*still) - 0.5*turned", {"hit": -1.0, "still": 2.0}, "-0.5*turned", "-hit + 2*still - 0.5*turned"),
        ("hit − 3×miss", {"hit": 1.0, "miss": -3.0}, "", "hit - 3*miss"),
        ("1 if distance < 300 else 0", {}, "1 if distance < 300 else 0", "1 if distance < 300 else 0"),
        ("hit + (distance > 9)", {"hit": 1.0}, "distance > 9", "hit + (distance > 9)"),
        ("0*hit", {"hit": 0.0}, "", "0"),
    ],
)
def test_the_terms_of_knobs_are_told_from_the_rest(text: str, weights: dict[str, float], rest: str, shown: str) -> None:
    line = parsed(text, NAMES, KNOBS)
    assert (line.weights, line.rest) == (weights, rest)
    assert line_of(with_line(Weights(), text, NAMES, KNOBS), KNOBS) == shown


def test_a_turned_knob_changes_its_term_alone() -> None:
    recipe = with_line(RECIPES[1], "10*hit - 0.01*turned", QUANTITIES, WEIGHTED)
    assert line_of(replace(recipe, hit=9.0), WEIGHTED) == "9*hit - 0.01*turned"
    assert line_of(RECIPES[1], WEIGHTED) == "10*hit - miss - behind"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "empty"),
        ("hit +", "syntax"),
        ("__import__('os').system('x')", "syntax"),
        ("(lambda: 1)()", "syntax"),
        ("hit.real", "syntax"),
        ("hit ** 9", "syntax"),
        ("[hit][0]", "syntax"),
        ("'a'*3", "syntax"),
        ("True", "syntax"),
        ("(hit := 1)", "syntax"),
        ("min(hit)", "syntax"),
        ("max(*hit, 1)", "syntax"),
        ("abs(hit, key=1)", "syntax"),
        ("print(hit)", "syntax"),
        ("0x", "syntax"),
        ("hit and miss", "syntax"),
        ("hit\x00", "syntax"),
        ("hits", "name"),
        ("1e999*hit", "big"),
        ("999*hit + 999*hit", "big"),
        ("2000", "big"),
        ("hit" + " + hit" * 20, "long"),
        ("(" * 79 + "1", "syntax"),
    ],
)
def test_what_is_no_reward_is_refused_in_one_line(text: str, reason: str) -> None:
    with pytest.raises(LineError) as found:
        parsed(text, NAMES, KNOBS)
    assert found.value.reason == reason
    assert "\n" not in str(found.value)


def test_random_text_is_a_finite_reward_or_refused() -> None:
    draw = random.Random(9)
    parts = [
        *NAMES,
        "1",
        "0",
        ".5",
        "e9",
        "+",
        "-",
        "*",
        "/",
        "(",
        ")",
        "if",
        "else",
        "<",
        "==",
        "min",
        "abs",
        ",",
        " ",
    ]
    lines = 0
    for _ in range(20_000):
        text = "".join(draw.choice(parts) for _ in range(draw.randint(1, 12)))
        try:
            program = parsed(text, NAMES, KNOBS).program
        except LineError:
            continue
        lines += len(text) <= LONGEST
        assert isfinite(points(program, [draw.uniform(-1e6, 1e6) for _ in NAMES]))
    assert lines > 300


def test_dividing_by_nothing_gives_nothing() -> None:
    assert worth("1 / (hit - hit)", [0.5] * 6) == 0.0


def test_a_recipe_with_a_wrong_rest_is_refused() -> None:
    with pytest.raises(LineError, match="hits"):
        Recipe(rest="3*hits")
