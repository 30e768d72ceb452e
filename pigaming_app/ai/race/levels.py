"""The five levels of Robot Race: four drivers by hand and a network.

Neighbours win about a quarter and three quarters of their duels. Over a whole race the better driver would win nearly
always, since robots do not slip. What makes it open is the form of the day, which varies more the lower the level. The
lower levels also drive wider lines, start later, miss braking points, and see pads, boxes and oil later.
"""

from dataclasses import replace

from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.networks.policy import Handicap
from pigaming_app.ai.race.racer import Driver, racer
from pigaming_app.ai.race.racer_thoughts import explain

NETWORK = "race"  # in assets/brains
HAND_WRITTEN = (
    Driver(0.165, 0.95, 13.0, 0.15, 0.3, (5, 35), 0.03, 0.01, 200.0, 0.1),
    Driver(0.133, 1.0, 7.0, 0.15, 0.2, (5, 25), 0.02, 0.01, 240.0, 0.18),
    Driver(0.095, 1.0, 4.0, 0.15, 0.1, (2, 20), 0.02, 0.0, 300.0, 0.4),
    Driver(0.055, 1.0, 3.0, 0.12, 0.05, (2, 20), 0.02, 0.0, 340.0, 0.8),
)
LEVELS = (
    *(replace(racer(f"level{n}", driver), explain=explain) for n, driver in enumerate(HAND_WRITTEN, start=1)),
    shipped_brain("level5", "race", NETWORK, Handicap(sharpness=4.0, form=0.034)),
)
