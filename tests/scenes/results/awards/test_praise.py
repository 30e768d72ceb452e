"""The last place is told something kind and true."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from pigaming_app.games.game import Outcome, Row
from pigaming_app.scenes.results.awards.award import FREE, Award, last_seats, places, praises
from pigaming_app.scenes.results.headline import EndedMatch
from pigaming_app.ui.i18n import Words
from tests.matches import setup_of
from tests.scenes.screens import ENDINGS


def ended_match(name: str = "alone", **changes: Any) -> EndedMatch:
    ending = replace(ENDINGS[name], **changes)
    setup = setup_of(ending.game, ending.brains, "", 5.0, 1, ending.variant, teams=ending.teams)
    return EndedMatch(setup, ending.outcome(), [None] * 4)


def spoken(ended: EndedMatch, feats: Mapping[int, Mapping[str, float]] | None = None, **named: str) -> dict[int, str]:
    every = {seat: Award(named.get(f"seat{seat}", "aim"), "target", "aim") for seat in range(4)}
    return praises(Words("en"), ended, every, feats or {})


def test_the_last_place_is_told_how_close_it_was() -> None:
    assert spoken(ended_match(scores=(9, 8, 7, 5), winners=(0,))) == {3: "So close: just 2 behind!"}


def test_or_that_it_has_led_or_what_it_was_best_at() -> None:
    far = ended_match(scores=(90, 80, 70, 5), winners=(0,))
    assert spoken(far, {3: {"led": 1.0}}) == {3: "In the lead at half time!"}
    assert spoken(far, {3: {"led": 0.0}}) == {3: "Nobody aimed better!"}
    assert spoken(far, seat3="something_of_a_plug_in") == {3: "Nobody did that better!"}


def test_after_an_award_that_compares_nobody_it_is_told_how_far_it_drove() -> None:
    far = ended_match(scores=(90, 80, 70, 5), winners=(0,))
    fair = dict.fromkeys(range(4), FREE[0])
    said = [praises(Words("en"), far, fair, {3: {"meters": way}})[3] for way in (13.2, 0.0)]
    assert said == ["13 m driven: well done!", "Great that you played!"]


def test_the_two_of_a_team_are_told_different_things() -> None:
    said = spoken(ended_match("in teams", scores=(5, 5, 5, 4), winners=(0, 2)))
    assert said == {1: "So close: just 1 behind!", 3: "Nobody aimed better!"}


def test_nobody_is_last_where_all_are_level_or_alone() -> None:
    assert last_seats(ended_match("tie").outcome) == []
    assert places(ended_match("in teams").outcome) == {0: 1, 2: 1, 1: 2, 3: 2}


def test_drivers_are_told_the_seconds() -> None:
    rows = tuple(Row(seat, seat, seat + 1, 2, {}, {}, (10.0, 11.0 + 0.8 * seat)) for seat in range(2))
    race = EndedMatch(setup_of("race", "human human", goal=2), Outcome(rows, (0,), ((),) * 4, 30.0), [None] * 4)
    assert spoken(race) == {1: "So close: just 0.8 s behind!"}
