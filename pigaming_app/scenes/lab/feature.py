"""The Lab as a feature: robots that learn while people watch."""

from pathlib import Path

from pigaming_app.scenes.features.feature import Feature, MenuItem, Service
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.scenes.launch import Options


def service(context: Context, options: Options) -> Service:
    """The background, with the command by which this start can fetch."""
    from pigaming_app.scenes.lab.background import ExtraFetch, LabBackground

    background = context.shared(LabBackground)
    background.network_fetch = ExtraFetch(options.fetch_networks)
    return background


def page(context: Context, game: str) -> Scene:
    """The Lab in its last state."""
    from pigaming_app.scenes.lab.background import LabBackground
    from pigaming_app.scenes.lab.scene import Lab

    background = context.shared(LabBackground)
    background.lab = background.lab or Lab(context)
    return background.lab


def saved_brains() -> list[Path]:
    from pigaming_app.scenes.lab.saved_robots import file_of, names

    return [file_of(name) for name in names()]


FEATURE = Feature(
    "lab",
    rooms=("scenes.lab", "ai.ppo.lab"),
    needs=("ai.learning", "ai.ppo", "scenes.brain"),
    menu=MenuItem(3, page),
    service=service,
    saved_brains=saved_brains,
    preload=(
        "pigaming_app.scenes.lab.scene",
        "pigaming_app.scenes.lab.pages.menu",
        "pigaming_app.scenes.lab.pages.open_page",
        "pigaming_app.scenes.lab.pages.compare_page",
        "pigaming_app.scenes.lab.pages.challenge",
    ),
)
