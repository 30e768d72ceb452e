"""End-to-end latency, measured on one robot: it wiggles, and observed motion is matched against commanded motion.

The inputs are the times of commands, of captured headings and of processed frames. The lag of the motors is fitted as
well, so that it is not mistaken for dead time.
"""

from collections.abc import Sequence
from math import exp
from typing import NamedTuple

import numpy as np

from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.recordings import Floats
from pigaming_app.hardware.signals import Fix, WheelCommand
from pigaming_app.sim.plant import Sighting
from pigaming_app.sim.world import DT, ROBOTS

SHAKES = (0.4, 0.5, 0.3, 0.6, 0.4, 0.45, 0.35, 0.55)  # s, left and right in turn; unequal, so the match is unique
SHARE = 0.14  # of full speed
STEP = 0.0025  # s, resolution of model and delay
DELAYS = np.arange(0.0, 0.30, STEP)  # s, search grid
LAGS = np.arange(0.02, 0.20, 0.01)  # s, search grid
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


class LatencyTest:
    """Wiggles one robot. Call `tick` every 1/50 s until it returns True, then `result`."""

    def __init__(self, rig: Rig, robot: int) -> None:
        self.rig, self.robot = rig, robot
        self._sent: list[tuple[float, float]] = []
        self._seen: list[tuple[float, float, float]] = []
        self._ticks = 0
        rig.recorder = self

    def tick(self) -> bool:
        """Run 1/50 s; True once done, with the robot stopped."""
        self._ticks += 1
        share, time = 0.0, self._ticks * DT
        for i, length in enumerate(SHAKES):
            if time < length:
                share = SHARE if i % 2 else -SHARE
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
        captured, arrived, headings = np.array(self._seen).T
        headings = np.unwrap(headings)
        if np.ptp(headings) < 0.3:
            return None
        best = (np.inf, 0.0, 0.0)
        grid = np.arange(self._sent[0][0], captured[-1], STEP)
        sent_at, sent = np.array(self._sent).T
        commanded = sent[np.maximum(np.searchsorted(sent_at, grid, side="right") - 1, 0)]
        for lag in LAGS:
            turned = np.cumsum(_low_pass(commanded, float(lag))) * STEP
            for delay in DELAYS:
                model = np.column_stack([np.interp(captured - delay, grid, turned), np.ones(len(captured))])
                residual = headings - model @ np.linalg.lstsq(model, headings, rcond=None)[0]
                best = min(best, (float(residual @ residual), float(delay), float(lag)))
        return Latency(best[1], float(np.mean(arrived - captured)), best[2])

    def record_commands(self, time: float, wheels: Sequence[WheelCommand | None]) -> None:
        """Recorder: commands were sent."""
        command = wheels[self.robot]
        self._sent.append((time, command.left if command else 0.0))

    def record_fixes(self, now: float, captured: float, fixes: Sequence[Fix]) -> None:
        """Recorder: a frame was processed."""
        self._seen += [(fix.captured, now, fix.heading) for fix in fixes if fix.robot == self.robot]

    def record_estimates(self, now: float, sightings: Sequence[Sighting]) -> None:
        """Recorder: predictions are not used."""


def _low_pass(commanded: Floats, lag: float) -> Floats:
    """Response of first-order motors with this time constant, s."""
    decay = exp(-STEP / lag)
    response = (1.0 - decay) * decay ** np.arange(int(8.0 * lag / STEP) + 1)
    return np.asarray(np.convolve(commanded, response)[: len(commanded)])
