"""Extra matches of a knock-out: worked by hand, and played by robots that score, or never do."""

from collections import Counter
from dataclasses import replace
from itertools import permutations

import pytest

from pigaming_app.ai.registry import new_match
from pigaming_app.events import event_files
from pigaming_app.events.event import Event
from pigaming_app.events.match_setup import setup_of
from pigaming_app.events.spec import Advance, Entrant, EventSpec, Format, Result
from pigaming_app.games.registry import games
from pigaming_app.games.replay import decode, encode, verify
from pigaming_app.scenes.events.quick_match import play
from tests.events.examples import best_seed_wins, level, new_event, played, ranked


def of_four(*places: tuple[str, ...], advance: Advance = Advance.HALF) -> Event:
    """The first match of eight in matches of four, ended like this."""
    event = new_event(Format.KNOCKOUT, 8, seats=4, advance=advance)
    assert sorted(event.open[0].entrants) == ["P1", "P4", "P5", "P8"]
    return event.record(Result(1, places))


def test_a_tie_is_played_off_before_anybody_goes_on():
    event = new_event(Format.KNOCKOUT, 4)
    event = event.record(level(event.open[0])).record(best_seed_wins(event.open[1]))
    (extra,) = event.open
    assert (extra.number, extra.extra, sorted(extra.entrants)) == (1, 1, ["P1", "P4"])
    assert extra.seed != event.fixtures[0].seed
    assert (event.round, len(event.fixtures), 1 in event.outcomes) == (1, 2, False)
    event = event.record(ranked(extra, "P4", "P1"))
    assert event.outcomes[1].places == (("P4",), ("P1",))
    assert sorted(sorted(one.entrants) for one in event.open) == [["P1", "P3"], ["P2", "P4"]]


@pytest.mark.parametrize(
    ("places", "advance", "tied"),
    [
        ([("P8",), ("P1", "P4"), ("P5",)], Advance.HALF, ["P1", "P4"]),
        ([("P8",), ("P1", "P4", "P5")], Advance.HALF, ["P1", "P4", "P5"]),
        ([("P1", "P4", "P5"), ("P8",)], Advance.HALF, ["P1", "P4", "P5"]),
        ([("P1", "P4", "P5", "P8")], Advance.HALF, ["P1", "P4", "P5", "P8"]),
        ([("P1", "P4"), ("P5", "P8")], Advance.HALF, []),
        ([("P1",), ("P4",), ("P5", "P8")], Advance.HALF, []),
        ([("P1", "P4"), ("P5",), ("P8",)], Advance.QUARTER, ["P1", "P4"]),
        ([("P1",), ("P4", "P5", "P8")], Advance.QUARTER, []),
    ],
)
def test_only_those_play_on_who_share_the_place_across_the_line(places, advance, tied):
    event = of_four(*places, advance=advance)
    extra = [sorted(one.entrants) for one in event.open if one.number == 1]
    assert extra == ([tied] if tied else [])
    assert (1 in event.outcomes) == (not tied)


def test_who_scores_first_has_the_place_and_the_others_play_on():
    event = of_four(("P8",), ("P5",), ("P1", "P4"), advance=Advance.HALF)
    assert 1 in event.outcomes
    event = of_four(("P1", "P4", "P5"), ("P8",))
    event = event.record(Result(1, (("P5",), ("P1", "P4")), extra=1))
    assert (sorted(event.open[0].entrants), event.open[0].extra) == (["P1", "P4"], 2)
    event = event.record(Result(1, (("P4",), ("P1",)), extra=2))
    assert event.outcomes[1].places == (("P5",), ("P4",), ("P1",), ("P8",))


def test_a_level_final_is_played_off_too():
    event = new_event(Format.KNOCKOUT, 3)
    while event.open[0].stage != "final":
        event = event.record(best_seed_wins(event.open[0]))
    event = event.record(level(event.open[0]))
    assert not event.over
    event = event.record(best_seed_wins(event.open[0]))
    assert event.over
    assert [row.place for row in event.standings] == [1, 2, 3]


def after_level_ones(event: Event) -> Event:
    """The event once the first match and three extra ones have been level."""
    for extra in range(4):
        assert (event.open[0].number, event.open[0].extra) == (1, extra)
        event = event.record(level(event.open[0]))
    return event


def test_after_three_level_extra_matches_lots_are_drawn_whatever_the_order_of_the_list():
    """Every order of four names, each in one match: who goes on depends on the seed, each name about as often."""
    names, wins = ("Ann", "Bob", "Cid", "Dee"), Counter[str]()
    for seed in range(200):
        found = set()
        for order in permutations(names) if seed < 4 else [names]:
            spec = EventSpec("T", Format.KNOCKOUT, ("pitanks",), tuple(map(Entrant, order)), seats=4, seed=seed)
            event = after_level_ones(Event(replace(spec, advance=Advance.QUARTER)))
            assert event.lots(1)
            assert [len(place) for place in event.outcomes[1].places] == [1] * 4
            found.add(event.outcomes[1].places)
        assert len(found) == 1
        wins[found.pop()[0][0]] += 1
    assert min(wins.values()) > 25  # of 50 expected: 4 standard deviations


def test_lots_are_no_lots_after_a_goal():
    event = new_event(Format.KNOCKOUT, 4)
    event = event.record(level(event.open[0]))
    event = event.record(best_seed_wins(event.open[0]))
    assert not event.lots(1)


def test_another_result_of_the_match_itself_does_not_count_as_an_extra_match():
    """As from a second process that has played the same match."""
    event = new_event(Format.KNOCKOUT, 4)
    first = event.open[0]
    event = event.record(level(first))
    with pytest.raises(ValueError, match=r"^match 1 goes on with extra match 1, not 0$"):
        event.record(best_seed_wins(first))
    with pytest.raises(ValueError, match=r"^match 1 goes on with extra match 1, not 2$"):
        event.record(replace(best_seed_wins(first), extra=2))


def test_a_correction_in_the_middle_replaces_the_match_and_its_extra_matches():
    event = new_event(Format.KNOCKOUT, 4)
    event = event.record(level(event.open[0]))
    event = event.record(level(event.open[0]))
    corrected = event.correct(Result(1, (("P4",), ("P1",)), note="score"))
    assert corrected.outcomes[1].places == (("P4",), ("P1",))
    assert [one.number for one in corrected.open] == [2]
    again = corrected.correct(Result(1, (("P1", "P4"),), note="level after all"))
    assert (again.open[0].number, again.open[0].extra) == (1, 1)


def test_whoever_is_there_wins_the_extra_match_of_someone_who_leaves():
    event = of_four(("P1", "P4", "P5"), ("P8",)).withdraw("P4")
    assert event.outcomes[1].places == (("P1", "P5"), ("P4",), ("P8",))
    event = of_four(("P1", "P4", "P5"), ("P8",)).withdraw("P4")
    event = of_four(("P8",), ("P1", "P4", "P5")).withdraw("P4")
    assert [sorted(one.entrants) for one in event.open if one.number == 1] == [["P1", "P5"]]
    for name in ("P5", "P1"):
        event = event.withdraw(name)
    assert event.outcomes[1].places[0] == ("P8",)
    assert event.outcomes[1].note == ""
    assert played(event).over


def test_an_extra_match_can_be_put_off():
    event = new_event(Format.KNOCKOUT, 4)
    event = event.record(level(event.open[0])).postpone(1)
    assert [one.number for one in event.open] == [2, 1]


def test_a_file_has_the_extra_matches(tmp_path):
    """After a kill in the middle of one, it is the next match again."""
    event = new_event(Format.KNOCKOUT, 4)
    for _ in range(2):
        event = event.record(level(event.open[0]))
        event_files.save(tmp_path / "cup.json", event)
        loaded = event_files.load(tmp_path / "cup.json")[0]
        assert loaded == event
        assert loaded.open == event.open
    assert event.open[0].extra == 2


@pytest.mark.parametrize("game", [*games()])
def test_robots_that_never_score_come_to_an_end(game):
    entrants = tuple(Entrant(name, "idle") for name in "ABC")
    event = Event(EventSpec("T", Format.KNOCKOUT, (game,), entrants, minutes={game: 0.05}))
    while not event.over:
        event = event.record(play(event, event.open[0]))
    assert len({row.place for row in event.standings}) == 3
    assert all(len(place) == 1 for outcome in event.outcomes.values() for place in outcome.places)


@pytest.mark.parametrize("game", [*games()])
def test_an_extra_match_ends_with_the_first_point_or_lap(game):
    """In full length: at its end, one has a point, or a lap, and nobody had one a tick before; a replay agrees."""
    entrants = tuple(Entrant(name, brain) for name, brain in (("A", "level5"), ("B", "level5"), ("C", "idle")))
    event = Event(EventSpec("T", Format.KNOCKOUT, (game,), entrants))
    event = event.record(level(event.open[0]))
    setup = setup_of(event, event.open[0])
    assert setup.minutes <= 3.0
    match = new_match(setup)
    while not match.over:
        before = sorted(robot.score for robot in match.state.robots)
        match.tick()
    after = sorted(robot.score for robot in match.state.robots)
    assert len(set(before)) == 1
    assert after[-1] > max(after[0], before[-1])
    assert len(match.outcome().winners) == 1
    assert verify(decode(encode(match), "extra"))
