"""What tests of servers share."""

import logging
from collections.abc import Iterator
from typing import Any

import pytest


@pytest.fixture
def quiet(caplog: pytest.LogCaptureFixture, capfd: Any, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """No traceback is printed or logged, and one line of a kind at most, however long the test takes."""
    from pigaming_app.ui.web import refusals

    monkeypatch.setattr(refusals, "LOG_SECONDS", 1e6)
    logging.getLogger("pigaming").propagate = True
    yield
    assert "Traceback" not in caplog.text + "".join(capfd.readouterr())
    kinds = [record.getMessage().split(",")[0] for record in caplog.records]
    assert len(kinds) == len(set(kinds)), kinds
