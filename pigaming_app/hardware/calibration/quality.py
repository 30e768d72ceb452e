"""Quality of the camera's picture at a calibration: exposure, size and blur of the robots' markers, and the predicted
share of the pictures in which a driving robot's marker is found, by `detection`.
"""

from dataclasses import dataclass, replace
from typing import Annotated

from pigaming_app.hardware.calibration.detection import found_share
from pigaming_app.hardware.signals import ExposureKept, ExposureState
from pigaming_app.hardware.vision.exposure import LONGEST
from pigaming_app.hardware.vision.markers import ROBOT_IDS
from pigaming_app.hardware.vision.sharpness import LightField
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.schema import Share, between, one_of

NEEDED = 0.95  # share of the pictures in which a marker must be found
CAUSES = ("finds_blurred", "finds_smeared", "finds_small", "finds_dim")  # of a weak prediction
SMALL_EDGE = 20.0  # camera px, edge of a marker below which the wizard warns
FLICKERS = 0.3  # share by which the light changes from picture to picture, above which the wizard warns
EVEN = LightField()
Pixels = Annotated[float, between(0.0, 1e4)]


@dataclass(frozen=True)
class CameraQuality:
    """Picture of a calibrated camera. Zeros: not measured."""

    exposure: Annotated[float, between(0.0, 10.0)] = 0.0  # s; 0: the driver gives no figure
    gain: Annotated[float, between(0.0, 1e6)] = 0.0  # units of the driver
    marker_px: Pixels = 0.0  # edge of a robot's marker at the weakest place of the arena, camera px
    blur_px: Pixels = 0.0  # standard deviation, camera px
    light: Share = 1.0  # of the darkest place, as a share of the usual one
    flicker: Share = 0.0  # share by which the light changes from picture to picture
    detection: Share = 0.0  # predicted share of the pictures in which the weakest marker of a driving robot is found
    anyway: bool = False  # the operator saved it despite a prediction below NEEDED
    cause: Annotated[str, one_of("", *CAUSES)] = ""  # key of the main cause of a weak prediction

    def with_edge(self, marker_px: float) -> "CameraQuality":
        """The same picture with markers of another size, px."""
        look = marker_px, self.blur_px, self.exposure, self.light
        detection = weakest(*look)
        cause = "" if detection >= NEEDED else _cause(*look)
        return replace(self, marker_px=marker_px, detection=detection, cause=cause)

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
        """The main cause of a weak prediction with its remedy, or a warning; None if all is well."""
        if not self.measured:
            return None
        if self.sufficient and self.flicker > FLICKERS:
            return OperatorMessage("flickers", share=round(100 * self.flicker))
        if self.sufficient:
            return (
                OperatorMessage("marker_small", edge=f"{self.marker_px:.0f}") if self.marker_px < SMALL_EDGE else None
            )
        light = round(100 * self.light)
        figures = {"edge": f"{self.marker_px:.0f}", "blur": f"{self.blur_px:.1f}", "light": light}
        return OperatorMessage(self.cause, share=round(100 * self.detection), **figures) if self.cause else None


def used_anyway(quality: CameraQuality) -> OperatorMessage:
    """The warning about a calibration that was saved despite its picture."""
    return OperatorMessage("used_anyway", share=round(100 * quality.detection))


def assessed(marker_px: float, blur_px: float, state: ExposureState, field: LightField = EVEN) -> CameraQuality:
    """The quality of a picture. Without a figure of the driver the exposure is taken to be LONGEST."""
    seconds = state.seconds or 0.0
    quality = CameraQuality(seconds, state.gain, blur_px=blur_px, light=field.light, flicker=field.flicker)
    return quality.with_edge(marker_px)


def weakest(marker_px: float, blur_px: float, exposure: float, light: float = 1.0) -> float:
    """The predicted share, 0..1, of the robots' marker that is found least."""
    return min(found_share(number, marker_px, blur_px, exposure, light) for number in ROBOT_IDS)


def _cause(marker_px: float, blur_px: float, exposure: float, light: float) -> str:
    """Of blur, exposure, size and light the one whose repair raises the prediction of the weakest marker most."""
    number = min(ROBOT_IDS, key=lambda number: found_share(number, marker_px, blur_px, exposure, light))
    repairs = {
        "finds_blurred": found_share(number, marker_px, min(blur_px, 0.8), exposure, light),
        "finds_smeared": found_share(number, marker_px, blur_px, min(exposure or LONGEST, 1 / 120), light),
        "finds_small": found_share(number, max(marker_px, 1.5 * SMALL_EDGE), blur_px, exposure, light),
        "finds_dim": found_share(number, marker_px, blur_px, exposure),
    }
    return max(repairs, key=lambda cause: repairs[cause])
