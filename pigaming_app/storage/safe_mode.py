"""Safe mode, after failed starts: screens, phones and plug-ins have defaults, whatever files and options contain."""

import os

VARIABLE = "PIGAMING_SAFE_MODE"  # of the environment, set by a supervisor
DEFAULTS = (
    "display",
    "fullscreen",
    "corners",
    "scoreboard",
    "phones",
    "phones_network",
    "phones_port",
    "desk",
)  # settings


def is_safe() -> bool:
    """True in safe mode."""
    return VARIABLE in os.environ
