"""Everybody meets everybody, in the order of the published tables."""

from itertools import combinations

import pytest

from pigaming_app.events.formats.round_robin import berger
from pigaming_app.events.spec import Entrant, Format
from tests.events.examples import best_seed_wins, new_event, played


def test_the_berger_table_of_six_is_the_published_one():
    """FIDE Handbook, C.05, annex 1: 5 or 6 players."""
    assert berger(6) == [
        [(1, 6), (2, 5), (3, 4)],
        [(6, 4), (5, 3), (1, 2)],
        [(2, 6), (3, 1), (4, 5)],
        [(6, 5), (1, 4), (2, 3)],
        [(3, 6), (4, 2), (5, 1)],
    ]


def test_the_berger_table_of_eight_is_the_published_one():
    """FIDE Handbook, C.05, annex 1: 7 or 8 players, rounds 1 to 3 and the last."""
    table = berger(8)
    assert table[:3] == [
        [(1, 8), (2, 7), (3, 6), (4, 5)],
        [(8, 5), (6, 4), (7, 3), (1, 2)],
        [(2, 8), (3, 1), (4, 7), (5, 6)],
    ]
    assert table[6] == [(4, 8), (5, 3), (6, 2), (7, 1)]


@pytest.mark.parametrize("count", [3, 4, 5, 6, 7, 8, 15, 16, 33, 64])
def test_each_two_meet_once_and_nobody_plays_twice_in_a_round(count):
    event = new_event(Format.ROUND_ROBIN, count)
    met = [frozenset(one.entrants) for one in event.fixtures]
    assert sorted(map(sorted, met)) == sorted(map(sorted, combinations([one.name for one in event.entrants], 2)))
    for number in range(1, count + count % 2):
        names = [name for one in event.fixtures if one.round == number for name in one.entrants]
        assert len(names) == len(set(names)) == count - count % 2
    if count % 2:
        assert sorted(name for names in event.byes.values() for name in names) == sorted(
            one.name for one in event.entrants
        )


@pytest.mark.parametrize("count", [4, 7, 10])
def test_seats_differ_by_one_at_most(count):
    event = new_event(Format.ROUND_ROBIN, count)
    for entrant in event.entrants:
        seats = [one.entrants.index(entrant.name) for one in event.fixtures if entrant.name in one.entrants]
        assert abs(seats.count(0) - seats.count(1)) <= 1


def test_a_second_cycle_changes_seats():
    event = new_event(Format.ROUND_ROBIN, 4, rounds=2)
    first, second = event.fixtures[:6], event.fixtures[6:]
    assert [one.entrants for one in second] == [one.entrants[::-1] for one in first]


@pytest.mark.parametrize(("count", "seats"), [(4, 4), (5, 4), (6, 4), (7, 3), (8, 4), (9, 3), (13, 4), (16, 4)])
def test_in_matches_of_several_each_two_meet_and_all_play(count, seats):
    event = new_event(Format.ROUND_ROBIN, count, seats=seats)
    met = {frozenset(pair) for one in event.fixtures for pair in combinations(one.entrants, 2)}
    assert len(met) == count * (count - 1) // 2
    for drawn in event.progress.rounds:
        sizes = [len(one.entrants) for one in drawn.fixtures]
        assert sum(sizes) == count
        assert max(sizes) - min(sizes) <= 1
        assert max(sizes) <= seats


def test_a_late_entrant_meets_everybody_from_round_two_on():
    event = played(new_event(Format.ROUND_ROBIN, 5), rounds=1).add(Entrant("P6"))
    event = played(event)
    met = sorted(tuple(sorted(one.entrants)) for one in event.fixtures)
    assert met == sorted(combinations([f"P{seed}" for seed in range(1, 7)], 2))
    assert all(row.played == 5 for row in event.standings)
    assert [row.entrant for row in event.standings] == [f"P{seed}" for seed in range(1, 7)]


def test_no_late_entrant_once_round_two_has_begun():
    event = new_event(Format.ROUND_ROBIN, 4)
    event = played(event, rounds=1)
    event = event.record(best_seed_wins(event.open[0]))
    with pytest.raises(ValueError, match=r"^P5 is too late: round 2 has begun$"):
        event.add(Entrant("P5"))
