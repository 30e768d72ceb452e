"""Events in any state, for tests of their pages."""

from pathlib import Path

from pigaming_app.events import event_files
from pigaming_app.events.event import Event
from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.spec import Entrant, EventSpec, Fixture, Format, Result
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.storage.settings import folders

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


def names(count: int) -> list[str]:
    """Initials: AAA, BBC, CCE …"""
    return [LETTERS[i % 26] + LETTERS[(i * 7 + i // 26) % 26] + LETTERS[(i * 3) % 26] for i in range(count)]


def an_event(
    form: Format = Format.SWISS,
    count: int = 4,
    seats: int = 2,
    brains: str = "",
    rounds: int = 3,
    title: str = "Open day",
    wide: bool = False,
) -> Event:
    """An event of PiTanks in the short form; `brains`: of everybody; empty: people; `wide`: the widest names."""
    entrants = tuple(Entrant(f"{'W' * 21}{name}" if wide else name, brains) for name in names(count))
    kind = KINDS[form]
    games = ("pitanks", "factory", "race") if kind.series else ("race",) if kind.timed else ("pitanks",)
    seats = seats if seats in kind.seats else kind.seats[0]
    fill = "level3" if kind.fills and seats > 1 else ""
    rounds = 0 if kind.sides else min(rounds, count - 1)
    return Event(EventSpec(title, form, games, entrants, rounds, seats, minutes={"pitanks": 1.0}, fill=fill))


def result_of(fixture: Fixture) -> Result:
    """The alphabet decides, so that results differ from the seeding."""
    order = sorted(fixture.entrants, key=lambda name: name[::-1])
    return Result(
        fixture.number, tuple((name,) for name in order), {name: float(9 - i) for i, name in enumerate(order)}
    )


def played(event: Event, matches: int = 10_000) -> Event:
    """The event after so many more matches, or at its end."""
    for _ in range(matches):
        if event.over:
            break
        event = event if event.open else event.continued()
        event = event.record(result_of(event.open[0])) if event.open else event
    return event


def tied(event: Event) -> Event:
    """The event after a match without a winner."""
    fixture = event.open[0]
    return event.record(Result(fixture.number, (fixture.entrants,), extra=fixture.extra))


def running(event: Event, name: str = "event") -> RunningEvent:
    """The event in a file of the data folder."""
    folder: Path = folders().data / event_files.FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    event_files.save(folder / f"{name}.json", event)
    return RunningEvent(folder / f"{name}.json", event)


def saved(run: RunningEvent) -> Event:
    """The event as the file has it."""
    event, problems = event_files.load(run.path)
    assert event is not None, problems
    return event
