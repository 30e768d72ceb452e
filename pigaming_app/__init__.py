"""PiGaming: a mixed-reality robot arcade, and the simulator in which its opponents learn."""

from pathlib import Path

__version__ = "1.4.0"

ASSETS = Path(__file__).resolve().parent.parent / "assets"
