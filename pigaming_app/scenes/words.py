"""The words on the screens, in English and European Portuguese: assets/text/LANGUAGE.toml."""

import tomllib
from typing import Any

from pigaming_app import ASSETS

LANGUAGES = ("en", "pt")


class Words:
    """`words("lobby.ready", player=2)` is a text in the language of the moment."""

    def __init__(self, language: str) -> None:
        self.language = language
        self.texts = texts(language)

    def __call__(self, key: str, **values: object) -> str:
        """The text of a key, with its {names} filled in. Raises KeyError for a key that is not there."""
        return self.texts[key].format(**values) if values else self.texts[key]

    def switch(self, language: str) -> None:
        """Speak another language from now on."""
        self.language, self.texts = language, texts(language)

    def other(self) -> str:
        """The language that is not spoken now."""
        return LANGUAGES[1 - LANGUAGES.index(self.language)]


def texts(language: str) -> dict[str, str]:
    """All texts of a language by `table.key`."""
    tables: dict[str, dict[str, Any]] = tomllib.loads((ASSETS / "text" / f"{language}.toml").read_text("utf-8"))
    return {f"{table}.{key}": str(text) for table, entries in tables.items() for key, text in entries.items()}
