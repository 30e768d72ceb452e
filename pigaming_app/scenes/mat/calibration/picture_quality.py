"""Texts about the camera's picture, shared by the pages that show it."""

from pigaming_app.hardware.signals import ExposureState
from pigaming_app.hardware.vision.exposure import fraction
from pigaming_app.ui.i18n import Words


def exposure_text(words: Words, state: ExposureState) -> str:
    """The exposure, its upper bound if the driver gives no figure, or neither."""
    if not state.bound:
        return words("calibrate.time_unknown")
    return words("calibrate.time_bound" if state.seconds is None else "calibrate.time", time=fraction(state.bound))
