"""Everything the arcade says, in English and Portuguese: assets/text/en.toml and pt.toml, with the same keys.

words = Words("pt")
words("lobby.seat", player=2)      "Jogador 2"
"""

import re
import tomllib
from collections.abc import Mapping
from functools import cache
from typing import Any, Protocol

from pigaming_app import ASSETS

LANGUAGES = ("en", "pt")
DECIMAL = re.compile(r"[+−-]?\d+\.\d+")
NAMES = {"en": "English", "pt": "Português"}


class Message(Protocol):
    """A key of the table `hardware`, and the values to put into its sentence."""

    @property
    def key(self) -> str: ...

    @property
    def values(self) -> Mapping[str, object]: ...


class Words:
    """The texts of one language at a time; `language` is one of LANGUAGES."""

    def __init__(self, language: str) -> None:
        self.language = language
        self._texts = texts(language)

    def __call__(self, key: str, **values: object) -> str:
        """The text of a key, `table.name`, with values put in. Raises KeyError where there is no such text."""
        return self._texts[key].format(**{name: self._written(value) for name, value in values.items()})

    def sentence(self, message: Message) -> str:
        """The sentence of a message of the hardware, as short as a screen needs it."""
        return self(f"hardware.{message.key}", **message.values)

    def explained(self, message: Message) -> str:
        """The sentence of a message for terminal and log: that of the table `terminal`, where there is one."""
        table = "terminal" if f"terminal.{message.key}" in self._texts else "hardware"
        return self(f"{table}.{message.key}", **message.values)

    def decimal(self, number: str) -> str:
        """A number, with a point before its decimals, as this language writes it: 1.5 s are 1,5 s in Portuguese."""
        return number.replace(".", self._texts["numbers.decimal"])

    def switch(self, language: str) -> None:
        """Speak another language from now on."""
        self.language = language
        self._texts = texts(language)

    @property
    def other(self) -> str:
        """The language that is not spoken."""
        return LANGUAGES[1 - LANGUAGES.index(self.language)]

    def printed(self, label: str) -> str:
        """What the button labelled `label` is called here: the space bar has a name of its own."""
        return self._texts.get(f"keys.{label}", label)

    def _written(self, value: object) -> object:
        """What is put into a text: a number as this language writes it, anything else as it is."""
        number = isinstance(value, float) or (isinstance(value, str) and DECIMAL.fullmatch(value))
        return self.decimal(str(value)) if number else value


@cache
def english() -> Words:
    """The texts of log and terminal, which are English whatever the screen's language."""
    return Words("en")


def in_every_language(*keys: str) -> list[str]:
    """The texts of these keys, one language after the other."""
    return [Words(language)(key) for language in LANGUAGES for key in keys]


def texts(language: str) -> dict[str, str]:
    """Every text of a language by its key. Raises OSError or ValueError for a file that is missing or broken."""
    file = ASSETS / "text" / f"{language}.toml"
    return dict(_flat(tomllib.loads(file.read_text(encoding="utf-8")), ""))


def _flat(table: dict[str, Any], path: str) -> list[tuple[str, str]]:
    found = []
    for name, value in table.items():
        found += _flat(value, f"{path}{name}.") if isinstance(value, dict) else [(path + name, str(value))]
    return found
