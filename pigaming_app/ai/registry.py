"""Registry of all brains by game and name, and the players that a match seats."""

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

from pigaming_app.ai.brain.archive import BrainFileError
from pigaming_app.ai.brain.driving import Controller
from pigaming_app.ai.brain.effort import between
from pigaming_app.ai.brain.kind import BrainKind, BrainPlayer, HumanPlayer, OneButtonPlayer
from pigaming_app.ai.brain_files import is_path, read_brain
from pigaming_app.ai.game_ai import LEVELS, ONE_BUTTON, RANDOM_ONLY, STAND_IN, GameAI
from pigaming_app.games.game import Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import OURS, games
from pigaming_app.games.setup import ChoiceError, require_one_of
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.plant import Plant, SimPlant
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.optional import optional
from pigaming_app.storage.plugins.parts import parts

AIS: Mapping[str, GameAI] = {
    **dict.fromkeys(games(), RANDOM_ONLY),
    **{game: optional(f"ai.{game}.brains").AI for game in OURS},
    **parts("ai", "AI", GameAI),
}  # by game
BRAINS: Mapping[str, Mapping[str, BrainKind]] = {game: ai.brains for game, ai in AIS.items()}


def every_brain(game: str) -> Mapping[str, BrainKind]:
    """The brains of a game by name, those of Auto, of people and bots among them; none of an unknown game."""
    return {**BRAINS.get(game, {}), **_auto(game), **_people(game), **_bots(game)}


@cache
def _auto(game: str) -> Mapping[str, BrainKind]:
    ai = AIS.get(game)
    return {kind.name: kind for kind in between(*ai.auto, ai.lead)} if ai and ai.auto else {}


@cache
def _people(game: str) -> Mapping[str, BrainKind]:
    models = optional("ai.people.models")
    return models.people(AIS[game]) if models and game in AIS else {}


def _bots(game: str) -> Mapping[str, BrainKind]:
    """Those of this computer now: they come and go while a program runs."""
    programs = optional("ai.bots.brains")
    return programs.bots(game, AIS[game]) if programs and game in AIS else {}


def is_brain(game: str, name: str) -> bool:
    """True for a registered name and for the path of a file."""
    return name in every_brain(game) or is_path(name)


def find_brain(game: str, name: str) -> BrainKind:
    """The brain of a registered name, or of the path of a file. Raises ChoiceError."""
    kinds = every_brain(game)
    if name in kinds or not is_path(name):
        require_one_of("brain", name, list(kinds))
        return kinds[name]
    try:
        return read_brain(game, name)
    except BrainFileError as error:
        raise ChoiceError(str(error)) from None


def known_brains(game: str, wanted: Sequence[str]) -> list[str]:
    """The registered names of a game, and the paths among the `wanted` names. Raises ChoiceError for unusable files."""
    kinds = every_brain(game)
    paths = [name for name in dict.fromkeys(wanted) if kinds and name not in kinds and is_path(name)]
    for path in paths:
        find_brain(game, path)
    return [*kinds, *paths]


def level_of(brain: str) -> int:
    """The level, 1 to 5, for which a brain is named; 0 if its name is that of no level."""
    return LEVELS.index(brain) + 1 if brain in LEVELS else 0


def make_brain(game: str, name: str, seed: int) -> BrainPlayer:
    """A player with the brain `name` of `game`. Raises ChoiceError."""
    return BrainPlayer(find_brain(game, name), seed)


def make_person(game: str, style: str, read: Callable[[], Controller], seed: int) -> HumanPlayer | OneButtonPlayer:
    """A person who drives in a style, one of `AIS[game].driving`; `read` polls the device."""
    if style != ONE_BUTTON:
        return HumanPlayer(read, AIS[game].driving[style])
    return OneButtonPlayer(read, make_brain(game, AIS[game].chauffeur, seed), AIS[game].boosts)


def new_match(setup: Setup, plant: Plant | Callable[[Any], Plant] = SimPlant, arena: Arena | None = None) -> Match:
    """A match with an AI player on every seat that names a brain; all other seats stay idle. Raises ChoiceError.

    `arena`: in place of that of the setup.
    """
    match = Match(setup, plant, arena)
    for i, seat in enumerate(setup.seats):
        gone = seat.brain.startswith("bot:") and not is_brain(setup.game, seat.brain)  # removed since it was chosen
        if brain := STAND_IN if gone else seat.brain if is_brain(setup.game, seat.brain) else "":
            match.sit(i, make_brain(setup.game, brain, setup.seed * ROBOTS + i))
    return match
