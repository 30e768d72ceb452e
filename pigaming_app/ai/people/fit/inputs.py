"""What a person's hands did, from the recorded actions alone: decisions, and what each of them pressed.

A stick that points is not recorded, but what it made of the robot: with the robot's heading its direction on the
screen follows again. Where the turn is at its limit only the speed tells of it, so the direction is then uncertain.
"""

from dataclasses import dataclass
from math import acos, cos, pi

import numpy as np

from pigaming_app.ai.brain.driving import FORESIGHT, TURN_GAIN
from pigaming_app.ai.people.fit.wishes import Array, Watched

NEAR, ROUGH = 0.035, 0.12  # of a stick value: as predicted, and as predicted where the direction is uncertain
LIKELY = (1.0, 0.85, 0.7, 0.6)  # deflections of a stick
LOWEST = 0.75  # turn value with which a turn may have left its limit in one tick


@dataclass(frozen=True)
class HandInputs:
    """`decisions`: ticks at which the hands changed something that stays; `shown`: of these, those with a value.

    `values`: of each of these ticks: the direction on the screen, rad, or with keys the turn, signed, in ticks.
    """

    decisions: Array
    shown: Array
    values: Array
    ends: Array  # True for decisions after which the stick was released: how long it then rests is no decision


def key_inputs(watched: Watched) -> HandInputs:
    """Of somebody who steers with keys."""
    linear, angular = watched.actions[:, 0], watched.actions[:, 1]
    driven = np.flatnonzero(np.diff(linear) != 0) + 1
    turned = np.flatnonzero(np.diff(angular) != 0) + 1
    taps = turned[angular[turned] != 0]
    after = np.append(turned, len(angular))[np.searchsorted(turned, taps, side="right")]
    decisions = np.union1d(driven, taps)
    return HandInputs(decisions, taps, angular[taps] * (after - taps), np.zeros(len(decisions), bool))


def pointing_inputs(watched: Watched) -> HandInputs:
    """Of somebody who points with a stick."""
    hand = _PointingHand(watched)
    decisions = [tick for tick in range(len(watched.actions)) if hand.changes(tick)]
    found = np.array(decisions, int)
    ends = np.abs(watched.actions[found, :2]).sum(axis=1) == 0.0
    shown = found[~ends]
    return HandInputs(found, shown, np.array(hand.ways)[np.minimum(shown + 1, len(hand.ways) - 1)], ends)


class _PointingHand:
    """Follows a stick tick by tick. `way`: its direction on the screen, rad; `reach`: its deflection."""

    def __init__(self, watched: Watched) -> None:
        self.linear: list[float] = watched.actions[:, 0].tolist()
        self.angular: list[float] = watched.actions[:, 1].tolist()
        self.seen: list[float] = (watched.poses[:, 0] + FORESIGHT * watched.poses[:, 1]).tolist()
        self.gain = TURN_GAIN / watched.turn_rate
        self.way, self.reach, self.uncertain, self.still = 0.0, 0.0, False, True
        self.ways: list[float] = []

    def changes(self, tick: int) -> bool:
        """Advance to a tick; true if the stick has moved."""
        linear, angular = self.linear[tick], self.angular[tick]
        still = linear == 0.0 and angular == 0.0
        new = not still if self.still else still or not self._held(tick)
        if not still:
            self._learn(tick, new)
        self.still = still
        self.ways.append(self.way)
        return new

    def _held(self, tick: int) -> bool:
        """True if the actions of this tick follow from the stick of the one before."""
        linear, angular = self.linear[tick], self.angular[tick]
        if self.uncertain:
            before = self.angular[tick - 1]
            if before * angular <= 0.0:
                return False
            if abs(angular) >= 1.0:
                return self._same_beyond(tick)
            return abs(angular) > LOWEST and abs(linear - self.linear[tick - 1]) < ROUGH
        angle = _wrap(self.way - self.seen[tick])
        turn = max(-1.0, min(1.0, self.gain * angle))
        return abs(turn - angular) < NEAR and abs(self.reach * cos(angle) - linear) < NEAR

    def _same_beyond(self, tick: int) -> bool:
        """True if some deflection explains the speed of this tick and of the one before, both turns at their limit."""
        before, side = self.linear[tick - 1], 1.0 if self.angular[tick] > 0.0 else -1.0
        turned = _wrap(self.seen[tick - 1] - self.seen[tick])
        speeds = [reach * cos(side * acos(before / reach) + turned) for reach in LIKELY if abs(before) <= reach]
        return bool(speeds) and min(speeds) - 0.03 < self.linear[tick] < max(speeds) + 0.03

    def _learn(self, tick: int, new: bool) -> None:
        """Take direction and deflection from a tick, where it tells more than those before."""
        linear, angular = self.linear[tick], self.angular[tick]
        beyond = abs(angular) >= 1.0
        if not beyond and (new or self.uncertain):
            angle = angular / self.gain
            self.way, self.reach, self.uncertain = self.seen[tick] + angle, linear / max(cos(angle), 0.1), False
        elif beyond and new:
            angle = acos(max(-1.0, min(1.0, linear))) * (1.0 if angular > 0.0 else -1.0)
            self.way, self.reach, self.uncertain = self.seen[tick] + angle, 1.0, True
        elif beyond and abs(self.gain * _wrap(self.way - self.seen[tick])) < 1.0:
            self.uncertain = True


def _wrap(angle: float) -> float:
    return (angle + pi) % (2.0 * pi) - pi
