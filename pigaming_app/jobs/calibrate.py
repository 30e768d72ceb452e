"""The job `calibrate`: the arcade's wizard on its own, the sheet of markers, and the proof on an emulated arena."""

import argparse
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from pigaming_app.jobs.options import path, real, whole


class NotCalibrated(Exception):
    """What was asked for cannot be done; the text is one sentence."""


def options(job: argparse.ArgumentParser) -> None:
    """What may be asked for."""
    job.add_argument("--camera", type=whole(0), help="its number, other than in the settings")
    job.add_argument("--display", type=whole(high=64), help="which display, from 1 on")
    job.add_argument(
        "--emulate", type=whole(0), nargs="?", const=1, metavar="SEED", help="an emulated arena, no hardware"
    )
    job.add_argument("--headless", action="store_true", help="with --emulate: nobody looks on, the errors are printed")
    job.add_argument("--robot", action="store_true", help="with --headless: a robot tells the camera's height")
    job.add_argument("--json", action="store_true", help="as --headless, and print one JSON object")
    job.add_argument("--sheet", type=path, metavar="FILE", help="write the page of markers to print (PDF), no more")
    job.add_argument("--edge", type=real(1.0, 1000.0), default=50.0, help="of a marker on that page, in mm")


def run(arguments: argparse.Namespace, show: Callable[[Any], int]) -> int:
    """Do what was asked for; `show` opens the arcade. 1: the calibration was too bad. Raises NotCalibrated."""
    if arguments.sheet is not None:
        return _write(arguments.sheet, arguments.edge)
    if arguments.headless or arguments.json or arguments.robot:
        if arguments.emulate is None:
            raise NotCalibrated("Without a picture only the emulated arena can be calibrated: add --emulate.")
        return _prove(arguments)
    from pigaming_app.scenes.app import Options
    from pigaming_app.scenes.calibration.setup_page import CalibrationPage

    display = None if arguments.display is None else arguments.display - 1
    first = lambda context: CalibrationPage(context, camera=arguments.camera)  # noqa: E731
    return show(Options(first=first, alone=True, display=display, emulate=arguments.emulate))


def _write(path: Path, edge: float) -> int:
    from pigaming_app.hardware.calibration.marker_sheet import sheet
    from pigaming_app.hardware.vision.markers import NoVision
    from pigaming_app.storage.safe_files import check_target, write

    if path.suffix.lower() != ".pdf":
        raise NotCalibrated(f"{path}: the page is a PDF; give it a name that ends in .pdf.")
    try:
        check_target(path)
        write(path, sheet(edge))
    except (NoVision, ValueError) as trouble:
        raise NotCalibrated(str(trouble)) from None
    print(f"{path}: print it at 100 %; the ruler on it must measure 100 mm")
    return 0


def _prove(arguments: argparse.Namespace) -> int:
    """Let the wizard run by itself."""
    os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"
    from pigaming_app.hardware.vision.markers import NoVision, opencv
    from pigaming_app.jobs.calibrate_unattended import calibrate

    try:
        opencv()
    except NoVision as missing:
        raise NotCalibrated(str(missing)) from None
    told = calibrate(arguments.emulate, arguments.robot)
    if arguments.json:
        print(json.dumps(told))
    else:
        for key, value in told.items():
            print(f"{key:20} {value}")
    return 0 if told["saved"] else 1
