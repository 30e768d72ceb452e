"""Events for tests, and ways to play them without matches."""

from collections.abc import Callable
from random import Random

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Entrant, EventSpec, Fixture, Format, Result


def new_event(form: Format, count: int, **more) -> Event:
    """An event of entrants named after their seeds: P1 is the best one."""
    entrants = tuple(Entrant(f"P{seed}") for seed in range(1, count + 1))
    return Event(EventSpec("Test", form, more.pop("games", ("pitanks",)), entrants, **more))


def seed_of(name: str) -> int:
    return int(name[1:])


def ranked(fixture: Fixture, *order: str) -> Result:
    """The entrants in this order, each with a place of its own."""
    return Result(fixture.number, tuple((name,) for name in order), extra=fixture.extra)


def level(fixture: Fixture) -> Result:
    """All entrants on one place."""
    return Result(fixture.number, (fixture.entrants,), extra=fixture.extra)


def best_seed_wins(fixture: Fixture) -> Result:
    return ranked(fixture, *sorted(fixture.entrants, key=seed_of))


def by_chance(seed: int, ties: bool = True) -> Callable[[Fixture], Result]:
    """Random places, sometimes equal ones."""
    random = Random(seed)

    def outcome(fixture: Fixture) -> Result:
        order = random.sample(fixture.entrants, len(fixture.entrants))
        if ties and random.random() < 0.2:
            places = (tuple(order[:2]), *((name,) for name in order[2:]))
            return Result(fixture.number, places, extra=fixture.extra)
        return ranked(fixture, *order)

    return outcome


def played(event: Event, outcome: Callable[[Fixture], Result] = best_seed_wins, rounds: int = 1000) -> Event:
    """The event after this many rounds, or at its end."""
    while not event.over and event.round <= rounds:
        event = event.record(outcome(event.open[0])) if event.open else event.continued()
    return event


def pairs_of(event: Event, number: int) -> list[tuple[str, ...]]:
    """The matches of a round, each sorted by seed, in the order of their numbers."""
    fixtures = sorted((one for one in event.fixtures if one.round == number), key=lambda one: one.number)
    return [tuple(sorted(one.entrants, key=seed_of)) for one in fixtures]
