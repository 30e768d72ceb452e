"""Robots on the mat in a ROS network: their poses as topics, their speeds by topics, within the safety of a match."""

import time
from contextlib import ExitStack
from dataclasses import dataclass

from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable
from pigaming_app.jobs.mat.sessions import require_deadman, robots_of
from pigaming_app.jobs.terminal.options import RigOptions, decimal, option
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require
from pigaming_app.sim.world import ROBOTS, WIDTH
from pigaming_app.ui.i18n import english


@dataclass(frozen=True, kw_only=True)
class RosOptions(RigOptions):
    """The robots, and for how long."""

    seconds: float | None = option("length; default: until Ctrl+C", decimal(0.1, 1e6), metavar="NUMBER")


def run(options: RosOptions) -> int:
    """Publish poses and obey speeds until the time is over. Raises Refusal."""
    options.mat_settings()
    require_deadman(options)
    require("hardware")
    from pigaming_app.hardware.ros.bridge import Bridge
    from pigaming_app.hardware.ros.node import RosNode, RosUnavailable, require_roscore, topic_of

    with refused(RosUnavailable):
        require_roscore()
    with robots_of(options) as session, ExitStack() as opened:
        with refused(RobotsUnavailable, RosUnavailable):
            rig = session.open()
            node = RosNode("pigaming_mat", [topic_of(robot, "pose") for robot in range(ROBOTS)])
        opened.callback(node.close)
        bridge, faults = Bridge(rig, node, session.mm, time.monotonic), set[tuple[str, int | None]]()
        print(f"/robot_1 to /robot_4; the arena is {1e-3 * session.mm * WIDTH:.3f} m wide", flush=True)
        end = time.monotonic() + (options.seconds or float("inf"))
        while time.monotonic() < end and node.fault is None:
            bridge.tick()
            session.tick()
            if session.emulated:  # its time is simulated
                RobotSession.tick(session)
            now = {(fault.name, fault.robot) for fault in bridge.plant.faults if fault.pauses}
            for name, robot in sorted(now - faults, key=str):
                print(english()(f"faults.{name}", robot=(robot or 0) + 1, button="the button"), flush=True)
            faults = now
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
