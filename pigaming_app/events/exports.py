"""An event for other programs: plain values for JSON, and tables for spreadsheets."""

import csv
from collections.abc import Iterable, Sequence
from io import StringIO
from typing import Any

from pigaming_app.events.event import Event
from pigaming_app.events.journal import Corrected
from pigaming_app.events.spec import Standing

FORMULAS = ("=", "+", "-", "@", "＝", "＋", "－", "＠", "\t", "\r")  # beginnings that a spreadsheet would calculate


def plain(event: Event) -> dict[str, Any]:
    """The whole event: standings first, then all matches in order of play."""
    spec = event.spec
    return {
        "title": spec.title,
        "format": spec.format.value,
        "games": list(spec.games),
        "round": event.round,
        "over": event.over,
        "break": event.pause,
        "standings": [plain_standing(row) for row in event.standings],
        "groups": {name: [plain_standing(row) for row in rows] for name, rows in event.part_standings.items()},
        "teams": [plain_standing(row) for row in event.team_standings],
        "entrants": [
            {
                "name": entrant.name,
                "brain": entrant.brain,
                "team": entrant.team,
                "withdrawn": entrant.name in event.withdrawn,
            }
            for entrant in event.entrants
        ],
        "matches": [_match(event, i) for i in range(len(event.fixtures))],
        "byes": [{"round": number, "entrants": list(names)} for number, names in event.byes.items()],
        "corrections": [
            {"match": entry.outcome.fixture, "note": entry.outcome.note}
            for entry in event.journal
            if isinstance(entry, Corrected)
        ],
    }


def plain_standing(row: Standing) -> dict[str, Any]:
    """One row of the table."""
    return {
        "place": row.place,
        "entrant": row.entrant,
        "points": row.points,
        "wins": row.wins,
        "played": row.played,
        "tie_breaks": dict(row.tie_breaks),
    }


def standings_csv(event: Event, comma: bool = False) -> str:
    """The table of the event. `comma`: for spreadsheets that write 1,5 and so separate cells by semicolons."""
    breaks = columns(event.standings)
    teams = {entrant.name: entrant.team for entrant in event.entrants}
    groups = {row.entrant: name for name, rows in event.part_standings.items() for row in rows}
    body = (
        [row.place, row.entrant, teams[row.entrant]]
        + ([groups[row.entrant]] if groups else [])
        + [row.points, row.wins, row.played, *(row.tie_breaks[key] for key in breaks)]
        for row in event.standings
    )
    group = ["group"] if groups else []
    return _csv(["place", "entrant", "team", *group, "points", "wins", "played", *breaks], body, comma)


def columns(rows: Sequence[Standing]) -> list[str]:
    """The tie-breaks that need a column of their own."""
    return [key for key in rows[0].tie_breaks if key != "wins"]


def matches_csv(event: Event, comma: bool = False) -> str:
    """All matches in order of play, one row for each entrant of a match. `comma`: see `standings_csv`."""
    header = ["match", "round", "stage", "game", "seat", "entrant", "place", "score", "sudden_death", "lots", "note"]
    body = (
        (
            *(match[key] for key in ("match", "round", "stage", "game")),
            *(seat, name, place, score, len(match["sudden_death"]), int(match["lots"]), match["note"]),
        )
        for match in (_match(event, i) for i in range(len(event.fixtures)))
        for seat, name in enumerate(match["entrants"], 1)
        for place, score in [(_place(match["places"], name), match["scores"].get(name, ""))]
    )
    return _csv(header, body, comma)


def _match(event: Event, i: int) -> dict[str, Any]:
    fixture = event.fixtures[i]
    outcome = event.outcomes.get(fixture.number)
    return {
        "match": fixture.number,
        "round": fixture.round,
        "stage": fixture.stage,
        "game": fixture.game,
        "arena": fixture.arena,
        "entrants": list(fixture.entrants),
        "called": event.calls.get(fixture.number),
        "played": outcome is not None,
        "places": [list(place) for place in outcome.places] if outcome else [],
        "scores": dict(outcome.scores) if outcome else {},
        "note": outcome.note if outcome else "",
        "sudden_death": [[list(place) for place in extra.places] for extra in event.played.get(fixture.number, ())[1:]],
        "lots": event.lots(fixture.number),
    }


def _place(places: Sequence[Sequence[str]], name: str) -> int | str:
    """Place of an entrant, from 1; equal ones share it."""
    ahead = 0
    for place in places:
        if name in place:
            return 1 + ahead
        ahead += len(place)
    return ""


def _csv(header: Sequence[str], rows: Iterable[Sequence[Any]], comma: bool) -> str:
    text = StringIO()
    writer = csv.writer(text, delimiter=";" if comma else ",")
    writer.writerow(header)
    writer.writerows([_cell(value, comma) for value in row] for row in rows)
    return text.getvalue()


def _cell(value: Any, comma: bool) -> Any:
    """A value that a spreadsheet takes as it is."""
    if isinstance(value, float):
        number = f"{value:.6f}".rstrip("0").removesuffix(".")
        return number.replace(".", ",") if comma else number
    return f"'{value}" if isinstance(value, str) and value.startswith(FORMULAS) else value
