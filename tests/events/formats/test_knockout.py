"""Double elimination: brackets worked by hand, and what must hold for every number of entrants."""

import pytest

from pigaming_app.events.formats.knockout import bracket
from pigaming_app.events.spec import Advance, Entrant, Format, Result
from tests.events.examples import best_seed_wins, by_chance, new_event, pairs_of, played, ranked, seed_of


def stages(event, number):
    fixtures = sorted((one for one in event.fixtures if one.round == number), key=lambda one: one.number)
    return [(one.stage[0], *sorted(map(seed_of, one.entrants))) for one in fixtures]


def test_the_two_best_seeds_of_a_bracket_meet_last():
    assert bracket(8) == [1, 8, 4, 5, 2, 7, 3, 6]
    assert bracket(4) == [1, 4, 2, 3]


def test_eight_entrants_of_whom_the_better_seed_always_wins():
    """Worked by hand: the standard bracket of eight; in round three losers cross over to the other half."""
    event = played(new_event(Format.KNOCKOUT, 8))
    assert stages(event, 1) == [("w", 1, 8), ("w", 4, 5), ("w", 2, 7), ("w", 3, 6)]
    assert stages(event, 2) == [("w", 1, 4), ("w", 2, 3), ("l", 5, 8), ("l", 6, 7)]
    assert stages(event, 3) == [("l", 3, 5), ("l", 4, 6)]
    assert stages(event, 4) == [("w", 1, 2), ("l", 3, 4)]
    assert stages(event, 5) == [("l", 2, 3)]
    assert stages(event, 6) == [("f", 1, 2)]
    assert event.over
    assert [row.entrant for row in event.standings] == [f"P{seed}" for seed in range(1, 9)]
    assert [row.place for row in event.standings] == [1, 2, 3, 4, 5, 5, 7, 7]
    assert [row.points for row in event.standings] == [7, 6, 5, 4, 2, 2, 0, 0]


def test_five_entrants_have_byes_for_the_best_three():
    event = played(new_event(Format.KNOCKOUT, 5))
    assert event.byes[1] == ("P1", "P2", "P3")
    assert stages(event, 1) == [("w", 4, 5)]
    assert stages(event, 2) == [("w", 1, 4), ("w", 2, 3)]


def test_who_loses_the_first_final_unbeaten_has_a_second_one():
    event = new_event(Format.KNOCKOUT, 3)
    while event.open[0].stage != "final":
        event = event.record(best_seed_wins(event.open[0]))
    event = event.record(ranked(event.open[0], "P2", "P1"))
    assert [one.stage for one in event.open] == ["final"]
    event = event.record(ranked(event.open[0], "P2", "P1"))
    assert event.over
    assert [row.entrant for row in event.standings] == ["P2", "P1", "P3"]


@pytest.mark.parametrize("count", range(3, 65))
def test_everybody_but_the_best_loses_twice(count):
    event = played(new_event(Format.KNOCKOUT, count), by_chance(count, ties=False))
    assert len(event.fixtures) in (2 * count - 2, 2 * count - 1)
    lost = {entrant.name: 0 for entrant in event.entrants}
    for fixture in event.fixtures:
        assert max(lost[name] for name in fixture.entrants) < 2
        lost[event.outcomes[fixture.number].places[1][0]] += 1
    best = event.standings[0].entrant
    assert lost.pop(best) < 2
    assert {*lost.values()} == {2}
    byes = [name for names in event.byes.values() for name in names]
    assert max(map(byes.count, byes), default=0) <= 3


@pytest.mark.parametrize("advance", list(Advance))
@pytest.mark.parametrize("seats", [3, 4])
@pytest.mark.parametrize("count", [3, 4, 5, 9, 16, 27, 64])
def test_matches_of_several_end_with_one_best(count, seats, advance):
    event = played(new_event(Format.KNOCKOUT, count, seats=seats, advance=advance), by_chance(count))
    assert event.over
    assert not event.byes
    assert event.open == ()
    assert [row.place for row in event.standings][:3].count(1) == 1
    for drawn in event.progress.rounds:
        names = [name for one in drawn.fixtures for name in one.entrants]
        assert len(names) == len(set(names))


def test_of_four_the_better_half_goes_on():
    event = played(new_event(Format.KNOCKOUT, 8, seats=4), rounds=1)
    assert pairs_of(event, 1) == [("P1", "P4", "P5", "P8"), ("P2", "P3", "P6", "P7")]
    assert stages(event, 2) == [("w", 1, 2, 3, 4), ("l", 5, 6, 7, 8)]


def test_a_late_entrant_begins_in_the_losers_bracket():
    event = played(new_event(Format.KNOCKOUT, 4), rounds=1).add(Entrant("P5"))
    assert stages(event, 2) == [("l", 4, 5)]
    assert event.byes[2] == ("P3",)
    event = played(event)
    assert event.standings[0].entrant == "P1"


def test_a_correction_draws_later_rounds_anew_until_they_have_begun():
    event = played(new_event(Format.KNOCKOUT, 4), rounds=1)
    event = event.correct(Result(1, (("P4",), ("P1",)), note="wrong button"))
    assert stages(event, 2) == [("w", 2, 4), ("l", 1, 3)]
    event = event.record(best_seed_wins(event.open[0]))
    for places in ((("P1",), ("P4",)), (("P1", "P4"),)):
        with pytest.raises(ValueError, match=r"^match 1 decides who goes on, and match 3 has been played since$"):
            event.correct(Result(1, places, note="right after all"))
    event = event.correct(Result(1, (("P4",), ("P1",)), {"P4": 3.0}, note="score"))
    assert event.outcomes[1].scores == {"P4": 3.0}


def test_the_opponents_of_who_withdraws_go_on():
    event = new_event(Format.KNOCKOUT, 4).record(ranked(new_event(Format.KNOCKOUT, 4).open[0], "P1", "P4"))
    event = event.withdraw("P2")
    assert event.outcomes[2].note == "walkover"
    assert stages(event, 2) == [("w", 1, 3)]
    assert played(event).over


def test_whoever_leaves_is_behind_all_who_are_there_and_ahead_of_who_was_out_before():
    """Of eight, P5 to P8 are out after round three; P3 leaves with one life, in round four."""
    event = played(new_event(Format.KNOCKOUT, 8), rounds=3).withdraw("P3")
    assert [(row.place, row.entrant) for row in event.standings[:5]] == [
        (1, "P1"), (1, "P2"), (3, "P4"), (4, "P3"), (5, "P5")
    ]  # fmt: skip


def test_who_rests_and_leaves_is_ahead_of_who_lost_in_that_round():
    """Of five, P4 rests in round three, in which P5 is out, and leaves then."""
    event = played(new_event(Format.KNOCKOUT, 5), rounds=3)
    assert event.byes[3] == ("P4",)
    assert [row.entrant for row in event.withdraw("P4").standings[-2:]] == ["P4", "P5"]
