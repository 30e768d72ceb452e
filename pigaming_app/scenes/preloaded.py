"""Modules that the preloader imports while the title is shown, in the order in which they may be needed."""

from pigaming_app.scenes.features.registry import features

CORE = (
    "numpy",
    "pigaming_app.scenes.lobby.scene",
    "pigaming_app.scenes.play.scene",
    "pigaming_app.scenes.options.page",
)


def modules() -> tuple[str, ...]:
    """Those of the core, then those of features."""
    return (*CORE, *(module for feature in features() for module in feature.preload))
