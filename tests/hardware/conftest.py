"""A MicroPython for the emulated boards. Without the extra `hardware`, none of these tests runs."""

from importlib.util import find_spec

import pytest

from pigaming_app.hardware.emulator.wifi.boards import NoMicroPython, interpreter

collect_ignore_glob = [] if find_spec("cv2") and find_spec("serial") else ["*/test_*.py"]


@pytest.fixture(scope="session")
def micropython() -> None:
    """Skip the test if MicroPython cannot be run here."""
    try:
        interpreter()
    except NoMicroPython as reason:
        pytest.skip(str(reason))
