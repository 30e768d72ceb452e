"""The numbers of the rules that a player should know, as texts: how long a match may last, protection, turbo."""

from collections.abc import Callable
from typing import Any

from pigaming_app.games import GAMES
from pigaming_app.games.factory.start import set_rules as factory_rules
from pigaming_app.games.factory.state import Rules as FactoryRules
from pigaming_app.games.game import Game, Seat, Setup
from pigaming_app.games.pitanks.start import set_rules as pitanks_rules
from pigaming_app.games.pitanks.state import Rules as PiTanksRules
from pigaming_app.games.race.start import set_rules as race_rules
from pigaming_app.games.race.state import Rules as RaceRules
from pigaming_app.sim.world import DT, HZ
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import Words

FIRES = {"pitanks": "hint_fire", "factory": "hint_lift"}  # text of what FIRE does, in games in which it does something
RULES: dict[str, tuple[Callable[[], Any], Callable[[Any, Setup], None]]] = {
    "pitanks": (PiTanksRules, pitanks_rules),
    "factory": (FactoryRules, factory_rules),
    "race": (RaceRules, race_rules),
}


def limits_line(words: Words, game: str, minutes: float) -> str:
    """One line for the page of a game whose matches last `minutes` at most."""
    return words(f"howto.limits_{game}", **rule_numbers(game, minutes, GAMES[game].variants[0]))


def tagline(words: Words, game: str, goal: int) -> str:
    """The line under a game's name; that of the race says how many laps it has."""
    return words("games.race_line_one" if game == "race" and goal == 1 else f"games.{game}_line", n=goal)


def last_goal(settings: Settings, game: str) -> int:
    """The laps or pallets that were chosen last."""
    goal, rules = settings.choice(game).goal, GAMES[game]
    return goal if goal in rules.goals else rules.default_goal


def last_minutes(settings: Settings, game: str) -> int:
    """The minutes that were chosen last."""
    minutes, rules = settings.choice(game).minutes, GAMES[game]
    return minutes if minutes in rules.minutes else rules.default_minutes


def match_length(words: Words, game: Game, minutes: float, goal: int) -> str:
    """How long a match is: its laps or pallets, or its minutes."""
    return words(f"setup.count_{game.goal}", count=goal) if game.goal else words("setup.min", minutes=f"{minutes:g}")


def rule_numbers(game: str, minutes: float, variant: str) -> dict[str, str]:
    """The numbers by the names they have in texts."""
    make, set_rules = RULES[game]
    rules, nobody = make(), Seat("off", 0)
    seats = nobody, nobody, nobody, nobody
    set_rules(rules, Setup(game, "", seats, minutes, 1, variant, GAMES[game].default_goal))
    found = {
        "minutes": rules.ticks * DT / 60.0,
        "protection": getattr(rules, "protection", 0) * DT,
        "patience": getattr(rules, "patience", 0) * DT,
        "turbo": 1.0 / (rules.turbo_drain * HZ),
        "refill": 1.0 / (rules.turbo_refill * HZ),
    }
    return {name: f"{round(4 * value) / 4:g}" for name, value in found.items()}  # to the quarter of a second
