"""How each game appears on the screens."""

from collections.abc import Iterator, Mapping

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import AIS
from pigaming_app.games.registry import OURS, games
from pigaming_app.scenes.views.game_screens import GameScreens
from pigaming_app.storage.optional import optional
from pigaming_app.storage.plugins.parts import SCREENS as PART
from pigaming_app.storage.plugins.parts import hidden, parts
from pigaming_app.ui.i18n import fields, texts


def text_keys(name: str, screens: GameScreens) -> Iterator[str]:
    """The texts that the screens of a game need."""
    game = games()[name]
    yield from (f"games.{name}", f"games.{name}_line", f"events.short_{name}", f"howto.limits_{name}")
    yield from (f"setup.arena_{name}", f"results.plot_{name}", f"highlights.last_{name}")
    for variant in game.variants.values():
        yield from (f"setup.{name}_{variant.name}", f"rules.{name}_{variant.name}")
        yield from (f"results.{column}" for column in variant.columns or game.columns)
    for achievement in game.record_kinds:
        yield from (f"results.best_{achievement.name}", f"setup.best_{achievement.name}")
    yield from (f"setup.rounds_{count}" for count in game.rounds if len(game.rounds) > 1)
    yield from (f"setup.count_{game.goal}", f"setup.{game.goal}") if game.goal else ()
    yield from (f"howto.{lesson}" for lesson in screens.lessons)
    awards = [f"awards.{figure.removeprefix('-')}" for figure in screens.awards]
    yield from (*awards, *(key for key in (f"{award}_praise" for award in awards) if key in texts("en")))
    yield from (f"howto.{screens.fire}",) if screens.fire else ()
    yield from (f"{page}.{rival}" for rival in AIS[name].rivals if rival not in LEVELS for page in ("lobby", "match"))


def _lacks(name: str, screens: GameScreens) -> str:
    """The texts that a plug-in lacks, as a reason to leave it out."""
    known = texts("en")
    keys = list(text_keys(name, screens))
    if missing := [key for key in keys if key not in known]:
        return f"text/en.toml lacks {', '.join(missing)}"
    for key in keys:
        if unknown := fields(known[key]) - _values(key, name):
            return f"text/en.toml: {key}: no value has the name {min(unknown)}"
    return ""


def _values(key: str, name: str) -> set[str]:
    """The names of the values that are filled into a text of a game: those in the texts of our games."""
    known = texts("en")
    alike = ["setup.count_laps"] if key.startswith("setup.count_") else [key.replace(name, other) for other in OURS]
    return {field for one in alike if one != key and one in known for field in fields(known[one])}


SCREENS: Mapping[str, GameScreens] = {
    **{game: optional(f"scenes.views.games.{game}").SCREENS for game in OURS},
    **parts(PART, "SCREENS", GameScreens, _lacks),
}  # by game


def shown_games() -> list[str]:
    """The games that can be played on the screen, in the order of the title."""
    return [name for name in games() if name not in hidden()]
