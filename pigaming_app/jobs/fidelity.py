"""The job `fidelity`: record real robots, find out what their wheels are like, and let the simulator know.

`record FILE` lets the robots dance and writes what they were told and where they were seen. `identify FILE` finds their
drivetrains, says how much better the simulator then foresees them, and keeps them for the arcade. `replay FILE` plays a
run again in the simulator.
"""

import json
import os
from argparse import Namespace
from dataclasses import asdict
from math import isfinite
from pathlib import Path
from typing import Any

from pigaming_app.hardware.session.workshop import kept_robots, open_workshop, wiring
from pigaming_app.storage.parsing import describe_error

HZ = 50
LOST = 5.0  # s of robots that cannot drive after which a recording is given up


class NotDone(Exception):
    """What was asked for cannot be done; the text is one sentence."""


def run(arguments: Namespace) -> int:
    """Do the job. Raises NotDone."""
    told = {"record": record, "identify": identify, "replay": replay}[arguments.what](arguments)
    if arguments.json:
        print(json.dumps(told))
    else:
        for line in told["said"]:
            print(line)
    return 0


def record(arguments: Namespace) -> dict[str, Any]:
    """Let the robots dance for a while on an empty mat, and write the run."""
    from pigaming_app.hardware.radio.stock_protocol import NO_DEADMAN
    from pigaming_app.hardware.recordings import Recorder
    from pigaming_app.hardware.vision.markers import NoVision
    from pigaming_app.storage.safe_files import require_writable

    if arguments.emulate is None and wiring().radio == "stock":
        raise NotDone(NO_DEADMAN)
    require_writable(arguments.file)
    try:
        shop = open_workshop(arguments.emulate, arguments.camera, arguments.port)
    except (ValueError, ImportError, NoVision) as trouble:
        raise NotDone(str(trouble)) from None
    try:
        present = _present(shop)
        recorder = Recorder(arguments.file, shop.mm, arguments.emulate is not None)
        try:
            shop.rig.recorder = recorder
            _dance(shop, present, arguments.seconds)
            shop.rig.recorder = None
            recorder.close()
        finally:
            recorder.discard()
    except OSError as trouble:
        raise NotDone(f"{arguments.file}: cannot be written ({describe_error(trouble)})") from None
    finally:
        shop.close()
    robots = ", ".join(str(robot + 1) for robot in present)
    said = [f"{arguments.file}: {arguments.seconds:g} s of robots {robots}. Now: fidelity identify {arguments.file}"]
    return {"file": str(arguments.file), "robots": [robot + 1 for robot in present], "said": said}


def _present(shop: Any) -> list[int]:
    """The robots that are seen and heard. Raises NotDone, before any run kept earlier is written over."""
    for _ in range(HZ):
        shop.tick()
        shop.rig.pump()
    present = [i for i, seen in enumerate(shop.rig.sense()) if seen.age < 1.0 and shop.rig.telemetry(i)]
    if not present:
        raise NotDone("No robot is both seen and heard: look at them with the job robots.")
    return present


def _dance(shop: Any, present: list[int], seconds: float) -> None:
    """Let them drive for a while. Raises NotDone."""
    from pigaming_app.hardware.control.real_plant import RealPlant
    from pigaming_app.hardware.sysid.excitation import Dance
    from pigaming_app.sim.world import DT, World

    world: Any = World()
    for i in present:
        world.robots[i].present = 1
    plant, dance, begun, stuck = RealPlant(world, shop.rig, present), Dance(), shop.rig.clock(), 0
    while shop.rig.clock() - begun < seconds:
        plant.drive(dance.twists(shop.rig.clock(), plant.sense()), DT)
        shop.tick()
        stuck = stuck + 1 if plant.safety.pauses else 0
        if stuck > LOST * HZ:
            raise NotDone(f"The robots cannot drive. {plant.faults[0]}")


def identify(arguments: Namespace) -> dict[str, Any]:
    """Find the drivetrains, keep them, tell and draw how good they are."""
    from pigaming_app.hardware.session.assembly import measured
    from pigaming_app.hardware.sysid.evaluate import HORIZONS, TooShort, measure
    from pigaming_app.sim.drivetrain import DrivetrainError, to_toml
    from pigaming_app.storage.safe_files import NotSaved, write_with_backup

    run = _load(arguments.file)
    out = arguments.out or kept_robots(run.emulated)
    try:
        verdicts = measure(run)
        drivetrains = list(measured(out))
        for verdict in verdicts:
            drivetrains[verdict.robot] = verdict.drivetrain
        write_with_backup(out, to_toml(drivetrains))
    except (TooShort, NotSaved, DrivetrainError) as trouble:
        raise NotDone(str(trouble)) from None
    said = [f"root mean square error in mm after {', '.join(f'{one:g}' for one in HORIZONS)} s, on what was held out"]
    for one in verdicts:
        before, after = (" ".join(f"{mm:7.1f}" for mm in errors.mm) for errors in (one.before, one.after))
        said.append(f"robot {one.robot + 1}  nominal {before}   identified {after}")
    left_out = sorted(run.courses.keys() - {one.robot for one in verdicts})
    said += [f"robot {robot + 1}  is left out: it hardly moved, or what was found makes no sense" for robot in left_out]
    said.append(f"kept in {out}")
    if arguments.plots:
        said += _draw(run, verdicts, arguments.plots)
    robots = {
        str(one.robot + 1): {
            "before_mm": _known(one.before.mm),
            "after_mm": _known(one.after.mm),
            "before_deg": _known(one.before.degrees),
            "after_deg": _known(one.after.degrees),
            **asdict(one.drivetrain),
        }
        for one in verdicts
    }
    return {"horizons": HORIZONS, "robots": robots, "out": str(out), "said": said}


def _known(figures: tuple[float, ...]) -> list[float | None]:
    """Figures as JSON has them: None where too little was seen to tell."""
    return [figure if isfinite(figure) else None for figure in figures]


def replay(arguments: Namespace) -> dict[str, Any]:
    """Play a run again in the simulator, with the robots of a file or the kept ones."""
    from pigaming_app.hardware.session.assembly import measured
    from pigaming_app.hardware.sysid.evaluate import replay as play_again
    from pigaming_app.sim.drivetrain import DrivetrainError

    run = _load(arguments.file)
    if arguments.robots and not os.path.exists(arguments.robots):
        raise NotDone(f"{arguments.robots}: there is no such file")
    try:
        drivetrains = measured(arguments.robots or kept_robots(run.emulated))
    except DrivetrainError as trouble:
        raise NotDone(str(trouble)) from None
    said, robots = [], {}
    for robot, found in play_again(run, drivetrains).items():
        apart = ((found.seen - found.predicted)[:, :2] ** 2).sum(axis=1) ** 0.5 * run.mm
        after = found.seen_at - found.seen_at[0]
        marks = {second: float(apart[after >= second][0]) for second in (1, 2, 5, 10, 30) if after[-1] >= second}
        robots[str(robot + 1)] = {str(second): miss for second, miss in marks.items()}
        said.append(f"robot {robot + 1}  " + "   ".join(f"after {s} s {miss:.0f} mm" for s, miss in marks.items()))
    return {"robots": robots, "said": said}


def _load(file: Path) -> Any:
    from pigaming_app.hardware.recordings import RunError, load

    try:
        return load(file)
    except RunError as trouble:
        raise NotDone(str(trouble)) from None


def _draw(run: Any, verdicts: Any, folder: Path) -> list[str]:
    from pigaming_app.hardware.sysid.plots import NoPlots, draw

    try:
        return [f"drawn: {path}" for path in draw(run, verdicts, folder)]
    except NoPlots as missing:
        return [str(missing)]
