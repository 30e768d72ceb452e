"""How late it all is, measured end to end on one robot: it is shaken left and right, and what is seen is compared.

What counts is when a command was sent, when the robot was seen to follow, and when that picture had been looked at.
The lag of the motors is found along, so that it is not taken for dead time.
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

SHAKES = (0.4, 0.5, 0.3, 0.6, 0.4, 0.45, 0.35, 0.55)  # s, left and right in turn; not alike, so that none is mistaken
SHARE = 0.14
STEP = 0.0025  # s
DELAYS = np.arange(0.0, 0.30, STEP)
LAGS = np.arange(0.02, 0.20, 0.01)
FEWEST = 20  # pictures


class Latency(NamedTuple):
    """s."""

    acts: float  # from sending a command to the motors hearing it
    picture: float  # from the light to the picture having been looked at, as far as the camera tells
    lag: float  # time constant of the motors

    @property
    def total(self) -> float:
        """The dead time of the whole loop."""
        return self.acts + self.picture


class LatencyTest:
    """Shakes one robot; `tick` every 1/50 s until it says that all is done, then `result`."""

    def __init__(self, rig: Rig, robot: int) -> None:
        self.rig, self.robot = rig, robot
        self._sent: list[tuple[float, float]] = []
        self._seen: list[tuple[float, float, float]] = []
        self._ticks = 0
        rig.recorder = self

    def tick(self) -> bool:
        """1/50 s of it; whether all is done. Then the robot stands."""
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
        self.rig.tell(wheels)
        done = self._ticks * DT > sum(SHAKES) + 0.5
        if done:
            self.rig.recorder = None
        return done

    def result(self) -> Latency | None:
        """What was found; None if the robot was hardly seen or did not move."""
        if len(self._seen) < FEWEST:
            return None
        captured, arrived, headings = np.array(self._seen).T
        headings = np.unwrap(headings)
        if np.ptp(headings) < 0.3:
            return None
        best = (np.inf, 0.0, 0.0)
        grid = np.arange(self._sent[0][0], captured[-1], STEP)
        told_at, told = np.array(self._sent).T
        held = told[np.maximum(np.searchsorted(told_at, grid, side="right") - 1, 0)]
        for lag in LAGS:
            turned = np.cumsum(_followed(held, float(lag))) * STEP
            for delay in DELAYS:
                model = np.column_stack([np.interp(captured - delay, grid, turned), np.ones(len(captured))])
                rest = headings - model @ np.linalg.lstsq(model, headings, rcond=None)[0]
                best = min(best, (float(rest @ rest), float(delay), float(lag)))
        return Latency(best[1], float(np.mean(arrived - captured)), best[2])

    def sent(self, time: float, wheels: Sequence[WheelCommand | None]) -> None:
        """The robots are told this."""
        one = wheels[self.robot]
        self._sent.append((time, one.left if one else 0.0))

    def seen(self, now: float, captured: float, fixes: Sequence[Fix]) -> None:
        """A picture has been looked at."""
        self._seen += [(captured, now, fix.heading) for fix in fixes if fix.robot == self.robot]

    def believed(self, now: float, sightings: Sequence[Sighting]) -> None:
        """What the tracker believes does not count here."""


def _followed(told: Floats, lag: float) -> Floats:
    """First-order motors."""
    kept = exp(-STEP / lag)
    answer = (1.0 - kept) * kept ** np.arange(int(8.0 * lag / STEP) + 1)
    return np.asarray(np.convolve(told, answer)[: len(told)])
