"""Modules of features, any of which may be missing."""

from importlib import import_module
from importlib.util import find_spec
from typing import Any

PACKAGE = "pigaming_app"


def is_there(room: str) -> bool:
    """True if a package or module of PiGaming, such as `scenes.lab`, can be imported, as far as its file goes."""
    try:
        return find_spec(f"{PACKAGE}.{room}") is not None
    except ModuleNotFoundError:  # its package
        return False


def optional(room: str) -> Any:
    """A module of PiGaming by its place, or None if it is missing. A mistake in it is raised."""
    return import_module(f"{PACKAGE}.{room}") if is_there(room) else None
