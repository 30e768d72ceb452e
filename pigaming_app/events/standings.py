"""The tables of an event: entrants, teams, and the groups of its format."""

from collections.abc import Mapping

from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.progress import Progress
from pigaming_app.events.spec import Standing


def standings(progress: Progress) -> tuple[Standing, ...]:
    """All entrants, best first; equal ones share a place and stand in the order of their seeding."""
    return KINDS[progress.spec.format].table(progress.as_field())


def part_standings(progress: Progress) -> Mapping[str, tuple[Standing, ...]]:
    """The tables of groups, by their names; none in most formats."""
    return KINDS[progress.spec.format].parts(progress.as_field())


def team_standings(progress: Progress) -> tuple[Standing, ...]:
    """All teams, best first, by the sum of the points, then of the wins, of their entrants; none without teams."""
    rows = {row.entrant: row for row in standings(progress)}
    members: dict[str, list[Standing]] = {}
    for entrant in progress.entrants:
        if entrant.team:
            members.setdefault(entrant.team, []).append(rows[entrant.name])
    points = {team: sum(row.points for row in team_rows) for team, team_rows in members.items()}
    won = {team: sum(row.wins for row in team_rows) for team, team_rows in members.items()}
    order = sorted(members, key=lambda team: (-points[team], -won[team]))
    ranks = [(points[team], won[team]) for team in order]
    return tuple(
        Standing(
            place=1 + ranks.index((points[team], won[team])),
            entrant=team,
            points=points[team],
            wins=won[team],
            played=sum(row.played for row in members[team]),
            tie_breaks={"wins": float(won[team])},
        )
        for team in order
    )
