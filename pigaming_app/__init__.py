"""PiGaming: a mixed-reality robot arcade, and the simulator in which its AI opponents are trained."""

import sys
from pathlib import Path

__version__ = "2.1.0"

_PACKAGE = Path(__file__).resolve().parent
ROOT = _PACKAGE.parent  # working directory for `python -m pigaming_app.…`
FROZEN = bool(getattr(sys, "frozen", False))  # in a bundle, which has its own interpreter
INSTALLED = (
    not FROZEN and (_PACKAGE / "assets").is_dir()
)  # a wheel has the assets inside the package, a clone next to it
ASSETS = (_PACKAGE if INSTALLED else ROOT) / "assets"
