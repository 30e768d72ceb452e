"""Typed values of files: what does not fit is one short line that names the key."""

from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated

import pytest
from msgspec import Meta

from pigaming_app.storage.parsing import ParseError
from pigaming_app.storage.schema import Count, Finite, Line, from_json, from_toml, to_json, to_toml, typed


class Kind(StrEnum):
    CUP = "cup"


@dataclass(frozen=True)
class Row:
    name: Line
    wins: Annotated[int, Meta(ge=0, le=9)] = 0
    at: tuple[Finite, Finite] = (0.0, 0.0)
    kind: Kind = Kind.CUP

    def __post_init__(self) -> None:
        if self.name == "nobody":
            raise ValueError("nobody plays")


@dataclass(frozen=True)
class Rows:
    rows: tuple[Row, ...]
    seed: Count = 1


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('{"rows": [{"name": "A"}, {"wins": 1}]}', "rows[1]: name is missing"),
        ('{"rows": [{"name": 7}]}', "rows[0].name: expected a text, got a whole number"),
        ('{"rows": [{"name": "A", "wins": 10}]}', "rows[0].wins: expected a whole number <= 9"),
        ('{"rows": [{"name": "A", "wins": true}]}', "rows[0].wins: expected a whole number, got true or false"),
        ('{"rows": [{"name": "A", "wins": 1.0}]}', "rows[0].wins: expected a whole number, got a number"),
        ('{"rows": [{"name": "A", "wins": %s}]}' % ("9" * 400), "rows[0].wins: expected a whole number, got a number"),
        ('{"rows": [{"name": "A", "at": [1]}]}', "rows[0].at: expected a list of length 2, got 1"),
        ('{"rows": [{"name": "A", "at": [1, NaN]}]}', "rows[0].at[1]: expected a number >= -1e+300"),
        ('{"rows": [{"name": "A", "at": [1, -Infinity]}]}', "rows[0].at[1]: expected a number >= -1e+300"),
        ('{"rows": [{"name": "A", "kind": "duel\\n"}]}', r"rows[0].kind: 'duel\n' is not possible"),
        ('{"rows": [{"name": "nobody"}]}', "rows[0]: nobody plays"),
        ('{"rows": {}}', "rows: expected a list, got a table"),
        ("[]", "expected a table, got a list"),
    ],
)
def test_what_does_not_fit_is_named_with_its_key(text, reason):
    with pytest.raises(ParseError) as refused:
        from_json(text, Rows)
    assert str(refused.value) == reason


@pytest.mark.parametrize(
    "text", ["a\n", "\x1b[2J", "\x9b", "a\u2028b", "\u202e", "\ud800", "\ue000", "\ufeff", "x" * 401]
)
def test_a_line_is_short_and_printable(text):
    with pytest.raises(ParseError, match=r"^name: expected a text of (printable characters|length <= 400)$"):
        typed({"name": text}, Row)


@pytest.mark.parametrize("text", ["", "Ação", "Zoë & Łukasz – ЁЖ", "日本", "/a b/mine.npz", "🤖"])
def test_names_of_people_and_files_are_lines(text):
    assert typed({"name": text}, Row).name == text


@pytest.mark.parametrize("head", ["", "format = 2\n", "format = true\n", 'format = "1"\n'])
def test_another_format_is_refused(head):
    with pytest.raises(ParseError, match=r"^format: .*, but 1 is needed$"):
        from_toml(head + "rows = []", Rows, 1)


def test_a_value_comes_back_from_both_languages():
    rows = Rows((Row("A", 3, (0.5, -2.0)), Row("B")), 2**63 - 1)
    assert from_json(to_json(rows), Rows) == rows
    assert from_toml(to_toml(rows, 1), Rows, 1) == rows
