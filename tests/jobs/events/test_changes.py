"""The words that change an event: results, corrections, entrants, places, seats, calls and breaks."""

import json
import random
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.event_files import load, save
from pigaming_app.events.event_files import update as update_event
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.jobs.cli import main
from tests.cases import one_in
from tests.jobs.test_hostile_options import ANY, POSIX, fault, furnish

ROOT = Path(__file__).resolve().parents[3]
FILE = Path("cup.json")


@pytest.fixture(autouse=True)
def _here(tmp_path, monkeypatch):
    for variable in ("SDL_VIDEODRIVER", "SDL_AUDIODRIVER"):  # `fault` changes them
        monkeypatch.setenv(variable, "dummy")
    monkeypatch.chdir(tmp_path)


def begin(*names: str, form: Format = Format.SWISS) -> None:
    entrants = tuple(map(Entrant, names or ("Ana", "Bia", "Caio", "Duda")))
    save(FILE, Event(EventSpec("Cup", form, ("pitanks",), entrants)))


def cup() -> Event:
    event, problems = load(FILE)
    assert event is not None
    assert not problems
    return event


@pytest.fixture
def changed(capsys: pytest.CaptureFixture[str]) -> Callable[..., Event]:
    """A function that runs a word on the file; what it prints with --json is what the file has."""

    def of(name: str, *words: str) -> Event:
        capsys.readouterr()
        assert main(["event", name, "cup.json", *words, "--json"]) == 0
        told = capsys.readouterr()
        assert told.err == ""
        printed = json.loads(told.out)
        assert main(["event", "show", "cup.json", "--json"]) == 0
        assert printed == json.loads(capsys.readouterr().out)
        return cup()

    return of


def test_a_result_by_scores_and_by_places(changed):
    begin()
    event = changed("result", "1", "Ana=3", "Caio=1,5")
    assert event.outcomes[1].places == (("Ana",), ("Caio",))
    assert event.outcomes[1].scores == {"Ana": 3.0, "Caio": 1.5}
    assert changed("result", "2", "Duda", "Bia").outcomes[2].places == (("Duda",), ("Bia",))


def test_equal_entrants_share_a_place_and_in_a_knock_out_play_an_extra_match(changed):
    begin(form=Format.KNOCKOUT)
    event = changed("result", "1", "Ana+Duda")
    assert (event.open[0].number, event.open[0].extra) == (1, 1)
    event = changed("result", "1", "Ana=0", "Duda=1")
    assert event.outcomes[1].places == (("Duda",), ("Ana",))
    assert [one.extra for one in event.played[1]] == [0, 1]


def test_a_correction_keeps_its_reason(changed):
    begin()
    changed("result", "1", "Ana", "Caio")
    event = changed("correct", "1", "Caio=2", "Ana=1", "--reason", "pads were swapped")
    assert event.outcomes[1].places == (("Caio",), ("Ana",))
    assert event.outcomes[1].note == "pads were swapped"
    assert len(event.played[1]) == 1


def test_entrants_come_and_go(changed):
    begin()
    assert changed("enter", "Eva/Red=level2").entrants[-1] == Entrant("Eva", "level2", "Red")
    assert changed("withdraw", "Bia").withdrawn == {"Bia"}


def test_places_seats_calls_and_breaks(changed):
    begin()
    event = changed("swap", "Caio", "Duda")
    assert [one.entrants for one in event.fixtures] == [("Ana", "Duda"), ("Bia", "Caio")]
    assert changed("seat", "1", "Ana=2").fixtures[0].entrants == ("Duda", "Ana")
    assert changed("call", "2", "left").calls == {2: "left"}
    assert changed("call", "2", "--off").calls == {}
    assert changed("break", "until 11:30").pause == "until 11:30"
    assert changed("break", "--off").pause is None


def test_the_page_for_people_names_what_is_called_and_the_break(capsys):
    begin()
    assert main(["event", "call", "cup.json", "2", "left"]) == 0
    assert main(["event", "break", "cup.json", "until 11:30"]) == 0
    told = capsys.readouterr().out
    assert "    2  Bia – Duda  (pitanks, called to left)\n" in told
    assert "\nbreak: until 11:30\n" in told


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["result", "1", "Ana=3"], "match 1: the score of Caio is missing"),
        (["result", "1", "Ana=3", "Caio=x"], "'x' is not a score"),
        (["result", "1", "Ana=3", "Caio=nan"], "a score is a number up to 1000000000"),
        (["result", "1", "Ana=3", "Caio=1", "Ana=2"], "match 1: each entrant has one score"),
        (["result", "1", "Ana=3", "Caio"], "'Caio': NAME=NUMBER is needed"),
        (["result", "1", "Ana", "Bia"], "'Bia' does not play in match 1, which is between Ana, Caio"),
        (["result", "1", "Ana"], "match 1 is between Ana, Caio, each with one place"),
        (["result", "9", "Ana", "Caio"], "there is no match 9"),
        (["result", "0", "Ana", "Caio"], "'0' is less than 1"),
        (["correct", "1", "Ana", "Caio", "--reason", "x"], "match 1 has not been played"),
        (["correct", "1", "Ana", "Caio"], "--reason"),
        (["enter", "Ana"], "Ana is entered already"),
        (["enter", "Eva=nobody"], "no brain 'nobody'"),
        (["enter", "x" * 25], "1 to 24 printable characters"),
        (["withdraw", "Eva"], "Eva is not entered"),
        (["swap", "Ana", "Caio"], "Ana and Caio play each other"),
        (["seat", "1", "Ana=3"], "match 1 has the seats 1 to 2, each for one: A=2 B=1"),
        (["seat", "1", "Ana=1", "Caio=1"], "match 1 has the seats 1 to 2, each for one: A=2 B=1"),
        (["seat", "1", "Bia=1"], "'Bia' does not play in match 1"),
        (["call", "1", "left", "--off"], "--off goes without"),
        (["call", "1", "--off"], "match 1 is not called"),
        (["break", "x", "--off"], "--off goes without a text"),
        (["break", "--off"], "there is no break"),
    ],
)
def test_a_change_that_is_not_possible_is_one_line_and_leaves_the_file(words, reason, refused):
    begin()
    before = FILE.read_bytes()
    assert reason in refused("event", words[0], "cup.json", *words[1:])
    assert FILE.read_bytes() == before


def test_a_result_counts_once(changed, refused):
    begin()
    changed("result", "1", "Ana", "Caio")
    assert "match 1 has been played" in refused("event", "result", "cup.json", "1", "Ana", "Caio")


WORDS = {
    "result": ["1", "Ana"], "correct": ["1", "Ana", "--reason"], "enter": [], "withdraw": [], "swap": ["Ana"],
    "seat": ["1"], "call": ["1"], "break": [],
}  # fmt: skip


@POSIX
@pytest.mark.parametrize("seed", one_in(2, range(2)))
def test_every_value_is_used_or_refused_in_one_line(tmp_path, monkeypatch, seed):
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    furnish(tmp_path / "here")
    cases = [["event", name, "cup.json", *words, value] for name, words in WORDS.items() for value in ANY]
    cases += [["event", name, value, *words, "x"] for name, words in WORDS.items() for value in ANY]
    cases += [["event", name, "cup.json", value, "x"] for name in ("result", "seat", "call") for value in ANY]
    faults = {}
    for case in random.Random(seed).sample(cases, 120):
        begin()
        if wrong := fault(case):
            faults[repr(case)] = wrong
    assert not faults


@pytest.mark.long
def test_words_and_another_writer_at_the_same_time_lose_nothing():
    """Processes enter results while this one postpones matches: every entry is in the file once."""
    begin(*(f"P{i}" for i in range(8)), form=Format.ROUND_ROBIN)
    fixtures = cup().fixtures[:6]
    command = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "event", "result", str(FILE)]
    processes = [
        subprocess.Popen([*command, str(one.number), *one.entrants], stdout=subprocess.DEVNULL) for one in fixtures
    ]
    stop, postponed = threading.Event(), []

    def postpone() -> None:
        while not stop.is_set():
            update_event(FILE, lambda event: event.postpone(28))
            postponed.append(28)
            stop.wait(0.05)

    writer = threading.Thread(target=postpone)
    writer.start()
    codes = [process.wait(120) for process in processes]
    stop.set()
    writer.join()
    event = cup()
    assert codes == [0] * 6
    assert {*event.outcomes} == {one.number for one in fixtures}
    assert len(event.journal) == 6 + len(postponed)
