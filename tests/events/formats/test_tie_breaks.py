"""Tie-breaks worked by hand."""

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.formats.tie_breaks import CountedMatch, Table, head_to_head
from pigaming_app.events.spec import Entrant, Format, Result
from tests.events.examples import best_seed_wins, new_event, played, ranked

# Round robin of four, worked by hand. P1 beats P2 and P3, loses to P4; P2 beats P3 and P4; P3 beats P4.
RESULTS = {
    frozenset(("P1", "P2")): "P1",
    frozenset(("P1", "P3")): "P1",
    frozenset(("P1", "P4")): "P4",
    frozenset(("P2", "P3")): "P2",
    frozenset(("P2", "P4")): "P2",
    frozenset(("P3", "P4")): "P3",
}


def by_results(fixture):
    winner = RESULTS[frozenset(fixture.entrants)]
    return ranked(fixture, winner, *(name for name in fixture.entrants if name != winner))


def test_head_to_head_decides_between_two_of_equal_points():
    """P1 and P2 have 2 points; P1 has beaten P2. P3 and P4 have 1; P3 has beaten P4."""
    event = played(new_event(Format.ROUND_ROBIN, 4), by_results)
    assert [(row.place, row.entrant, row.points) for row in event.standings] == [
        (1, "P1", 2.0), (2, "P2", 2.0), (3, "P3", 1.0), (4, "P4", 1.0)
    ]  # fmt: skip
    assert event.standings[0].tie_breaks == {"head_to_head": 1.0, "wins": 2.0, "sonneborn_berger": 3.0}
    assert event.standings[1].tie_breaks == {"head_to_head": 0.0, "wins": 2.0, "sonneborn_berger": 2.0}


def test_in_a_circle_of_three_equal_ones_share_the_place():
    event = new_event(Format.ROUND_ROBIN, 3)
    beats = {"P1": "P2", "P2": "P3", "P3": "P1"}
    while event.open:
        fixture = event.open[0]
        one, two = fixture.entrants
        event = event.record(ranked(fixture, *((one, two) if beats[one] == two else (two, one))))
    assert [(row.place, row.points) for row in event.standings] == [(1, 1.0)] * 3


def test_head_to_head_counts_again_among_those_who_are_still_level():
    """Six, worked by hand: P1 to P4 have 3 points each, of these against one another 2, 2, 1 and 1. P1 has beaten P2,
    P3 has beaten P4 (article 6.2). Wins are 3 each; Sonneborn-Berger is 7, 7, 6 and 6, so nothing else decides.
    """
    beats = {"P1": "P2 P3 P5", "P2": "P3 P4 P5", "P3": "P4 P5 P6", "P4": "P1 P5 P6", "P5": "P6", "P6": "P1 P2"}

    def by_table(fixture):
        one, two = fixture.entrants
        return ranked(fixture, *((one, two) if two in beats[one].split() else (two, one)))

    event = played(new_event(Format.ROUND_ROBIN, 6), by_table)
    assert [(row.place, row.entrant, row.points) for row in event.standings] == [
        (1, "P1", 3.0), (2, "P2", 3.0), (3, "P3", 3.0), (4, "P4", 3.0), (5, "P6", 2.0), (6, "P5", 1.0)
    ]  # fmt: skip
    assert [row.tie_breaks["head_to_head"] for row in event.standings[:4]] == [2.0, 2.0, 1.0, 1.0]
    assert [row.tie_breaks["sonneborn_berger"] for row in event.standings[:4]] == [7.0, 7.0, 6.0, 6.0]


def met(*pairs):
    """The table of these matches, each of a winner and a loser."""
    return Table({}, [CountedMatch({one: 1.0, other: 0.0}, one) for one, other in pairs], {}, {})


def test_of_several_matches_with_one_the_mean_counts_head_to_head():
    """Article 6.1.2: P1 has 1 against P2, and ½ against P3."""
    table = met(("P1", "P2"), ("P1", "P2"), ("P1", "P3"), ("P3", "P1"), ("P2", "P3"), ("P2", "P3"))
    assert head_to_head(table, ["P1", "P2", "P3"]) == {"P1": 1.5, "P2": 1.0, "P3": 0.5}


def test_whoever_is_ahead_without_the_missing_matches_is_ahead():
    """Article 6.3: P1 has beaten both others, who have not met. Had P1 met P2 only, P3 could have caught up."""
    assert head_to_head(met(("P1", "P2"), ("P1", "P3")), ["P1", "P2", "P3"]) == {"P1": 2.0, "P2": 0.0, "P3": 0.0}
    assert head_to_head(met(("P1", "P2")), ["P1", "P2", "P3"]) == {"P1": 0.0, "P2": 0.0, "P3": 0.0}


def test_buchholz_adds_the_points_of_the_opponents():
    """Eight, the better seed always wins. 1 met 5 (1 point), 3 (2) and 2 (2); 2 met 6, 4 and 1 (3);
    3 met 7 (1), 1 and 5; 4 met 8 (0), 2 and 6 (1).
    """
    event = played(new_event(Format.SWISS, 8))
    table = {row.entrant: row for row in event.standings}
    assert [table[f"P{seed}"].points for seed in range(1, 9)] == [3, 2, 2, 2, 1, 1, 1, 0]
    assert [table[f"P{seed}"].tie_breaks["buchholz"] for seed in (1, 2, 3, 4)] == [5.0, 6.0, 5.0, 3.0]
    assert [row.entrant for row in event.standings[:4]] == ["P1", "P2", "P3", "P4"]


def test_a_bye_counts_as_an_opponent_of_equal_points():
    """Three entrants, two rounds: P3 has a bye, then meets P1, who has beaten P2. Worked by hand."""
    event = played(new_event(Format.SWISS, 3))
    assert event.byes == {1: ("P3",), 2: ("P2",)}
    table = {row.entrant: row for row in event.standings}
    assert [table[name].points for name in ("P1", "P2", "P3")] == [2.0, 1.0, 1.0]
    assert table["P3"].tie_breaks["buchholz"] == 1.0 + 2.0
    assert table["P2"].tie_breaks["buchholz"] == 2.0 + 1.0


def test_sonneborn_berger_counts_the_points_of_beaten_opponents_and_half_of_ties():
    """P1 beats P2, ties with P3; P2 beats P3: 1.5, 1 and 0.5 points. P1: 1 + 0.5 / 2; P2: 0.5; P3: 1.5 / 2."""
    event = new_event(Format.ROUND_ROBIN, 3)
    while event.open:
        fixture = event.open[0]
        tied = {*fixture.entrants} == {"P1", "P3"}
        event = event.record(Result(fixture.number, (fixture.entrants,)) if tied else best_seed_wins(fixture))
    values = {row.entrant: row.tie_breaks["sonneborn_berger"] for row in event.standings}
    assert values == {"P1": 1.25, "P2": 0.5, "P3": 0.75}


def test_who_leaves_a_round_robin_early_does_not_count():
    """P6 plays one of five matches: its opponent has no point for that, nor for those that were to come."""
    event = played(new_event(Format.ROUND_ROBIN, 6), rounds=1).withdraw("P6")
    event = played(event)
    assert [(row.entrant, row.points) for row in event.standings] == [
        ("P1", 4.0), ("P2", 3.0), ("P3", 2.0), ("P4", 1.0), ("P5", 0.0), ("P6", 0.0)
    ]  # fmt: skip


def test_who_leaves_a_round_robin_late_loses_the_rest():
    event = played(played(new_event(Format.ROUND_ROBIN, 4), rounds=2).withdraw("P1"))
    assert {row.entrant: row.points for row in event.standings} == {"P1": 2.0, "P2": 2.0, "P3": 2.0, "P4": 0.0}


@pytest.mark.parametrize("form", [Format.SWISS, Format.ROUND_ROBIN])
def test_matches_of_four_count_by_the_share_of_beaten_opponents(form):
    event = new_event(form, 4, seats=4, rounds=1)
    event = event.record(Result(1, (("P2",), ("P1", "P4"), ("P3",))))
    assert {row.entrant: round(row.points, 6) for row in event.standings} == {
        "P2": 1.0, "P1": 0.5, "P4": 0.5, "P3": 0.0
    }  # fmt: skip
    assert Entrant("P1") in event.entrants


def of_several(event: Event, **places: str) -> Event:
    """Results of matches by their number (m1 …): names, best first, level ones joined by +."""
    for key, order in places.items():
        event = event.record(Result(int(key[1:]), tuple(tuple(place.split("+")) for place in order.split())))
    return event


def test_sixths_do_not_tell_apart_who_is_level():
    """Buchholz of the third of each match: (1 + 2/3 + 0) / 3 and (5/6 + 5/6 + 0) / 3 are the same."""
    event = of_several(new_event(Format.SWISS, 8, seats=4, rounds=1), m1="P1 P2 P3 P4", m2="P5+P6 P7 P8")
    assert {row.entrant: row.place for row in event.standings}["P3"] == 5
    assert {row.entrant: row.place for row in event.standings}["P7"] == 5


def test_a_bye_counts_in_the_buchholz_while_the_next_round_is_played():
    """P5 rests in round one (1 point), and has met nobody of more points than P5 since."""
    event = played(new_event(Format.SWISS, 5, rounds=2), rounds=1)
    match = next(one for one in event.open if "P5" in one.entrants)
    (other,) = {*match.entrants} - {"P5"}
    event = event.record(ranked(match, "P5", other))
    points = {row.entrant: row.points for row in event.standings}
    assert {row.entrant: row.tie_breaks["buchholz"] for row in event.standings}["P5"] == points["P5"] + points[other]


def test_sonneborn_berger_of_four_counts_who_was_beaten():
    """P3 has beaten P4 only, who has no points: nothing."""
    event = of_several(new_event(Format.SWISS, 4, seats=4, rounds=1), m1="P1 P2 P3 P4")
    value = {row.entrant: row.tie_breaks["sonneborn_berger"] for row in event.standings}
    assert value == pytest.approx({"P1": 1 / 3, "P2": 1 / 9, "P3": 0.0, "P4": 0.0}, abs=1e-6)


def test_who_leaves_early_takes_no_results_of_others_along():
    """Three in a match, P3 has played one of six: between P1 and P2 it still counts."""
    event = new_event(Format.ROUND_ROBIN, 7, seats=3)
    first = event.open[0]
    a, b, c = first.entrants
    event = event.record(ranked(first, c, a, b)).withdraw(c)
    assert {row.entrant: row.points for row in event.standings}[a] == 1.0
    assert {row.entrant: row.points for row in event.standings}[c] == 0.0
