"""The Ladder as a feature: a climb against AIs, and how strong they are."""

import secrets

from pigaming_app.scenes.features.feature import Feature, MenuItem, Show
from pigaming_app.scenes.flow.scene import Context, Scene


def page(context: Context, game: str) -> Scene:
    from pigaming_app.scenes.ladder.choice import LadderChoice

    return LadderChoice(context, game)


def show(context: Context, game: str) -> Show | None:
    """The best climbers of the game, or of all games; None if there are none."""
    from pigaming_app.events.ladder import ALL, table_of
    from pigaming_app.scenes.ladder.climbers import Climbers

    climbed = [ladder for ladder in (game, ALL) if context.scores.best(table_of(ladder))]
    if not climbed:
        return None
    best = Climbers(context, secrets.choice(climbed))
    return Show(best, best.show)


FEATURE = Feature(
    "ladder",
    rooms=("scenes.ladder",),
    needs=("events",),  # for its rules
    menu=MenuItem(1, page),
    show=show,
    preload=("pigaming_app.scenes.ladder.choice",),
)
