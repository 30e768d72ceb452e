"""The command that starts this program: from a clone, an installed package or a bundle."""

import sys
from collections.abc import Sequence

from pigaming_app import FROZEN, INSTALLED, ROOT


def own_command(words: Sequence[str], python: str = sys.executable, prepared: bool = True) -> list[str]:
    """The command with these words. `prepared`: `python` has the packages, so that main.py need not look for them."""
    if FROZEN:
        return [sys.executable, *words]
    if INSTALLED:
        return [python, "-m", "pigaming_app", *words]
    return [python, *(("-X", "pigaming") if prepared else ()), str(ROOT / "main.py"), *words]
