"""Every refusal that somebody at the desk can meet, in every language."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.event_files import save
from pigaming_app.events.journal import Paused, Resumed, Summoned
from pigaming_app.events.spec import MOST, Entrant, EventSpec, Format
from pigaming_app.ui.i18n import LANGUAGES, texts
from tests.events.examples import level, ranked
from tests.scenes.events.desk.examples import Operator, desk_on
from tests.ui.web.test_markup import Reader


def of(form: Format, count: int = 4, **more) -> Event:
    entrants = tuple(Entrant(f"P{i}") for i in range(1, count + 1))
    games = ("race",) if form is Format.TIME_TRIAL else ("pitanks",)
    if form is Format.HIGH_SCORE:
        more = {"seats": 2, "fill": "level1"} | more
    if form is Format.TIME_TRIAL:
        more = {"seats": 1} | more
    return Event(EventSpec("Cup", form, games, entrants, **more))


def won(event: Event, *numbers: int) -> Event:
    """The first of each of these matches has won it."""
    for number in numbers:
        fixture = next(one for one in event.open if one.number == number)
        event = event.record(ranked(fixture, *fixture.entrants))
    return event


def finished(event: Event) -> Event:
    while event.open:
        event = won(event, event.open[0].number)
    return event


@dataclass(frozen=True)
class Situation:
    """A form that is refused for the reason of this key."""

    key: str
    event: Event
    address: str
    form: Mapping[str, str] = field(default_factory=dict)


SWISS, KNOCKOUT, LADDER = of(Format.SWISS), of(Format.KNOCKOUT), of(Format.CHALLENGE)
TRIES = of(Format.TIME_TRIAL, rounds=1)
SCORES = {"do": "result", "extra": "0", "score0": "3", "score1": "1"}
CORRECTION = {"do": "correct", "score0": "1", "score1": "3", "reason": "seats"}
SITUATIONS = (
    Situation("done", SWISS.postpone(1), "match/1", {"do": "postpone", "seen": "0"}),
    Situation("done", SWISS.after(Paused()).after(Resumed()), "break", {"do": "begin", "seen": "0"}),
    Situation("bad_name", SWISS, "enter", {"name": ""}),
    Situation("bad_team", SWISS, "enter", {"name": "Eva", "team": "x" * 30}),
    Situation("bad_arcade", SWISS, "match/1", {"do": "call", "arcade": "x" * 30}),
    Situation("no_entrant", SWISS, "entrant/99", {"do": "withdraw"}),
    Situation("entered", SWISS, "enter", {"name": "P1"}),
    Situation("not_entered", SWISS, "entrant/0", {"do": "swap", "other": "Eva"}),
    Situation("withdrawn", SWISS.withdraw("P2"), "entrant/1", {"do": "withdraw"}),
    Situation("full", of(Format.CHALLENGE, MOST), "enter", {"name": "Eva"}),
    Situation("late_over", TRIES.close(), "enter", {"name": "Eva"}),
    Situation("late_round", won(SWISS, 1, 2, 3), "enter", {"name": "Eva"}),
    Situation("ai_path", SWISS, "enter", {"name": "Eva", "brain": "/etc/passwd.npz"}),
    Situation("no_ai", SWISS, "enter", {"name": "Eva", "brain": "nobody"}),
    Situation("no_match", SWISS, "match/99", {"do": "postpone"}),
    Situation("played", won(SWISS, 1), "match/1", {"do": "postpone"}),
    Situation("unplayed", SWISS, "match/1", CORRECTION),
    Situation("counted", won(SWISS, 1), "match/1", SCORES),
    Situation(
        "begun", KNOCKOUT.record(level(KNOCKOUT.open[0])), "match/1", {"do": "seats", "seat0": "P4", "seat1": "P1"}
    ),
    Situation("decided", won(KNOCKOUT, 1, 2, 3), "match/1", CORRECTION),
    Situation("no_reason", won(SWISS, 1), "match/1", CORRECTION | {"reason": " "}),
    Situation("bad_note", won(SWISS, 1), "match/1", CORRECTION | {"reason": "walkover"}),
    Situation("one_seat", SWISS, "match/1", {"do": "seats", "seat0": "P1", "seat1": "P1"}),
    Situation("score_range", SWISS, "match/1", SCORES | {"score0": "1e10"}),
    Situation("bad_score", SWISS, "match/1", SCORES | {"score0": "x"}),
    Situation(
        "called", of(Format.ROUND_ROBIN).after(Summoned(1, "left")), "match/3", {"do": "call", "arcade": "right"}
    ),
    Situation("not_called", SWISS, "match/1", {"do": "call_off"}),
    Situation("in_break", SWISS.after(Paused()), "match/1", {"do": "call", "arcade": "left"}),
    Situation("break_begun", SWISS.after(Paused("x")), "break", {"do": "begin"}),
    Situation("no_break", SWISS, "break", {"do": "end"}),
    Situation("same", SWISS, "entrant/0", {"do": "swap", "other": "P1"}),
    Situation("no_round", finished(SWISS), "entrant/0", {"do": "swap", "other": "P2"}),
    Situation("no_place", won(KNOCKOUT, 1, 2, 3, 4), "entrant/3", {"do": "swap", "other": "P1"}),
    Situation("round_played", won(SWISS, 1), "entrant/0", {"do": "swap", "other": "P2"}),
    Situation("opponents", SWISS, "entrant/0", {"do": "swap", "other": "P3"}),
    Situation("brackets", won(KNOCKOUT, 1, 2), "entrant/0", {"do": "swap", "other": "P4"}),
    Situation("all_meet", of(Format.ROUND_ROBIN), "entrant/0", {"do": "swap", "other": "P2"}),
    Situation("undrawn", LADDER, "entrant/0", {"do": "swap", "other": "P2"}),
    Situation("drawn", SWISS, "arrange", {"name0": "P1", "name1": "P2"}),
    Situation("over", TRIES.close(), "arrange", {"name0": "P1"}),
    Situation("no_period", SWISS, "close"),
    Situation("two", LADDER, "arrange", {"name0": "P2"}),
    Situation("challenge_open", LADDER.arrange("P2", "P1"), "arrange", {"name0": "P3", "name1": "P1"}),
    Situation("reach", LADDER, "arrange", {"name0": "P1", "name1": "P2"}),
    Situation("once", of(Format.HIGH_SCORE), "arrange", {"name0": "P1", "name1": "P1"}),
    Situation("try_open", TRIES.arrange("P1"), "arrange", {"name0": "P1"}),
    Situation("tries", won(TRIES.arrange("P1"), 1), "arrange", {"name0": "P1"}),
)
ELSEWHERE = {  # on the command line, whose words a form does not have
    "one_place", "other_scores", "other_extra", "stranger", "seats", "bad_seat", "no_score", "one_score", "no_pair"
}  # fmt: skip


@pytest.mark.parametrize("at", range(len(SITUATIONS)), ids=lambda at: f"{at} {SITUATIONS[at].key}")
def test_it_says_why_in_the_language_of_the_desk_and_changes_nothing(tmp_path: Path, at: int) -> None:
    situation, path = SITUATIONS[at], tmp_path / "cup.json"
    save(path, situation.event)
    before = path.read_bytes()
    operator = Operator(desk_on(path))
    operator.log_in()
    told = set()
    for language in LANGUAGES:
        operator.get(f"/desk?language={language}")
        reply = operator.post(f"/desk/{situation.address}", **situation.form)
        assert reply.status == 409
        sentence = texts(language)[f"refused.{situation.key}"]
        pattern = texts(language)["desk.refused"].replace("{reason}", re.sub(r"\\{.*?\\}", ".+", re.escape(sentence)))
        banner = Reader(reply.body.decode()).text
        assert re.search(pattern, banner), banner
        told.add(sentence)
    assert len(told) == len(LANGUAGES)
    assert path.read_bytes() == before


def test_no_refusal_is_missing_here() -> None:
    keys = {key.removeprefix("refused.") for key in texts("en") if key.startswith("refused.")}
    assert {one.key for one in SITUATIONS} == keys - ELSEWHERE
