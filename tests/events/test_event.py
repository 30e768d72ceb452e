"""The journal is the whole truth: what it permits, what it refuses, and that it replays to the same event."""

from random import Random

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.event_files import parse, to_text
from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.spec import Advance, Entrant, EventSpec, Format, Result
from tests.events.examples import best_seed_wins, by_chance, new_event, played


@pytest.mark.parametrize("form", list(Format))
@pytest.mark.parametrize("seed", range(12))
def test_a_journal_replays_to_the_same_event(form, seed):
    """Chance plays, corrects, adds, withdraws, postpones and substitutes."""
    random = Random(f"{form}{seed}")
    seats = random.choice(KINDS[form].seats)
    games = ("race",) if KINDS[form].single else ("pitanks", "race")
    fill = "level1" if KINDS[form].single and seats > 1 else ""
    event = new_event(form, random.randint(5, 14), seats=seats, games=games, fill=fill, seed=seed)
    outcome = by_chance(seed)
    reasons: list[str] = []
    for step in range(60):
        try:
            event = _changed(event, random, outcome, step)
        except ValueError as error:
            reasons.append(str(error))
    again = parse(to_text(event))
    assert again == event
    assert again.fixtures == event.fixtures
    assert again.outcomes == event.outcomes
    assert again.standings == event.standings
    assert len(reasons) < 60
    assert not any("\n" in reason for reason in reasons)
    event = played(event, outcome)
    assert event.over
    assert len(event.outcomes) == len(event.fixtures)
    points = [row.points for row in event.standings]
    assert points == sorted(points, reverse=True)


def _changed(event: Event, random: Random, outcome, step: int) -> Event:
    names = [entrant.name for entrant in event.entrants]
    match random.randrange(12):
        case 0 if event.outcomes:
            number = random.choice([*event.outcomes])
            fixture = next(one for one in event.fixtures if one.number == number)
            places = outcome(fixture).places
            return event.correct(Result(number, places, note="corrected"))
        case 1:
            return event.add(Entrant(f"P{100 + step}"))
        case 2 if step % 3 == 0:
            return event.withdraw(random.choice(names))
        case 3 if event.open:
            return event.postpone(random.choice(event.open).number)
        case 5 if event.progress.kind.on_call:
            return event.close() if step % 4 == 0 else event.continued()
        case 4:
            return event.substitute(random.choice(names), "level2")
    return event.record(outcome(random.choice(event.open))) if event.open else event


def test_a_result_counts_once():
    event = new_event(Format.ROUND_ROBIN, 4)
    first = event.open[0]
    after = event.record(best_seed_wins(first))
    assert event.outcomes == {}
    with pytest.raises(ValueError, match=r"^match 1 has been played$"):
        after.record(best_seed_wins(first))


@pytest.mark.parametrize("places", [(("P1",),), (("P1",), ("P2",)), (("P1", "P1", "P4"),), (("P1", "P4"), ()), ()])
def test_a_result_names_everybody_of_the_match_once(places):
    event = new_event(Format.ROUND_ROBIN, 4)
    assert {*event.open[0].entrants} == {"P1", "P4"}
    with pytest.raises(ValueError, match=r"^match 1 is between P1, P4, each with one place$"):
        event.record(Result(1, places))


def test_a_result_of_no_match_is_refused():
    with pytest.raises(ValueError, match=r"^there is no match 99$"):
        new_event(Format.SWISS, 4).record(Result(99, ()))


def test_a_correction_needs_a_note_and_a_played_match():
    event = new_event(Format.SWISS, 4)
    with pytest.raises(ValueError, match=r"^match 1 has not been played$"):
        event.correct(Result(1, (("P1",), ("P3",)), note="?"))
    event = event.record(best_seed_wins(event.open[0]))
    with pytest.raises(ValueError, match=r"^a correction needs a note$"):
        event.correct(Result(1, (("P3",), ("P1",))))
    event = event.correct(Result(1, (("P3",), ("P1",)), note="pads were swapped"))
    assert event.standings[0].entrant == "P3"
    assert len(event.outcomes) == 1


def test_a_swiss_round_that_has_begun_stays_after_a_correction():
    event = played(new_event(Format.SWISS, 8), rounds=1)
    begun = event.record(best_seed_wins(event.open[0]))
    corrected = begun.correct(Result(1, (("P5",), ("P1",)), note="mixed up"))
    assert corrected.fixtures == begun.fixtures
    fresh = event.correct(Result(1, (("P5",), ("P1",)), note="mixed up"))
    assert {"P1", "P3"} not in [{*one.entrants} for one in fresh.open]


def test_others_overtake_a_postponed_match():
    event = new_event(Format.SWISS, 8)
    assert [one.number for one in event.postpone(1).open] == [2, 3, 4, 1]
    assert [one.number for one in event.postpone(1).postpone(2).postpone(1).open] == [3, 4, 2, 1]
    event = new_event(Format.ROUND_ROBIN, 4)
    assert [one.number for one in event.postpone(1).open] == [2, 3, 4, 1, 5, 6]


def test_an_ai_in_the_place_of_an_entrant_plays_under_the_same_name():
    event = new_event(Format.SWISS, 4).substitute("P3", "level2")
    assert event.entrants[2] == Entrant("P3", "level2")
    assert event.substitute("P3", "").entrants[2] == Entrant("P3")
    with pytest.raises(ValueError, match=r"^X is not entered$"):
        event.substitute("X", "level1")


def test_in_a_match_of_four_the_others_play_without_who_has_withdrawn():
    event = new_event(Format.SWISS, 8, seats=4)
    event = event.record(by_chance(1, ties=False)(event.open[0]))
    gone = event.open[0].entrants[1]
    event = event.withdraw(gone)
    assert len(event.open[0].entrants) == 3
    assert gone not in event.open[0].entrants
    with pytest.raises(ValueError, match=rf"^{gone} has withdrawn$"):
        event.withdraw(gone)


def test_seeding_games_and_seeds_of_matches():
    event = new_event(Format.SWISS, 4, games=("pitanks", "race"), arenas={"race": ("kidney",)}, seed=7)
    event = played(event, rounds=1)
    assert [(one.game, one.arena, one.seed) for one in event.fixtures] == [
        ("pitanks", "", 70_001), ("pitanks", "", 70_002), ("race", "kidney", 70_003), ("race", "kidney", 70_004)
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"count": 2}, "an event has 3 to 64 entrants, not 2"),
        ({"count": 65}, "an event has 3 to 64 entrants, not 65"),
        ({"seats": 5}, "a match has 2 to 4 seats, not 5"),
        ({"rounds": 65}, "an event has at most 64 rounds, not 65"),
        ({"rounds": 4}, "4 entrants can play at most 3 Swiss rounds, not 4"),
        ({"fill": "level1"}, "AIs fill seats in grandprix, timetrial, highscore only"),
        ({"games": ()}, "an event needs a game"),
        ({"seed": -1}, "a seed is a number from 0 to 1000000000000, not -1"),
    ],
)
def test_an_impossible_event_is_refused_with_one_sentence(changes, reason):
    with pytest.raises(ValueError, match=f"^{reason}$"):
        _ = new_event(Format.SWISS, **{"count": 4, **changes}).progress


@pytest.mark.parametrize("name", ["", "x" * 25, "a\nb", " a"])
def test_a_name_is_short_and_printable(name):
    with pytest.raises(ValueError, match="1 to 24 printable characters"):
        new_event(Format.SWISS, 4).add(Entrant(name))


def test_a_name_is_entered_once():
    with pytest.raises(ValueError, match=r"^P2 is entered already$"):
        new_event(Format.SWISS, 4).add(Entrant("P2"))
    with pytest.raises(ValueError, match=r"^A is entered twice$"):
        _ = Event(EventSpec("x", Format.SWISS, ("pitanks",), (Entrant("A"), Entrant("B"), Entrant("A")))).progress


def test_the_only_winner_of_a_quarter_goes_on():
    event = new_event(Format.KNOCKOUT, 8, seats=4, advance=Advance.QUARTER)
    event = played(event, rounds=1)
    assert sorted(len(one.entrants) for one in event.open) == [3, 3]
    assert {one.stage for one in event.open} == {"losers"}
