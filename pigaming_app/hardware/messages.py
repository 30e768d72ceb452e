"""Sentences for the operator: English for the log, with a key by which a screen says them in another language."""

from typing import Self


class Said(str):
    """A sentence, and how to say it elsewhere: the text `hardware.KEY` with these values put in."""

    key: str
    values: dict[str, object]

    def __new__(cls, sentence: str, key: str, **values: object) -> Self:
        made = super().__new__(cls, sentence)
        made.key, made.values = key, values
        return made


def said(trouble: BaseException) -> str:
    """The sentence of an exception, as it was given to it."""
    return trouble.args[0] if trouble.args and isinstance(trouble.args[0], Said) else str(trouble)
