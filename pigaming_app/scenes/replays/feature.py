"""The list of saved replays as a feature."""

from pigaming_app.scenes.features.feature import Feature, MenuItem
from pigaming_app.scenes.flow.scene import Context, Scene


def page(context: Context, game: str) -> Scene:
    from pigaming_app.scenes.replays.page import ReplaysPage

    return ReplaysPage(context)


FEATURE = Feature(
    "replays",
    rooms=("scenes.replays", "jobs.replays"),
    menu=MenuItem(5, page),
    preload=("pigaming_app.scenes.replays.page",),
)
