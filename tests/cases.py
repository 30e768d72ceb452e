"""Sampling of long parametrisations: a part runs in `test`, the rest in `test --long`, a part of that in `.ci/run`."""

import os
from collections.abc import Iterable
from typing import Any

import pytest
from hypothesis import settings


def one_in(count: int, cases: Iterable[Any]) -> list[Any]:
    """Values for `parametrize`: every `count`-th, from the first, unmarked; the others `long`, each second `again`.

    A tuple holds the values of several arguments.
    """
    values = [case if isinstance(case, tuple) else (case,) for case in cases]
    marks = (pytest.mark.long, pytest.mark.again)
    return [pytest.param(*value, marks=marks[: (i % count > 0) * (1 + i % 2)]) for i, value in enumerate(values)]


def repeated(cases: Iterable[Any]) -> list[Any]:
    """Values for `parametrize` of a long proof: the first unmarked; the others `again`, which `.ci/run` leaves out.

    A tuple holds the values of several arguments.
    """
    values = [case if isinstance(case, tuple) else (case,) for case in cases]
    return [pytest.param(*value, marks=[pytest.mark.again] if i else []) for i, value in enumerate(values)]


def examples(count: int) -> settings:
    """A test by hypothesis: so many random examples with PIGAMING_TEST_SEED, else a fifth, the same in every run."""
    return settings(max_examples=count if os.environ.get("PIGAMING_TEST_SEED") else count // 5, deadline=None)
