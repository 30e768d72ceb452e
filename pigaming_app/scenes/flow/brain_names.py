"""Names of AIs on the screen: levels as stars, the others in words."""

from pigaming_app.ai.auto import NAME
from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.ai.brain_files import display_name
from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import AIS, level_of
from pigaming_app.storage.optional import optional
from pigaming_app.ui.draw.theme import STARS
from pigaming_app.ui.i18n import Words

LIT, UNLIT = STARS[0], STARS[1]


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
