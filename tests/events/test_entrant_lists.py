"""Lists of entrants as people type, paste and export them."""

from pathlib import Path

import pytest

from pigaming_app.events.entrant_lists import entrants_of_text, entrants_of_words, read_list
from pigaming_app.events.spec import Entrant
from pigaming_app.storage.parsing import ParseError


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
        '"AAA"\n"BBB=level1"\n"CCC/Red"\n',
        "sep=;\r\nAAA;;\r\nBBB;level1;\r\nCCC;;Red\r\n;;\r\n;;\r\n",
        "team,name,ai\n,AAA,\n,BBB,level1\nRed,CCC,\n",
        "Nome;IA;Equipa\nAAA\nBBB;level1\nCCC;;Red\n",
    ],
)
def test_texts_and_tables(text):
    assert entrants_of_text(text) == (Entrant("AAA"), Entrant("BBB", "level1"), Entrant("CCC", "", "Red"))


def test_separators_within_quotes_belong_to_the_name():
    text = '"Ana, M.";level1\n"B;C",level2\n"Rui, S."\n"D""x";'
    assert [one.name for one in entrants_of_text(text)] == ["Ana, M.", "B;C", "Rui, S.", 'D"x']


def test_equal_names_are_equal_however_their_letters_are_composed():
    with pytest.raises(ValueError, match=r"^line 2: Jürgen is entered twice$"):
        entrants_of_text("Jürgen\nJu\u0308rgen\n")
    assert entrants_of_text("Ana\xa0B\xa0\n") == (Entrant("Ana B"),)


@pytest.mark.parametrize("code", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_files_as_spreadsheets_save_them(tmp_path: Path, code):
    (tmp_path / "list.csv").write_bytes("name;ai\r\nMüller;\r\nNúñez;level1\r\n".encode(code))
    assert entrants_of_text(read_list(tmp_path / "list.csv")) == (Entrant("Müller"), Entrant("Núñez", "level1"))


@pytest.mark.parametrize("raw", [b"AAA\0BBB\n", b"\x7fELF\x02\x01", b"\xff\xfe\x00", bytes(range(256))])
def test_binary_files_are_no_lists(tmp_path: Path, raw):
    (tmp_path / "list.csv").write_bytes(raw)
    with pytest.raises(ParseError, match=r"^it is not text$"):
        read_list(tmp_path / "list.csv")


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
