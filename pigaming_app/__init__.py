"""PiGaming: a mixed-reality robot arcade, and the simulator in which its opponents learn."""

from pathlib import Path

__version__ = "1.5.0"

_PACKAGE = Path(__file__).resolve().parent
ROOT = _PACKAGE.parent  # the working directory in which `python -m pigaming_app.…` finds this package
INSTALLED = (_PACKAGE / "assets").is_dir()  # a wheel has the assets inside the package, a clone beside it
ASSETS = (_PACKAGE if INSTALLED else ROOT) / "assets"
