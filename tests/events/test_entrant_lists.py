"""Lists of entrants as people type, paste and export them: bytes of spreadsheets, and tables that `csv` writes."""

import csv
import io
from pathlib import Path

import pytest

from pigaming_app.events.entrant_lists import ListError, entrants_of_text, entrants_of_words, read_list
from pigaming_app.events.spec import Entrant
from pigaming_app.storage.parsing import ParseError

THREE = (Entrant("AAA"), Entrant("BBB", "level1"), Entrant("CCC", "", "Red"))


def test_words():
    assert entrants_of_words(["AAA=level1", " BBB/Red=a/mine.npz", "CCC"]) == (
        Entrant("AAA", "level1"), Entrant("BBB", "a/mine.npz", "Red"), Entrant("CCC")
    )  # fmt: skip


@pytest.mark.parametrize(
    "text",
    [
        "AAA\nBBB=level1\nCCC/Red\n",
        '\ufeffAAA\r\n\r\n# a comment, "with a quote\r\nBBB=level1\r\nCCC/Red',
        "name,ai,team\nAAA,,\nBBB,level1,\nCCC,,Red\n",
        "Name;AI;Team\nAAA;;\nBBB;level1\nCCC;;Red\n",
        'AAA\t\t\n"BBB"\tlevel1\nCCC\t\tRed',
        '"AAA"\n"BBB=level1"\n"CCC/Red"\n',
        "sep=;\r\nAAA;;\r\nBBB;level1;\r\nCCC;;Red\r\n;;\r\n;;\r\n",
        "sep=\t\r\nname\tai\tteam\r\nAAA\r\nBBB\tlevel1\r\nCCC\t\tRed\r\n",
        "team,name,ai\n,AAA,\n,BBB,level1\nRed,CCC,\n",
        "Nome;IA;Equipa\nAAA\nBBB;level1\nCCC;;Red\n",
        "AAA\rBBB=level1\rCCC/Red\r",
        "Name;;Team;AI;;\nAAA;;;;;\nBBB;;;level1;;\nCCC;;Red;;;\n",
    ],
)
def test_texts_and_tables(text):
    found = entrants_of_text(text)
    assert found.entrants == THREE
    assert found.ignored == ()


@pytest.mark.parametrize(
    ("name", "ai", "team"),
    [
        ("Name", "AI", "Team"), ("Nome", "IA", "Equipa"), ("NOME", "ia", "Equipe"), ("Nombre", "IA", "Equipo"),
        ("Name", "KI", "Mannschaft"), ("Nom", "IA", "Équipe"), ("nom", "Ia", "EQUIPE"), ("Nom :", "IA", "E\u0301quipe"),
        ("Player", "ai", "TEAM"), ("Jogador", "IA", "equipa"), ("Jugador", "IA", "equipo"), ("Spieler", "ki", "Team"),
        ("Joueur", "IA", "équipe"), ("Participant", "IA", "Équipe"), ("Teilnehmer", "KI", "Team"),
    ],
)  # fmt: skip
def test_headings_of_five_languages(name, ai, team):
    assert entrants_of_text(f"{team};{ai};{name}\nRed;level1;AAA\n").entrants == (Entrant("AAA", "level1", "Red"),)


@pytest.mark.parametrize(
    "how",
    [
        {"dialect": "excel"},
        {"dialect": "excel-tab"},
        {"dialect": "unix"},
        {"dialect": "excel", "delimiter": ";"},
        {"dialect": "excel", "delimiter": ";", "quoting": csv.QUOTE_ALL},
        {"dialect": "unix", "delimiter": "\t", "quoting": csv.QUOTE_NONNUMERIC},
    ],
)
def test_tables_as_python_writes_them(how):
    """Names with separators, quotes and line breaks; columns that mean nothing, one of them with line breaks, too."""
    text = io.StringIO(newline="")
    writer = csv.writer(text, **how)
    writer.writerow(["Class", "Name", "Notes, if any", "KI"])
    writer.writerow(["5a", "Ana, M.", 'tall; "fast"\n\n# no comment', ""])
    writer.writerow(["5b", 'Rui "R" S;T', "", "level1"])
    writer.writerow(["6", "Eva\nLuz", "", "", ""])
    writer.writerow(["", "", "", ""])
    found = entrants_of_text(text.getvalue())
    assert found.entrants == (Entrant("Ana, M."), Entrant('Rui "R" S;T', "level1"), Entrant("Eva Luz"))
    assert found.ignored == ("Notes, if any",)
    assert [*found.classes.values()] == ["5a", "5b", "6"]


def test_a_space_may_follow_a_separator():
    assert entrants_of_text('name, ai\n"Ana, M.", level1\n').entrants == (Entrant("Ana, M.", "level1"),)


def test_columns_without_a_heading_are_ignored_where_there_is_a_header():
    found = entrants_of_text("Nr;Name;;Team\n1;AAA;tall;Red;late\n2;BBB\n")
    assert found.entrants == (Entrant("AAA", "", "Red"), Entrant("BBB"))
    assert found.ignored == ("Nr", "column 3", "column 5")


def test_equal_names_are_equal_however_their_letters_are_composed():
    with pytest.raises(ValueError, match=r"^line 2: Jürgen is entered twice$"):
        entrants_of_text("Jürgen\nJu\u0308rgen\n")
    assert entrants_of_text("Ana\xa0B\xa0\n").entrants == (Entrant("Ana B"),)


PEOPLE = {
    "es": ["Íñigo Núñez", "Raúl García", "Ángela Muñoz", "Begoña Ibáñez"],
    "pt": ["João Simões", "Conceição", "Inês", "Antão Gonçalves"],
    "de": ["Jürgen Müller", "Jörg Weiß", "Änne Öztürk"],
    "fr": ["René", "Zoë", "Gisèle Lefèvre", "François", "Éric"],
    "apostrophes": ["O’Brien", "D’Arcy", "Siân"],
    "one": ["Jörg", "Anna", "Ben"],
    "another": ["Raúl", "Anna", "Ben"],
    "capitals": ["JOSÉ", "MARÍA", "ÍÑIGO", "JOÃO"],
}


@pytest.mark.parametrize("code", ["utf-8", "utf-8-sig", "utf-16", "cp1252", "mac_roman"])
@pytest.mark.parametrize("names", PEOPLE)
def test_files_as_spreadsheets_save_them(tmp_path: Path, code, names):
    """Each as Excel or Numbers saves it, with the line ends of the system."""
    ends = "\r" if code == "mac_roman" else "\r\n"
    (tmp_path / "list.csv").write_bytes(ends.join(["name;ai", *(f"{name};" for name in PEOPLE[names])]).encode(code))
    found = entrants_of_text(read_list(tmp_path / "list.csv"))
    assert [one.name for one in found.entrants] == PEOPLE[names]


@pytest.mark.parametrize("raw", [b"AAA\0BBB\n", b"\x7fELF\x02\x01", b"\xff\xfe\x00", bytes(range(256))])
def test_binary_files_are_no_lists(tmp_path: Path, raw):
    (tmp_path / "list.csv").write_bytes(raw)
    with pytest.raises(ParseError, match=r"^it is not text$"):
        read_list(tmp_path / "list.csv")


def check(brain: str) -> None:
    """An event in which one AI plays."""
    if brain != "level1":
        raise ValueError(f"no brain '{brain}'")


@pytest.mark.parametrize(
    ("text", "reason", "kind"),
    [
        ("AAA\nAAA", "^line 2: AAA is entered twice$", "taken"),
        ("x" * 24 + "\n" + "x" * 25, "^line 2: 'x{25}': a name has 1 to 24 printable characters$", "name"),
        ("AAA/" + "x" * 25, "^line 1: 'x{25}': a team has 1 to 24 printable characters$", "name"),
        ("A,b,c,d", "^line 1: a row has a name, an AI and a team$", "line"),
        (",level1", "^line 1: '': a name has", "name"),
        ("\n".join(f"N{i}" for i in range(65)), "^line 65: an event has at most 64 entrants$", "full"),
        ('name;ai\n"A\nB";\n\n# C\nD;nobody\n', "^line 6: no brain 'nobody'$", "ai"),
        ('A;\nB;\n"C;\nD;\n', "^line 3: a quoted cell does not end with a quote$", "line"),
        ("Nome;Nom;IA\nA;B;\n", "^line 1: two columns are the name$", "line"),
    ],
)
def test_a_wrong_line_is_named(text, reason, kind):
    with pytest.raises(ListError, match=reason) as error:
        entrants_of_text(text, check)
    assert error.value.kind == kind
