"""Quality of the camera's picture at a calibration: exposure, size and blur of the robots' markers, and the prediction
of the share of pictures in which a driving robot's marker is found.

A marker is found if it is not smeared and if it is clear enough; the two shares multiply. Both are fits to the emulated
arena, with robots at 0.35 m/s: `tests/bench/detection.py` prints the table that they were fitted to, and the fit.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import exp, log

from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.signals import ExposureKept, ExposureState
from pigaming_app.hardware.vision.exposure import LONGEST

NEEDED = 0.95  # share of the pictures in which a marker must be found
SMALL_EDGE = 20.0  # camera px, edge of a marker below which the wizard warns
SPEED = 350.0  # mm/s, of a robot
MOTION = (17.63, -13.23)  # weights of `motion_terms`
CLARITY = (-9.22, 5.84, -2.64, -14.5, -1.95)  # weights of `clarity_terms`; mean error of the predicted share 2 %
CELLS, MARKER_MM = 6.0, 50.0  # cells across a marker; its edge


@dataclass(frozen=True)
class CameraQuality:
    """Picture of a calibrated camera. Zeros: not measured, as in calibrations of older versions."""

    exposure: float = 0.0  # s; 0: the driver gives no figure
    gain: float = 0.0  # units of the driver
    marker_px: float = 0.0  # edge of a robot's marker at the weakest place of the arena, camera px
    blur_px: float = 0.0  # standard deviation, camera px
    detection: float = 0.0  # predicted share of the pictures in which a driving robot's marker is found
    anyway: bool = False  # the operator saved it despite a prediction below NEEDED

    def with_edge(self, marker_px: float) -> "CameraQuality":
        """The same picture with markers of another size, px."""
        return replace(self, marker_px=marker_px, detection=predicted(marker_px, self.blur_px, self.exposure))

    @property
    def measured(self) -> bool:
        """True if the calibration measured the picture."""
        return self.marker_px > 0.0

    @property
    def sufficient(self) -> bool:
        """True if enough markers are expected to be found."""
        return not self.measured or self.detection >= NEEDED

    @property
    def kept(self) -> ExposureKept | None:
        """The exposure to set again, or None if there is no figure."""
        return ExposureKept(self.exposure, self.gain) if self.exposure else None

    @property
    def advice(self) -> OperatorMessage | None:
        """The main cause of a weak prediction with its remedy, or a warning; None if all is well.

        Of blur, exposure and size the one is named whose repair raises the prediction most.
        """
        if not self.measured:
            return None
        if self.sufficient:
            return (
                OperatorMessage("marker_small", edge=f"{self.marker_px:.0f}") if self.marker_px < SMALL_EDGE else None
            )
        share, edge = round(100 * self.detection), f"{self.marker_px:.0f}"
        repairs = {
            "finds_blurred": predicted(self.marker_px, min(self.blur_px, 0.8), self.exposure),
            "finds_smeared": predicted(self.marker_px, self.blur_px, min(self.exposure or LONGEST, 1 / 120)),
            "finds_small": predicted(max(self.marker_px, 1.5 * SMALL_EDGE), self.blur_px, self.exposure),
        }
        cause = max(repairs, key=lambda name: repairs[name])
        return OperatorMessage(cause, share=share, edge=edge, blur=f"{self.blur_px:.1f}")


def used_anyway(quality: CameraQuality) -> OperatorMessage:
    """The warning about a calibration that was saved despite its picture."""
    return OperatorMessage("used_anyway", share=round(100 * quality.detection))


def assessed(marker_px: float, blur_px: float, state: ExposureState) -> CameraQuality:
    """The quality of a picture. Without a figure of the driver the exposure is taken to be LONGEST."""
    seconds = state.seconds or 0.0
    return CameraQuality(seconds, state.gain, marker_px, blur_px, predicted(marker_px, blur_px, seconds))


def predicted(marker_px: float, blur_px: float, exposure: float) -> float:
    """Predicted share of the pictures, 0..1, in which the marker of a driving robot is found.

    `exposure`: s; 0, unknown, counts as LONGEST.
    """
    return logistic(MOTION, motion_terms(exposure)) * logistic(CLARITY, clarity_terms(marker_px, blur_px, exposure))


def motion_terms(exposure: float) -> tuple[float, float]:
    """Terms of the share of markers that are not smeared: 1, motion in an exposure (s) in cells of a marker."""
    return 1.0, SPEED * (exposure or LONGEST) / (MARKER_MM / CELLS)


def clarity_terms(marker_px: float, blur_px: float, exposure: float) -> tuple[float, float, float, float, float]:
    """Terms of the share of markers that are clear enough: 1, size (px); blur in px, and squared in cells; motion."""
    blur, motion = blur_px / (marker_px / CELLS), motion_terms(exposure)[1]
    return 1.0, log(marker_px), blur_px, blur**2, motion**2


def logistic(weights: Sequence[float], values: Sequence[float]) -> float:
    """A share, 0..1, by the weighted sum of terms."""
    logit = sum(weight * value for weight, value in zip(weights, values, strict=True))
    return 1.0 / (1.0 + exp(-max(-30.0, min(30.0, logit))))
