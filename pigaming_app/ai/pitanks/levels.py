"""The five levels of PiTanks: one network with handicaps.

All see others late and beside where they are, as people do, and save shots. Weaker levels see later, aim worse, drive
more slowly, choose less surely and save more. No level skips decisions, which would look like a machine that hangs. The
network alone is `net`: no person beats it.
"""

from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.networks.policy import Handicap

NETWORK = "pitanks"  # file in assets/brains
HANDICAPS = (
    Handicap(delay=0.45, error=0.3, sharpness=0.8, thrift=0.6, speed=0.42),
    Handicap(delay=0.38, error=0.3, sharpness=0.88, thrift=0.54, speed=0.51),
    Handicap(delay=0.36, error=0.3, sharpness=0.9, thrift=0.52, speed=0.69),
    Handicap(delay=0.32, error=0.265, thrift=0.52, speed=0.78),
    Handicap(delay=0.28, error=0.225, thrift=0.52, speed=0.87),
)
LEVELS = tuple(
    shipped_brain(f"level{number}", "pitanks", NETWORK, handicap) for number, handicap in enumerate(HANDICAPS, start=1)
)
NET = shipped_brain("net", "pitanks", NETWORK)
