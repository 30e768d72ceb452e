"""The AIs of Robot Race by name, and the driving styles with steering help.

The five levels are one driver by hand, set against models of people (`ai/people`), who are much slower than it could
be. Over a whole race the better driver would win nearly always, since robots do not slip. What makes it open is
form, which comes and goes. The lower levels also drive wider lines, start later, miss braking points, and see pads,
boxes and oil later. The network alone is `net`.
"""

from functools import partial

from pigaming_app.ai.brain.driving import helped, point_where_to_go, turn_and_drive
from pigaming_app.ai.game_ai import HELPED_POINT, HELPED_TURN, ONE_BUTTON, POINT, TURN, GameAI
from pigaming_app.ai.game_ai import LEVELS as NAMES
from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.race.racer import HAND1, HAND2, HAND3, Driver, lead, person, racer
from pigaming_app.ai.race.steering_help import HELP, helped_stick

NETWORK = "race"  # in assets/brains
driver = partial(Driver, form=0.15, spell=0.45, boost=0.15, reaction=(5, 30), care=0.03)
DRIVERS = (
    driver(speed=0.62, line=0.9, spread=12.0, delay=0.3, mistakes=0.01, foresight=190.0, alert=0.08),
    driver(speed=0.725, form=0.2, line=0.95, spread=10.0, delay=0.3, mistakes=0.01, foresight=210.0, alert=0.1),
    driver(speed=0.78, line=0.95, spread=8.0, delay=0.2, mistakes=0.01, foresight=240.0, alert=0.18),
    driver(speed=0.875, line=1.0, spread=6.0, delay=0.1, mistakes=0.0, foresight=290.0, alert=0.35),
    driver(speed=1.0, line=1.0, spread=4.0, delay=0.05, mistakes=0.0, foresight=380.0, alert=1.0),
)
EASIEST = driver(speed=0.28, line=0.85, spread=14.0, delay=0.3, mistakes=0.01, foresight=180.0, alert=0.05)
HARDEST = driver(
    form=0.005, spell=0.01, care=0.02, line=1.0, spread=2.0, delay=0.05, mistakes=0.0, foresight=400.0, alert=1.0
)
LEVELS = tuple(racer(f"level{number}", driver) for number, driver in enumerate(DRIVERS, start=1))
NET = shipped_brain("net", "race", NETWORK, handicap={"sharpness": 4.0})

AI = GameAI(
    {kind.name: kind for kind in (HAND1, HAND2, HAND3, NET, *LEVELS)},
    rivals=(*NAMES, "net"),
    driving={
        TURN: turn_and_drive,
        POINT: point_where_to_go,
        HELPED_TURN: helped(turn_and_drive, helped_stick),
        HELPED_POINT: helped(point_where_to_go, helped_stick),
        ONE_BUTTON: turn_and_drive,
    },
    boosts=True,
    auto=(racer("easiest", EASIEST), racer("hardest", HARDEST)),
    lead=lead,
    person=person,
    help=HELP,
    chauffeur="hand3",
)
