"""Places and seats that entrants exchange, calls and breaks."""

from contextlib import suppress
from random import Random

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.event_files import parse, to_text
from pigaming_app.events.formats.knockout import FINAL
from pigaming_app.events.journal import Paused, Reseated, Resumed, Summoned, Swapped
from pigaming_app.events.spec import Format, Result
from tests.events.examples import best_seed_wins, by_chance, new_event, pairs_of, played


@pytest.mark.parametrize("form", [Format.KNOCKOUT, Format.SWISS, Format.GRAND_PRIX])
@pytest.mark.parametrize("seed", range(40))
def test_entrants_who_exchange_places_leave_an_event_that_ends(form, seed):
    """A count beside the code: everybody of a round stands in it once, and in a knock-out two defeats are the end."""
    random = Random(f"{form}{seed}")
    more = {"seats": 3, "rounds": 6} if form == Format.GRAND_PRIX else {}
    event = new_event(form, random.randint(5, 13), seed=seed, **more)
    names = [entrant.name for entrant in event.entrants]
    outcome, swaps, lost = by_chance(seed, ties=False), 0, dict.fromkeys(names, 0)
    for _ in range(400):
        if event.over:
            break
        for _ in range(random.randint(0, 6)):
            with suppress(ValueError):
                event = event.after(Swapped(*random.sample(names, 2)))
                swaps += 1
        fixture = random.choice([one for one in event.open if one.round == event.open[0].round])
        here = [one for one in event.fixtures if one.round == fixture.round]
        placed = [name for one in here for name in one.entrants] + [*event.byes.get(fixture.round, ())]
        assert len(placed) == len({*placed})
        if form == Format.KNOCKOUT:
            assert all(len(one.entrants) == 2 for one in here)
            assert all(lost[name] < 2 for name in fixture.entrants)
        result = outcome(fixture)
        if form == Format.KNOCKOUT:
            lost[result.places[-1][0]] += 1
        event = event.record(result)
    assert event.over
    assert swaps
    assert parse(to_text(event)) == event
    if form == Format.KNOCKOUT:
        assert sorted(lost.values())[1:] == [2] * (len(names) - 1)
        assert event.fixtures[-1].stage == FINAL


def test_friends_who_are_drawn_against_each_other_meet_others():
    event = new_event(Format.SWISS, 4)
    assert pairs_of(event, 1) == [("P1", "P3"), ("P2", "P4")]
    assert pairs_of(event.after(Swapped("P3", "P4")), 1) == [("P1", "P4"), ("P2", "P3")]


def test_a_place_in_the_bracket_is_kept_to_its_end():
    """Of eight, P1 and P2 meet in the final; in each other's place, P2 and P4 do."""
    event = new_event(Format.KNOCKOUT, 8).after(Swapped("P1", "P4"))
    assert pairs_of(event, 1) == [("P4", "P8"), ("P1", "P5"), ("P2", "P7"), ("P3", "P6")]
    event = played(event, rounds=1)
    assert pairs_of(event, 2)[:2] == [("P1", "P4"), ("P2", "P3")]


def test_a_bye_is_a_place():
    event = new_event(Format.SWISS, 5)
    assert event.byes[1] == ("P5",)
    event = event.after(Swapped("P5", "P1"))
    assert event.byes[1] == ("P1",)
    assert ("P3", "P5") in pairs_of(event, 1)


@pytest.mark.parametrize(
    ("form", "names", "reason"),
    [
        (Format.SWISS, ("P1", "P1"), "two different entrants exchange their places"),
        (Format.SWISS, ("P1", "X"), "X is not entered"),
        (Format.SWISS, ("P2", "P5"), "P2 and P5 play each other"),
        (Format.SWISS, ("P1", "P2"), "P1 has played in round 1"),
        (Format.ROUND_ROBIN, ("P2", "P3"), "in a round robin everybody meets everybody: .*"),
    ],
)
def test_an_exchange_that_is_not_possible_is_refused(form, names, reason):
    event = new_event(form, 6)
    first = next(one for one in event.open if "P1" in one.entrants)
    with pytest.raises(ValueError, match=f"^{reason}$"):
        event.record(best_seed_wins(first)).after(Swapped(*names))


def test_both_brackets_of_a_knock_out_stay_apart():
    event = played(new_event(Format.KNOCKOUT, 8), rounds=1)
    with pytest.raises(ValueError, match=r"^P1 and P8 are not in the same bracket$"):
        event.after(Swapped("P1", "P8"))
    assert pairs_of(event, 2)[2:] == [("P5", "P8"), ("P6", "P7")]
    moved = event.after(Swapped("P8", "P6"))
    assert pairs_of(moved, 2)[2:] == [("P5", "P6"), ("P7", "P8")]


def test_seats_of_a_match():
    event = new_event(Format.SWISS, 4)
    turned = tuple(reversed(event.open[0].entrants))
    event = event.after(Reseated(1, turned))
    assert event.open[0].entrants == turned
    with pytest.raises(ValueError, match=r"^match 1 is between P3, P1, each with one seat$"):
        event.after(Reseated(1, ("P1", "P2")))
    with pytest.raises(ValueError, match=r"^match 1 has been played$"):
        event.record(best_seed_wins(event.open[0])).after(Reseated(1, turned))


def test_two_arcades_are_never_given_the_same_match_or_entrant():
    event = new_event(Format.ROUND_ROBIN, 5)
    there: dict[str, int] = {}
    for arcade in ("left", "right"):
        fixture = event.next_at(arcade)
        assert fixture
        event = event.after(Summoned(fixture.number, arcade))
        there[arcade] = fixture.number
        assert event.next_at(arcade) == fixture
    left, right = (event.fixtures[there[arcade] - 1] for arcade in there)
    assert not {*left.entrants} & {*right.entrants}
    assert event.next_at("third") is None
    with pytest.raises(ValueError, match=rf"is called to match {there['left']}$"):
        event.after(Summoned(next(one.number for one in event.open if one not in (left, right)), "third"))
    event = event.record(best_seed_wins(left))
    assert event.calls == {right.number: "right"}


def test_a_call_is_taken_back_and_goes_to_another_arcade():
    event = new_event(Format.SWISS, 4).after(Summoned(1, "left"))
    assert event.after(Summoned(1, "right")).calls == {1: "right"}
    event = event.after(Summoned(1, None))
    assert event.calls == {}
    with pytest.raises(ValueError, match=r"^match 1 is not called$"):
        event.after(Summoned(1, None))
    with pytest.raises(ValueError, match="printable characters"):
        event.after(Summoned(1, "a\nb"))


def test_nothing_is_called_during_a_break():
    event = new_event(Format.SWISS, 4).after(Paused("until 11:30"))
    assert event.pause == "until 11:30"
    with pytest.raises(ValueError, match=r"^nothing is called during a break$"):
        event.after(Summoned(1, ""))
    with pytest.raises(ValueError, match=r"^the break has begun already$"):
        event.after(Paused())
    event = event.after(Resumed())
    assert event.pause is None
    with pytest.raises(ValueError, match=r"^there is no break$"):
        event.after(Resumed())
    assert event.after(Summoned(1, "")).calls == {1: ""}


def test_a_call_of_a_match_that_is_drawn_anew_is_gone():
    event: Event = played(new_event(Format.SWISS, 4), rounds=1).after(Summoned(3, "left"))
    assert event.calls == {3: "left"}
    assert event.withdraw("P4").calls == {}


def test_a_correction_of_who_has_come_that_far_forgets_an_exchange_in_the_bracket():
    """P1 and P2 have exchanged places in round two; then P8 has beaten P1, and takes their place against P4."""
    event = played(new_event(Format.KNOCKOUT, 8), rounds=1).after(Swapped("P1", "P2"))
    event = event.correct(Result(1, (("P8",), ("P1",)), note="the judge"))
    assert [{*one.entrants} for one in event.open if one.stage == "winners"] == [{"P4", "P8"}, {"P2", "P3"}]
