"""Hyper-parameters changed by texts such as rate=0.001."""

from collections.abc import Iterable
from dataclasses import fields, replace
from typing import Any, TypeVar

Knobs = TypeVar("Knobs", bound=Any)


def changed(knobs: Knobs, settings: Iterable[str]) -> Knobs:
    """A frozen dataclass of numbers with changes of the form NAME=NUMBER. Raises ValueError."""
    kinds: dict[str, Any] = {field.name: type(getattr(knobs, field.name)) for field in fields(knobs)}
    changes: dict[str, Any] = {}
    for text in settings:
        name, equals, value = text.partition("=")
        if name not in kinds or not equals:
            raise ValueError(f"{text!r}; NAME=NUMBER is needed, with one of {', '.join(kinds)}")
        try:
            changes[name] = kinds[name](value)
        except ValueError:
            raise ValueError(f"{text!r}; {value!r} is not such a number") from None
    return replace(knobs, **changes)
