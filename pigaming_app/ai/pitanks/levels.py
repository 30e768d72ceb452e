"""The five levels of PiTanks: one network with handicaps.

Weaker levels see others later and beside where they are, choose less surely, and are more sparing of shots. No level
skips decisions, which would look like a machine that hangs.
"""

from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.networks.policy import Handicap

NETWORK = "pitanks"  # file in assets/brains
HANDICAPS = (
    Handicap(delay=0.35, error=0.20, sharpness=0.6, thrift=0.33),
    Handicap(delay=0.30, error=0.15, sharpness=0.8, thrift=0.25),
    Handicap(delay=0.20, error=0.10, sharpness=1.0, thrift=0.18),
    Handicap(delay=0.10, error=0.05, sharpness=1.0, thrift=0.10),
    Handicap(),
)
LEVELS = tuple(
    shipped_brain(f"level{number}", "pitanks", NETWORK, handicap) for number, handicap in enumerate(HANDICAPS, start=1)
)
