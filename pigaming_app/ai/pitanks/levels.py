"""The five levels of PiTanks: one network with handicaps.

All see others late and beside where they are, as people do. Weaker levels drive more slowly and save more shots, so that
they look like beginners. No level skips decisions, which would look like a machine that hangs. The network alone is
`net`: no person beats it.
"""

from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.networks.policy import Handicap

NETWORK = "pitanks"  # file in assets/brains
HANDICAPS = (
    Handicap(delay=0.4, error=0.3, sharpness=0.86, thrift=0.59, speed=0.4),
    Handicap(delay=0.4, error=0.3, sharpness=0.86, thrift=0.535, speed=0.528),
    Handicap(delay=0.4, error=0.3, sharpness=0.86, thrift=0.508, speed=0.668),
    Handicap(delay=0.39, error=0.3, sharpness=0.86, thrift=0.487, speed=0.828),
    Handicap(delay=0.38, error=0.3, sharpness=0.86, thrift=0.467, speed=0.985),
)
LEVELS = tuple(
    shipped_brain(f"level{number}", "pitanks", NETWORK, handicap) for number, handicap in enumerate(HANDICAPS, start=1)
)
NET = shipped_brain("net", "pitanks", NETWORK)
