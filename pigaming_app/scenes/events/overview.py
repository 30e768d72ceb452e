"""Bracket and tables of an event as pages of plain values, for its own page and for the second screen."""

from dataclasses import dataclass, replace

from pigaming_app.events.event import Event
from pigaming_app.events.formats import knockout
from pigaming_app.events.formats.knockout import FINAL, LOSERS, WINNERS
from pigaming_app.events.spec import WALKOVER, Fixture, Format, Result, Standing
from pigaming_app.scenes.events import bracket_view, table_view
from pigaming_app.scenes.events.bracket_view import LATER, NEXT, OPEN, PLAYED, BracketBox, Page
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
        drawn = {(column.stage, column.round) for page in self.bracket for column in page}
        return [stage_name(self.words, column.stage, column.round, drawn) for column in self.bracket[number]]


def overview(words: Words, event: Event, playing: int | None = None) -> Overview:
    """The pages of an event: a knock-out begins with its bracket, all others with the table.

    `playing`: number of the match to be marked; None: the next one.
    """
    upcoming = playing or (event.open[0].number if event.open else None)
    rows = rows_of(words, event.standings, {entrant.name for entrant in event.entrants if entrant.brain})
    teams = rows_of(words, event.team_standings, set())
    bracket = bracket_view.pages_of(_sides(words, event, upcoming))
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


def _sides(words: Words, event: Event, upcoming: int | None) -> list[list[BracketBox]]:
    """All matches that are drawn; of a knock-out also those to come: the winners' side with the finals, the losers'."""
    if event.spec.format is not Format.KNOCKOUT:
        return [[_box(event, event, fixture, upcoming) for fixture in event.fixtures]]
    shown = outlook(event)
    boxes = [_box(event, shown, fixture, upcoming) for fixture in shown.fixtures]
    if boxes[-1].state == LATER:
        boxes[-1] = replace(boxes[-1], note=words("events.if_needed"), come=frozenset())  # the second final
    order = {stage: [box for box in boxes if box.stage == stage] for stage in (WINNERS, LOSERS, FINAL)}
    return [side for side in (order[WINNERS] + order[FINAL], order[LOSERS]) if side]


def _box(event: Event, shown: Event, fixture: Fixture, upcoming: int | None) -> BracketBox:
    """A match of the event, or one to come from its outlook `shown`."""
    outcome = event.outcomes.get(fixture.number)
    drawn = fixture.number <= len(event.fixtures)
    state = PLAYED if outcome else NEXT if fixture.number == upcoming else OPEN if drawn else LATER
    best = through(event, fixture, outcome) if outcome else ()
    names, go, come = fixture.entrants, frozenset(best), frozenset(fixture.entrants)
    if event.spec.format is not Format.KNOCKOUT:
        go = frozenset()
    elif fixture.stage == WINNERS and event.spec.seats == 2:  # its matches to come follow from the draw
        go = frozenset(through(event, fixture, shown.outcomes[fixture.number]))
    if not drawn:
        certain = fixture.stage == FINAL or (fixture.stage == WINNERS and event.spec.seats == 2)
        names = tuple(name if certain and is_settled(event, shown, fixture, name) else "" for name in names)
        come = come if certain else frozenset()
    return BracketBox(
        fixture.number, fixture.stage, fixture.round, names, tuple(name in best for name in names), state, go, come
    )


def outlook(event: Event) -> Event:
    """A knock-out at its end, for the matches of each round to come. Who wins is made up: the first of a match, of
    the final the one who has lost, so that both finals are there.
    """
    while event.open:
        event = event.record(_made_up(event, event.open[0]))
    return event


def is_settled(event: Event, shown: Event, fixture: Fixture, name: str) -> bool:
    """True if it is certain that an entrant plays this match of the outlook `shown`: all matches before are decided."""
    before = (one for one in shown.fixtures if one.number < fixture.number and name in one.entrants)
    return all(one.number in event.outcomes for one in before)


def _made_up(event: Event, fixture: Fixture) -> Result:
    order = fixture.entrants
    if fixture.stage == FINAL:
        lost = knockout.defeats(event.progress.as_field())
        order = tuple(sorted(order, key=lambda name: -lost[name]))
    return Result(fixture.number, tuple((name,) for name in order), extra=fixture.extra)


def through(event: Event, fixture: Fixture, outcome: Result) -> tuple[str, ...]:
    """Who goes on from a match of a knock-out, or has won another."""
    if event.spec.format is Format.KNOCKOUT:
        return tuple(knockout.through(fixture, outcome, event.spec.advance))
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
