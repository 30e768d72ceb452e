"""Everybody plays every game, and places bring points."""

from itertools import combinations

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.formats.grand_prix import shared
from pigaming_app.events.spec import Entrant, EventSpec, Format, Result
from tests.events.examples import by_chance, new_event, played

GAMES = ("pitanks", "factory", "race")


def test_four_play_the_three_games_in_a_row():
    event = played(new_event(Format.GRAND_PRIX, 4, games=GAMES, seats=4))
    assert [one.game for one in event.fixtures] == list(GAMES)
    assert [(row.entrant, row.points) for row in event.standings] == [
        ("P1", 30.0), ("P2", 18.0), ("P3", 9.0), ("P4", 3.0)
    ]  # fmt: skip
    assert event.standings[0].tie_breaks == {"first": 3.0, "second": 0.0, "third": 0.0}


def test_equal_places_share_their_points():
    assert shared(1, 2) == 8.0
    assert shared(2, 3) == pytest.approx(10.0 / 3)
    event = new_event(Format.GRAND_PRIX, 4, games=("pitanks",), seats=4)
    event = event.record(Result(1, (("P1",), ("P2", "P3"), ("P4",))))
    assert [(row.place, row.entrant, row.points) for row in event.standings] == [
        (1, "P1", 10.0), (2, "P2", 4.5), (2, "P3", 4.5), (4, "P4", 1.0)
    ]  # fmt: skip


def test_more_first_places_count_among_equal_points():
    """Worked by hand: A 10 + 1 + 1 and B 6 + 3 + 3 are 12 each, but A has been first once."""
    event = new_event(Format.GRAND_PRIX, 4, games=("pitanks",), rounds=3, seats=4)
    for order in (("P2", "P1", "P3", "P4"), ("P3", "P4", "P1", "P2"), ("P4", "P3", "P1", "P2")):
        event = event.record(Result(event.open[0].number, tuple((name,) for name in order)))
    rows = [(row.entrant, row.points, row.tie_breaks["first"]) for row in event.standings]
    assert rows[2:] == [("P2", 12.0, 1.0), ("P1", 12.0, 0.0)]


@pytest.mark.parametrize("count", [3, 5, 6, 9, 13, 64])
def test_all_play_in_each_round_and_seats_change(count):
    event = played(new_event(Format.GRAND_PRIX, count, games=GAMES, rounds=6, seats=4), by_chance(count))
    for drawn in event.progress.rounds:
        assert sum(len(one.entrants) for one in drawn.fixtures) == count
    for entrant in event.entrants:
        assert len({one.entrants.index(entrant.name) for one in event.fixtures if entrant.name in one.entrants}) > 1


def test_other_opponents_in_the_next_round():
    event = new_event(Format.GRAND_PRIX, 16, games=GAMES, seats=4)
    met = [frozenset(pair) for one in event.fixtures for pair in combinations(one.entrants, 2)]
    assert len(met) == 72
    assert len(set(met)) >= 70


def test_ais_fill_empty_seats_and_have_no_place():
    event = new_event(Format.GRAND_PRIX, 5, games=GAMES, seats=4, fill="level2")
    assert [(len(one.entrants), one.fill) for one in event.open[:2]] == [(3, 1), (2, 2)]


def test_points_of_a_team_are_those_of_its_entrants():
    entrants = tuple(Entrant(name, team=team) for name, team in (("A", "Red"), ("B", "Blue"), ("C", "Red")))
    event = Event(EventSpec("Teams", Format.GRAND_PRIX, ("pitanks",), entrants, seats=4))
    event = event.record(Result(1, (("A",), ("B",), ("C",))))
    assert [(row.entrant, row.points, row.wins) for row in event.team_standings] == [
        ("Red", 13.0, 1), ("Blue", 6.0, 0)
    ]  # fmt: skip
    assert new_event(Format.GRAND_PRIX, 3).team_standings == ()


def test_an_odd_one_out_in_heats_of_two_has_the_points_of_a_tie():
    event = new_event(Format.GRAND_PRIX, 3, games=GAMES, seats=2)
    assert event.byes == {1: ("P3",), 2: ("P2",), 3: ("P1",)}
    assert [row.points for row in event.standings] == [0.0, 0.0, 0.0]
    event = played(event)
    assert [(row.entrant, row.points) for row in event.standings] == [("P1", 28.0), ("P2", 24.0), ("P3", 20.0)]
