"""The desk: what each form does to the file, who may send one, and names that would be HTML."""

import re
from pathlib import Path
from random import Random
from unittest.mock import Mock

import pytest

from pigaming_app.events.changes.live import LiveMatch, write
from pigaming_app.events.event_files import save, update
from pigaming_app.events.spec import Format
from pigaming_app.scenes.events.desk import desk
from pigaming_app.scenes.events.desk.desk import LASTS, MOST, Sessions
from pigaming_app.scenes.events.desk.public_page import public_page
from pigaming_app.storage.pin import PinFile
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.web.server import WebRequest
from tests.events.examples import ranked
from tests.jobs.kiosk.test_supervisor import Clock
from tests.scenes.events import drawn
from tests.scenes.events.desk.examples import PIN, Operator, cup, desk_on, new_event
from tests.ui.web.test_markup import HOSTILE, Reader


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return new_event(tmp_path)


@pytest.fixture
def operator(path: Path) -> Operator:
    one = Operator(desk_on(path))
    assert one.log_in().status == 303
    return one


def test_a_result_a_correction_and_who_leads(path: Path, operator: Operator) -> None:
    reply = operator.post("/desk/match/1", do="result", extra="0", score0="3", score1="1,5")
    assert (reply.status, reply.headers["Location"]) == (303, "/desk")
    assert cup(path).outcomes[1].scores == {"Ana": 3.0, "Caio": 1.5}
    operator.post("/desk/match/1", do="correct", score0="0", score1="2", reason="seats\nmixed up")
    outcome = cup(path).outcomes[1]
    assert outcome.places == (("Caio",), ("Ana",))
    assert outcome.note == "seats mixed up"
    assert "1. Caio 2   2. Ana 0" in operator.get("/").body.decode()


def test_a_form_that_is_sent_twice_counts_once(path: Path, operator: Operator) -> None:
    for status in (303, 409, 409):
        assert operator.post("/desk/match/1", do="result", extra="0", score0="3", score1="1").status == status
    assert len(cup(path).journal) == 1


def test_a_tie_sent_twice_is_no_extra_match(tmp_path: Path) -> None:
    path = new_event(tmp_path, form=Format.KNOCKOUT)
    operator = Operator(desk_on(path))
    operator.log_in()
    for status in (303, 409):
        assert operator.post("/desk/match/1", do="result", extra="0", score0="1", score1="1").status == status
    assert "Sudden death" in operator.get("/desk/match/1").body.decode()
    assert operator.post("/desk/match/1", do="result", extra="1", score0="1", score1="0").status == 303
    assert [one.extra for one in cup(path).played[1]] == [0, 1]


def test_every_other_form(path: Path, operator: Operator) -> None:
    assert operator.post("/desk/match/1", do="call", arcade=" left ").status == 303
    assert cup(path).calls == {1: "left"}
    assert 'Pad 1</span><span class="name">Ana' in operator.get("/").body.decode()
    assert operator.post("/desk/match/1", do="call_off").status == 303
    assert operator.post("/desk/match/1", do="seats", seat0="Caio", seat1="Ana").status == 303
    assert cup(path).fixtures[0].entrants == ("Caio", "Ana")
    assert operator.post("/desk/match/1", do="postpone").status == 303
    assert [one.number for one in cup(path).open] == [2, 1]
    assert operator.post("/desk/entrant/2", do="swap", other="Duda").status == 303
    assert [{*one.entrants} for one in cup(path).open] == [{"Bia", "Caio"}, {"Duda", "Ana"}]
    assert operator.post("/desk/entrant/1", do="absent").status == 303
    assert cup(path).entrants[1].brain == "level3"
    assert operator.post("/desk/entrant/1", do="back").status == 303
    assert cup(path).entrants[1].brain == ""
    assert operator.post("/desk/enter", name="Eva  Maria", team="Red", brain="level2").status == 303
    assert [(one.name, one.team, one.brain) for one in cup(path).entrants[4:]] == [("Eva Maria", "Red", "level2")]
    assert operator.post("/desk/entrant/3", do="withdraw").status == 303
    assert cup(path).withdrawn == {"Duda"}
    assert operator.post("/desk/break", do="begin", note="until 11:30").status == 303
    assert "until 11:30" in operator.get("/").body.decode()
    assert operator.post("/desk/match/1", do="call", arcade="left").status == 409
    assert operator.post("/desk/break", do="end").status == 303
    assert cup(path).pause is None


REFUSED = (
    ("/desk/match/1", {"do": "result", "extra": "0", "score0": "x", "score1": "1"}, "is not a score"),
    ("/desk/match/1", {"do": "result", "extra": "0", "score0": "nan", "score1": "1"}, "a score is a number"),
    ("/desk/match/1", {"do": "result", "extra": "1", "score0": "3", "score1": "1"}, "has a result already"),
    ("/desk/match/1", {"do": "correct", "score0": "3", "score1": "1", "reason": "x"}, "has not been played"),
    ("/desk/match/1", {"do": "seats", "seat0": "Ana", "seat1": "Ana"}, "each with one seat"),
    ("/desk/match/1", {"do": "call_off"}, "is not called"),
    ("/desk/match/1", {"do": "call", "arcade": "x" * 30}, "1 to 24 printable"),
    ("/desk/match/99", {"do": "postpone"}, "there is no match 99"),
    ("/desk/entrant/0", {"do": "swap", "other": "Caio"}, "play each other"),
    ("/desk/entrant/99", {"do": "withdraw"}, "there is no such entrant"),
    ("/desk/enter", {"name": "Ana"}, "is entered already"),
    ("/desk/enter", {"name": "Eva", "brain": "nobody"}, "nobody: there is no AI of this name"),
    ("/desk/enter", {"name": "Eva", "brain": "/etc/passwd.npz"}, "by their names only"),
    ("/desk/enter", {"name": ""}, "1 to 24 printable"),
    ("/desk/break", {"do": "end"}, "there is no break"),
)  # fmt: skip


@pytest.mark.parametrize(("address", "form", "reason"), REFUSED)
def test_a_form_that_is_not_possible_says_why_and_changes_nothing(path, operator, address, form, reason) -> None:
    before = path.read_bytes()
    reply = operator.post(address, **form)
    assert reply.status == 409
    assert reason in Reader(reply.body.decode()).text
    assert path.read_bytes() == before


FORMS = [
    ("/desk/match/1", {"do": do, "extra": "0", "score0": "3", "score1": "1", "reason": "x", "arcade": "x"})
    for do in ("result", "call", "postpone")
] + [("/desk/entrant/0", {"do": "withdraw"}), ("/desk/enter", {"name": "Eva"}), ("/desk/break", {"do": "begin"})]


@pytest.mark.parametrize(("address", "form"), FORMS)
def test_nobody_else_can_send_a_form(path: Path, operator: Operator, address: str, form: dict[str, str]) -> None:
    """Without a session, from another site, with a guessed key or token, or by a link."""
    before = path.read_bytes()
    stranger = Operator(operator.desk)
    assert stranger.send(address, form | {"key": operator.key}).status == 403
    assert operator.send(address, form | {"key": operator.key}, own=False).status == 403
    for key in ("", "x", operator.key[:-1], "ä" * 20):
        assert operator.send(address, form | {"key": key}).status == 403
    stranger.token = operator.token[:-1]
    assert stranger.send(address, form | {"key": operator.key}).status == 403
    query = "&".join(f"{name}={value}" for name, value in form.items())
    operator.get(f"{address}?key={operator.key}&{query}")
    assert path.read_bytes() == before
    assert operator.post(address, **form).status == 303
    assert path.read_bytes() != before


def test_without_the_pin_nobody_sees_the_desk(path: Path) -> None:
    stranger = Operator(desk_on(path))
    for address in ("/desk", "/desk/match/1", "/desk/enter", "/desk/entrant/0", "/desk/break"):
        page = stranger.get(address).body.decode()
        assert 'name="pin"' in page
        assert "Ana" not in page
    assert stranger.log_in("000000").status == 403
    assert not stranger.token


def test_the_language_of_the_login_stays(path: Path) -> None:
    operator = Operator(desk_on(path))
    login = Reader(operator.get("/desk?language=fr").body.decode())
    (chosen,) = (words["value"] for _, words in login.elements if words.get("name") == "language")
    assert operator.send("/desk/login", {"pin": "000000", "language": str(chosen)}).status == 403
    reply = operator.send("/desk/login", {"pin": PIN, "language": str(chosen)})
    operator.token = reply.headers["Set-Cookie"].partition(";")[0].partition("=")[2]
    assert 'lang="fr"' in operator.get("/desk").body.decode()


def test_guessing_is_slowed_down_by_address(path: Path) -> None:
    desk = desk_on(path)
    guesser, other = Operator(desk, "192.0.2.1"), Operator(desk, "192.0.2.2")
    answers = [guesser.log_in(f"{i:06}").body.decode() for i in range(8)]
    assert "That is not the PIN." in answers[0]
    assert re.search(r"Next attempt in \d+ s", answers[-1])
    assert guesser.log_in(PIN).status == 403
    assert other.log_in(PIN).status == 303


def test_a_session_ends_by_itself_by_logging_out_and_by_many_others(tmp_path: Path) -> None:
    pin = PinFile(tmp_path)
    pin.set(PIN)
    clock = Clock()
    sessions = Sessions(pin, clock)
    first = sessions.begin(PIN, "a")
    assert sessions.find(first)
    clock.now += LASTS
    assert sessions.find(first) is None
    tokens = [sessions.begin(PIN, "a") for _ in range(MOST + 1)]
    assert len({*tokens}) == MOST + 1
    assert sessions.find(tokens[0]) is None
    assert sessions.find(tokens[1])
    sessions.end(tokens[1])
    assert sessions.find(tokens[1]) is None
    assert sessions.find("") is None


def test_the_cookie_is_only_for_this_server_and_no_script(path: Path, operator: Operator) -> None:
    cookie = operator.log_in().headers["Set-Cookie"]
    assert {"HttpOnly", "SameSite=Strict"} <= {*cookie.split("; ")}
    gone = operator.post("/desk/logout").headers["Set-Cookie"]
    assert "Max-Age=0" in gone
    assert 'name="pin"' in operator.get("/desk").body.decode()


@pytest.mark.parametrize("language", LANGUAGES)
def test_names_that_would_be_html_are_text_on_every_page(tmp_path: Path, language: str) -> None:
    """Every page has the elements of the same page with plain names, and no other ones."""
    hostile = [name[:24] for name in HOSTILE if name.isprintable()]
    plain = [f"N{i}" for i in range(len(hostile))]
    pages = {}
    for kind, names in (("hostile", hostile), ("plain", plain)):
        (tmp_path / kind).mkdir()
        path = new_event(tmp_path / kind, *names, form=Format.KNOCKOUT, title=names[0])
        operator = Operator(desk_on(path, language))
        operator.log_in()
        operator.post("/desk/match/1", do="result", extra="0", score0="3", score1="1")
        operator.post("/desk/match/2", do="call", arcade=names[1])
        write(path, LiveMatch(names[2], 3, {cup(path).fixtures[2].entrants[0]: names[3]}, names[4]))
        operator.post("/desk/match/1", do="correct", score0="3", score1="2", reason=names[5])
        operator.post("/desk/break", do="begin", note=names[6])
        addresses = ["/", "/desk", "/desk/match/1", "/desk/match/2", "/desk/enter", "/desk/break"]
        addresses += [f"/desk/entrant/{i}" for i in range(len(names))]
        shown = [operator.get(address).body.decode() for address in addresses]
        shown.append(operator.post("/desk/enter", name=names[7], team=names[8]).body.decode())
        shown.append(operator.post("/desk/entrant/0", do="swap", other=names[0]).body.decode())
        pages[kind] = [Reader(page) for page in shown]
    for wild, tame in zip(pages["hostile"], pages["plain"], strict=True):
        assert [name for name, _ in wild.elements] == [name for name, _ in tame.elements]
        assert [[*words] for _, words in wild.elements] == [[*words] for _, words in tame.elements]
    for name in hostile:
        assert name in pages["hostile"][0].text


def test_any_path_query_and_form_is_answered(path: Path, operator: Operator) -> None:
    random = Random(7)
    numbers = ("1", "0", "-1", "9" * 30, "..", "%2e", "ä", "", "x" * 500)
    heads = ("desk/match", "desk/entrant", "desk/enter", "desk/break", "desk/login", "desk", "", "..", "desk.css")
    values = ["", "result", "call", "seats", "swap", "begin", "end", "x" * 5000, "\x00", "1e999", "-0", "٣", *HOSTILE]
    fields = ["do", "extra", "score0", "score1", "reason", "seat0", "arcade", "other", "name", "note", "key", "pin"]
    seen = set()
    for _ in range(600):
        address = "/" + "/".join([random.choice(heads), *random.choices(numbers, k=random.randint(0, 2))])
        form = {name: random.choice(values) for name in random.sample(fields, 5)} | {"key": operator.key}
        request = WebRequest(
            random.choice(("GET", "POST")), address, form, form, operator._cookies(), peer="192.0.2.9", own=True
        )
        seen.add(status := operator.desk(request).status)
        if status in (303, 403):  # its session may have ended
            operator.log_in()
    assert {200, 404, 409} <= seen <= {200, 303, 403, 404, 409}
    cup(path)


def test_the_page_follows_the_file_that_others_change(path: Path, operator: Operator) -> None:
    mark = operator.get("/").headers["ETag"]
    assert operator.get("/", **{"if-none-match": mark}).status == 304
    update(path, lambda event: event.withdraw("Duda"))
    fresh = operator.get("/", **{"if-none-match": mark})
    assert fresh.status == 200
    path.write_text("{broken", encoding="utf-8")
    path.with_name("cup.json.bak").unlink()
    assert operator.get("/").status == 200, "the last one that could be read"


def test_a_match_that_is_played_shows_its_score_until_the_arcade_is_gone(path: Path) -> None:
    clock = Clock()
    desk = desk_on(path)
    desk._live._clock = clock
    operator = Operator(desk)
    write(path, LiveMatch("left", 1, {"Ana": "12", "Caio": "7"}, "1:30"))
    text = Reader(operator.get("/").body.decode()).text
    assert all(part in text for part in ("left", "12", "1:30"))
    clock.now += 60.0
    assert "1:30" not in operator.get("/").body.decode()


def test_the_public_page_speaks_the_language_of_the_browser(path: Path) -> None:
    operator = Operator(desk_on(path, "pt"))
    assert 'lang="pt"' in operator.get("/").body.decode()[:60]
    assert 'lang="de"' in operator.get("/", **{"accept-language": "xx,de-AT;q=0.9,en"}).body.decode()[:60]
    assert 'lang="fr"' in operator.get("/?language=fr", **{"accept-language": "de"}).body.decode()[:60]


def test_results_of_the_arcade_meanwhile_are_kept(path: Path, operator: Operator) -> None:
    update(path, lambda event: event.record(best_first(event)))
    assert operator.post("/desk/match/2", do="result", extra="0", score0="3", score1="1").status == 303
    assert {*cup(path).outcomes} == {1, 2}


def best_first(event):
    fixture = event.open[0]
    return ranked(fixture, *fixture.entrants)


@pytest.mark.parametrize("form", list(Format))
@pytest.mark.parametrize("rounds", [0, 2, 1000])
def test_every_format_has_its_pages_at_every_time(tmp_path: Path, form: Format, rounds: int) -> None:
    path = tmp_path / "cup.json"
    save(path, drawn.played(drawn.an_event(form, 6), rounds))
    operator = Operator(desk_on(path))
    operator.log_in()
    for address in ("/", "/desk", "/desk/match/1", "/desk/entrant/0", "/desk/enter"):
        page = operator.get(address)
        assert page.status == 200 or (address == "/desk/match/1" and not cup(path).fixtures)
        assert page.status == 404 or cup(path).spec.title in Reader(page.body.decode()).text


def test_many_who_look_at_the_public_page_cost_one_page(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = Mock(side_effect=public_page)
    monkeypatch.setattr(desk, "public_page", page)
    operator = Operator(desk_on(path))
    pages = {operator.get("/").body for _ in range(20)}
    assert (len(pages), page.call_count) == (1, 1)
    update(path, lambda event: event.withdraw("Duda"))
    assert operator.get("/").body not in pages
    write(path, LiveMatch("left", 1, {"Ana": "12"}, "1:30"))
    assert "1:30" in operator.get("/").body.decode()
    operator.get("/?language=de")
    assert page.call_count == 4
