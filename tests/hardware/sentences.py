"""English texts of hardware messages and errors, as in terminal and log."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from pigaming_app.storage.messages import OperatorError, OperatorMessage
from pigaming_app.ui.i18n import english


def sentence(fault: Any) -> str:
    """The text of an OperatorMessage or OperatorError."""
    return english().long_sentence(fault.message if isinstance(fault, OperatorError) else fault)


def key_of(fault: OperatorMessage | None) -> str:
    """The key of a fault that there must be."""
    assert fault is not None
    return fault.key


@contextmanager
def refused(kind: type[OperatorError], match: str) -> Iterator["pytest.ExceptionInfo[OperatorError]"]:
    """The block must raise this error with a text that matches the pattern `match`."""
    with pytest.raises(kind) as caught:
        yield caught
    assert re.search(match, sentence(caught.value)), sentence(caught.value)
