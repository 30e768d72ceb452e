"""Tables for spreadsheets, read back as Excel reads a file: byte order mark, separator and numbers by the language."""

import csv
import io

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.exports import matches_csv, standings_csv
from pigaming_app.events.spec import Entrant, EventSpec, Format
from tests.events.examples import by_chance

NAMES = ("Jürgen", "=HYPERLINK(x)", "+1", "-2", "@sum", 'a;b,"c"', "Íñigo")


def ended(form: Format) -> Event:
    event = Event(EventSpec("T", form, ("pitanks",), tuple(map(Entrant, NAMES))))
    outcome = by_chance(2)
    while not event.over:
        event = event.record(outcome(event.open[0])) if event.open else event.continued()
    return event


def opened(text: str, comma: bool) -> list[list[str | float]]:
    """The cells as a spreadsheet sees them: it splits at the separator of its language, and numbers are numbers.

    A cell that begins like a formula would be calculated: there is none.
    """
    point, separator = (",", ";") if comma else (".", ",")
    rows: list[list[str | float]] = []
    for row in csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True):
        cells: list[str | float] = []
        for cell in row:
            digits = cell.replace(point, "", 1)
            if digits.isdecimal() and (point in cell or digits == cell):
                cells.append(float(cell.replace(point, ".")))
            else:
                assert cell[:1] not in ("=", "+", "-", "@")
                cells.append(cell)
        rows.append(cells)
    return rows


@pytest.mark.parametrize("comma", [True, False])
@pytest.mark.parametrize("form", [Format.ROUND_ROBIN, Format.SWISS, Format.GROUPS, Format.KNOCKOUT, Format.CHALLENGE])
def test_a_spreadsheet_sees_names_and_numbers(form, comma):
    event = ended(form)
    header, *rows = opened(standings_csv(event, comma), comma)
    assert len({len(row) for row in (header, *rows)}) == 1
    for row, standing in zip(rows, event.standings, strict=True):
        cells = dict(zip(header, row, strict=True))
        assert str(cells["entrant"]).lstrip("'") == standing.entrant
        assert cells["points"] == pytest.approx(standing.points)
        assert cells["place"] == standing.place
        for key, value in standing.tie_breaks.items():
            assert cells[key] == pytest.approx(value, abs=1e-6)
    assert ("group" in header) == (form is Format.GROUPS)
    header, *rows = opened(matches_csv(event, comma), comma)
    assert len(rows) == sum(len(one.entrants) for one in event.fixtures)
    assert {str(row[header.index("entrant")]).lstrip("'") for row in rows} <= {*NAMES}
