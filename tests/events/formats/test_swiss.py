"""Swiss rounds worked by hand, and what must hold in all of them."""

from collections.abc import Iterator
from itertools import combinations
from random import Random

import pytest

from pigaming_app.events.formats.swiss import default_rounds, pairing
from pigaming_app.events.spec import Entrant, Format, Result
from tests.events.examples import by_chance, new_event, pairs_of, played

ROUNDS = ((3, 2), (4, 3), (5, 3), (6, 3), (8, 4), (9, 4), (12, 6), (16, 8), (20, 10))
CROWDS = ((32, 16), (33, 8), (64, 6))


def test_eight_entrants_of_whom_the_better_seed_always_wins():
    """Worked by hand after C.04.3: the upper half of each score group meets the lower half in order."""
    event = played(new_event(Format.SWISS, 8))
    assert pairs_of(event, 1) == [("P1", "P5"), ("P2", "P6"), ("P3", "P7"), ("P4", "P8")]
    assert pairs_of(event, 2) == [("P1", "P3"), ("P2", "P4"), ("P5", "P7"), ("P6", "P8")]
    assert pairs_of(event, 3) == [("P1", "P2"), ("P3", "P5"), ("P4", "P6"), ("P7", "P8")]
    assert event.over
    assert [(row.entrant, row.points) for row in event.standings[:2]] == [("P1", 3.0), ("P2", 2.0)]


def test_seven_entrants_have_byes_in_turn_from_the_last_one_up():
    """Worked by hand: 3 and 6 have met in round one, so 3 meets 7 in round three."""
    event = played(new_event(Format.SWISS, 7))
    assert event.byes == {1: ("P7",), 2: ("P6",), 3: ("P5",)}
    assert pairs_of(event, 1) == [("P1", "P4"), ("P2", "P5"), ("P3", "P6")]
    assert pairs_of(event, 2) == [("P1", "P3"), ("P2", "P7"), ("P4", "P5")]
    assert pairs_of(event, 3) == [("P1", "P2"), ("P3", "P7"), ("P4", "P6")]


def test_an_odd_score_group_floats_its_last_one_down():
    """Worked by hand: three have a point after round one of six, so the last of them, P3, meets the best without."""
    event = played(new_event(Format.SWISS, 6), rounds=1)
    assert pairs_of(event, 1) == [("P1", "P4"), ("P2", "P5"), ("P3", "P6")]
    assert pairs_of(event, 2) == [("P1", "P2"), ("P3", "P4"), ("P5", "P6")]


def test_a_tie_is_half_a_point_each():
    """Worked by hand: a point P2, P3; half a point P1, P4, who have met; nothing P5, P6."""
    event = new_event(Format.SWISS, 6)
    event = event.record(Result(event.open[0].number, (("P4", "P1"),)))
    event = played(event, rounds=1)
    assert [(row.entrant, row.points) for row in event.standings][2:4] == [("P1", 0.5), ("P4", 0.5)]
    assert pairs_of(event, 2) == [("P2", "P3"), ("P1", "P5"), ("P4", "P6")]


@pytest.mark.parametrize(
    ("count", "rounds"), [*ROUNDS, *(pytest.param(*crowd, marks=pytest.mark.long) for crowd in CROWDS)]
)
def test_no_rematch_no_second_bye_and_seats_that_change(count, rounds):
    event = played(new_event(Format.SWISS, count, rounds=rounds), by_chance(count))
    assert event.round == rounds
    met = [frozenset(one.entrants) for one in event.fixtures]
    assert len(met) == len(set(met)) == rounds * (count // 2)
    byes = [name for names in event.byes.values() for name in names]
    assert len(byes) == len(set(byes)) == rounds * (count % 2)
    for entrant in event.entrants:
        seats = [one.entrants.index(entrant.name) for one in event.fixtures if entrant.name in one.entrants]
        assert rounds < 3 or {*seats} == {0, 1}


def test_all_rounds_are_drawn_even_if_rematches_are_needed():
    event = played(new_event(Format.SWISS, 6, rounds=5), by_chance(4))
    assert event.round == 5
    assert len(event.fixtures) == 15


@pytest.mark.parametrize(("count", "seats"), [(5, 3), (8, 4), (10, 4), (16, 4), (31, 3)])
def test_matches_of_several_have_no_byes(count, seats):
    event = played(new_event(Format.SWISS, count, seats=seats, rounds=4), by_chance(count))
    for drawn in event.progress.rounds:
        assert sum(len(one.entrants) for one in drawn.fixtures) == count
        assert not drawn.byes


def test_sixteen_in_matches_of_four_meet_others_in_the_second_round():
    event = played(new_event(Format.SWISS, 16, seats=4, rounds=3), rounds=1)
    first = [set(group) for group in pairs_of(event, 1)]
    assert all(len(set(group) & other) <= 1 for group in pairs_of(event, 2) for other in first)


def test_a_late_entrant_has_no_points_for_the_missed_round():
    event = played(new_event(Format.SWISS, 4), rounds=1).add(Entrant("P5"))
    assert next(row.points for row in event.standings if row.entrant == "P5") == 0.0
    assert event.byes == {2: ("P5",)}
    event = played(event, rounds=2)
    assert next(row.points for row in event.standings if row.entrant == "P5") == 1.0


@pytest.mark.parametrize(("count", "rounds"), [(3, 2), (4, 2), (5, 3), (8, 3), (9, 4), (64, 6)])
def test_the_default_leaves_one_with_all_points(count, rounds):
    assert default_rounds(count) == rounds


def every_pairing(left: list[int]) -> Iterator[list[tuple[int, int]]]:
    """All ways to pair an even number of entrants."""
    if not left:
        yield []
    for other in left[1:]:
        for rest in every_pairing([one for one in left[1:] if one != other]):
            yield [(left[0], other), *rest]


def merits(
    found: list[tuple[int, int]], score: list[float], met: dict[tuple[int, int], int], byes: list[int]
) -> tuple[int, ...]:
    """The criteria of docs/events.md, less is better. The place behind the last one is a bye."""
    opponent = dict(found) | {other: one for one, other in found}
    bye = len(score)
    brackets = [[one for one, own in enumerate(score) if own == points] for points in sorted(set(score))[::-1]]
    brackets[-1].append(bye)  # nobody floats to it from the last one
    floaters: list[int] = []
    floated = []
    for bracket in brackets:
        here = {*floaters, *bracket}
        floaters = [one for one in here if opponent.get(one, one) not in here]
        floated.append(len(floaters))
    choice = []
    for one, other in found:
        bracket = next(bracket for bracket in brackets if one in bracket)
        own = [name for name in bracket if name != bye]
        taken = sum(len(b) for b in brackets[: brackets.index(bracket)]) % 2
        middle = taken + (len(own) - taken) // 2
        line = [*own[middle:], *own[:middle][::-1], *range(own[-1] + 1, bye + 1)]
        choice.append([name for name in line if name > one].index(other))
    rested = byes[opponent[bye]] if bye in opponent else 0
    return rested, sum(met.get(pair, 0) for pair in found), *floated, *choice


@pytest.mark.parametrize("count", range(2, 11))
def test_no_pairing_is_better_than_the_drawn_one(count: int) -> None:
    """Every pairing of up to ten entrants is compared, in states that an event reaches and in others."""
    random = Random(count)
    for crowd in (0.1, 0.4, 0.7, 0.95):
        for _ in range(3):
            score = sorted((random.choice((0.0, 0.5, 1.0, 1.5, 2.0, 3.0)) for _ in range(count)), reverse=True)
            met = {pair: random.randint(1, 2) for pair in combinations(range(count), 2) if random.random() < crowd}
            byes = [random.randint(0, 1) for _ in range(count)]
            best = min(every_pairing([*range(count + count % 2)]), key=lambda one: merits(one, score, met, byes))
            again = frozenset((one, other, times) for (one, other), times in met.items())
            assert list(pairing(tuple(score), again, tuple(byes))) == best


def test_leaders_who_have_met_float_to_the_next_group() -> None:
    """Worked by hand: 1 and 2 have met, so both float; 1 has met all but the last one, so only 1 floats."""
    assert pairing((2.0, 2.0, 1.0, 1.0), frozenset({(0, 1, 1)}), (0,) * 4) == ((0, 2), (1, 3))
    assert pairing((2.0, 1.0, 1.0, 0.0), frozenset({(0, 1, 1), (0, 2, 1)}), (0,) * 4) == ((0, 3), (1, 2))
