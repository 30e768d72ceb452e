"""Rules, AIs and devices in words: length, protection, turbo; levels as stars; what people steer with."""

from pigaming_app.ai.auto import NAME
from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.ai.brain_files import display_name
from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import AIS, level_of
from pigaming_app.games.arenas import default_goal
from pigaming_app.games.game import Game, Seat, Setup, Variant
from pigaming_app.games.registry import games
from pigaming_app.sim.world import DT, HZ
from pigaming_app.storage.optional import optional
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw.theme import STARS
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Device

LIT, UNLIT = STARS[0], STARS[1]


def limits_line(words: Words, game: str, minutes: float, variant: str) -> str:
    """The rule limits of a game whose matches last at most `minutes`, as one line."""
    numbers = rule_numbers(game, minutes, variant)
    magazine = words("howto.magazine", **numbers) + "  " if numbers["magazine"] != "0" else ""
    return magazine + words(f"howto.limits_{game}", **numbers)


def game_title(words: Words, game: str) -> str:
    """The name of a game, also of one that is not here: a plug-in that was removed or switched off."""
    key = f"games.{game}"
    return words(key) if key in words else game.replace("_", " ").title()


def tagline(words: Words, game: str, goal: int) -> str:
    """The line under a game's name; it may contain the goal, such as the number of laps."""
    return words.counted(f"games.{game}_line", goal, n=goal)


def last_goal(settings: Settings, game: str) -> int:
    """The laps or pallets of the last match."""
    choice, variant = settings.choice(game), last_variant(settings, game)
    if choice.goal in variant.goals:
        return choice.goal
    return default_goal(game, variant.name, choice.arena or games()[game].arena)


def last_minutes(settings: Settings, game: str) -> int:
    """The minutes of the last match."""
    choice, variant = settings.choice(game), last_variant(settings, game)
    return choice.minutes if choice.minutes in variant.minutes else variant.default_minutes


def last_variant(settings: Settings, game: str) -> Variant:
    """The rule set of the last match."""
    return games()[game].variants.get(settings.choice(game).variant, games()[game].default)


def sudden_death_key(game: str) -> str:
    """The key of the sentence that says what ends a sudden death."""
    return "events.first_lap" if games()[game].timed else "events.next_point"


def match_length(words: Words, game: Game, minutes: float, goal: int) -> str:
    """The length of a match: laps, pallets, or minutes."""
    return words(f"setup.count_{game.goal}", count=goal) if goal else words("setup.min", minutes=f"{minutes:g}")


def rule_numbers(game: str, minutes: float, variant: str) -> dict[str, str]:
    """The rule numbers by their placeholder names, in minutes or seconds."""
    empty, goal = Seat("off", 0), games()[game].variants[variant].default_goal
    rules = games()[game].rules(Setup(game, "", (empty, empty, empty, empty), minutes, 1, variant, goal))
    numbers = {
        "minutes": rules.ticks * DT / 60.0,
        "protection": getattr(rules, "protection", 0) * DT,
        "patience": getattr(rules, "patience", 0) * DT,
        "magazine": getattr(rules, "magazine", 0),
        "loading": getattr(rules, "loading", 0) * DT,
        "turbo": 1.0 / (rules.turbo_drain * HZ) if rules.turbo_drain else 0.0,
        "refill": 1.0 / (rules.turbo_refill * HZ) if rules.turbo_refill else 0.0,
    }
    return {name: f"{round(20 * value) / 20:g}" for name, value in numbers.items()}  # rounded to 0.05


def rivals(game: str) -> tuple[str, ...]:
    """What the lobby of a game offers as AIs, in the order in which it steps through them; last what is connected."""
    own = (NAME, *AIS[game].rivals) if AIS[game].auto else AIS[game].rivals
    programs = optional("ai.bots.brains")
    return (*own, *programs.connected()) if programs else own


def lit_stars(brain: str) -> str:
    """One star for each level of a brain; empty if it is no level."""
    return LIT * level_of(brain)


def stars_of(level: int) -> str:
    """A level as a row of as many stars as there are levels, of which the first are lit."""
    return LIT * level + UNLIT * (len(LEVELS) - level)


def brain_name(words: Words, game: str, brain: str) -> str:
    """The name of an AI on a label: the stars of a level, the words for another that the lobby offers, else its own."""
    if level := level_of(brain):
        return stars_of(level)
    if brain in AUTO:
        return words("match.auto")
    return words(f"match.{brain}") if game in AIS and brain in AIS[game].rivals else display_name(brain).upper()


def steering(words: Words, controls: Controls, device: Device) -> str:
    """The signs on the steering keys; of a number pad or a pad its name; of a phone that of its owner, if known."""
    if own := controls.owner(device):
        return own
    name = controls.name(device)
    return controls.moves(device) if name == "Keyboard" else words(f"devices.{name}")
