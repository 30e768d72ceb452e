"""Bracket and tables of an event as pages of plain values, for its own page and for the second screen."""

from dataclasses import dataclass, replace

from pigaming_app.events.event import Event
from pigaming_app.events.formats import knockout
from pigaming_app.events.formats.knockout import FINAL
from pigaming_app.events.spec import WALKOVER, Fixture, Result, Standing
from pigaming_app.scenes.events import bracket_view, table_view
from pigaming_app.scenes.events.bracket_view import LATER, NEXT, OPEN, PLAYED, BracketBox, Page
from pigaming_app.scenes.events.running import stage_name
from pigaming_app.scenes.events.table_view import GroupTable, TableRow
from pigaming_app.ui.i18n import Words, numeral

TABLE, TEAMS, GROUPS, BRACKET = "table", "teams", "groups", "bracket"  # kinds of pages
TEAM_FIGURES = ("points", "wins", "played")


@dataclass(frozen=True)
class Overview:
    """The pages of an event, each a kind and a number among those of its kind; `first`: the one to open with."""

    words: Words
    heads: tuple[str, ...]  # of the values of a table
    rows: tuple[TableRow, ...]
    teams: tuple[TableRow, ...]
    groups: tuple[GroupTable, ...]
    bracket: tuple[Page, ...]
    pages: tuple[tuple[str, int], ...]
    first: int

    def table(self, kind: str) -> tuple[tuple[TableRow, ...], tuple[str, ...]]:
        """Rows and headings of the table of the entrants, or of the teams."""
        return (self.rows, self.heads) if kind == TABLE else (self.teams, heads_of(self.words, TEAM_FIGURES))

    def stages(self, number: int) -> list[str]:
        """Headings of the columns of a page of the bracket."""
        drawn = {(column.stage, column.round) for page in self.bracket for column in page}
        return [stage_name(self.words, column.stage, column.round, drawn) for column in self.bracket[number]]


def overview(words: Words, event: Event, playing: int | None = None) -> Overview:
    """The pages of an event: a knock-out begins with its bracket, groups with their tables, all others with the table.

    `playing`: number of the match to be marked; None: the next one.
    """
    upcoming = playing or (event.open[0].number if event.open else None)
    kind, ais = event.progress.kind, {entrant.name for entrant in event.entrants if entrant.brain}
    rows = rows_of(words, event.standings, kind.figures, ais)
    teams = rows_of(words, event.team_standings, TEAM_FIGURES, set())
    groups = tuple(
        GroupTable(f"{words('events.group')} {name}", rows_of(words, part, TEAM_FIGURES, ais))
        for name, part in event.part_standings.items()
    )
    bracket = bracket_view.pages_of(_sides(words, event, upcoming))
    table = [(TABLE, i) for i in range(table_view.pages_of(len(rows)))]
    table += [(TEAMS, i) for i in range(table_view.pages_of(len(teams))) if teams]
    rounds = [(BRACKET, i) for i in range(len(bracket))]
    parts = [(GROUPS, i) for i in range(table_view.group_pages(groups))]
    knocked = bool(kind.sides) and any(kind.wins(event.spec, one) for one in event.fixtures)
    return Overview(
        words,
        heads_of(words, kind.figures),
        rows,
        teams,
        groups,
        tuple(bracket),
        tuple([*parts, *rounds, *table] if kind.sides else [*table, *rounds]),
        len(parts) + bracket_view.page_with(bracket, upcoming) if knocked else 0,
    )


def _sides(words: Words, event: Event, upcoming: int | None) -> list[list[BracketBox]]:
    """All matches that are drawn; of a knock-out also those to come, each side for itself."""
    sides = event.progress.kind.sides
    if not sides:
        return [[_box(event, event, fixture, upcoming) for fixture in event.fixtures]]
    shown = outlook(event)
    boxes = [_box(event, shown, fixture, upcoming) for fixture in shown.fixtures]
    if boxes[-1].state == LATER and boxes[-1].stage == FINAL:
        boxes[-1] = replace(boxes[-1], note=words("events.if_needed"), come=frozenset())  # the second final
    of_stages = [[box for stage in stages for box in boxes if box.stage == stage] for stages in sides.values()]
    knocked = {stage for stages in sides.values() for stage in stages}
    rest = [replace(box, stage="") for box in boxes if box.stage not in knocked]  # the groups, round by round
    return [side for side in (*of_stages, rest) if side]


def _box(event: Event, shown: Event, fixture: Fixture, upcoming: int | None) -> BracketBox:
    """A match of the event, or one to come from its outlook `shown`."""
    outcome = event.outcomes.get(fixture.number)
    drawn = fixture.number <= len(event.fixtures)
    state = PLAYED if outcome else NEXT if fixture.number == upcoming else OPEN if drawn else LATER
    best = through(event, fixture, outcome) if outcome else ()
    names, go, come = fixture.entrants, event.through(fixture), frozenset(fixture.entrants)
    kind = event.progress.kind
    bound = kind.bound(event.spec)
    if fixture.stage in bound and fixture.stage != FINAL:
        go = shown.through(fixture)
    if not drawn:
        certain = fixture.stage in bound
        begun = any(kind.wins(event.spec, one) for one in event.fixtures)
        names = tuple(name if certain and begun and is_settled(event, shown, fixture, name) else "" for name in names)
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
    if event.progress.kind.wins(event.spec, fixture):
        return tuple(event.through(fixture))
    return outcome.places[0] if len(outcome.places) > 1 or outcome.note == WALKOVER else ()


def rows_of(
    words: Words, standings: tuple[Standing, ...], figures: tuple[str, ...], ais: set[str]
) -> tuple[TableRow, ...]:
    """The rows of a table with these figures of its entrants."""
    first = [row.entrant for row in standings if row.place == 1]
    return tuple(
        TableRow(
            row.place,
            row.entrant,
            tuple(figure_of(words, row, key) for key in figures),
            row.entrant in ais,
            first == [row.entrant],
        )
        for row in standings
    )


def figure_of(words: Words, row: Standing, key: str) -> str:
    """A figure of a row: points, wins, matches, or a tie-break."""
    if key in ("best", "second_best"):
        return worth(words, row.tie_breaks[key]) if row.tie_breaks[key] else "–"
    return number(words, {"points": row.points, "wins": row.wins, "played": row.played, **row.tie_breaks}[key])


def worth(words: Words, value: float) -> str:
    """A time, s, to the hundredth, or points."""
    return words.decimal(numeral(value, 0 if value == int(value) else 2))


def number(words: Words, value: float) -> str:
    """A number with at most one decimal."""
    return words.decimal(numeral(value, 1).removesuffix(".0"))


def heads_of(words: Words, figures: tuple[str, ...]) -> tuple[str, ...]:
    """Headings of the figures of a row."""
    return tuple(words(f"events.{name}") for name in figures)
