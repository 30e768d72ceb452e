"""A MicroPython for the emulated boards."""

import pytest

from pigaming_app.hardware.emulator.wifi.boards import NoMicroPython, interpreter


@pytest.fixture(scope="session")
def micropython() -> None:
    """Skip the test if MicroPython cannot be run here."""
    try:
        interpreter()
    except NoMicroPython as reason:
        pytest.skip(str(reason))
