"""The editor of arenas as a feature."""

from collections.abc import Callable
from functools import partial

from pigaming_app.scenes.features.feature import Feature, MenuItem
from pigaming_app.scenes.flow.scene import Context, Scene


def page(context: Context, game: str) -> Scene:
    from pigaming_app.scenes.editor.gallery.page import Gallery

    return Gallery(context, game)


def draw_arena(context: Context, game: str) -> Callable[[], Scene] | None:
    """Opens the page of a game's drawn arenas; None if none can be drawn."""
    from pigaming_app.scenes.editor.registry import EDITORS

    return partial(page, context, game) if game in EDITORS else None


FEATURE = Feature(
    "editor",
    rooms=("scenes.editor", "jobs.editor"),
    menu=MenuItem(4, page),
    draw_arena=draw_arena,
    preload=("pigaming_app.scenes.editor.gallery.page",),
)
