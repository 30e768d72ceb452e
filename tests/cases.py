"""Cases of a test that take long together: some of them are tried by `test`, the others by `test --long`."""

from collections.abc import Iterable
from typing import Any

import pytest


def one_in(count: int, cases: Iterable[Any]) -> list[Any]:
    """Values for `parametrize`: one in `count`, from the first on, as it is; the others are marked `long`.

    A tuple holds the values of several arguments.
    """
    values = [case if isinstance(case, tuple) else (case,) for case in cases]
    return [pytest.param(*value, marks=[pytest.mark.long] if i % count else []) for i, value in enumerate(values)]
