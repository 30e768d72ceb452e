"""Fixtures of tests of the editor: people who draw."""

from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from tests.scenes.arcade import Arcade
from tests.scenes.editor.artist import Artist, Gamer, Mouse, Typist
from tests.ui.input.virtual_pad import VirtualPad


@pytest.fixture(params=["keys", "mouse", "pad"])
def artist(request: pytest.FixtureRequest, arcade: Arcade) -> Iterator[Artist]:
    with ExitStack() as stack:
        if request.param == "pad":
            pad = stack.enter_context(VirtualPad())
            arcade.frame()
            yield Gamer(arcade, pad)
        else:
            yield Typist(arcade) if request.param == "keys" else Mouse(arcade)


@pytest.fixture
def mouse(arcade: Arcade) -> Mouse:
    return Mouse(arcade)
