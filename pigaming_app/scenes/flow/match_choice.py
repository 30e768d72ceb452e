"""The playable arenas, and the match options, initially those of the last match."""

import logging
from collections.abc import Iterator
from functools import lru_cache

from pigaming_app.games.arenas import arenas, default_goal, own_arenas, score_name, shipped_arenas
from pigaming_app.games.game import Game
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_words import match_length
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.storage.settings import Choice, Settings

KIOSK_RULES = "party"  # rule set that a kiosk offers at first, in the games that have it

log = logging.getLogger(__name__)


def playable_arenas(game: str) -> tuple[str, ...]:
    """The arenas of a game with valid files, the user's own last; errors of the others are logged."""
    return *shipped_playable(game), *own_arenas(game)


def arena_of_table(game: str, name: str) -> str:
    """The arena of a high-score table, by its name there; empty if there is none any more."""
    return next((arena for arena in playable_arenas(game) if score_name(game, arena) == name), "")


@lru_cache(maxsize=4)
def shipped_playable(game: str) -> tuple[str, ...]:
    """The arenas with valid files that come with a game."""
    return tuple(_playable(game))


@lru_cache(maxsize=16)
def first_arena(game: str) -> str:
    """The first of them, without loading the others."""
    return next(_playable(game))


def _playable(game: str) -> Iterator[str]:
    return (name for name in shipped_arenas(game) if _is_playable(game, name))


def _is_playable(game: str, name: str) -> bool:
    try:
        load_cached(game, name)
    except ArenaError as trouble:
        log.warning("%s", trouble)
        return False
    return True


def arena_title(arena: Arena, language: str) -> str:
    """An arena's title in a language, else in English."""
    return arena.title.get(language, arena.title.get("en", arena.name))


def last_choice(context: Context, game: str) -> Choice:
    """The options of the last match, or the game's defaults where those are no longer available. Loads one arena."""
    rules, last = games()[game], context.settings.choice(game)
    variant = rules.variants.get(last.variant, rules.default)
    there = last.arena in arenas(game) and _is_playable(game, last.arena)
    arena = last.arena if there else first_arena(game)
    rounds = last.rounds if last.rounds in rules.rounds else rules.rounds[0]
    choice = Choice(arena=arena, minutes=last.minutes, variant=variant.name, goal=last.goal, rounds=rounds)
    fit_choice(rules, choice)
    return choice


def change_arena(game: Game, choice: Choice, name: str) -> None:
    """Choose an arena; the goal changes to its default where that differs from that of the one before."""
    before, after = (default_goal(game.name, choice.variant, arena) for arena in (choice.arena, name))
    choice.arena = name
    if after != before:
        choice.goal = after


def fit_choice(game: Game, choice: Choice) -> None:
    """Set the minutes and the goal to the defaults of rules and arena where these do not offer the chosen ones."""
    variant = game.variants[choice.variant]
    if choice.minutes not in variant.minutes:
        choice.minutes = variant.default_minutes
    if choice.goal not in variant.goals:
        choice.goal = default_goal(game.name, variant.name, choice.arena)


def change_rules(game: Game, choice: Choice, name: str) -> None:
    """Choose a rule set; minutes and goal change to its defaults where these differ from those of the one before."""
    before, after = game.variants.get(choice.variant, game.default), game.variants[name]
    choice.variant = name
    if after.default_minutes != before.default_minutes:
        choice.minutes = after.default_minutes
    goals = [default_goal(game.name, rules.name, choice.arena) for rules in (before, after)]
    if goals[1] != goals[0]:
        choice.goal = goals[1]
    fit_choice(game, choice)


def choose_kiosk_rules(settings: Settings) -> None:
    """Choose the rule set of kiosks in every game that has it, unless another one was chosen."""
    for game in games().values():
        if KIOSK_RULES in game.variants and not settings.choice(game.name).variant:
            change_rules(game, settings.choice(game.name), KIOSK_RULES)
    settings.leave_choices_unsaved()


def choice_summary(context: Context, game: str) -> str:
    """Game, minutes, goal or rounds, and arena in one line."""
    words, choice = context.words, last_choice(context, game)
    arena = arena_title(load_cached(game, choice.arena), words.language)
    length = match_length(words, games()[game], choice.minutes, choice.goal)
    if choice.rounds > 1:
        length = words("setup.count_rounds", count=choice.rounds)
    return "  ·  ".join((words(f"games.{game}"), length, arena))
