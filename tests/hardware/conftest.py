"""A MicroPython for the emulated boards. Without the extra `hardware`, none of these tests runs."""

from collections.abc import Iterator
from importlib.util import find_spec

import pytest

from pigaming_app.hardware.emulator.wifi.boards import NoMicroPython, interpreter
from tests.hardware.emulator.one_board import Arcade

collect_ignore_glob = [] if find_spec("cv2") and find_spec("serial") else ["*/test_*.py"]


@pytest.fixture(scope="session")
def micropython() -> None:
    """Skip the test if MicroPython cannot be run here."""
    try:
        interpreter()
    except NoMicroPython as reason:
        pytest.skip(str(reason))


@pytest.fixture
def arcade(request: pytest.FixtureRequest, micropython: None) -> Iterator[Arcade]:
    """An arcade and its board; `param`: the board."""
    arcade = Arcade(**getattr(request, "param", {}))
    yield arcade
    arcade.close()
