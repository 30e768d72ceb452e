"""AIs play an event without a window: each match as it is played elsewhere."""

from dataclasses import replace

import pytest

from pigaming_app.ai.registry import new_match
from pigaming_app.events.event import Event
from pigaming_app.events.match_setup import outcome_of, setup_of
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.games.registry import games
from pigaming_app.jobs.events.play import HeadlessRun

BRAINS = ("level1", "idle", "random", "")


def short_event(form=Format.ROUND_ROBIN, games=("pitanks",), **more) -> Event:
    entrants = tuple(Entrant(f"P{number}", brain) for number, brain in enumerate(BRAINS, 1))
    minutes = dict.fromkeys(games, 0.05)
    return Event(EventSpec("Test", form, games, entrants, minutes=minutes, **more))


@pytest.mark.parametrize("game", games())
def test_a_match_ends_as_it_does_in_the_arcade(game):
    event = short_event(games=(game,), seats=4)
    fixture = event.open[0]
    match = new_match(setup_of(event, fixture, "level3"))
    while not match.over:
        match.tick()
    assert HeadlessRun(event, fast=False).play(event) == [outcome_of(event.spec, fixture, match.outcome().rows)]


@pytest.mark.long
@pytest.mark.again
def test_compiled_matches_have_the_same_outcomes():
    """Few brains, since compiling takes long; in one batch every match has a line-up of its own."""
    entrants = tuple(
        Entrant(f"P{number}", brain) for number, brain in enumerate(("idle", "random", "random", "idle"), 1)
    )
    event = short_event(seats=2)
    event = replace(event, spec=replace(event.spec, entrants=entrants, minutes={"pitanks": 2.0}))
    plain, fast = HeadlessRun(event, fast=False), HeadlessRun(event, fast=True)
    outcomes = fast.play(event)
    assert [outcome.fixture for outcome in outcomes] == [1, 2, 3, 4, 5, 6]
    assert outcomes == plain.play_these(event, event.open)
    assert any(len(outcome.places) == 2 for outcome in outcomes)


def test_people_drive_and_entrants_of_a_team_play_together():
    entrants = tuple(Entrant(name, team=team) for name, team in (("A", "x"), ("B", "y"), ("C", "y"), ("D", "x")))
    event = Event(EventSpec("Test", Format.GRAND_PRIX, ("pitanks", "factory", "race"), entrants, seats=4))
    for fixture in event.open:
        setup = setup_of(event, fixture)
        assert [seat.brain for seat in setup.seats] == ["human"] * 4
        sides = {fixture.entrants[i]: seat.team for i, seat in enumerate(setup.seats)}
        assert (sides["A"] == sides["D"]) == (fixture.game != "race")
        assert (sides["B"] == sides["C"]) == (fixture.game != "race")
        assert sides["A"] != sides["B"]


def test_filled_seats_have_no_place():
    event = short_event(Format.GRAND_PRIX, seats=4, fill="level2")
    event = replace(event, spec=replace(event.spec, entrants=event.entrants[:3]))
    setup = setup_of(event, event.open[0])
    assert [seat.brain for seat in setup.seats].count("level2") == 1
    outcome = HeadlessRun(event, fast=False).play(event)[0]
    assert sorted(name for place in outcome.places for name in place) == ["P1", "P2", "P3"]
