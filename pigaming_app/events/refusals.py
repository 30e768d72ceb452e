"""Why a change of an event is not possible: a key and values, whose sentence is in all languages.

The sentences are in assets/text, table `refused`. In logs and on the command line they are English.
"""

from functools import cache

from pigaming_app import ASSETS
from pigaming_app.storage.parsing import parse_toml, read_text


class Refused(ValueError):
    """A change that is not possible. `key` and `values` make the sentence; as a text it is the English one."""

    def __init__(self, key: str, **values: object) -> None:
        super().__init__(key)
        self.key, self.values = key, values

    def __str__(self) -> str:
        return str(_english()[self.key]).format(**self.values)


@cache
def _english() -> dict[str, object]:
    sentences: dict[str, object] = parse_toml(read_text(ASSETS / "text" / "en.toml"))["refused"]
    return sentences
