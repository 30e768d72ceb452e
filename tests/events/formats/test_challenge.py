"""The challenge ladder: worked by hand, and against a second implementation that counts places as numbers."""

from datetime import date
from random import Random

import pytest

from pigaming_app.events.changes.calendar import up_to
from pigaming_app.events.event import Event
from pigaming_app.events.journal import Added, Arranged, Closed, Corrected, Recorded, Withdrawn
from pigaming_app.events.spec import WALKOVER, Entrant, Format, Result
from tests.cases import one_in
from tests.events.examples import by_chance, level, new_event, ranked


def ladder(count: int = 6, **more) -> Event:
    return new_event(Format.CHALLENGE, count, **more)


def order(event: Event) -> str:
    """The seeds from the top of the ladder down."""
    return " ".join(row.entrant[1:] for row in event.standings)


def challenged(event: Event, challenger: str, other: str, winner: str = "") -> Event:
    """After a challenge that somebody has won; nobody: it is open."""
    event = event.arrange(challenger, other)
    fixture = event.open[-1]
    loser = other if winner == challenger else challenger
    return event.record(ranked(fixture, winner, loser)) if winner else event


def test_who_wins_takes_the_place_and_the_others_move_down():
    event = challenged(ladder(), "P5", "P2", "P5")
    assert order(event) == "1 5 2 3 4 6"
    assert order(challenged(event, "P6", "P3", "P3")) == "1 5 2 3 4 6"
    event = event.arrange("P2", "P1")
    assert order(event.record(level(event.open[0]))) == "1 5 2 3 4 6"


@pytest.mark.parametrize(
    ("pair", "reason"),
    [
        (("P5", "P1"), "P5 can challenge those up to 3 places above only"),
        (("P1", "P2"), "P1 can challenge those up to 3 places above only"),
        (("P5", "P5"), "P5 can challenge those up to 3 places above only"),
        (("P6", "P4"), "P4 has an open challenge"),
        (("P2",), "a challenge is between two entrants, the challenger first"),
        (("P9", "P2"), "P9 is not entered"),
    ],
)
def test_what_is_no_challenge(pair, reason):
    with pytest.raises(ValueError, match=f"^{reason}$"):
        challenged(ladder(), "P4", "P3").arrange(*pair)


def test_reach_can_be_chosen_and_skips_who_has_withdrawn():
    assert order(challenged(ladder(reach=5), "P6", "P1", "P6")) == "6 1 2 3 4 5"
    event = ladder(reach=1).withdraw("P4")
    assert order(challenged(event, "P5", "P3", "P5")) == "1 2 5 3 6 4"


def test_a_week_ends_open_challenges_and_two_weeks_without_a_match_cost_a_place():
    event = challenged(ladder(), "P4", "P3").close()
    assert event.outcomes[1].note == WALKOVER
    event = challenged(event, "P2", "P1", "P1")
    event = challenged(event, "P6", "P5", "P5").close()
    assert order(event) == "1 2 5 3 4 6", "3 and 4 have not played for two weeks"
    assert order(event.close()) == "1 2 5 6 3 4"
    assert order(event.close().close()) == "1 2 5 6 3 4", "nobody has played"


def test_who_joins_late_starts_at_the_foot_and_is_not_idle_before():
    event = ladder(4).close()
    event = event.add(Entrant("P5"))
    assert order(event) == "1 2 3 4 5"
    event = challenged(event, "P2", "P1", "P1").close()
    assert order(event) == "1 2 5 3 4"


def test_the_ladder_ends_with_its_last_week():
    event = ladder(rounds=2)
    event = challenged(event, "P2", "P1", "P2").close()
    assert not event.over
    event = event.close()
    assert event.over
    for change in (event.close, lambda: event.arrange("P1", "P2"), lambda: event.add(Entrant("P7"))):
        with pytest.raises(ValueError, match=r"over|closed"):
            change()


def test_who_is_left_alone_wins_the_challenge():
    event = challenged(ladder(), "P4", "P2")
    assert order(event.withdraw("P2")) == "1 4 3 5 6 2"
    assert order(event.withdraw("P4")) == "1 2 3 5 6 4"


def test_a_correction_counts_from_the_beginning():
    event = challenged(ladder(), "P3", "P2", "P3")
    event = challenged(event, "P5", "P2", "P5")
    assert order(event) == "1 3 5 2 4 6"
    assert order(event.correct(Result(1, (("P2",), ("P3",)), note="?"))) == "1 5 2 3 4 6"


def test_weeks_go_by_the_calendar():
    event = ladder(start="2026-11-02")
    assert up_to(event, date(2026, 11, 8)).progress.closed == 0
    assert up_to(event, date(2026, 11, 9)).progress.closed == 1
    assert up_to(event, date(2026, 11, 29)).progress.closed == 3
    assert up_to(event, date(2030, 1, 1)).over
    assert up_to(ladder(), date(2030, 1, 1)).progress.closed == 0


def test_ais_play_once_a_week_from_the_foot_up():
    event = ladder().continued()
    assert [one.entrants for one in event.open] == [("P6", "P3"), ("P5", "P2"), ("P4", "P1")]
    while event.open:
        event = event.record(ranked(event.open[0], *event.open[0].entrants))
    assert event.continued().progress.closed == 1


# ---- the second implementation


def a_random_event(seed: int) -> Event:
    """Chance challenges, plays, corrects, adds, withdraws and ends weeks."""
    random = Random(f"ladder {seed}")
    event = ladder(random.randint(3, 12), reach=random.randint(1, 5), rounds=random.randint(2, 9))
    outcome = by_chance(seed)
    for step in range(150):
        names = [one.name for one in event.entrants]
        try:
            match random.randrange(20):
                case 0 if event.played:
                    fixture = event.progress.fixtures[random.choice([*event.played]) - 1]
                    event = event.correct(Result(fixture.number, outcome(fixture).places, note="corrected"))
                case 1:
                    event = event.add(Entrant(f"P{100 + step}"))
                case 2 if random.random() < 0.3:
                    event = event.withdraw(random.choice(names))
                case 3:
                    event = event.close()
                case 4 | 5 | 6 | 7 | 8 | 9 if event.open:
                    event = event.record(outcome(random.choice(event.open)))
                case _:
                    event = event.arrange(*random.sample(names, 2))
        except ValueError:
            continue
    return event


def places(event: Event) -> dict[str, int]:
    """Everybody's place from the journal alone: each challenge and each end of a week changes numbers."""
    place = {one.name: float(i) for i, one in enumerate(event.spec.entrants)}
    results: dict[int, tuple[tuple[str, ...], ...]] = {}
    for entry in event.journal:
        if isinstance(entry, Recorded | Corrected):
            results[entry.outcome.fixture] = entry.outcome.places
    week: list[tuple[int, str, str]] = []  # number, challenger, challenged
    weeks = [week]
    gone: set[str] = set()
    open_now: dict[int, tuple[str, str]] = {}
    walked: dict[int, str] = {}  # number, and who was there
    joined: dict[int, list[str]] = {}
    number = 0
    for entry in event.journal:
        match entry:
            case Arranged(names):
                number += 1
                week.append((number, names[0], names[1]))
                open_now[number] = (names[0], names[1])
            case Recorded(outcome):
                open_now.pop(outcome.fixture)
            case Added(entrant):
                joined.setdefault(len(weeks), []).append(entrant.name)
            case Withdrawn(name):
                gone.add(name)
                for one, pair in [*open_now.items()]:
                    if name in pair:
                        walked[one] = pair[1 - pair.index(name)]
                        del open_now[one]
            case Closed():
                open_now.clear()
                week = []
                weeks.append(week)
    rest: dict[str, int] = {}
    for i, matches in enumerate(weeks, 1):
        for name in joined.get(i, []):
            place[name] = 1 + max(place.values())
        active = set()
        for one, challenger, other in matches:
            if one in results:
                active |= {challenger, other}
                first = results[one][0]
            elif one in walked:
                active |= {walked[one]}
                first = (walked[one],)
            else:
                continue
            low, high = (challenger, other) if place[challenger] > place[other] else (other, challenger)
            if first == (low,):
                place[low] = place[high] - 0.5
                place = {name: float(k) for k, name in enumerate(sorted(place, key=place.__getitem__))}
        if i < len(weeks):
            rest = {name: 0 if name in active else rest.get(name, 0) + 1 for name in place}
            idle = [name for name in place if rest[name] >= 2]
            busy = sorted((name for name in place if name not in idle), key=place.__getitem__)
            above = {name: sum(place[other] < place[name] for other in busy) for name in idle}
            slots: list[str] = []
            for k in range(len(busy) + 1):  # each block of idle ones goes behind the next busy one
                slots += busy[k - 1 : k] if k else []
                came = [name for name in sorted(idle, key=place.__getitem__) if above[name] == k - 1]
                slots += came
            slots += [name for name in sorted(idle, key=place.__getitem__) if above[name] == len(busy)]
            place = {name: float(k) for k, name in enumerate(slots)}
    final = sorted(place, key=lambda name: (name in gone, place[name]))
    return {name: 1 + i for i, name in enumerate(final)}


@pytest.mark.parametrize("block", one_in(5, range(10)))
def test_250_random_events_agree_with_a_second_implementation(block):
    for seed in range(25 * block, 25 * block + 25):
        event = a_random_event(seed)
        assert {row.entrant: row.place for row in event.standings} == places(event)
