"""Formats without a draw at the desk: challenges, tries, the end of a week; what is sent twice counts once."""

from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.event_files import save
from pigaming_app.events.journal import Closed
from pigaming_app.events.spec import Format
from pigaming_app.ui.i18n import LANGUAGES, Words
from tests.scenes.events.desk.examples import Operator, cup, desk_on
from tests.scenes.events.desk.test_refusals import of
from tests.ui.web.test_markup import Reader


def at_the_desk(folder: Path, event: Event) -> Operator:
    save(folder / "cup.json", event)
    operator = Operator(desk_on(folder / "cup.json"))
    operator.log_in()
    return operator


def choices(operator: Operator, name: str) -> list[str]:
    """The values of a select of the page on which matches are arranged."""
    page = Reader(operator.get("/desk/arrange").body.decode())
    found, inside = [], False
    for element, words in page.elements:
        inside = words.get("name") == name if element == "select" else inside and element == "option"
        if inside and element == "option" and words["value"]:
            found.append(str(words["value"]))
    return found


def test_a_challenge_and_its_result_change_the_ladder(tmp_path: Path) -> None:
    operator = at_the_desk(tmp_path, of(Format.CHALLENGE, 5, reach=2))
    path = tmp_path / "cup.json"
    page = operator.get("/desk").body.decode()
    assert "/desk/arrange" in page
    assert "Bracket" not in page, "no heading of nothing"
    assert choices(operator, "name0") == ["P2", "P3", "P4", "P5"]
    assert choices(operator, "name1") == ["P1", "P2", "P3", "P4"]
    assert operator.post("/desk/arrange", name0="P4", name1="P2").status == 303
    assert cup(path).open[0].entrants == ("P4", "P2")
    assert choices(operator, "name0") == ["P3", "P5"]
    assert choices(operator, "name1") == ["P1", "P3"]
    again = operator.post("/desk/arrange", name0="P4", name1="P1")
    assert again.status == 409
    assert "P4 has an open challenge" in Reader(again.body.decode()).text
    operator.post("/desk/match/1", do="result", extra="0", score0="3", score1="1")
    assert [row.entrant for row in cup(path).standings] == ["P1", "P4", "P2", "P3", "P5"]


def test_a_try_alone_and_one_of_two(tmp_path: Path) -> None:
    operator = at_the_desk(tmp_path, of(Format.HIGH_SCORE, rounds=1))
    path = tmp_path / "cup.json"
    assert operator.post("/desk/arrange", name0="P2", name1="").status == 303
    assert operator.post("/desk/arrange", name0="P1", name1="P4").status == 303
    assert [{*one.entrants} for one in cup(path).open] == [{"P2"}, {"P1", "P4"}]
    assert choices(operator, "name0") == choices(operator, "name1") == ["P3"]
    operator.post("/desk/arrange", name0="P3", name1="")
    assert "/desk/arrange" not in operator.get("/desk").body.decode()
    assert operator.post("/desk/close").status == 303
    assert cup(path).over
    assert "/desk/close" not in operator.get("/desk").body.decode()
    for address in ("/desk/arrange", "/desk/close"):
        assert operator.get(address).status == 404


@pytest.mark.parametrize("form", [form for form in Format if form not in ("challenge", "timetrial", "highscore")])
def test_other_formats_have_no_such_pages(tmp_path: Path, form: Format) -> None:
    operator = at_the_desk(tmp_path, of(form, 6))
    page = operator.get("/desk").body.decode()
    assert "/desk/arrange" not in page
    assert "/desk/close" not in page
    assert operator.get("/desk/arrange").status == operator.get("/desk/close").status == 404


def test_a_form_that_is_sent_twice_counts_once(tmp_path: Path) -> None:
    """A second end of the week would end the next one; a second exchange would undo the first."""
    path = tmp_path / "cup.json"
    operator = at_the_desk(tmp_path, of(Format.CHALLENGE))
    seen = str(len(cup(path).journal))
    for status in (303, 409):
        assert operator.post("/desk/close", seen=seen).status == status
    assert cup(path).progress.closed == 1
    assert operator.post("/desk/close", seen="1").status == 303, "the next week"
    swiss = at_the_desk(tmp_path, of(Format.SWISS))
    for status in (303, 409):
        assert swiss.post("/desk/entrant/0", do="swap", other="P2", seen="0").status == status
    assert cup(path).fixtures[0].entrants == ("P2", "P3")
    for status in (303, 409):
        assert swiss.post("/desk/match/1", do="postpone", seen="1").status == status
    assert len(cup(path).journal) == 2


def test_each_page_tells_its_forms_what_it_has_seen(tmp_path: Path) -> None:
    operator = at_the_desk(tmp_path, of(Format.CHALLENGE).arrange("P2", "P1").close())
    for address in ("", "/arrange", "/close", "/enter", "/break", "/entrant/0"):
        page = Reader(operator.get(f"/desk{address}").body.decode())
        forms = sum(name == "form" for name, _ in page.elements)
        assert [words["value"] for _, words in page.elements if words.get("name") == "seen"] == ["2"] * forms


def test_the_calendar_closes_the_weeks_that_have_passed(tmp_path: Path) -> None:
    event = of(Format.CHALLENGE)
    start = (date.today() - timedelta(days=15)).isoformat()
    operator = at_the_desk(tmp_path, Event(replace(event.spec, start=start)))
    assert "Week 3 of 4" in Reader(operator.get("/").body.decode()).text
    assert cup(tmp_path / "cup.json").journal == (Closed(), Closed())


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_pages_are_in_every_language(tmp_path: Path, language: str) -> None:
    words = Words(language)
    for form, kind, period in ((Format.CHALLENGE, "challenge", "week"), (Format.TIME_TRIAL, "try", "day")):
        operator = at_the_desk(tmp_path, of(form))
        operator.get(f"/desk?language={language}")
        assert words(f"desk.{kind}") in Reader(operator.get("/desk/arrange").body.decode()).text
        assert words(f"desk.close_{period}_line") in Reader(operator.get("/desk/close").body.decode()).text
