"""Lists of entrants as people type, paste and export them."""

import pytest

from pigaming_app.events.entrant_lists import entrants_of_text, entrants_of_words
from pigaming_app.events.spec import Entrant


def test_words():
    assert entrants_of_words(["AAA=level1", " BBB/Red=a/mine.npz", "CCC"]) == (
        Entrant("AAA", "level1"), Entrant("BBB", "a/mine.npz", "Red"), Entrant("CCC")
    )  # fmt: skip


@pytest.mark.parametrize(
    "text",
    [
        "AAA\nBBB=level1\nCCC/Red\n",
        "\ufeffAAA\r\n\r\n# a comment\r\nBBB=level1\r\nCCC/Red",
        "name,ai,team\nAAA,,\nBBB,level1,\nCCC,,Red\n",
        "Name;AI;Team\nAAA;;\nBBB;level1\nCCC;;Red\n",
        'AAA\t\t\n"BBB"\tlevel1\nCCC\t\tRed',
    ],
)
def test_texts_and_tables(text):
    assert entrants_of_text(text) == (Entrant("AAA"), Entrant("BBB", "level1"), Entrant("CCC", "", "Red"))


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("AAA\nAAA", "^line 2: AAA is entered twice$"),
        ("AAA\n" + "x" * 13, "^line 2: 'xxxxxxxxxxxxx': a name has 1 to 12 printable characters$"),
        ("A,b,c,d", "^line 1: a row has a name, an AI and a team$"),
        (",level1", "^line 1: '': a name has"),
        ("\n".join(f"N{i}" for i in range(65)), "^line 65: an event has at most 64 entrants$"),
    ],
)
def test_a_wrong_line_is_named(text, reason):
    with pytest.raises(ValueError, match=reason):
        entrants_of_text(text)
