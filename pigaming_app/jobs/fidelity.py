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

from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable, unfit
from pigaming_app.jobs.sessions import new_session
from pigaming_app.storage.parsing import reason as reason_of
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.i18n import english

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
    from pigaming_app.hardware.recordings import RecordingWriter
    from pigaming_app.storage.safe_files import check_target

    if arguments.emulate is None and (reason := unfit(Settings.load(folders().config)[0])):
        raise NotDone(english().explained(reason))
    check_target(arguments.file)
    try:
        session = new_session(arguments.emulate, arguments.camera, arguments.port)
        rig = session.open()
    except RobotsUnavailable as trouble:
        raise NotDone(english().explained(trouble.message)) from None
    try:
        present = _present(session, rig)
        recorder = RecordingWriter(arguments.file, session.mm, arguments.emulate is not None)
        try:
            rig.recorder = recorder
            _dance(session, rig, present, arguments.seconds)
            rig.recorder = None
            recorder.close()
        finally:
            recorder.discard()
    except OSError as trouble:
        raise NotDone(f"{arguments.file}: cannot be written ({reason_of(trouble)})") from None
    finally:
        session.end()
    robots = ", ".join(str(robot + 1) for robot in present)
    said = [f"{arguments.file}: {arguments.seconds:g} s of robots {robots}. Now: fidelity identify {arguments.file}"]
    return {"file": str(arguments.file), "robots": [robot + 1 for robot in present], "said": said}


def _present(session: RobotSession, rig: Any) -> list[int]:
    """The robots that are seen and heard. Raises NotDone, before any run kept earlier is written over."""
    for _ in range(HZ):
        session.tick()
        rig.pump()
    present = [i for i, seen in enumerate(rig.sense()) if seen.age < 1.0 and rig.telemetry(i)]
    if not present:
        raise NotDone("No robot is both seen and heard: look at them with the job robots.")
    return present


def _dance(session: RobotSession, rig: Any, present: list[int], seconds: float) -> None:
    """Let them drive for a while. Raises NotDone."""
    from pigaming_app.hardware.control.real_plant import RealPlant
    from pigaming_app.hardware.sysid.excitation import ExcitationPattern
    from pigaming_app.sim.world import DT, World

    world: Any = World()
    for i in present:
        world.robots[i].present = 1
    plant, dance, begun, stuck = RealPlant(world, rig, present), ExcitationPattern(), rig.clock(), 0
    while rig.clock() - begun < seconds:
        plant.drive(dance.twists(rig.clock(), plant.sense()), DT)
        session.tick()
        stuck = stuck + 1 if plant.safety.pauses else 0
        if stuck > LOST * HZ:
            fault = plant.faults[0]
            cause = english()(f"faults.{fault.name}", robot=(fault.robot or 0) + 1, button="the button")
            raise NotDone(f"The robots cannot drive. {cause}")


def identify(arguments: Namespace) -> dict[str, Any]:
    """Find the drivetrains, keep them, tell and draw how good they are."""
    from pigaming_app.hardware.session.store import load_robots, robots_file
    from pigaming_app.hardware.sysid.evaluate import HORIZONS, RecordingTooShort, measure
    from pigaming_app.sim.drivetrain import DrivetrainError, tell
    from pigaming_app.storage.safe_files import NotSaved, keep

    run = _load(arguments.file)
    out = arguments.out or robots_file(run.emulated)
    try:
        verdicts = measure(run)
        drivetrains = list(load_robots(out))
        for verdict in verdicts:
            drivetrains[verdict.robot] = verdict.drivetrain
        keep(out, tell(drivetrains))
    except RecordingTooShort as trouble:
        raise NotDone(english().explained(trouble.message)) from None
    except (NotSaved, DrivetrainError) as trouble:
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
    from pigaming_app.hardware.session.store import load_robots, robots_file
    from pigaming_app.hardware.sysid.evaluate import replay as play_again
    from pigaming_app.sim.drivetrain import DrivetrainError

    run = _load(arguments.file)
    if arguments.robots and not os.path.exists(arguments.robots):
        raise NotDone(f"{arguments.robots}: there is no such file")
    try:
        drivetrains = load_robots(arguments.robots or robots_file(run.emulated))
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
    from pigaming_app.hardware.recordings import RecordingError, load

    try:
        return load(file)
    except RecordingError as trouble:
        raise NotDone(str(trouble)) from None


def _draw(run: Any, verdicts: Any, folder: Path) -> list[str]:
    from pigaming_app.hardware.sysid.plots import PlotsUnavailable, draw

    try:
        return [f"drawn: {path}" for path in draw(run, verdicts, folder)]
    except PlotsUnavailable as missing:
        return [english().explained(missing.message)]
