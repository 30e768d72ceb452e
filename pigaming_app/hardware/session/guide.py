"""The way from the box to the first match: steps that check themselves by the files and settings they leave.

So nothing else has to be kept, and whoever stopped goes on the next day where they were.
"""

from pathlib import Path
from typing import NamedTuple

from pigaming_app.hardware.calibration.ground_plane import CalibrationError
from pigaming_app.hardware.session import store
from pigaming_app.hardware.session.robot_session import settings_problem
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.settings import Settings

STEPS = ("robots", "sheet", "pin", "calibrate", "mat", "pair", "drive", "match")
SHEET = "markers.pdf"  # in the data folder


class GuideStep(NamedTuple):
    """A step. `problem`: what is wrong; None also for a step that was not begun."""

    name: str  # of STEPS
    done: bool
    problem: OperatorMessage | None = None


def steps(
    settings: Settings, data: Path, site: str, projection: str | None, heard: int, fault: OperatorMessage | None
) -> list[GuideStep]:
    """All steps, in order.

    `data`: data folder; `site`: `real` or `emulated`; `projection`: `Canvas.projection`, None for any; `heard`: robots
    that report by radio at present; `fault`: of the radio.
    """
    paired, problem = settings.camera_delay >= 0, settings_problem(settings)
    try:
        store.load(store.calibration_file(site), projection)
        wrong = None
    except CalibrationError as error:
        wrong = error.message
    calibrated, begun = wrong is None, wrong is not None and wrong.key != "none"
    return [
        GuideStep("robots", problem is None and (heard > 0 or paired), problem or (None if heard else fault)),
        GuideStep("sheet", (data / SHEET).exists() or paired),
        GuideStep("pin", bool(settings.corners) or calibrated),
        GuideStep("calibrate", calibrated, wrong if begun else None),
        GuideStep("mat", settings.mat),
        GuideStep("pair", paired),
        GuideStep("drive", bool(settings.tops)),
        GuideStep("match", settings.mat and bool(settings.real)),
    ]


def next_step(found: list[GuideStep]) -> str:
    """The name of the first step that is not done; empty if all are."""
    return next((step.name for step in found if not step.done), "")
