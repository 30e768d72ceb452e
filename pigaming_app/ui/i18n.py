"""All texts in five languages, from assets/text/LANGUAGE.toml; all these files have the same keys.

words = Words("pt")
words("lobby.seat", player=2)      "Jogador 2"
"""

import re
from collections.abc import Mapping
from datetime import date, datetime
from functools import cache
from pathlib import Path
from string import Formatter
from typing import Any, Protocol
from unicodedata import category

from pigaming_app import ASSETS
from pigaming_app.storage.parsing import parse_toml, read_text
from pigaming_app.storage.plugins.parts import data_folders, leave_out

LANGUAGES = ("en", "pt", "es", "fr", "de")
LONGEST = 500  # letters of a plug-in's text
DECIMAL = re.compile(r"[+−-]?\d+\.\d+")
NAMES = {"en": "English", "pt": "Português", "es": "Español", "fr": "Français", "de": "Deutsch"}
MINUS = "−"


class Message(Protocol):
    """A key of the table `hardware` and its format values."""

    @property
    def key(self) -> str: ...

    @property
    def values(self) -> Mapping[str, object]: ...


class Words:
    """The texts of one language; `language` is one of LANGUAGES."""

    def __init__(self, language: str) -> None:
        self.language = language
        self._texts = texts(language)

    def __call__(self, key: str, **values: object) -> str:
        """The text of a key, `table.name`, with values filled in. Raises KeyError for an unknown key."""
        return self._texts[key].format(**{name: self._localised(value) for name, value in values.items()})

    def counted(self, key: str, number: object, **values: object) -> str:
        """The text of a key; for the number 1 that of `key_one` if there is such a text. Raises KeyError."""
        one = f"{key}_one"
        return self(one if number == 1 and one in self else key, **values)

    def __contains__(self, key: str) -> bool:
        """True if there is such a text."""
        return key in self._texts

    def sentence(self, message: Message) -> str:
        """The short on-screen sentence of a hardware message."""
        return self(f"hardware.{message.key}", **message.values)

    def long_sentence(self, message: Message) -> str:
        """The sentence of a hardware message for terminal and log: from the table `terminal` if present there."""
        table = "terminal" if f"terminal.{message.key}" in self._texts else "hardware"
        return self(f"{table}.{message.key}", **message.values)

    def decimal(self, number: str) -> str:
        """A number written with a decimal point, in this language's notation: 1.5 is 1,5 in Portuguese."""
        return number.replace(".", self._texts["numbers.decimal"])

    def day(self, day: date) -> str:
        """A day in this language's notation: 2026-03-01 is 01.03.2026 in German."""
        return f"{day:{self._texts['numbers.date']}}"

    def day_of_year(self, day: date) -> str:
        """A day of this year in this language's notation."""
        return f"{day:{self._texts['numbers.date'].removesuffix('%Y').rstrip('/')}}"

    def moment(self, at: datetime) -> str:
        """A day of this year and its time in this language's notation."""
        return f"{self.day_of_year(at)} {at:%H:%M}"

    def switch(self, language: str) -> None:
        """Change the language."""
        self.language = language
        self._texts = texts(language)

    @property
    def following(self) -> str:
        """The next language, cyclically."""
        return LANGUAGES[(LANGUAGES.index(self.language) + 1) % len(LANGUAGES)]

    def key_name(self, label: str) -> str:
        """The local name of the button labelled `label`: the space bar, for example, is translated."""
        head, space, last = label.partition(" ") if label.startswith("NUM ") else ("", "", label)
        return f"{head}{space}{self._texts.get(f'keys.{last}', last)}"

    def _localised(self, value: object) -> object:
        """A format value: numbers in local notation, everything else unchanged."""
        number = isinstance(value, float) or (isinstance(value, str) and DECIMAL.fullmatch(value))
        text = str(value)
        if number and not any(digit in "123456789" for digit in text):
            text = text.lstrip("+−-")
        return self.decimal(text) if number else value


@cache
def english() -> Words:
    """The texts of log and terminal, always English."""
    return Words("en")


def with_english(language: str, *keys: str) -> list[str]:
    """The texts of these keys in a language, and then in English: for what is printed."""
    return [Words(code)(key) for code in dict.fromkeys((language, "en")) for key in keys]


def system_language() -> str:
    """The first language of the system's user that has texts, else English."""
    from pygame.system import get_pref_locales

    return next((place["language"] for place in get_pref_locales() if place["language"] in LANGUAGES), "en")


@cache
def texts(language: str) -> Mapping[str, str]:
    """All texts of a language by key, cached. Raises OSError or ValueError for a missing or malformed file.

    Plug-ins add texts, but change none, of two with one key the second; what they lack in a language is English.
    """
    ours = _read(ASSETS / "text" / f"{language}.toml")
    added: dict[str, str] = {}
    for game, folder in data_folders("text"):
        theirs: dict[str, str] = {}
        for file in (folder / f"{code}.toml" for code in dict.fromkeys(("en", language))):
            try:
                theirs |= _checked(_read(file), theirs) if file.exists() else {}
            except (OSError, ValueError) as error:
                leave_out(game, f"text/{file.name}: {error}")
                theirs = {}
                break
        added = theirs | added
    return added | ours


def fields(text: str) -> set[str]:
    """The names of the values that are filled into a text. Raises ValueError for one that cannot be filled."""
    found = [(name, kind) for _, name, kind, _ in Formatter().parse(text) if name is not None]
    if wrong := [name for name, kind in found if kind or not name.isidentifier()]:
        raise ValueError(f"{{{wrong[0]}}} is no name of a value")
    return {name for name, _ in found}


def _checked(added: dict[str, str], english: Mapping[str, str]) -> dict[str, str]:
    """The texts of a plug-in, after a look at their letters and values. Raises ValueError."""
    for key, text in added.items():
        if len(text) > LONGEST or any(category(letter) == "Cc" for letter in text):
            raise ValueError(f"{key}: more than {LONGEST} letters, or a control character")
        try:
            unknown = fields(text) - fields(english.get(key, text))
        except ValueError as error:
            raise ValueError(f"{key}: {error}") from None
        if unknown:
            raise ValueError(f"{key}: {{{min(unknown)}}} is not in the English text")
    return added


def _read(file: Path) -> dict[str, str]:
    return dict(_flat(parse_toml(read_text(file)), ""))


def _flat(table: dict[str, Any], path: str) -> list[tuple[str, str]]:
    flat = []
    for name, value in table.items():
        flat += _flat(value, f"{path}{name}.") if isinstance(value, dict) else [(path + name, str(value))]
    return flat


def numeral(value: float, digits: int = 0) -> str:
    """A number rounded to `digits` decimals."""
    return f"{value:z.{digits}f}".replace("-", MINUS)


def signed(value: float, digits: int = 0) -> str:
    """The same with its sign; none for what rounds to zero."""
    text = numeral(value, digits)
    return text if text[0] == MINUS or not any(digit in "123456789" for digit in text) else f"+{text}"
