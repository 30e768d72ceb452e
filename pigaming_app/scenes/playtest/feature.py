"""Play tests as a feature: a page in the options, and what keeps the matches."""

from pigaming_app.scenes.features.feature import Feature, OptionRow, ReplayKind, Service
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.playtest.watch import PlayTestWatch
from pigaming_app.ui.draw import FOCUS, ICE, GlowCanvas


def service(context: Context, options: Options) -> Service:
    return PlayTestWatch(context)


def replays() -> ReplayKind:
    from pigaming_app.scenes.playtest.replays import PlayTestReplays

    return PlayTestReplays()


def page(context: Context) -> Scene:
    from pigaming_app.scenes.playtest.page import PlayTestPage

    return PlayTestPage(context)


def sketch(ink: GlowCanvas, beat: int) -> None:
    """Draw presses of two keys over time."""
    from pigaming_app.scenes.playtest.pictures import presses

    presses(ink, FOCUS if beat else ICE)


FEATURE = Feature(
    "playtest",
    rooms=("scenes.playtest",),
    options={"playtest": OptionRow("", "day", page, sketch)},
    service=service,
    replays=replays,
)
