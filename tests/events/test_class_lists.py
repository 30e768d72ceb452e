"""Lists of school classes: columns of five languages, names told apart, and spreadsheets that LibreOffice has saved."""

import csv
import io
import zipfile
from pathlib import Path
from random import Random

import pytest

from pigaming_app.events.entrant_lists import EntrantList, entrants_of_text, read_list
from pigaming_app.events.spreadsheets import MOST_BYTES, text_of
from pigaming_app.storage.parsing import ParseError

DATA = Path(__file__).parents[1] / "data" / "lists"  # saved by LibreOffice 7.4
SCHOOLS = {
    "pt": ("N.º;Nome;Apelido;Turma\n1;Ana;Silva;7.º A\n2;Ana;Moreira;7.º B\n3;João;Simões;7.º A\n", "7.º A"),
    "de": ("Klasse;Name;Vorname;Bemerkung\n5a;Silva;Ana;\n5b;Moreira;Ana;\n5a;Simões;João;\n", "5a"),
    "fr": ("Nom;Prénom;Classe\nSilva;Ana;6e A\nMoreira;Ana;6e B\nSimões;João;6e A\n", "6e A"),
    "es": ("Nombre;Apellidos;Curso;ID\nAna;Silva;1.º A;17\nAna;Moreira;1.º B;18\nJoão;Simões;1.º A;19\n", "1.º A"),
    "en": ("ID;First name;Last name;Class\n7;Ana;Silva;4C\n8;Ana;Moreira;4D\n9;João;Simões;4C\n", "4C"),
    "names": ("Name;Surname;Class\nAna;Silva;4C\nAna;Moreira;4D\nJoão;Simões;4C\n", "4C"),
    "latin": ("Nachname;Vorname;Klasse\nSilva;Ana;4C\nMoreira;Ana;4D\nSimões;João;4C\n", "4C"),
    "nome": ("Sobrenome;Nome;Turma\nSilva;Ana;4C\nMoreira;Ana;4D\nSimões;João;4C\n", "4C"),
}


def names(found: EntrantList) -> list[str]:
    return [one.name for one in found.entrants]


@pytest.mark.parametrize("code", ["utf-8-sig", "utf-16", "cp1252", "utf-8"])
@pytest.mark.parametrize("school", SCHOOLS)
def test_first_names_and_classes_as_excel_saves_them(tmp_path: Path, school, code):
    """Semicolons, as where the decimal sign is a comma; tabs in UTF-16, which Excel calls Unicode text."""
    text, group = SCHOOLS[school]
    rows = list(csv.reader(io.StringIO(text), delimiter=";"))
    saved = io.StringIO(newline="")
    csv.writer(saved, delimiter="\t" if code == "utf-16" else ";", lineterminator="\r\n").writerows(rows)
    (tmp_path / "list.csv").write_bytes(saved.getvalue().encode(code))
    found = entrants_of_text(read_list(tmp_path / "list.csv"))
    assert names(found) == ["Ana S.", "Ana M.", "João"]
    assert found.told_apart == ("Ana S.", "Ana M.")
    assert {one.team for one in found.entrants} == {""}
    assert [one.team for one in found.by_class.entrants][::2] == [group, group]
    assert len({one.team for one in found.by_class.entrants}) == 2


@pytest.mark.parametrize(
    ("people", "expected"),
    [
        ("Ana,Silva Ana,Santos Ana,Moreira", ["Ana Si.", "Ana Sa.", "Ana M."]),
        ("Ana,Sousa Ana,Sousa-Reis Eva,Reis", ["Ana Sousa", "Ana Sousa-.", "Eva"]),
        ("Ana,silva Ana,Sousa Eva,Reis", ["Ana si.", "Ana So.", "Eva"]),
        ("Ana, Ana,Sousa Eva,Reis", ["Ana", "Ana S.", "Eva"]),
        (
            "Maximiliane-Friederike-A,Aal Maximiliane-Friederike-A,Beer",
            ["Maximiliane-Friederik A.", "Maximiliane-Friederik B."],
        ),
    ],
)
def test_as_few_letters_as_tell_them_apart(people, expected):
    rows = "\n".join(person.replace(",", ";") for person in people.split())
    found = entrants_of_text(f"First name;Last name\n{rows}\n")
    assert names(found) == expected
    assert max(map(len, names(found))) <= 24


def test_the_order_of_the_list_does_not_matter_for_the_names():
    rows = ["Ana;Silva", "Ana;Santos", "Ana;Moreira", "Eva;Reis"]
    first = entrants_of_text("\n".join(["First name;Last name", *rows]))
    last = entrants_of_text("\n".join(["First name;Last name", *rows[::-1]]))
    assert names(first) == names(last)[::-1]


def test_the_same_person_twice_is_refused():
    with pytest.raises(ValueError, match=r"^line 3: Ana Silva is entered twice$"):
        entrants_of_text("First name;Last name\nAna;Silva\nAna;Silva\n")


def test_a_full_name_that_is_too_long_keeps_its_first_and_last_word():
    found = entrants_of_text("Nome completo;Turma\nMaria Inês Gonçalves Pereira da Silva;7A\nRui Reis;\n;7B\n")
    assert names(found) == ["Maria Silva", "Rui Reis"]
    assert found.classes == {"Maria Silva": "7A"}
    found = entrants_of_text("Name\nMaximiliane-Friederike von Hohenberg-Lichtenau\n")
    assert names(found) == ["Maximiliane-Friederik H."]


def test_a_list_without_classes_has_no_teams_by_class():
    with pytest.raises(ValueError, match=r"^the list has no column of classes$"):
        _ = entrants_of_text("Name\nAna\nEva\n").by_class


# ---- spreadsheets


@pytest.mark.parametrize("kind", ["xlsx", "ods"])
def test_spreadsheets_of_libreoffice(kind):
    found = entrants_of_text(read_list(DATA / f"class_pt.{kind}"))
    assert names(found) == ["Ana Sil.", "Ana M.", "João", "Conceição", "Ana Sim."]
    assert found.classes["Conceição"] == "7.º B"
    assert found.ignored == ("N.º", "Data de nascimento")
    found = entrants_of_text(read_list(DATA / f"class_de.{kind}"))
    assert names(found) == ["Jürgen Mü.", "Änne", "Jürgen Mö.", "Emre"]
    assert [one.team for one in found.by_class.entrants] == ["5a", "5a", "5b", "5b"]


def zipped(**parts: bytes) -> bytes:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as file:
        for name, raw in parts.items():
            place = zipfile.ZipInfo(
                name.replace("__", "/").replace("_xml", ".xml")
            )  # of 1980: tests are named by the bytes
            file.writestr(place, raw, zipfile.ZIP_DEFLATED)
    return packed.getvalue()


TABLE = "<office><table>{}</table></office>"
ROW = "<table-row><table-cell><p>{}</p></table-cell></table-row>"


@pytest.mark.parametrize(
    ("raw", "reason"),
    [
        (zipped(content_xml=b" " * (MOST_BYTES + 1)), "too large"),
        (zipped(content_xml=b'<!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>'), "declares entities"),
        (zipped(content_xml=b'<!DOCTYPE a SYSTEM "file:///etc/passwd"><a/>'), "declares entities"),
        (zipped(content_xml='<!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>'.encode("utf-16")), "declares entities"),
        (zipped(content_xml=b"<a>"), "damaged"),
        (zipped(content_xml=b"<a/>"), "no sheet"),
        (zipped(content_xml=TABLE.format("".join(ROW.format(i) for i in range(1001))).encode()), "more than 1000 rows"),
        (zipped(xl__workbook_xml=b"<workbook/>"), "no sheet"),
        (zipped(xl__workbook_xml=b'<workbook><sheet id="1"/></workbook>'), "damaged"),
        (zipped(other=b""), "nor a spreadsheet"),
        (b"PK\x03\x04" + bytes(100), "damaged"),
        (zipped(content_xml=b"<a/>")[:-30], "damaged"),
    ],
)
def test_hostile_spreadsheets_are_refused(raw, reason):
    with pytest.raises(ParseError, match=reason):
        text_of(raw)


def test_repeated_cells_and_rows_end():
    """LibreOffice repeats the last row a million times, and its last cell 16,384 times."""
    cell = '<table-cell number-columns-repeated="999999999"><p>A</p></table-cell>'
    row = f'<table-row number-rows-repeated="1048576">{cell}</table-row>'
    text = text_of(zipped(content_xml=TABLE.format(f"<table-row>{cell}</table-row>").encode()))
    assert len(text.split("\t")) == 100
    assert text_of(zipped(content_xml=TABLE.format(row).encode())).count("\n") == 1000


@pytest.mark.parametrize("seed", range(20))
def test_damaged_spreadsheets_are_refused_or_read_but_nothing_else(seed):
    random, reasons = Random(seed), []
    for kind in ("xlsx", "ods"):
        raw = bytearray((DATA / f"class_de.{kind}").read_bytes())
        for _ in range(random.randint(1, 30)):
            raw[random.randrange(4, len(raw))] = random.randrange(256)
        try:
            entrants_of_text(text_of(bytes(raw)))
        except ValueError as error:
            reasons.append(str(error))
    assert not any("\n" in reason for reason in reasons)


def test_cells_of_excel_by_reference_number_and_inline_text():
    sheet = (
        '<worksheet><row><c r="B1" t="s"><v>0</v></c><c r="D1" t="inlineStr"><is><t>Class</t></is></c></row>'
        '<row><c r="B2" t="s"><v>1</v></c><c r="D2"><v>5</v></c></row>'
        '<row><c r="B3" t="s"><v>99999999999</v></c><c r="ZZZ3"><v>6</v></c></row></worksheet>'
    )
    raw = zipped(
        xl__workbook_xml=b'<workbook><sheet id="r1"/></workbook>',
        xl___rels__workbook_xml_rels=b"",
        xl__sharedStrings_xml=b"<sst><si><t>Name</t></si><si><r><t>A</t></r><r><t>na</t></r></si></sst>",
        xl__worksheets__sheet1_xml=sheet.encode(),
    )
    assert text_of(raw) == "\tName\t\tClass\n\tAna\t\t5\n\t\n"
