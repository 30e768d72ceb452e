"""The English sentences of messages and errors of the hardware, as terminal and log have them."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from pigaming_app.hardware.messages import OperatorError
from pigaming_app.ui.i18n import english


def sentence(trouble: Any) -> str:
    """The sentence of an OperatorMessage or an OperatorError."""
    return english().explained(trouble.message if isinstance(trouble, OperatorError) else trouble)


@contextmanager
def refused(kind: type[OperatorError], match: str) -> Iterator["pytest.ExceptionInfo[OperatorError]"]:
    """What is inside must raise this error with a sentence in which `match` is found."""
    with pytest.raises(kind) as caught:
        yield caught
    assert re.search(match, sentence(caught.value)), sentence(caught.value)
