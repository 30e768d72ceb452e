"""Fixtures of tests with screens."""

from collections.abc import Iterator

import pytest

from pigaming_app.ui.draw import read_large


@pytest.fixture(autouse=True)
def _usual_text() -> Iterator[None]:
    """Texts of the usual size, also after tests that press their way through the options."""
    read_large(False)
    yield
    read_large(False)
