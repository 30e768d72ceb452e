"""Measure real robots for the simulator: record a run, identify the drivetrains, replay the run in the simulator."""

import json
import os
from dataclasses import asdict, dataclass
from math import isfinite
from pathlib import Path
from typing import Any

from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable
from pigaming_app.jobs.mat.sessions import require_deadman, robots_of
from pigaming_app.jobs.terminal.options import JsonOption, RigOptions, argument, integer, option, path
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require
from pigaming_app.storage.messages import OperatorError
from pigaming_app.storage.parsing import describe_error
from pigaming_app.ui.i18n import english

LONGEST = 3600  # s of a recording
HZ = 50
LOST = 5.0  # s, timeout of a recording while the robots cannot drive


@dataclass(frozen=True, kw_only=True)
class FidelityOptions(RigOptions, JsonOption):
    """A step on a run."""

    step: str = argument("in this order, on the same run", choices=("record", "identify", "replay"))
    file: Path = argument("run (JSONL), or a recorded match of real robots", path, metavar="FILE")
    seconds: int = option("record: length; default 60", integer(high=LONGEST), 60, metavar="NUMBER")
    out: Path | None = option("identify: drivetrains (TOML); default: the arcade's", path, metavar="FILE")
    plots: Path | None = option("identify: draw the errors (extra `plots`)", path, metavar="FOLDER")
    robots: Path | None = option("replay: drivetrains; default: the arcade's", path, metavar="FILE")


def run(options: FidelityOptions) -> int:
    """Carry out one step and print its result. Raises Refusal or NotSaved."""
    options.mat_settings()
    if options.plots is not None:
        require("plots")
    result = STEPS[options.step](options)
    if options.json:
        print(json.dumps(result))
    else:
        for line in result["said"]:
            print(line)
    return 0


def record(options: FidelityOptions) -> dict[str, Any]:
    """Drive the robots for a while on an empty mat, and write their commands and poses. Raises Refusal or NotSaved."""
    from pigaming_app.hardware.run_writer import RecordingWriter
    from pigaming_app.storage.safe_files import require_writable

    require_deadman(options)
    require("hardware")
    require_writable(options.file)
    try:
        with robots_of(options) as session:
            with refused(RobotsUnavailable):
                rig = session.open()
            present = _present(session, rig)
            recorder = RecordingWriter(options.file, session.mm, options.emulate is not None)
            try:
                rig.recorder = recorder
                _excite(session, rig, present, options.seconds)
                rig.recorder = None
                recorder.close()
            finally:
                recorder.discard()
    except OSError as trouble:
        raise Refusal(f"{options.file}: cannot be written ({describe_error(trouble)})") from None
    robots = ", ".join(str(robot + 1) for robot in present)
    lines = [f"{options.file}: {options.seconds:g} s of robots {robots}. Now: fidelity identify {options.file}"]
    return {"file": str(options.file), "robots": [robot + 1 for robot in present], "said": lines}


def _present(session: RobotSession, rig: Any) -> list[int]:
    """The robots that are in view and report by radio. Raises Refusal, before an earlier run is overwritten."""
    for _ in range(HZ):
        session.tick()
        rig.pump()
    present = [i for i, seen in enumerate(rig.sense()) if seen.age < 1.0 and rig.telemetry(i)]
    if not present:
        raise Refusal("No robot is both seen and heard: see the job robots.")
    return present


def _excite(session: RobotSession, rig: Any, present: list[int], seconds: float) -> None:
    """Drive these robots in the excitation pattern for `seconds`. Raises Refusal."""
    from pigaming_app.hardware.control.real_plant import RealPlant
    from pigaming_app.hardware.sysid.excitation import ExcitationPattern
    from pigaming_app.sim.world import DT, World

    world: Any = World()
    for i in present:
        world.robots[i].present = 1
    plant, pattern, begun, stuck = RealPlant(world, rig, present), ExcitationPattern(), rig.clock(), 0
    while rig.clock() - begun < seconds:
        plant.drive(pattern.twists(rig.clock(), plant.sense()), DT)
        session.tick()
        stuck = stuck + 1 if plant.safety.pauses else 0
        if stuck > LOST * HZ:
            fault = plant.faults[0]
            cause = english()(f"faults.{fault.name}", robot=(fault.robot or 0) + 1, button="the button")
            raise Refusal(f"The robots cannot drive. {cause}")


def identify(options: FidelityOptions) -> dict[str, Any]:
    """Identify and save the drivetrains; compare the simulator with and without them. Raises Refusal or NotSaved."""
    from pigaming_app.hardware.session.store import load_robots, robots_file
    from pigaming_app.hardware.sysid.evaluate import HORIZONS, RecordingTooShort, measure
    from pigaming_app.sim.drivetrain import DrivetrainError, to_toml
    from pigaming_app.storage.safe_files import write_with_backup

    run = _load(options.file)
    out = options.out or robots_file(run.emulated)
    with refused(RecordingTooShort, DrivetrainError):
        verdicts = measure(run)
        drivetrains = list(load_robots(out, run.mm))
        for verdict in verdicts:
            drivetrains[verdict.robot] = verdict.drivetrain
        write_with_backup(out, to_toml(drivetrains, run.mm))
    horizons = ", ".join(f"{horizon:g}" for horizon in HORIZONS)
    lines = [f"root mean square error in mm after {horizons} s, on held-out data"]
    for verdict in verdicts:
        before, after = (" ".join(f"{mm:7.1f}" for mm in errors.mm) for errors in (verdict.before, verdict.after))
        lines.append(f"robot {verdict.robot + 1}  nominal {before}   identified {after}")
    left_out = sorted(run.courses.keys() - {verdict.robot for verdict in verdicts})
    lines += [f"robot {robot + 1}  left out: it hardly moved, or its result is implausible" for robot in left_out]
    lines.append(f"kept in {out}")
    if options.plots:
        from pigaming_app.hardware.sysid.plots import draw

        with refused(OperatorError):
            lines += [f"drawn: {path}" for path in draw(run, verdicts, options.plots)]
    robots = {
        str(verdict.robot + 1): {
            "before_mm": _finite(verdict.before.mm),
            "after_mm": _finite(verdict.after.mm),
            "before_deg": _finite(verdict.before.degrees),
            "after_deg": _finite(verdict.after.degrees),
            **asdict(verdict.drivetrain),
        }
        for verdict in verdicts
    }
    return {"horizons": HORIZONS, "robots": robots, "out": str(out), "said": lines}


def _finite(figures: tuple[float, ...]) -> list[float | None]:
    """Figures for JSON: None where there are too few samples."""
    return [figure if isfinite(figure) else None for figure in figures]


def replay(options: FidelityOptions) -> dict[str, Any]:
    """Replay a run in the simulator with the drivetrains of a file, by default the saved ones. Raises Refusal."""
    from pigaming_app.hardware.session.store import load_robots, robots_file
    from pigaming_app.hardware.sysid.evaluate import replay as simulate
    from pigaming_app.sim.drivetrain import DrivetrainError

    run = _load(options.file)
    if options.robots and not os.path.exists(options.robots):
        raise Refusal(f"{options.robots}: there is no such file")
    with refused(DrivetrainError):
        drivetrains = load_robots(options.robots or robots_file(run.emulated), run.mm)
    lines, robots = [], {}
    for robot, result in simulate(run, drivetrains).items():
        errors = ((result.seen - result.predicted)[:, :2] ** 2).sum(axis=1) ** 0.5 * run.mm
        elapsed = result.pose_times - result.pose_times[0]
        marks = {second: float(errors[elapsed >= second][0]) for second in (1, 2, 5, 10, 30) if elapsed[-1] >= second}
        robots[str(robot + 1)] = {str(second): miss for second, miss in marks.items()}
        lines.append(f"robot {robot + 1}  " + "   ".join(f"after {s} s {miss:.0f} mm" for s, miss in marks.items()))
    return {"robots": robots, "said": lines}


def _load(file: Path) -> Any:
    from pigaming_app.hardware.recordings import RecordingError, load

    with refused(RecordingError):
        return load(file)


STEPS = {"record": record, "identify": identify, "replay": replay}
