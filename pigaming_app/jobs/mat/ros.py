"""Robots on the mat in a ROS network: their poses as topics, their speeds by topics, within the safety of a match."""

import time
from dataclasses import dataclass

from pigaming_app.hardware.session.robot_session import RobotsUnavailable, settings_problem
from pigaming_app.jobs.mat.sessions import new_session
from pigaming_app.jobs.terminal.options import RigOptions, decimal, option
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require
from pigaming_app.sim.world import DT, ROBOTS, WIDTH
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.i18n import english


@dataclass(frozen=True, kw_only=True)
class RosOptions(RigOptions):
    """The robots, and for how long."""

    seconds: float | None = option("length; default: until Ctrl+C", decimal(0.1, 1e6), metavar="NUMBER")


def run(options: RosOptions) -> int:
    """Publish poses and obey speeds until the time is over. Raises Refusal."""
    options.mat_settings()
    if options.emulate is None and (problem := settings_problem(Settings.load(folders().config)[0])):
        raise Refusal(english().long_sentence(problem))
    require("hardware")
    from pigaming_app.hardware.ros.bridge import Bridge
    from pigaming_app.hardware.ros.node import RosNode, RosUnavailable, require_roscore, topic_of

    with refused(RosUnavailable):
        require_roscore()
    with refused(RobotsUnavailable):
        session = new_session(options.emulate, options.camera, options.port)
    node: RosNode | None = None
    try:
        with refused(RobotsUnavailable, RosUnavailable):
            rig = session.open()
            node = RosNode("pigaming_mat", [topic_of(robot, "pose") for robot in range(ROBOTS)])
        bridge, faults = Bridge(rig, node, session.mm, time.monotonic), set[tuple[str, int | None]]()
        print(f"/robot_1 to /robot_4; the arena is {1e-3 * session.mm * WIDTH:.3f} m wide", flush=True)
        end = time.monotonic() + (options.seconds or float("inf"))
        due = time.monotonic()
        while time.monotonic() < end and node.fault is None:
            bridge.tick()
            session.tick()
            if session.emulated:  # its time is simulated
                due = max(due + DT, time.monotonic() - DT)
                time.sleep(max(0.0, due - time.monotonic()))
            now = {(fault.name, fault.robot) for fault in bridge.plant.faults if fault.pauses}
            for name, robot in sorted(now - faults, key=str):
                print(english()(f"faults.{name}", robot=(robot or 0) + 1, button="the button"), flush=True)
            faults = now
    finally:
        session.end()
        if node is not None:
            node.close()
    return 0


def arena_width(wanted: float | None, emulate: int | None) -> float:
    """Width of the arena of `--plant ros`, mm; `wanted`: by its option. Raises Refusal without ROS."""
    from pigaming_app.hardware.ros.node import RosUnavailable, require_roscore
    from pigaming_app.hardware.session.ros import WIDTH_MM

    if emulate is not None:
        raise Refusal("--plant ros: goes without --emulate")
    with refused(RosUnavailable):
        require_roscore()
    return float(wanted or WIDTH_MM)
