"""The five levels of PiTanks: one network with handicaps.

All see others late and beside where they are, as people do; weaker levels later, and they are more sparing of shots. No
level skips decisions, which would look like a machine that hangs. The network alone is `net`: no person beats it.
"""

from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.networks.policy import Handicap

NETWORK = "pitanks"  # file in assets/brains
HANDICAPS = (
    Handicap(delay=0.40, error=0.10, thrift=0.85),
    Handicap(delay=0.40, error=0.10, thrift=0.75),
    Handicap(delay=0.36, error=0.10, thrift=0.64),
    Handicap(delay=0.33, error=0.10, thrift=0.53),
    Handicap(delay=0.30, error=0.10, thrift=0.41),
)
LEVELS = tuple(
    shipped_brain(f"level{number}", "pitanks", NETWORK, handicap) for number, handicap in enumerate(HANDICAPS, start=1)
)
NET = shipped_brain("net", "pitanks", NETWORK)
