"""Bracket and tables of an event as pages of plain values, for its own page and for the second screen."""

from dataclasses import dataclass

from pigaming_app.events.event import Event
from pigaming_app.events.formats import knockout
from pigaming_app.events.spec import WALKOVER, Fixture, Format, Outcome, Standing
from pigaming_app.scenes.events import bracket_view, table_view
from pigaming_app.scenes.events.bracket_view import NEXT, OPEN, PLAYED, Box, Page
from pigaming_app.scenes.events.running import stage_name
from pigaming_app.scenes.events.table_view import TableRow
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.numbers import numeral

TABLE, TEAMS, BRACKET = "table", "teams", "bracket"  # kinds of pages


@dataclass(frozen=True)
class Overview:
    """The pages of an event, each a kind and a number among those of its kind; `first`: the one to open with."""

    words: Words
    heads: tuple[str, ...]  # of the values of a table
    rows: tuple[TableRow, ...]
    teams: tuple[TableRow, ...]
    bracket: tuple[Page, ...]
    pages: tuple[tuple[str, int], ...]
    first: int

    def table(self, kind: str) -> tuple[tuple[TableRow, ...], tuple[str, ...]]:
        """Rows and headings of the table of the entrants, or of the teams."""
        return (self.rows, self.heads) if kind == TABLE else (self.teams, self.heads[:2])

    def stages(self, number: int) -> list[str]:
        """Headings of the columns of a page of the bracket."""
        return [stage_name(self.words, column.stage, column.round) for column in self.bracket[number]]


def overview(words: Words, event: Event, playing: int | None = None) -> Overview:
    """The pages of an event: a knock-out begins with its bracket, all others with the table.

    `playing`: number of the match to be marked; None: the next one.
    """
    upcoming = playing or (event.open[0].number if event.open else None)
    rows = rows_of(words, event.standings, {entrant.name for entrant in event.entrants if entrant.brain})
    teams = rows_of(words, event.team_standings, set())
    bracket = bracket_view.pages_of([_box(event, fixture, upcoming) for fixture in event.fixtures])
    table = [(TABLE, i) for i in range(table_view.pages_of(len(rows)))]
    table += [(TEAMS, i) for i in range(table_view.pages_of(len(teams))) if teams]
    rounds = [(BRACKET, i) for i in range(len(bracket))]
    knocked = event.spec.format is Format.KNOCKOUT
    return Overview(
        words,
        heads_of(words, event.spec.format),
        rows,
        teams,
        tuple(bracket),
        tuple([*rounds, *table] if knocked else [*table, *rounds]),
        bracket_view.page_with(bracket, upcoming) if knocked else 0,
    )


def _box(event: Event, fixture: Fixture, upcoming: int | None) -> Box:
    outcome = event.outcomes.get(fixture.number)
    state = PLAYED if outcome else NEXT if fixture.number == upcoming else OPEN
    best = through(event, fixture, outcome) if outcome else ()
    return Box(
        fixture.number,
        fixture.stage,
        fixture.round,
        fixture.entrants,
        tuple(name in best for name in fixture.entrants),
        state,
    )


def through(event: Event, fixture: Fixture, outcome: Outcome) -> tuple[str, ...]:
    """Who goes on from a match of a knock-out, or has won another."""
    if event.spec.format is Format.KNOCKOUT:
        names = tuple(entrant.name for entrant in event.entrants)
        return tuple(knockout.through(fixture, outcome, names, event.spec.advance))
    return outcome.places[0] if len(outcome.places) > 1 or outcome.note == WALKOVER else ()


def rows_of(words: Words, standings: tuple[Standing, ...], ais: set[str]) -> tuple[TableRow, ...]:
    """The rows of a table: points, wins, matches, and the first tie-break."""
    first = [row.entrant for row in standings if row.place == 1]
    return tuple(
        TableRow(row.place, row.entrant, figures_of(words, row), row.entrant in ais, first == [row.entrant])
        for row in standings
    )


def figures_of(words: Words, row: Standing) -> tuple[str, ...]:
    """Points, wins, matches and the first tie-break of a row."""
    first = next(iter(row.tie_breaks.values()), None)
    figures = [number(words, row.points), str(row.wins), str(row.played)]
    return (*figures, *([number(words, first)] if first is not None else []))


def number(words: Words, value: float) -> str:
    """A number with at most one decimal."""
    return words.decimal(numeral(value, 1).removesuffix(".0"))


def heads_of(words: Words, form: Format) -> tuple[str, ...]:
    """Headings of the figures of a row."""
    tie = {Format.ROUND_ROBIN: "head_to_head", Format.SWISS: "buchholz", Format.GRAND_PRIX: "first"}.get(form)
    return tuple(words(f"events.{name}") for name in ("points", "wins", "played", *([tie] if tie else [])))
