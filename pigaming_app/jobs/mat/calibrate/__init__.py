"""Calibration of projector, mat and camera: the arcade's wizard alone, or the page of markers to print."""

import json
import os
from argparse import ArgumentParser, Namespace
from pathlib import Path

from pigaming_app.jobs.arcade import show
from pigaming_app.jobs.terminal.options import decimal, display, mat_settings, path, shared
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require
from pigaming_app.storage.messages import OperatorError
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.i18n import with_english

VIEWS = ("good", "defocused", "long", "stubborn", "silent", "dim", "dark", "tilted")  # of the emulated camera


def options(parser: ArgumentParser) -> None:
    shared(parser, "--camera", "--display", "--emulate", "--json")
    parser.add_argument("--headless", action="store_true", help="with --emulate: no window, print the errors")
    parser.add_argument("--robot", action="store_true", help="with --headless: camera height measured by a robot")
    parser.add_argument("--view", choices=VIEWS, help=f"with --headless: a camera of this quality; default {VIEWS[0]}")
    parser.add_argument("--anyway", action="store_true", help="with --headless: save it though markers will be missed")
    parser.add_argument("--sheet", type=path, metavar="FILE", help="write the page of markers to print (PDF), no more")
    parser.add_argument(
        "--edge", type=decimal(1.0, 1000.0), metavar="MM", default=50.0, help="edge of its markers; default 50"
    )


def run(arguments: Namespace) -> int:
    """Calibrate, or write the page of markers; 1: the calibration is not good enough. Raises Refusal or NotSaved."""
    mat_settings(arguments)
    require("hardware")
    if arguments.sheet is not None:
        return _write(arguments.sheet, arguments.edge)
    if arguments.headless or arguments.json or arguments.robot or arguments.anyway or arguments.view:
        if arguments.emulate is None:
            raise Refusal("without a window only the emulated arena can be calibrated: add --emulate")
        return _prove(arguments)
    from pigaming_app.scenes.launch import Options
    from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage

    first = lambda context: CalibrationPage(context, camera=arguments.camera)  # noqa: E731
    return show(
        Options(first_scene=first, without_title=True, display=display(arguments), emulator_seed=arguments.emulate)
    )


def _write(path: Path, edge: float) -> int:
    from pigaming_app.hardware.calibration.marker_sheet import sheet
    from pigaming_app.storage.safe_files import require_writable, write_atomic

    language = Settings.load(folders().config)[0].language
    if path.suffix.lower() != ".pdf":
        raise Refusal(f"{path}: the page is a PDF; give it a name that ends in .pdf.")
    with refused(OperatorError, ValueError):
        require_writable(path)
        notes = with_english(language, "sheet.print", "sheet.cut")
        write_atomic(path, sheet(edge, notes, with_english(language, "sheet.blocks")))
    print(f"{path}: print it at 100 %; the ruler on it must measure 100 mm")
    return 0


def _prove(arguments: Namespace) -> int:
    """Calibrate the emulated arena unattended."""
    os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"
    from pigaming_app.hardware.vision.markers import opencv
    from pigaming_app.jobs.mat.calibrate.unattended import calibrate

    with refused(OperatorError):
        opencv()
    result = calibrate(arguments.emulate, arguments.robot, arguments.view or VIEWS[0], arguments.anyway)
    if arguments.json:
        print(json.dumps(result))
    else:
        for key, value in result.items():
            print(f"{key:20} {value}")
    return 0 if result["saved"] else 1
