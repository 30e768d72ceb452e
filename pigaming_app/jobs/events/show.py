"""Table and next matches of an event."""

import json
from collections.abc import Iterator, Sequence

from pigaming_app.events.event import Event
from pigaming_app.events.exports import columns, plain
from pigaming_app.events.spec import Standing
from pigaming_app.jobs.events.files import EventOptions, loaded

NEXT = 8  # matches shown


def run(options: EventOptions) -> int:
    """Print the event. Raises Refusal."""
    print_event(loaded(options.file), options.json)
    return 0


def print_event(event: Event, as_json: bool, **more: float) -> None:
    """Print tables, or one JSON object with `more` figures."""
    if as_json:
        print(json.dumps(plain(event) | more))
    else:
        print("\n".join(line.rstrip() for line in lines(event)))


def lines(event: Event) -> Iterator[str]:
    """The tables of entrants and teams, then the next matches."""
    spec, played = event.spec, len(event.outcomes)
    yield f"{spec.title}: {spec.format}, {', '.join(spec.games)}"
    yield f"{played} matches played, {len(event.open)} open"
    if event.pause is not None:
        yield f"break: {event.pause}".rstrip(": ")
    yield ""
    yield from _table(event.standings)
    for name, rows in event.part_standings.items():
        yield ""
        yield f"group {name}"
        yield from _table(rows)
    if event.team_standings:
        yield ""
        yield from _table(event.team_standings)
    if event.open:
        yield ""
        yield f"round {event.round}, next:"
    for fixture in event.open[:NEXT]:
        stage = f", {fixture.stage}" if fixture.stage else ""
        stage += ", sudden death" if fixture.extra else ""
        called = event.calls.get(fixture.number)
        stage += "" if called is None else f", called to {called}" if called else ", called"
        yield f"{fixture.number:>5}  {' – '.join(fixture.entrants)}  ({fixture.game}{stage})"
    if len(event.open) > NEXT:
        yield f"       and {len(event.open) - NEXT} more"


def _table(rows: Sequence[Standing]) -> Iterator[str]:
    breaks = columns(rows)
    wide = max(14, *(len(row.entrant) + 1 for row in rows))
    yield f"{'':4}{'':{wide}}{'points':>8}{'wins':>6}{'played':>8}" + "".join(f"{key:>18}" for key in breaks)
    for row in rows:
        values = "".join(f"{row.tie_breaks[key]:z18.2f}" for key in breaks)
        yield f"{row.place:>3} {row.entrant:{wide}}{row.points:z8.2f}{row.wins:6}{row.played:8}{values}"
