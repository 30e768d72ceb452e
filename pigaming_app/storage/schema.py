"""Typed values of untrusted files: what `parsing` reads becomes dataclasses or Structs, or an error of one short line.

    @dataclass(frozen=True)
    class Climber:
        name: Line
        wins: Annotated[int, Meta(ge=0, le=9)] = 0

A type says all that its file may hold: ranges and patterns by `Meta`, choices by `Literal` or an enumeration, all else
by a ValueError of `__post_init__`. The message names the key: `climb[0].wins: expected a whole number <= 9`.
"""

import json
import re
from datetime import datetime
from typing import Annotated, Any, TypeVar

from msgspec import Meta, ValidationError, convert, to_builtins

from pigaming_app.storage.parsing import ParseError, one_line, parse_json, parse_toml, quote

T = TypeVar("T")
_UNPRINTABLE = r"\x00-\x1f\x7f-\xa0\xad\u061c\u200b-\u200f\u2028-\u202f\u205f-\u206f\ud800-\uf8ff\ufeff\ufff0-\uffff"
_PRINTABLE = rf"^[^{_UNPRINTABLE}]*\Z"
_LINE = re.compile(_PRINTABLE)
PRINTABLE = Meta(pattern=_PRINTABLE)
Line = Annotated[str, PRINTABLE, Meta(max_length=400)]
Finite = Annotated[float, Meta(ge=-1e300, le=1e300)]
Share = Annotated[float, Meta(ge=0.0, le=1.0)]
Count = Annotated[int, Meta(ge=0)]
_NOUNS = {
    "int": "a whole number",
    "float": "a number",
    "str": "a text",
    "bool": "true or false",
    "array": "a list",
    "object": "a table",
    "null": "nothing",
    "datetime": "a time",
}


def between(low: float, high: float) -> Meta:
    """The limits of a number from `low` to `high`, both included."""
    return Meta(ge=low, le=high)


def one_of(*words: str) -> Meta:
    """The limits of a text that is one of these words."""
    return Meta(pattern=rf"^({'|'.join(words)})\Z")


def is_line(text: str) -> bool:
    """True if a file may hold this text as a `Line`, its length aside."""
    return text.isprintable() and _LINE.match(text) is not None


def from_json(text: str | bytes, kind: type[T], form: int | None = None) -> T:
    """The value in a JSON text; `form`: the number that its key `format` must have, if any. Raises ParseError."""
    return _of_format(parse_json(text), kind, form)


def from_toml(text: str, kind: type[T], form: int | None = None) -> T:
    """The value in a TOML text, as `from_json`."""
    return _of_format(parse_toml(text), kind, form)


def typed(value: object, kind: type[T]) -> T:
    """A value of parsed JSON or TOML as one of this type. Raises ParseError."""
    try:
        return convert(value, kind)
    except ValidationError as error:
        raise ParseError(one_line(_reason(str(error)))) from None


def to_plain(value: object) -> Any:
    """The value as JSON and TOML have it: tables, lists, texts, numbers, truth values, times."""
    return to_builtins(value, builtin_types=(datetime,))


def to_json(value: object) -> str:
    """The value as JSON on one line."""
    return json.dumps(to_builtins(value), ensure_ascii=False)


def to_toml(value: object, form: int | None = None) -> str:
    """The value as TOML, with its format if it has one; what is None is left out."""
    import tomli_w

    head = {} if form is None else {"format": form}
    return tomli_w.dumps(head | {key: entry for key, entry in to_plain(value).items() if entry is not None})


def valid_entries(entries: object, kind: type[T]) -> list[T]:
    """The valid entries of a list, for a file whose other entries do not count; none if it is no list."""
    found = []
    for entry in entries if isinstance(entries, list) else []:
        try:
            found.append(typed(entry, kind))
        except ParseError:
            continue
    return found


def _of_format(value: object, kind: type[T], form: int | None) -> T:
    if form is not None:
        theirs = value.pop("format", None) if isinstance(value, dict) else None
        if type(theirs) is not int or theirs != form:
            raise ParseError(f"format: {quote(theirs)}, but {form} is needed")
    return typed(value, kind)


def _reason(message: str) -> str:
    """`Expected `int`, got `str` - at `$.a[0]`` becomes `a[0]: expected a whole number, got a text`."""
    text, _, place = message.rpartition(" - at ")
    text, place = (text, place.strip("`").removeprefix("$").removeprefix(".")) if text else (message, "")
    text = text.replace(f"matching regex {_PRINTABLE!r}", "of printable characters")
    if words := re.search(r"`str` matching regex '\^\((.*)\)\\\\Z'", text):
        text = text.replace(words[0], f"one of {words[1].replace('|', ', ')}")
    text = re.sub(r"^Object missing required field `(.*)`$", r"\1 is missing", text, flags=re.DOTALL)
    text = re.sub(r"^Object contains unknown field `(.*)`$", r"\1 is not a key here", text, flags=re.DOTALL)
    text = re.sub(r"^Invalid (enum )?value (.*)$", r"\2 is not possible", text, flags=re.DOTALL)
    text = text.replace(" | null`", "`")
    text = re.sub(r"`(\w+)`", lambda found: _NOUNS.get(found[1], found[1]), text)
    text = re.sub("^Expected", "expected", text)
    return f"{place}: {text}" if place else text
