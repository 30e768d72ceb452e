"""Sampling of long parametrisations: a part runs in `test`, the rest in `test --long`."""

from collections.abc import Iterable
from typing import Any

import pytest


def one_in(count: int, cases: Iterable[Any]) -> list[Any]:
    """Values for `parametrize`: every `count`-th, from the first, unmarked; the others `long` and `again`.

    A tuple holds the values of several arguments.
    """
    values = [case if isinstance(case, tuple) else (case,) for case in cases]
    marks = (pytest.mark.long, pytest.mark.again)
    return [pytest.param(*value, marks=marks if i % count else ()) for i, value in enumerate(values)]


def repeated(cases: Iterable[Any]) -> list[Any]:
    """Values for `parametrize` of a long proof: the first unmarked; the others `again`, which `.ci/run` leaves out.

    A tuple holds the values of several arguments.
    """
    values = [case if isinstance(case, tuple) else (case,) for case in cases]
    return [pytest.param(*value, marks=[pytest.mark.again] if i else []) for i, value in enumerate(values)]
