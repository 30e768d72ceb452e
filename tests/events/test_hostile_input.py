"""Files and lists that nobody would write: one line says why they are refused, and nothing is lost by what is taken."""

import json
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest

from pigaming_app.events.entrant_lists import ListError, entrants_of_text, read_list
from pigaming_app.events.event import Event
from pigaming_app.events.event_files import load, parse, save, to_text
from pigaming_app.events.exports import standings_csv
from pigaming_app.events.journal import Paused, Summoned
from pigaming_app.events.spec import Entrant, Format, Result
from pigaming_app.storage.parsing import ParseError
from tests.events.examples import new_event, ranked

ODD = ("\ufffd", "\ufffc", "\u200b", "\u202e", "\u00ad", "\ue000", "\x7f", "\x00", "\n", "\ud800")
SHEET = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"


def begun() -> Event:
    event = new_event(Format.SWISS, 4)
    return event.record(ranked(event.open[0], *event.open[0].entrants))


@pytest.mark.parametrize("odd", ODD)
def test_what_a_file_cannot_hold_is_refused_before_it_is_saved(odd):
    event = begun()
    text = f"Jos{odd}"
    for change in (
        lambda: event.add(Entrant(text)),
        lambda: event.add(Entrant("Eva", team=text)),
        lambda: event.add(Entrant("Eva", text)),
        lambda: event.substitute("P1", text),
        lambda: event.correct(Result(1, (("P1",), ("P3",)), note=text)),
        lambda: event.after(Paused(text)),
        lambda: event.after(Summoned(2, text)),
        lambda: event.renamed(text),
        lambda: Event(replace(event.spec, entrants=(Entrant(text), *event.spec.entrants))).progress,
        lambda: entrants_of_text(f"Ana\n{text}s") if odd not in "\n\u00ad" else event.add(Entrant(text)),
    ):
        with pytest.raises(ValueError, match=r"\w") as refused:
            change()
        assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    "name",
    [
        "محمد علي",
        "נועה",
        "王小明",
        "👩🏽🎮🏆",
        "é" * 24,
        "e\u0301ric",
        "=1+1",
        "'; DROP TABLE",
        "<b>&amp;",
        "\\u0000",
        "NULL",
        "W" * 24,
    ],
)
def test_what_is_taken_comes_back(tmp_path: Path, name):
    event = begun().add(Entrant(name, team=name))
    save(tmp_path / "a.json", event)
    assert load(tmp_path / "a.json") == (event, [])


@pytest.mark.parametrize(
    "change",
    [
        lambda plain: plain["spec"].update(minutes={"pitanks": -5}),
        lambda plain: plain["spec"].update(minutes={"pitanks": 1e300}),
        lambda plain: plain["spec"].update(minutes={"pitanks": float("nan")}),
        lambda plain: plain["journal"].append({"entry": "seats", "fixture": -2, "entrants": ["P2", "P4"]}),
        lambda plain: plain["journal"].append({"entry": "seats", "fixture": 2, "entrants": ["P2", "P2"]}),
        lambda plain: plain["journal"].append({"entry": "call", "fixture": 10**40, "arcade": ""}),
        lambda plain: plain["journal"].append(plain["journal"][0]),
        lambda plain: plain["journal"].insert(0, {"entry": "correction", "outcome": plain["journal"][0]["outcome"]}),
        lambda plain: plain["journal"][0]["outcome"].update(scores={"P1": float("nan")}),
        lambda plain: plain["journal"][0]["outcome"].update(extra=-1),
        lambda plain: plain["journal"][0]["outcome"].update(places=[["P1", "P3"], []]),
        lambda plain: plain["journal"].append(json.loads("[" * 20 + "]" * 20)),
    ],
)
def test_impossible_entries_are_one_line(change):
    plain = json.loads(to_text(begun()))
    change(plain)
    with pytest.raises(ValueError, match=r"\w") as refused:
        parse(json.dumps(plain))
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("raw", [b"\xff\xfe{\x00}\x00", b"\x80", b"[" * 500_000, b'{"a":' * 100_000, b" " * 8_000_001])
def test_a_file_in_another_code_or_too_deep_or_too_long_stays_as_it_is(tmp_path: Path, raw):
    file = tmp_path / "a.json"
    file.write_bytes(raw)
    event, problems = load(file)
    assert (event, len(problems)) == (None, 1)
    assert "\n" not in problems[0]
    assert file.read_bytes() == raw


def test_a_byte_order_mark_is_no_damage(tmp_path: Path):
    (tmp_path / "a.json").write_text(to_text(begun()), encoding="utf-8-sig")
    assert load(tmp_path / "a.json") == (begun(), [])


def test_a_list_of_a_hundred_thousand_rows_is_refused_at_the_first_one_too_many():
    """All of one name, which would be compared each with each: 10,000,000,000 times."""
    with pytest.raises(ListError, match=r"line 2: A is entered twice"):
        entrants_of_text("A\n" * 100_000)
    with pytest.raises(ListError, match=r"line 65: an event has at most 64 entrants"):
        entrants_of_text("".join(f"A{i}\n" for i in range(100_000)))


def workbook(path: Path, rows: str, strings: str = "") -> Path:
    """An Excel file of these rows and shared texts."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("xl/workbook.xml", f'<workbook xmlns="{SHEET}"><sheets><sheet name="1"/></sheets></workbook>')
        file.writestr("xl/worksheets/sheet1.xml", f'<worksheet xmlns="{SHEET}">{rows}</worksheet>')
        file.writestr("xl/sharedStrings.xml", f'<sst xmlns="{SHEET}">{strings}</sst>')
    return path


def test_one_long_text_in_many_cells_is_refused(tmp_path: Path):
    """100,000 cells of 100,000 letters would be 10 GB; the file has 30 kB."""
    row = "<row>" + '<c t="s"><v>0</v></c>' * 100 + "</row>"
    file = workbook(tmp_path / "a.xlsx", row * 1000, f"<si><t>{'x' * 100_000}</t></si>")
    assert file.stat().st_size < 50_000
    with pytest.raises(ParseError, match="the spreadsheet is too large"):
        read_list(file)


@pytest.mark.parametrize(
    ("cell", "reason"),
    [
        ('<c r="A2"><f>B2&amp;C2</f></c>', "cell A2 of the spreadsheet has a formula without a value"),
        ('<c r="A2" t="str"><f>B2&amp;C2</f><v></v></c>', "cell A2 of the spreadsheet has a formula without a value"),
        ('<c r="A2" t="e"><f>B2</f><v>#N/A</v></c>', "cell A2 of the spreadsheet has the error #N/A"),
    ],
)
def test_nobody_is_lost_by_a_formula_that_was_not_calculated(tmp_path: Path, cell, reason):
    rows = f'<row><c r="A1" t="str"><v>Ana</v></c></row><row>{cell}</row>'
    with pytest.raises(ParseError, match=reason):
        read_list(workbook(tmp_path / "a.xlsx", rows))


def test_formatted_names_come_without_their_readings(tmp_path: Path):
    """Excel stores a name in several runs, and the reading of a Japanese one beside it."""
    strings = "<si><r><t>山</t></r><r><rPr><b/></rPr><t>田</t></r><rPh sb='0' eb='2'><t>ヤマダ</t></rPh></si>"
    file = workbook(tmp_path / "a.xlsx", '<row><c t="s"><v>0</v></c></row>', strings)
    assert [one.name for one in entrants_of_text(read_list(file)).entrants] == ["山田"]


@pytest.mark.parametrize("name", ["=cmd|' /C calc'!A0", "＝1+1", "＋1", "－1", "＠x"])
def test_no_name_is_a_formula(name):
    """Also not by the wide signs that spreadsheets of East Asia calculate."""
    event = Event(replace(new_event(Format.SWISS, 4).spec, entrants=(*map(Entrant, ("A", "B", name)),)))
    assert f",'{name}" in standings_csv(event)
