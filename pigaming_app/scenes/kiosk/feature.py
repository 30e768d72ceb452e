"""The operator's desk as a feature: keys on every screen, a page in the options, the second screen."""

from pigaming_app.scenes.features.feature import Feature, OptionRow, Service
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.scenes.launch import Options
from pigaming_app.ui.draw import FOCUS, ICE, LINE, STEEL, GlowCanvas, cut_box


def service(context: Context, options: Options) -> Service:
    from pigaming_app.scenes.kiosk.operator.desk import OperatorDesk

    return OperatorDesk(context, options.scoreboard, not options.without_title)


def page(context: Context) -> Scene:
    from pigaming_app.scenes.kiosk.operator.page import OperatorPage

    return OperatorPage(context)


def sketch(ink: GlowCanvas, beat: int) -> None:
    """Draw the bars of a day."""
    for i, high in enumerate((60, 130, 190, 110)):
        ink.line(cut_box(-134 + 70 * i, 100 - high, 48, high, 8), FOCUS if high == 190 else ICE, LINE, True)
    ink.line([(-160, 112), (160, 112)], STEEL, LINE)


FEATURE = Feature(
    "kiosk",
    rooms=("scenes.kiosk", "jobs.kiosk"),
    options={"day": OptionRow("", "games", page, sketch)},
    service=service,
)
