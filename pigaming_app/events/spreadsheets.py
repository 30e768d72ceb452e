"""The first sheet of an Excel or OpenDocument file (.xlsx, .ods) as text with tabs.

Both are ZIP archives of XML. A hostile one is refused before it costs anything: what is read of a part is limited, XML
may not declare entities, and repeated cells and rows end at the limits of a list.
"""

import csv
import re
import zlib
from collections.abc import Iterator
from io import BytesIO, StringIO
from xml.etree.ElementTree import Element, fromstring
from xml.etree.ElementTree import ParseError as XmlError
from zipfile import BadZipFile, ZipFile

from pigaming_app.storage.parsing import ParseError

ZIP = b"PK\x03\x04"
MOST_BYTES = 8_000_000  # of a part, unpacked
MOST_ROWS, MOST_CELLS = 1000, 100  # that are read
MOST_EMPTY = 100_000  # rows with nothing in them
MOST_LETTERS = 1_000_000  # of all cells; one text can stand in many of them
_DECLARED = re.compile(rb"<!(DOCTYPE|ENTITY)", re.IGNORECASE)
_COLUMN = re.compile(r"[A-Z]{1,3}")


def text_of(raw: bytes) -> str:
    """The rows of the first sheet, cells separated by tabs. Raises ParseError."""
    try:
        with ZipFile(BytesIO(raw)) as file:
            names = {*file.namelist()}
            if "content.xml" in names:
                rows = _of_opendocument(_part(file, "content.xml"))
            elif "xl/workbook.xml" in names:
                rows = _of_excel(file, names)
            else:
                raise ParseError("it is not a list, nor a spreadsheet")
            return _text(rows)
    except (BadZipFile, zlib.error, XmlError, NotImplementedError, RuntimeError, EOFError, KeyError) as error:
        raise ParseError("the spreadsheet is damaged, or has a password") from error


def _part(file: ZipFile, name: str) -> Element:
    with file.open(name) as part:
        raw = part.read(MOST_BYTES + 1)
    if len(raw) > MOST_BYTES:
        raise ParseError("the spreadsheet is too large")
    if _DECLARED.search(raw) or b"\0" in raw:  # no other coding than UTF-8, which could hide one
        raise ParseError("the spreadsheet declares entities")
    return fromstring(raw)


def _tag(element: Element) -> str:
    return element.tag.rpartition("}")[2]


def _named(element: Element, tag: str) -> Iterator[Element]:
    return (one for one in element.iter() if _tag(one) == tag)


def _attribute(element: Element, name: str) -> str:
    return next((value for key, value in element.attrib.items() if key.rpartition("}")[2] == name), "")


def _of_excel(file: ZipFile, names: set[str]) -> Iterator[list[str]]:
    shared = [
        _excel_text(item)
        for item in (_named(_part(file, "xl/sharedStrings.xml"), "si") if "xl/sharedStrings.xml" in names else ())
    ]
    for row in _named(_part(file, _first_sheet(file, names)), "row"):
        cells: dict[int, str] = {}
        for cell in row:
            if _tag(cell) == "c":
                column = _column(_attribute(cell, "r"), len(cells))
                if column < MOST_CELLS:
                    cells[column] = _excel_cell(cell, shared)
        yield [cells.get(i, "") for i in range(max(cells, default=-1) + 1)]


def _first_sheet(file: ZipFile, names: set[str]) -> str:
    """The part of the first sheet of the workbook, which its relations name."""
    sheet = next(_named(_part(file, "xl/workbook.xml"), "sheet"), None)
    if sheet is None:
        raise ParseError("the spreadsheet has no sheet")
    of_id = {_attribute(one, "Id"): _attribute(one, "Target") for one in _relations(file, names)}
    target = of_id.get(_attribute(sheet, "id"), "worksheets/sheet1.xml")
    return target.lstrip("/") if target.startswith("/") else f"xl/{target}"


def _relations(file: ZipFile, names: set[str]) -> Iterator[Element]:
    part = "xl/_rels/workbook.xml.rels"
    return _named(_part(file, part), "Relationship") if part in names else iter(())


def _column(reference: str, following: int) -> int:
    """The number of a column, from 0, from the reference of a cell, such as B7."""
    found = _COLUMN.match(reference)
    if not found:
        return following
    number = 0
    for letter in found[0]:
        number = 26 * number + ord(letter) - 64
    return number - 1


def _excel_cell(cell: Element, shared: list[str]) -> str:
    kind = _attribute(cell, "t")
    if kind == "inlineStr":
        return "".join(_excel_text(one) for one in cell if _tag(one) == "is")
    value = next((one.text or "" for one in cell if _tag(one) == "v"), "")
    if kind == "e" or (not value and any(_tag(one) == "f" for one in cell)):
        what = f"the error {value}" if kind == "e" else "a formula without a value"
        raise ParseError(f"cell {_attribute(cell, 'r')} of the spreadsheet has {what}")
    if kind != "s":
        return value
    return shared[int(value[:9])] if value[:9].isdecimal() and int(value[:9]) < len(shared) else ""


def _excel_text(element: Element) -> str:
    """The text of all runs, without the readings (furigana) above it."""
    runs = (part if _tag(part) == "t" else part.find("{*}t") for part in element if _tag(part) in ("t", "r"))
    return "".join(text.text or "" for text in runs if text is not None)


def _of_opendocument(content: Element) -> Iterator[list[str]]:
    table = next(_named(content, "table"), None)
    if table is None:
        raise ParseError("the spreadsheet has no sheet")
    for row in _named(table, "table-row"):
        cells: list[str] = []
        for cell in row:
            if _tag(cell) in ("table-cell", "covered-table-cell"):
                lines = ["".join(part.itertext()) for part in cell if _tag(part) == "p"]
                cells += [" ".join(lines)] * _times(cell, "number-columns-repeated", MOST_CELLS - len(cells))
        times = _times(row, "number-rows-repeated", MOST_ROWS) if any(cells) else 1
        yield from [cells] * times


def _times(element: Element, attribute: str, most: int) -> int:
    text = _attribute(element, attribute)
    return min(int(text[:9]) if text.isdecimal() else 1, max(0, most))


def _text(rows: Iterator[list[str]]) -> str:
    text = StringIO()
    writer = csv.writer(text, "excel-tab", lineterminator="\n")
    filled = letters = 0
    for number, row in enumerate(rows):
        letters += sum(map(len, row))
        if letters > MOST_LETTERS or number > filled + MOST_EMPTY:
            raise ParseError("the spreadsheet is too large")
        filled += any(row)
        if filled > MOST_ROWS:
            raise ParseError(f"the spreadsheet has more than {MOST_ROWS} rows")
        writer.writerow([" ".join(cell.split()) for cell in row])
    return text.getvalue()
