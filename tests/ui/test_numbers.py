"""Numbers on the screen, against exact decimal arithmetic; and that all of them are written here."""

import ast
import random
import re
from collections.abc import Iterator
from decimal import ROUND_HALF_EVEN, Decimal

import pytest

from pigaming_app import ASSETS
from pigaming_app.ui.i18n import LANGUAGES, MINUS, Words, numeral, signed
from tests.scenes.measuring import SIGNED_ZERO

ROOT = ASSETS.parent
EDGES = (0.0, -0.0, 0, -1, 1, -0.5, 0.5, -0.05, 0.049, -0.004, -0.4999999, -999, 2**31 - 1, -1e-300)


def values() -> Iterator[float]:
    draw = random.Random(28)
    yield from EDGES
    for _ in range(2000):
        yield draw.choice((1.0, -1.0)) * 10.0 ** draw.uniform(-6.0, 6.0)
        yield draw.randint(-1000, 1000)


@pytest.mark.parametrize("digits", [0, 1, 2, 3])
def test_numbers_are_rounded_exactly_and_zero_has_no_sign(digits: int) -> None:
    for value in values():
        exact = Decimal(value).quantize(Decimal(1).scaleb(-digits), ROUND_HALF_EVEN)
        plain, with_sign = numeral(value, digits), signed(value, digits)
        assert Decimal(plain.replace(MINUS, "-")) == exact, value
        assert not plain.startswith("-")
        if exact == 0:
            assert plain == with_sign == f"{Decimal(0):.{digits}f}"
        else:
            assert with_sign == (plain if exact < 0 else f"+{plain}")


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("value", [-0.0, "-0.0", "−0.00", "+0.0"])
def test_no_text_shows_a_zero_with_a_sign(language: str, value: object) -> None:
    words = Words(language)
    assert not SIGNED_ZERO.search(words("calibrate.mm", mm=value))
    assert words("calibrate.mm", mm=value).startswith("0")


def test_a_zero_with_a_sign_is_found() -> None:
    assert all(SIGNED_ZERO.search(text) for text in ("−0", "-0.00", "Total −0", "+0", "−0,0 mm"))
    assert not any(SIGNED_ZERO.search(text) for text in ("−0.01", "0", "2026-01-02", "+0,5", "10-0", "−05"))


def test_no_other_module_of_the_screens_writes_signs() -> None:
    """Neither f"{number:+}" nor a sign put before a number or a minus in the place of a hyphen."""
    rooms = ("pigaming_app/scenes", "pigaming_app/ui", "pigaming_football")
    others = [file for room in rooms for file in sorted((ROOT / room).rglob("*.py")) if file.name != "i18n.py"]
    assert len(others) > 200
    assert [f"{file}:{line}" for file in others for line in lines_with_signs(file.read_text("utf-8"))] == []


def test_such_signs_are_found() -> None:
    for line in ('f"{a:+}"', 'f"{a:+.2f}"', 'f"−{a}"', 'f"up +{a}"', 'str(a).replace("-", "−")'):
        assert list(lines_with_signs(f"b = {line}")) == [1], line


def lines_with_signs(source: str) -> Iterator[int]:
    """Lines of Python that write the sign of a number."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FormattedValue) and node.format_spec and ast.unparse(node.format_spec)[2:3] == "+":
            yield node.lineno
        elif isinstance(node, ast.JoinedStr):
            for part, after in zip(node.values, node.values[1:], strict=False):
                if re.search(r"(^| )[+−]$", str(getattr(part, "value", ""))) and isinstance(after, ast.FormattedValue):
                    yield node.lineno
        elif isinstance(node, ast.Call) and [getattr(word, "value", "") for word in node.args] == ["-", "−"]:
            yield node.lineno
