"""The page of an event for everybody: what is played, what comes next, table and bracket.

The same page is served, and written as files. Its parts with the class `page` follow one another; on a projector
(`?big`) they take turns.
"""

from collections.abc import Iterator, Sequence
from typing import TypeVar

from pigaming_app.events.changes.live import LiveMatch
from pigaming_app.events.event import Event
from pigaming_app.events.spec import Fixture, Result
from pigaming_app.scenes.events.bracket_view import BracketBox, Column
from pigaming_app.scenes.events.desk.document import document
from pigaming_app.scenes.events.names import places_of
from pigaming_app.scenes.events.overview import (
    BRACKET,
    GROUPS,
    TABLE,
    TEAM_FIGURES,
    TEAMS,
    Overview,
    heads_of,
    overview,
    worth,
)
from pigaming_app.scenes.events.running import decided_by, progress_line, round_name
from pigaming_app.scenes.events.table_view import TableRow
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.web.markup import Markup, joined, tag

NEXT = 7  # matches shown
ROWS = 8  # of a table or a list on one page of a projector
T = TypeVar("T")
SHAPES = ("disc", "triangle", "square", "diamond")  # of the seats, as on the screens


def public_page(
    words: Words, event: Event, live: Sequence[LiveMatch] = (), foot: Sequence[object] = (), every: float = 0
) -> Markup:
    """The whole page."""
    return document(words, event.spec.title, parts(words, event, live), foot, every)


def parts(words: Words, event: Event, live: Sequence[LiveMatch] = ()) -> Iterator[Markup]:
    """Title, matches of now and the next ones, then bracket and tables in the order of the arcade, then all results."""
    yield from head(words, event)
    yield from now(words, event, live)
    yield from _coming(words, event, live)
    yield from tables(words, event)
    yield from _results(words, event)


def head(words: Words, event: Event) -> Iterator[Markup]:
    """Title, progress, and the break."""
    state = words("events.over") if event.over else progress_line(words, event)
    yield tag("header", tag("h1", event.spec.title), tag("p", state))
    if event.pause is not None:
        yield tag("p", tag("strong", words("desk.pause")), " ", event.pause, class_="banner")


def now(words: Words, event: Event, live: Sequence[LiveMatch]) -> Iterator[Markup]:
    """The matches that are played or called."""
    playing = {one.match: one for one in live if one.match}
    if first := _busy(event, live):
        cards = (_card(words, event, one, playing.get(one.number)) for one in first)
        yield tag("section", tag("h2", words("desk.now")), tag("div", *cards, class_="cards"), class_="page")


def tables(words: Words, event: Event) -> Iterator[Markup]:
    """Bracket and tables, as the arcade shows them."""
    seen = overview(words, event)
    kinds: set[str] = set()
    for kind, i in seen.pages:
        if kind == BRACKET and not any(column.boxes for column in seen.bracket[i]):
            continue  # nothing is arranged yet
        heading = None if kind in kinds else words(HEADINGS[kind])
        kinds.add(kind)
        if kind == BRACKET:
            yield _bracket(seen, i, heading)
        elif heading and kind == GROUPS:
            for group in seen.groups:
                yield from _table(group.rows, heads_of(words, TEAM_FIGURES), group.head)
        elif heading:
            yield from _table(*seen.table(kind), heading)


HEADINGS = {BRACKET: "desk.bracket", GROUPS: "events.groups_side", TABLE: "events.hint_table", TEAMS: "desk.teams"}


def _busy(event: Event, live: Sequence[LiveMatch]) -> list[Fixture]:
    playing = {one.match for one in live}
    return [one for one in event.open if one.number in playing or one.number in event.calls]


def _coming(words: Words, event: Event, live: Sequence[LiveMatch]) -> Iterator[Markup]:
    busy = _busy(event, live)
    if rest := [one for one in event.open if one not in busy][:NEXT]:
        rows = (tag("li", _line(words, event, one)) for one in rest)
        yield tag("section", tag("h2", words("desk.coming")), tag("ol", *rows, class_="rows"), class_="page")


def _card(words: Words, event: Event, fixture: Fixture, live: LiveMatch | None) -> Markup:
    """A match that is played or called: where, and who on which seat, with the score."""
    place = event.calls.get(fixture.number) or (live.arcade if live else "")
    seats = (
        tag(
            "li",
            tag("span", words("events.pad", number=seat + 1), class_="pad"),
            tag("span", name, class_="name"),
            tag("b", live.scores.get(name) if live else None),
            class_=f"seat {SHAPES[seat]}",
        )
        for seat, name in enumerate(fixture.entrants)
    )
    return tag(
        "article",
        tag("p", place or words("desk.match", number=fixture.number), tag("b", live.clock if live else None)),
        tag("ol", *seats),
        tag("p", round_name(words, event, fixture), class_="small"),
        class_="card playing" if live else "card",
    )


def _line(words: Words, event: Event, fixture: Fixture) -> Markup:
    kind = words("events.sudden_death") if fixture.extra else round_name(words, event, fixture)
    return joined([tag("span", versus(fixture.entrants), class_="name"), tag("span", kind, class_="small")])


def versus(names: Sequence[str]) -> str:
    """Those who play a match, in full."""
    return " – ".join(names)


def _table(rows: Sequence[TableRow], heads: Sequence[str], heading: str) -> Iterator[Markup]:
    head = tag("thead", tag("tr", tag("th"), tag("th"), *(tag("th", one) for one in heads)))
    for i, group in enumerate(_groups(rows, ROWS)):
        body = tag("tbody", *(_row(row, len(heads)) for row in group))
        yield tag("section", tag("h2", heading if i == 0 else None), tag("table", head, body), class_="page table")


def _row(row: TableRow, count: int) -> Markup:
    return tag(
        "tr",
        tag("td", row.place),
        tag("th", row.name, scope="row"),
        *(tag("td", figure) for figure in row.figures[:count]),
        class_="first" if row.leads else None,
    )


def _bracket(seen: Overview, i: int, heading: str | None) -> Markup:
    columns = (_column(column, head) for column, head in zip(seen.bracket[i], seen.stages(i), strict=True))
    return tag("section", tag("h2", heading), tag("div", *columns, class_="bracket"), class_="page")


def _column(column: Column, head: str) -> Markup:
    return tag("div", tag("h3", head), tag("div", *map(_box, column.boxes)), class_="column")


def _box(box: BracketBox) -> Markup:
    names = (
        tag("li", name or "\u00a0", class_="through" if best else None)
        for name, best in zip(box.names, box.through, strict=True)
    )
    return tag("div", tag("p", box.note) if box.note else "", tag("ul", *names), class_=f"box {box.state}")


def _results(words: Words, event: Event) -> Iterator[Markup]:
    """What has been played, the latest first."""
    played = [one for one in event.fixtures if one.number in event.outcomes]
    for i, group in enumerate(_groups(played[::-1], ROWS)):
        rows = (tag("li", _result(words, event, one)) for one in group)
        title = words("events.results") if i == 0 else None
        yield tag("section", tag("h2", title), tag("ol", *rows, class_="rows"), class_="page results")


def _result(words: Words, event: Event, fixture: Fixture) -> Markup:
    outcome = event.outcomes[fixture.number]
    how = decided_by(words, event, fixture.number)
    kind = round_name(words, event, fixture) + (f" · {how}" if how else "")
    return joined([tag("span", result_line(words, outcome), class_="name"), tag("span", kind, class_="small")])


def result_line(words: Words, outcome: Result) -> str:
    """Places with scores, if any: 1. Ana 3   2. Bia 1."""
    return "   ".join(
        f"{place}. " + " = ".join(name + _score(words, outcome, name) for name in names)
        for place, names in places_of(outcome)
    )


def _score(words: Words, outcome: Result, name: str) -> str:
    return f" {worth(words, outcome.scores[name])}" if name in outcome.scores else ""


def _groups(rows: Sequence[T], most: int) -> list[Sequence[T]]:
    return [rows[i : i + most] for i in range(0, len(rows), most)]
