"""The AIs of Robot Race by name, and the driving styles with steering help.

The five levels are four drivers by hand and a network. Neighbours win about a quarter and three quarters of their
duels. Over a whole race the better driver would win nearly always, since robots do not slip. What makes it open is the
form of the day, which varies more the lower the level. The lower levels also drive wider lines, start later, miss
braking points, and see pads, boxes and oil later.
"""

from pigaming_app.ai.brain.driving import point_where_to_go, turn_and_drive
from pigaming_app.ai.game_ai import HELPED_POINT, HELPED_TURN, ONE_BUTTON, POINT, TURN, GameAI
from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.race.racer import HAND1, HAND2, HAND3, Driver, racer
from pigaming_app.ai.race.steering_help import with_help

NETWORK = "race"  # in assets/brains
HAND_WRITTEN = (
    Driver(
        form=0.166,
        line=0.95,
        spread=13.0,
        boost=0.15,
        delay=0.3,
        reaction=(5, 35),
        care=0.03,
        mistakes=0.01,
        foresight=190.0,
        alert=0.08,
    ),
    Driver(
        form=0.133,
        line=1.0,
        spread=7.0,
        boost=0.15,
        delay=0.2,
        reaction=(5, 25),
        care=0.02,
        mistakes=0.01,
        foresight=240.0,
        alert=0.18,
    ),
    Driver(
        form=0.095,
        line=1.0,
        spread=4.0,
        boost=0.15,
        delay=0.1,
        reaction=(2, 20),
        care=0.02,
        mistakes=0.0,
        foresight=290.0,
        alert=0.35,
    ),
    Driver(
        form=0.058,
        line=1.0,
        spread=3.5,
        boost=0.12,
        delay=0.05,
        reaction=(2, 20),
        care=0.02,
        mistakes=0.0,
        foresight=380.0,
        alert=1.0,
    ),
)
LEVELS = (
    *(racer(f"level{n}", driver) for n, driver in enumerate(HAND_WRITTEN, start=1)),
    shipped_brain("level5", "race", NETWORK, handicap={"sharpness": 4.0, "form": 0.052, "delay": 0.35, "error": 0.2}),
)

AI = GameAI(
    {kind.name: kind for kind in (HAND1, HAND2, HAND3, *LEVELS)},
    driving={
        TURN: turn_and_drive,
        POINT: point_where_to_go,
        HELPED_TURN: with_help(turn_and_drive),
        HELPED_POINT: with_help(point_where_to_go),
        ONE_BUTTON: turn_and_drive,
    },
    boosts=True,
)
