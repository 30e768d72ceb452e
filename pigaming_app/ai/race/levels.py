"""The five levels of Robot Race: four drivers by hand and a network.

Neighbours win about a quarter and three quarters of their duels. Over a whole race the better driver would win nearly
always, since robots do not slip. What makes it open is the form of the day, which varies more the lower the level. The
lower levels also drive wider lines, start later, miss braking points, and see pads, boxes and oil later.
"""

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.networks.policy import Handicap
from pigaming_app.ai.race.racer import RacerMind, make_reset, think
from pigaming_app.ai.race.racer_thoughts import explain

NETWORK = "race"  # in assets/brains


def driver(
    name: str,
    form: float,
    line: float,
    spread: float,
    boost: float,
    delay: float,
    reaction: tuple[int, int],
    care: float,
    mistakes: float,
    foresight: float,
    alert: float,
) -> BrainKind:
    """A driver by hand who reaches full speed on a good day; the parameters are those of `make_reset`."""
    reset = make_reset(1.0, form, line, spread, boost, delay, reaction, care, mistakes, foresight, alert)
    return BrainKind(name, RacerMind, think, reset, explain=explain)


LEVELS = (
    driver("level1", 0.165, 0.95, 13.0, 0.15, 0.3, (5, 35), 0.03, 0.01, 200.0, 0.1),
    driver("level2", 0.133, 1.0, 7.0, 0.15, 0.2, (5, 25), 0.02, 0.01, 240.0, 0.18),
    driver("level3", 0.095, 1.0, 4.0, 0.15, 0.1, (2, 20), 0.02, 0.0, 300.0, 0.4),
    driver("level4", 0.055, 1.0, 3.0, 0.12, 0.05, (2, 20), 0.02, 0.0, 340.0, 0.8),
    shipped_brain("level5", "race", NETWORK, Handicap(sharpness=4.0, form=0.034)),
)
