"""Fixtures of tests with screens."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.ui.draw import read_large
from pigaming_app.ui.input.controls import Controls
from tests.scenes.arcade import Arcade


@pytest.fixture(autouse=True)
def _usual_text() -> Iterator[None]:
    """Texts of the usual size, also after tests that press their way through the options."""
    read_large(False)
    yield
    read_large(False)


@pytest.fixture
def language() -> str:
    """The language of `arcade`: English, or the one for which a test is parametrised."""
    return "en"


@pytest.fixture
def arcade(controls: Controls, home: Path, language: str) -> Iterator[Arcade]:
    """An arcade with folders of its own, `home`; its pads are unplugged in the end."""
    arcade = Arcade(controls, language)
    yield arcade
    for pad in arcade.pads:
        pad.unplug()


@pytest.fixture
def _nothing_prewarmed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Matches begin at once."""
    monkeypatch.setattr(MatchRunner, "prewarm", lambda runner, milliseconds: True)
