"""The five levels of PiTanks: one network with handicaps.

All see others late and beside where they are, as people do, and save shots. Weaker levels see later, aim worse and
drive more slowly. The best is the most sparing of shots, since it needs fewest. No level skips decisions, which would
look like a machine that hangs. The network alone is `net`: no person beats it.
"""

from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.networks.policy import Handicap

NETWORK = "pitanks"  # file in assets/brains
HANDICAPS = (
    Handicap(delay=0.48, error=0.375, thrift=0.81, speed=0.38),
    Handicap(delay=0.42, error=0.27, thrift=0.785, speed=0.42),
    Handicap(delay=0.375, error=0.21, thrift=0.76, speed=0.49),
    Handicap(delay=0.33, error=0.15, thrift=0.76, speed=0.59),
    Handicap(delay=0.30, error=0.14, thrift=0.82),
)
LEVELS = tuple(
    shipped_brain(f"level{number}", "pitanks", NETWORK, handicap) for number, handicap in enumerate(HANDICAPS, start=1)
)
NET = shipped_brain("net", "pitanks", NETWORK)
