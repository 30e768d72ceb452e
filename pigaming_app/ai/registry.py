"""Registry of all brains by game and name, and the levels that the lobby offers.

The registry also attaches each brain's `explain`, so that no brain imports its own explanation.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from pigaming_app.ai.brain import baselines
from pigaming_app.ai.brain.archive import BrainFileError
from pigaming_app.ai.brain.driving import Controller, Driving, point_where_to_go, turn_and_drive
from pigaming_app.ai.brain.kind import BrainKind, BrainPlayer, HumanPlayer, OneButtonPlayer
from pigaming_app.ai.brain_files import is_path, read_brain
from pigaming_app.ai.factory import foreman, foreman_thoughts
from pigaming_app.ai.factory import levels as factory_levels
from pigaming_app.ai.pitanks import classic, classic_thoughts, fsm, fsm_thoughts, gunner, gunner_thoughts
from pigaming_app.ai.pitanks import levels as pitanks_levels
from pigaming_app.ai.qlearning import table_files
from pigaming_app.ai.race import levels as race_levels
from pigaming_app.ai.race import racer, racer_thoughts
from pigaming_app.ai.race.steering_help import with_help
from pigaming_app.games.game import Setup
from pigaming_app.games.match import Match
from pigaming_app.games.setup import ChoiceError, require_one_of
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.plant import Plant, SimPlant
from pigaming_app.sim.world import ROBOTS

KINDS: dict[str, dict[str, BrainKind]] = {
    "pitanks": {
        "idle": baselines.IDLE,
        "random": baselines.RANDOM,
        "hand1": replace(gunner.HAND1, explain=gunner_thoughts.explain),
        "hand2": replace(gunner.HAND2, explain=gunner_thoughts.explain),
        "hand3": replace(gunner.HAND3, explain=gunner_thoughts.explain),
        "fsm": replace(fsm.FSM, explain=fsm_thoughts.explain),
        "classic": replace(classic.CLASSIC, explain=classic_thoughts.explain),
        "q1": table_files.shipped_brain("q1"),
        "q2": table_files.shipped_brain("q2"),
        "net": pitanks_levels.NET,
        **{level.name: level for level in pitanks_levels.LEVELS},
    },
    "factory": {
        "idle": baselines.IDLE,
        "random": baselines.RANDOM,
        "hand1": replace(foreman.HAND1, explain=foreman_thoughts.explain),
        "hand2": replace(foreman.HAND2, explain=foreman_thoughts.explain),
        "hand3": replace(foreman.HAND3, explain=foreman_thoughts.explain),
        **{level.name: replace(level, explain=foreman_thoughts.explain) for level in factory_levels.LEVELS},
    },
    "race": {
        "idle": baselines.IDLE,
        "random": baselines.RANDOM,
        "hand1": replace(racer.HAND1, explain=racer_thoughts.explain),
        "hand2": replace(racer.HAND2, explain=racer_thoughts.explain),
        "hand3": replace(racer.HAND3, explain=racer_thoughts.explain),
        **{level.name: level for level in race_levels.LEVELS},
    },
}

LEVELS = ("level1", "level2", "level3", "level4", "level5")  # in every game; one to five stars on the screen
NAMED_LEVELS = {"easy": "level1", "normal": "level3", "hard": "level5"}
BRAINS = {
    game: {**kinds, **{name: kinds[level] for name, level in NAMED_LEVELS.items()}} for game, kinds in KINDS.items()
}  # by game; three of the levels answer to a second name
RIVALS: dict[str, tuple[str, ...]] = {  # AI opponents offered in the lobby, in the order in which it steps through them
    "pitanks": (*LEVELS, "q1", "q2", "fsm"),
    "factory": LEVELS,
    "race": LEVELS,
}

TURN, POINT = "turn", "point"
HELPED_TURN, HELPED_POINT = "helped_turn", "helped_point"  # with steering help
ONE_BUTTON = "one_button"  # an AI drives, see `make_person`; its entries below show a stick on pages without a match
CHAUFFEURS = {"pitanks": "level3", "factory": "level3", "race": "level3"}  # the AI that drives for one button
DRIVING: dict[str, dict[str, Driving]] = {  # driving styles for people, in the order in which the lobby steps through
    "pitanks": {TURN: turn_and_drive, POINT: point_where_to_go, ONE_BUTTON: turn_and_drive},
    "factory": {TURN: turn_and_drive, POINT: point_where_to_go, ONE_BUTTON: turn_and_drive},
    "race": {
        TURN: turn_and_drive,
        POINT: point_where_to_go,
        HELPED_TURN: with_help(turn_and_drive),
        HELPED_POINT: with_help(point_where_to_go),
        ONE_BUTTON: turn_and_drive,
    },
}


def is_brain(game: str, name: str) -> bool:
    """True for a registered name and for the path of a file."""
    return name in BRAINS.get(game, {}) or is_path(name)


def find_brain(game: str, name: str) -> BrainKind:
    """The brain of a registered name, or of the path of a file. Raises ChoiceError."""
    kinds = BRAINS.get(game, {})
    if name in kinds or not is_path(name):
        require_one_of("brain", name, list(kinds))
        return kinds[name]
    try:
        return read_brain(game, name)
    except BrainFileError as error:
        raise ChoiceError(str(error)) from None


def known_brains(game: str, wanted: Sequence[str]) -> list[str]:
    """The registered names of a game, and the paths among the `wanted` names. Raises ChoiceError for unusable files."""
    kinds = BRAINS.get(game, {})
    paths = [name for name in dict.fromkeys(wanted) if kinds and name not in kinds and is_path(name)]
    for path in paths:
        find_brain(game, path)
    return [*kinds, *paths]


def level_of(brain: str) -> int:
    """The level, 1 to 5, for which a brain is named; 0 if its name is that of no level."""
    name = NAMED_LEVELS.get(brain, brain)
    return LEVELS.index(name) + 1 if name in LEVELS else 0


def make_brain(game: str, name: str, seed: int) -> BrainPlayer:
    """A player with the brain `name` of `game`. Raises ChoiceError."""
    return BrainPlayer(find_brain(game, name), seed)


def make_person(game: str, style: str, read: Callable[[], Controller], seed: int) -> HumanPlayer | OneButtonPlayer:
    """A person who drives in a style, one of `DRIVING[game]`; `read` polls the device."""
    if style != ONE_BUTTON:
        return HumanPlayer(read, DRIVING[game][style])
    return OneButtonPlayer(read, make_brain(game, CHAUFFEURS[game], seed), boosts=game == "race")


def new_match(setup: Setup, plant: Plant | Callable[[Any], Plant] = SimPlant, arena: Arena | None = None) -> Match:
    """A match with an AI player on every seat that names a brain; all other seats stay idle. Raises ChoiceError.

    `arena`: in place of that of the setup.
    """
    match = Match(setup, plant, arena)
    for i, seat in enumerate(setup.seats):
        if is_brain(setup.game, seat.brain):
            match.sit(i, make_brain(setup.game, seat.brain, setup.seed * ROBOTS + i))
    return match
