"""Random events of all formats, step by step beside a second implementation; their files survive cuts."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.event_files import load, parse, save, to_text
from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.journal import (
    Entry,
    Paused,
    Postponed,
    Recorded,
    Reseated,
    Resumed,
    Substituted,
    Summoned,
    Swapped,
)
from pigaming_app.events.spec import Advance, Entrant, Fixture, Format, Result
from tests.events.examples import by_chance, new_event
from tests.events.formats import test_challenge, test_groups, test_tries
from tests.events.second import grand_prix, knockout, round_robin, swiss
from tests.events.second.board import Board, new_board

SECOND = {
    Format.KNOCKOUT: (knockout.check, knockout.table),
    Format.GRAND_PRIX: (grand_prix.check, grand_prix.table),
    Format.ROUND_ROBIN: (round_robin.check, round_robin.table),
    Format.SWISS: (swiss.check, round_robin.table),
}
LONG = (pytest.mark.long, pytest.mark.again)
FEW = 40  # matches, up to which everything is compared after each result
SIZES = (3, 4, 5, 6, 7, 8, 9, 11, 16, 23)


def random_event(form: Format, seed: int) -> Event:
    """The event before the first match."""
    random = Random(f"second {form} {seed}")
    count = random.choice(SIZES) if seed % 25 else random.choice((32, 47, 64))
    seats = random.choice((2, 2, 3, 4)) if form in SECOND else 2
    if form in (Format.TIME_TRIAL, Format.HIGH_SCORE):
        return test_tries.day(form, count, seats=random.randint(1, 4), rounds=random.choice((0, 2, 4)))
    rounds = {Format.KNOCKOUT: 0, Format.ROUND_ROBIN: random.choice((0, 0, 0, 2)) if count < 12 else 0}
    most = min(5, count - 1)
    more: dict[str, Any] = {"rounds": rounds.get(form, random.randint(1, most)), "seats": seats, "seed": seed}
    if form == Format.KNOCKOUT:
        more["advance"] = random.choice([*Advance])
    if form == Format.GRAND_PRIX and random.random() < 0.3:
        more["fill"] = "level2"
    return new_event(form, count, **more)


def random_change(event: Event, random: Random, outcome: Callable[[Fixture], Result]) -> Event:
    """One more entry. Raises ValueError for one that is not possible."""
    names = [one.name for one in event.entrants]
    fixture = random.choice(event.open) if event.open else None
    on_call = KINDS[event.spec.format].on_call is not None
    match random.randrange(36 if on_call else 24):
        case 0 if event.outcomes:
            number = random.choice([*event.outcomes])
            again = outcome(event.progress.fixtures[number - 1])
            return event.correct(Result(number, again.places, note="the judge"))
        case 1:
            return event.add(Entrant(f"P{len(names) + 101}"))
        case 2 if random.random() < 0.5:
            return event.withdraw(random.choice(names))
        case 3 | 4:
            return event.after(Swapped(*random.sample(names, 2)))
        case 5 if fixture:
            return event.after(Reseated(fixture.number, tuple(random.sample(fixture.entrants, len(fixture.entrants)))))
        case 6 if fixture:
            return event.after(Postponed(fixture.number))
        case 7 if fixture:
            return event.after(Summoned(fixture.number, random.choice(("", "left", "right", None))))
        case 8:
            return event.after(random.choice((Paused("lunch"), Resumed())))
        case 9:
            return event.after(Substituted(random.choice(names), random.choice(("level1", ""))))
        case 10 if on_call and random.random() < (0.5 if event.spec.format == Format.CHALLENGE else 0.05):
            return event.close()
        case number if on_call and number > 18:
            return event.arrange(*random.sample(names, random.randint(1, min(3, event.spec.seats, len(names)))))
        case _ if fixture:
            return event.record(outcome(fixture))
    raise ValueError("nothing to change")


def compare(event: Event, board: Board) -> None:
    """All that both implementations tell."""
    check, table = SECOND[event.spec.format]
    check(board)
    decided = {number: board.decided(number) for number in board.matches}
    assert {number: one.places for number, one in event.outcomes.items()} == {
        number: places for number, places in decided.items() if places is not None
    }
    waiting = {number: match for number, match in board.matches.items() if decided[number] is None}
    extra = {number: (len(board.reports[number]), board.tied(number)) for number in waiting if number in board.reports}
    assert {one.number: (one.extra, sorted(one.entrants)) for one in event.open} == {
        number: (extra[number][0], sorted(extra[number][1])) if number in extra else (0, sorted(match.entrants))
        for number, match in waiting.items()
    }
    for number in decided:
        if decided[number] is not None and board.winners(number):
            assert event.through(board.matches[number]) == board.through(number)[0]
    places, points = table(board)
    found = {row.entrant: (row.place, round(row.points, 6), row.played, row.wins) for row in event.standings}
    assert found == {
        name: (place, round(points[name], 6), board.played(name), board.won(name)) for place, name in places
    }
    order = [row.place for row in event.standings]
    assert order == sorted(order)


def with_scores(outcome: Callable[[Fixture], Result], random: Random) -> Callable[[Fixture], Result]:
    """Tries have scores; somebody may be without one."""

    def scored(fixture: Fixture) -> Result:
        scores = {name: float(random.randint(1, 4)) for name in fixture.entrants if random.random() < 0.8}
        return replace(outcome(fixture), scores=scores)

    return scored


def compare_other(event: Event) -> None:
    """Formats with a second implementation beside their own tests."""
    match event.spec.format:
        case Format.GROUPS:
            test_groups.check(event)
        case Format.CHALLENGE:
            assert {row.entrant: row.place for row in event.standings} == test_challenge.places(event)
        case _:
            assert {row.entrant: row.place for row in event.standings} == test_tries.compared(event)


def run_other(form: Format, seed: int) -> Event:
    """One random event, compared now and then, and at its end."""
    event = random_event(form, seed)
    random, outcome = Random(f"changes {form} {seed}"), by_chance(seed)
    if form in (Format.TIME_TRIAL, Format.HIGH_SCORE):
        outcome = with_scores(outcome, random)
    for step in range(400):
        try:
            event = random_change(event, random, outcome)
        except ValueError:
            continue
        if step % 7 == 0:
            compare_other(event)
        if event.over:
            break
    compare_other(event)
    return event


def check_file(event: Event, seed: int, folder: Path) -> None:
    """The file has all of the event; cut anywhere, the version before takes its place, with one line."""
    again = parse(to_text(event))
    assert again == event
    assert (again.standings, again.fixtures, again.byes, again.calls) == (
        event.standings, event.fixtures, event.byes, event.calls
    )  # fmt: skip
    file = folder / f"{seed}.json"
    before = Event(event.spec, event.journal[:-1])
    save(file, before)
    save(file, event)
    text = file.read_bytes()
    cut = Random(seed).randrange(len(text) - 2)
    file.write_bytes(text[:cut])
    found, problems = load(file)
    assert found == before
    assert len(problems) == 1
    assert "\n" not in problems[0]


def run(form: Format, seed: int) -> Event:
    """One random event, compared after each entry, to its end unless everybody leaves."""
    event = random_event(form, seed)
    random, outcome = Random(f"changes {form} {seed}"), by_chance(seed)
    board = new_board(event)
    compare(event, board)
    steps = 0
    while not event.over and steps < 2000:
        steps += 1
        try:
            after = random_change(event, random, outcome)
        except ValueError:
            continue
        entry: Entry = after.journal[-1]
        try:
            board.step(entry, after)
            if not isinstance(entry, Recorded) or len(board.matches) < FEW or random.random() < 0.1 or after.over:
                compare(after, board)
        except AssertionError as error:
            raise AssertionError(f"{form} {seed}, after entry {len(after.journal)}: {entry}") from error
        event = after
    assert event.over
    return event


@pytest.mark.parametrize("form", [*Format])
@pytest.mark.parametrize("block", [0, *(pytest.param(block, marks=LONG[: 1 + (block > 1)]) for block in range(1, 9))])
def test_250_random_events_agree_with_a_second_implementation(form, block, tmp_path):
    """34 of each format, two of them quick."""
    for seed in range(4 * block - 1, 4 * block + 3) if block else (1, 2):
        event = run(form, seed) if form in SECOND else run_other(form, seed)
        check_file(event, seed, tmp_path)


def test_no_byte_of_a_file_can_be_missing():
    text = to_text(run(Format.KNOCKOUT, 2))
    for cut in range(len(text.rstrip())):
        with pytest.raises(ValueError, match=r"\w") as refused:
            parse(text[:cut])
        assert "\n" not in str(refused.value)
