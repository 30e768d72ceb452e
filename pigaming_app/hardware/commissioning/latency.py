"""End-to-end latency, measured on one robot: it wiggles, and observed motion is matched against commanded motion.

The inputs are the times of commands, of captured headings and of processed frames.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from pigaming_app.hardware.control.kinematics import spin_share
from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.run_writer import Recorder
from pigaming_app.hardware.signals import Fix, WheelCommand
from pigaming_app.hardware.tracking.motion_delay import ANY_LAG, motion_delay
from pigaming_app.sim.world import DT, ROBOTS

SHAKES = (0.4, 0.5, 0.3, 0.6, 0.4, 0.45, 0.35, 0.55)  # s, left and right in turn; unequal, so the match is unique
FEWEST = 20  # frames


class Latency(NamedTuple):
    """Parts of the latency, s."""

    acts: float  # from sending a command to the reaction of the motors
    picture: float  # from exposure, as stamped by the camera, to the processed frame
    lag: float  # time constant of the motors

    @property
    def total(self) -> float:
        """Dead time of the whole loop."""
        return self.acts + self.picture


class LatencyTest(Recorder):
    """Wiggles one robot. Call `tick` every 1/50 s until it returns True, then `result`."""

    def __init__(self, rig: Rig, robot: int) -> None:
        self.rig, self.robot, self._share = rig, robot, spin_share(rig.kinematics[robot].drivetrain)
        self._sent: list[tuple[float, float, float]] = []
        self._seen: list[Fix] = []
        self._pictures: list[float] = []  # s from exposure to the processed frame
        self._ticks = 0
        rig.recorder = self

    def tick(self) -> bool:
        """Run 1/50 s; True once done, with the robot stopped."""
        self._ticks += 1
        share, time = 0.0, self._ticks * DT
        for i, length in enumerate(SHAKES):
            if time < length:
                share = self._share if i % 2 else -self._share
                break
            time -= length
        wheels: list[WheelCommand | None] = [None] * ROBOTS
        wheels[self.robot] = WheelCommand(share, -share)
        self.rig.pump()
        self.rig.send(wheels)
        done = self._ticks * DT > sum(SHAKES) + 0.5
        if done:
            self.rig.recorder = None
        return done

    def result(self) -> Latency | None:
        """The fitted latency; None if the robot was hardly seen or did not move."""
        if len(self._seen) < FEWEST:
            return None
        if np.ptp(np.unwrap([fix.heading for fix in self._seen])) < 0.3:
            return None
        fit = motion_delay(self._sent, self._seen, self.rig.kinematics[self.robot].drivetrain.base, ANY_LAG)
        return Latency(fit.seconds, float(np.mean(self._pictures)), fit.lag)

    def record_commands(self, time: float, wheels: Sequence[WheelCommand | None]) -> None:
        command = wheels[self.robot]
        self._sent.append((time, *(command or (0.0, 0.0))))

    def record_fixes(self, now: float, captured: float, fixes: Sequence[Fix]) -> None:
        mine = [fix for fix in fixes if fix.robot == self.robot]
        self._seen += mine
        self._pictures += [now - fix.captured for fix in mine]
