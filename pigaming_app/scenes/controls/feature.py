"""Pages about keys and pads as a feature: a test of them, and other keys."""

from pigaming_app.scenes.features.feature import Feature, OptionRow
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.ui.draw import FOCUS, ICE, LINE, STEEL, GlowCanvas, cut_box, icon


def pads_page(context: Context) -> Scene:
    from pigaming_app.scenes.controls.controls_test import ControlsTest

    return ControlsTest(context)


def remap_page(context: Context) -> Scene:
    from pigaming_app.scenes.controls.remap_page import RemapPage

    return RemapPage(context)


def pad(ink: GlowCanvas, beat: int) -> None:
    """Draw a pad of which a button is pressed at every other beat."""
    icon(ink, "pad", 0, 10, 130, FOCUS, LINE)
    if beat:
        ink.disc(0.44 * 130, 10 - 0.28 * 130, 12, ICE)


def keys(ink: GlowCanvas, beat: int) -> None:
    """Draw a key that takes the place of another."""
    for x, lit in ((-84, STEEL), (84, FOCUS)):
        ink.line(cut_box(x - 52, -52, 104, 104, 14), lit, LINE, True)
    ink.line([(-20, 0), (20, 0)], ICE, LINE).line([(6, -14), (20, 0), (6, 14)], ICE, LINE)


FEATURE = Feature(
    "controls",
    rooms=("scenes.controls",),
    options={
        "padtest": OptionRow("controls", "rumble", pads_page, pad, for_children=True),
        "remap": OptionRow("controls", "padtest", remap_page, keys),
    },
    preload=("pigaming_app.scenes.controls.controls_test",),
)
