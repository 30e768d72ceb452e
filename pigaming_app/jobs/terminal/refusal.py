"""Refusals of jobs: a request that cannot be carried out ends in one line and exit code 2."""

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from pigaming_app import FROZEN, INSTALLED
from pigaming_app.links import installing
from pigaming_app.storage.messages import OperatorError
from pigaming_app.storage.optional import optional
from pigaming_app.ui.i18n import english

EXTRAS = {  # a module, and the package's name
    "events": ("PIL", "Pillow"),
    "hardware": ("cv2", "OpenCV"),
    "onnx": ("onnxruntime", "onnxruntime"),
    "phones": ("aiohttp", "aiohttp"),
    "plots": ("matplotlib", "matplotlib"),
    "ray": ("ray", "Ray"),
    "train": ("numba", "numba"),
    "bundle": ("PyInstaller", "PyInstaller"),
    "bench": ("pymunk", "pymunk"),
}
PLUGINS = "pigaming_app.storage.plugins.parts"  # imported by jobs that may play games
NOT_BUNDLED = "this bundle was built without it; a clone of the project fetches it"
FETCHED = "connect this machine to the internet and start main.py again, which installs it"


class Refusal(Exception):
    """A request that cannot be carried out; the text is one line."""


def module_of(place: str, named: str) -> Any:
    """A module below `jobs`. Raises Refusal with this name if a feature that it needs is not in this installation."""
    try:
        return import_module(f"pigaming_app.jobs.{place}")
    except ModuleNotFoundError as missing:
        if not (missing.name or "").startswith("pigaming_app."):
            raise
        raise Refusal(f"{named} is not part of this installation") from None


@contextmanager
def refused(*errors: type[Exception]) -> Iterator[None]:
    """Within this context, errors of these classes become a Refusal with the same text."""
    try:
        yield
    except errors as error:
        raise Refusal(sentence(error)) from None


def sentence(error: Exception) -> str:
    """The text of an error; hardware errors carry a key, whose English sentence this is."""
    return english().long_sentence(error.message) if isinstance(error, OperatorError) else str(error)


def is_of_plugin(error: BaseException) -> bool:
    """True if an error is due to a plug-in, which is left out with one line on standard error."""
    if PLUGINS not in sys.modules:
        return False
    from pigaming_app.ai.plugin_faults import blame, suspect  # late: most jobs end without an error

    return bool(blame(error) or (isinstance(error, Exception) and suspect(error, failures=1)))


def names_failed_plugin(games: str) -> bool:
    """True if one of some games, `race,tag`, is a plug-in's that has failed; a line on standard error has told it."""
    if PLUGINS not in sys.modules:
        return False
    from pigaming_app.games.registry import OURS  # late, as above
    from pigaming_app.storage.plugins.parts import has_failed

    return any(has_failed(game) for game in games.split(",") if game not in OURS)


def require(extra: str) -> None:
    """Raises Refusal where an extra of the package is not installed, with the way to install it."""
    if lacks := missing(extra):
        raise Refusal(lacks)


def missing(extra: str) -> str:
    """One line that says that an extra is missing, with the way to install it; empty if it is installed."""
    module, name = EXTRAS[extra]
    return "" if find_spec(module) else f"{name} is missing (extra `{extra}`): {remedy(extra)}"


def require_for_brains(names: Iterable[str], play: bool = True) -> None:
    """Raises Refusal where a brain is an ONNX model and the extra that runs it is not installed.

    `play`: without a window; then bots have to connect, which is waited for.
    """
    asked = list(names)
    if any(name.lower().endswith(".onnx") for name in asked):
        require("onnx")
    bots = [name for name in asked if name.startswith("bot:")]
    programs = optional("jobs.bots.connect") if bots else None
    if programs:
        (programs.connect if play else programs.require_open)(bots)


def remedy(extra: str) -> str:
    """How to install an extra: `main.py` does it in a clone, pip in an installed package; a bundle stays as it is."""
    if FROZEN:
        return NOT_BUNDLED
    return installing(extra) if INSTALLED else FETCHED
