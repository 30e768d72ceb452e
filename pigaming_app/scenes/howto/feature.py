"""How to play as a feature: an animated lesson of each game."""

from pigaming_app.scenes.features.feature import Feature, MenuItem, Show
from pigaming_app.scenes.flow.scene import Context, Scene


def page(context: Context, game: str) -> Scene:
    from pigaming_app.scenes.howto.scene import HowTo

    return HowTo(context, game)


def show(context: Context, game: str) -> Show | None:
    """The lessons of the game; None if it has none."""
    from pigaming_app.scenes.howto.scene import HowTo, taught

    if game not in taught():
        return None
    lesson = HowTo(context, game)
    return Show(lesson, lesson.draw)


FEATURE = Feature("howto", rooms=("scenes.howto",), menu=MenuItem(0, page), show=show)
