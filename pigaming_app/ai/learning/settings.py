"""Changes of hyper-parameters from the command line."""

from collections.abc import Iterable
from dataclasses import fields, replace
from typing import Any, TypeVar

T = TypeVar("T")


def changed(recipe: T, settings: Iterable[str]) -> T:
    """A dataclass of numbers with changes of the form NAME=NUMBER. Raises ValueError."""
    kinds: dict[str, Any] = {field.name: field.type for field in fields(recipe)}  # type: ignore[arg-type]
    changes: dict[str, Any] = {}
    for text in settings:
        name, equals, value = text.partition("=")
        if name not in kinds or not equals:
            raise ValueError(f"{text!r}; NAME=NUMBER is needed, with one of {', '.join(kinds)}")
        try:
            changes[name] = kinds[name](value)
        except ValueError:
            raise ValueError(f"{text!r}; {value!r} is not such a number") from None
    return replace(recipe, **changes)  # type: ignore[type-var]
