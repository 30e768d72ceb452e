"""Fixtures of tests of the editor: people who draw."""

import pytest

from tests.scenes.arcade import Arcade
from tests.scenes.editor.artist import Artist, Gamer, Mouse, Typist


@pytest.fixture(params=["keys", "mouse", "pad"])
def artist(request: pytest.FixtureRequest, arcade: Arcade) -> Artist:
    if request.param == "pad":
        return Gamer(arcade, arcade.plug()[0])
    return Typist(arcade) if request.param == "keys" else Mouse(arcade)


@pytest.fixture
def mouse(arcade: Arcade) -> Mouse:
    return Mouse(arcade)
