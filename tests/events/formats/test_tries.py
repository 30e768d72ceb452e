"""Time trial and high score: the best try counts, then the next; by hand, by chance, and in real matches."""

from random import Random

import pytest

from pigaming_app.ai.registry import find_brain
from pigaming_app.events.event import Event
from pigaming_app.events.journal import Corrected, Recorded
from pigaming_app.events.match_setup import check_playable, setup_of
from pigaming_app.events.spec import Entrant, EventSpec, Format, Result
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError
from pigaming_app.jobs.events.play import HeadlessRun
from pigaming_app.scenes.events.quick_match import play
from tests.cases import one_in
from tests.events.examples import new_event


def day(form: Format, count: int = 4, **more) -> Event:
    game = "race" if form is Format.TIME_TRIAL else "pitanks"
    seats = more.pop("seats", 1 if form is Format.TIME_TRIAL else 2)
    return new_event(form, count, games=(game,), seats=seats, fill="level1" if seats > 1 else "", **more)


def tried(event: Event, **values: float | None) -> Event:
    """After a try of each of these; None: it brought nothing."""
    for name, value in values.items():
        event = event.arrange(name)
        fixture = event.open[0]
        event = event.record(Result(fixture.number, ((name,),), {} if value is None else {name: value}))
    return event


def table(event: Event) -> list[tuple[int, str, float, float]]:
    rows = event.standings
    return [(row.place, row.entrant, row.tie_breaks["best"], row.tie_breaks["second_best"]) for row in rows]


def test_the_shortest_time_is_best_and_the_second_one_decides_between_equal_ones():
    event = tried(day(Format.TIME_TRIAL), P1=20.0, P2=19.5, P3=21.0, P4=None)
    event = tried(event, P3=19.5, P2=22.0)
    assert table(event) == [(1, "P3", 19.5, 21.0), (2, "P2", 19.5, 22.0), (3, "P1", 20.0, 0.0), (4, "P4", 0.0, 0.0)]
    event = tried(event, P2=21.0, P3=30.0)
    assert [row[:2] for row in table(event)][:2] == [(1, "P2"), (2, "P3")], "the third one decides"


def test_the_highest_score_is_best_and_a_score_of_0_is_better_than_none():
    event = tried(day(Format.HIGH_SCORE), P1=3.0, P2=0.0, P3=5.0)
    event = tried(event, P1=5.0)
    assert [row[:2] for row in table(event)] == [(1, "P1"), (2, "P3"), (3, "P2"), (4, "P4")]
    assert [row.points for row in event.standings] == [3.0, 2.0, 1.0, 0.0]


def test_equal_tries_share_the_place():
    event = tried(day(Format.HIGH_SCORE), P1=3.0, P2=3.0)
    assert [row[:2] for row in table(event)] == [(1, "P1"), (1, "P2"), (3, "P3"), (3, "P4")]


def test_tries_go_on_until_the_day_is_closed():
    event = tried(day(Format.TIME_TRIAL), **dict.fromkeys(("P1", "P2"), 20.0))
    for _ in range(20):
        event = tried(event, P1=20.0)
    event = event.add(Entrant("Late"))
    event = tried(event, Late=9.0).arrange("P2").close()
    assert event.over
    assert event.standings[0].entrant == "Late"
    assert [row.played for row in event.standings if row.entrant == "P2"] == [1], "an open try lapses"
    with pytest.raises(ValueError, match=r"^the event is over$"):
        event.arrange("P1")


def test_several_share_a_match_for_a_high_score():
    event = day(Format.HIGH_SCORE, seats=3).arrange("P1", "P4")
    (fixture,) = event.open
    assert (len(fixture.entrants), fixture.fill) == (2, 1)
    event = event.record(Result(1, (("P4",), ("P1",)), {"P4": 9.0, "P1": 2.0}))
    assert [row[:3] for row in table(event)][:2] == [(1, "P4", 9.0), (2, "P1", 2.0)]


@pytest.mark.parametrize(
    ("names", "reason"),
    [
        (("P1",), "P1 has an open try"),
        (("P2",), "P2 has had 1 tries"),
        ((), "1 to 2 entrants play a match, each of them once"),
        (("P3", "P3"), "1 to 2 entrants play a match, each of them once"),
        (("P3", "P4", "P1"), "1 to 2 entrants play a match, each of them once"),
    ],
)
def test_what_is_no_try(names, reason):
    event = tried(day(Format.HIGH_SCORE, rounds=1), P2=1.0).arrange("P1")
    with pytest.raises(ValueError, match=f"^{reason}$"):
        event.arrange(*names)


def test_specs_that_cannot_be_compared():
    for changes, reason in (
        ({"games": ("race", "pitanks")}, "one game"),
        ({"arenas": {"race": ("kidney", "hairpin")}}, "one arena"),
        ({"seats": 2}, "an AI is needed"),
    ):
        with pytest.raises(ValueError, match=reason):
            _ = new_event(Format.TIME_TRIAL, 3, **({"games": ("race",), "seats": 1} | changes)).progress


def test_a_time_trial_needs_a_game_that_takes_times():
    event = new_event(Format.TIME_TRIAL, 3, seats=1)
    with pytest.raises(ChoiceError, match=r"^pitanks takes no times, so it has no time trial$"):
        check_playable(event.spec, find_brain)


@pytest.mark.parametrize("seats", [1, 3])
def test_a_robot_alone_or_beside_others_drives_for_its_best_lap(seats):
    """In full: headless and in the arcade's process the same time, which is the record of the game."""
    entrants = tuple(Entrant(name, brain) for name, brain in (("A", "level5"), ("B", "level1"), ("C", "idle")))
    spec = EventSpec("T", Format.TIME_TRIAL, ("race",), entrants, 1, seats, minutes={"race": 1.5})
    event = Event(spec if seats == 1 else spec.__class__(**{**vars(spec), "fill": "level1"})).continued()
    assert setup_of(event, event.open[0]).seats[1].brain == ("off" if seats == 1 else "level1")
    outcomes = HeadlessRun(event, fast=False).play_these(event, event.open)
    assert outcomes[0] == play(event, event.open[0])
    for outcome in outcomes:
        event = event.record(outcome)
    best = {row.entrant: row.tie_breaks["best"] for row in event.standings}
    assert 10.0 < best["A"] < best["B"] < 90.0
    assert best["C"] == 0.0
    assert [row.entrant for row in event.standings] == ["A", "B", "C"]


@pytest.mark.parametrize("game", [*games()])
def test_scores_of_every_game_count(game):
    entrants = tuple(Entrant(name, "level5") for name in "ABC")
    spec = EventSpec("T", Format.HIGH_SCORE, (game,), entrants, 1, 2, minutes={game: 0.5}, fill="level1")
    check_playable(spec, find_brain)
    event = Event(spec)
    while not event.over:
        event = event.record(play(event, event.open[0])) if event.open else event.continued()
    assert [row.played for row in event.standings] == [1, 1, 1]
    best = [row.tie_breaks["best"] for row in event.standings]
    assert best == sorted(best, reverse=True)


# ---- the second implementation


def a_random_event(form: Format, seed: int) -> Event:
    """Chance tries, alone and together, corrects, adds, withdraws."""
    random = Random(f"{form} {seed}")
    event = day(form, random.randint(3, 9), seats=random.randint(1, 4), rounds=random.choice((0, 0, 3)))
    for step in range(60):
        names = [one.name for one in event.entrants]
        values = {name: float(random.randint(1, 4)) for name in names if random.random() < 0.8}
        try:
            match random.randrange(12):
                case 0 if event.played:
                    fixture = event.progress.fixtures[random.choice([*event.played]) - 1]
                    scores = {name: values[name] for name in fixture.entrants if name in values}
                    event = event.correct(Result(fixture.number, (fixture.entrants,), scores, "corrected"))
                case 1:
                    event = event.add(Entrant(f"P{100 + step}"))
                case 2 if random.random() < 0.3:
                    event = event.withdraw(random.choice(names))
                case 3 if step > 50:
                    event = event.close()
                case 4 | 5 | 6 | 7 if event.open:
                    fixture = random.choice(event.open)
                    scores = {name: values[name] for name in fixture.entrants if name in values}
                    event = event.record(Result(fixture.number, (fixture.entrants,), scores))
                case _:
                    event = event.arrange(*random.sample(names, random.randint(1, min(3, len(names)))))
        except ValueError:
            continue
    return event


def compared(event: Event) -> dict[str, int]:
    """Places from the journal alone: one behind another for each who has the better tries, one pair after the other."""
    sheets: dict[int, dict[str, float]] = {}
    for entry in event.journal:
        if isinstance(entry, Recorded | Corrected):
            sheets[entry.outcome.fixture] = {**entry.outcome.scores}
    low = event.spec.format is Format.TIME_TRIAL
    tries = {one.name: sorted(s[one.name] for s in sheets.values() if one.name in s) for one in event.entrants}

    def beats(one: str, other: str) -> bool:
        left, right = list(tries[one]), list(tries[other])
        while left or right:
            if not left or not right:
                return bool(left)
            mine, theirs = (left.pop(0), right.pop(0)) if low else (left.pop(), right.pop())
            if mine != theirs:
                return (mine < theirs) == low
        return False

    return {name: 1 + sum(beats(other, name) for other in tries) for name in tries}


@pytest.mark.parametrize("form", [Format.TIME_TRIAL, Format.HIGH_SCORE])
@pytest.mark.parametrize("block", one_in(5, range(5)))
def test_250_random_events_agree_with_a_second_implementation(form, block):
    for seed in range(25 * block, 25 * block + 25):
        event = a_random_event(form, seed)
        assert {row.entrant: row.place for row in event.standings} == compared(event)
