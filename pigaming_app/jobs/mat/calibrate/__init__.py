"""Calibration of projector, mat and camera: the arcade's wizard alone, or what is printed: markers, arenas to scale."""

import argparse
import json
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from pigaming_app.jobs.arcade import show
from pigaming_app.jobs.terminal.options import (
    ONE_OF,
    DisplayOption,
    Groups,
    JsonOption,
    RigOptions,
    decimal,
    flag,
    option,
    path,
    require_unused,
    word,
)
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require
from pigaming_app.storage.messages import OperatorError
from pigaming_app.storage.parsing import quote
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.i18n import with_english

MAT = "mat"  # one page as large as the surface
PAPERS = (MAT, "A4", "A3")
EDGE = 50.0  # mm, of a marker
USUAL = (2540.0, 1430.0)  # mm: a 3pi is as wide there as a simulated robot
LEAST, MOST = 300.0, 5000.0  # mm, of a side
VIEWS = ("good", "defocused", "long", "stubborn", "silent", "dim", "dark", "tilted")  # of the emulated camera


def area(text: str) -> tuple[float, float]:
    """WxH in metres as width and height, mm; the longer side is the width, along which the arena lies."""
    found = re.fullmatch(r"(\d{1,4}(?:\.\d{1,6})?)x(\d{1,4}(?:\.\d{1,6})?)", text.lower().replace(",", "."))
    high, wide = sorted(1000.0 * float(side) for side in found.groups()) if found else (0.0, 0.0)
    if not LEAST <= high <= wide <= MOST:
        limits = f"{LEAST / 1000.0:g} to {MOST / 1000.0:g}"
        raise argparse.ArgumentTypeError(f"{quote(text)} is not a size in metres such as 1.6x1.0, each {limits}")
    return wide, high


@dataclass(frozen=True, kw_only=True)
class CalibrateOptions(RigOptions, DisplayOption, JsonOption):
    """What to calibrate, and how."""

    GROUPS: ClassVar[Groups] = {ONE_OF: ("sheet", "print")}

    headless: bool = flag("with --emulate: no window, print the errors")
    printed: bool = flag("by the markers of a printed floor, with any screen beside it; see --print")
    robot: bool = flag("with --headless: camera height measured by a robot")
    view: str | None = option(f"with --headless: a camera of this quality; default {VIEWS[0]}", choices=VIEWS)
    anyway: bool = flag("with --headless: save it though markers will be missed")
    sheet: Path | None = option("write the page of markers to print (PDF), no more", path, metavar="FILE")
    edge: float | None = option("with --sheet: edge of a marker; default 50", decimal(1.0, 1000.0), metavar="MM")
    print: Path | None = option("write arenas to scale with corner markers (PDF), no more", path, metavar="FILE")
    size: tuple[float, float] | None = option(
        "with --print: the surface in metres; default 2.54x1.43", area, metavar="WxH"
    )
    arena: str | None = option("with --print: this one, also drawn by you; default all", word, metavar="[GAME/]NAME")
    paper: str | None = option(
        f"with --print: one page an arena ({MAT}), or pages to put together; default {MAT}", choices=PAPERS
    )


def run(options: CalibrateOptions) -> int:
    """Calibrate, or write the page of markers; 1: the calibration is not good enough. Raises Refusal or NotSaved."""
    options.mat_settings()
    require("hardware")
    if options.sheet is None:
        require_unused(options, ("edge",), "--sheet")
    if options.print is None:
        require_unused(options, ("size", "arena", "paper"), "--print")
    if options.sheet is not None:
        return _write(options.sheet, options.edge or EDGE)
    if options.print is not None:
        return _print(options.print, options)
    if options.headless or options.json or options.robot or options.anyway or options.view:
        if options.printed:
            raise Refusal("the emulated arena has no printed floor: leave out --printed")
        if options.emulate is None:
            raise Refusal("without a window only the emulated arena can be calibrated: add --emulate")
        return _prove(options, options.emulate)
    from pigaming_app.scenes.launch import Options
    from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage

    first = lambda context: CalibrationPage(context, camera=options.camera, printed=options.printed)  # noqa: E731
    return show(Options(first_scene=first, without_title=True, display=options.display, emulator_seed=options.emulate))


def _write(path: Path, edge: float) -> int:
    from pigaming_app.scenes.mat.paper.marker_sheet import sheet
    from pigaming_app.storage.safe_files import require_writable, write_atomic

    language = Settings.load(folders().config)[0].language
    _check_name(path)
    with refused(OperatorError, ValueError):
        require_writable(path)
        notes = with_english(language, "sheet.print", "sheet.cut")
        write_atomic(path, sheet(edge, notes, with_english(language, "sheet.blocks")))
    print(f"{path}: print it at 100 %; the ruler on it must measure 100 mm")
    return 0


def _print(path: Path, options: CalibrateOptions) -> int:
    from pigaming_app.hardware.calibration.floor_surface import FloorSurface
    from pigaming_app.jobs.mat.calibrate.floor import chosen_arenas, names, with_room, write
    from pigaming_app.storage.safe_files import require_writable

    _check_name(path)
    settings, surface = Settings.load(folders().config)[0], FloorSurface(*(options.size or USUAL))
    chosen, narrow = with_room(chosen_arenas(options.arena), surface, settings)
    with refused(OperatorError, ValueError):
        require_writable(path)
        print(write(path, surface, chosen, options.paper or MAT, settings.language))
    if narrow:
        print(f"left out, without room for the robots of this arcade: {names(narrow)}")
    print("print it at 100 %; the bars on it must measure 100 mm")
    return 0


def _check_name(path: Path) -> None:
    if path.suffix.lower() != ".pdf":
        raise Refusal(f"{path}: the page is a PDF; give it a name that ends in .pdf.")


def _prove(options: CalibrateOptions, seed: int) -> int:
    """Calibrate the emulated arena unattended."""
    os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"
    from pigaming_app.hardware.vision.markers import opencv
    from pigaming_app.jobs.mat.calibrate.unattended import calibrate

    with refused(OperatorError):
        opencv()
    result = calibrate(seed, options.robot, options.view or VIEWS[0], options.anyway)
    if options.json:
        print(json.dumps(result))
    else:
        for key, value in result.items():
            print(f"{key:20} {value}")
    return 0 if result["saved"] else 1
