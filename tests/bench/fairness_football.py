"""Robot Football: ties, wins by side, goals, passes, and time without play, of two teams with equal brains."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from pigaming_football.rules import RESTING, side_of
from tests.bench.trial import StandingStill, Trial, by_arena, column, live, of_robots, played


def measure(trial: Trial) -> Mapping[str, Any]:
    """Measures of the four robots of a trial, and of its first two alone, by pitch and over all."""
    alone = trial.of(*trial.brains[:2], "off", "off")
    return {"two against two": company(trial), "one against one": company(alone)}


def company(trial: Trial) -> Mapping[str, Mapping[str, float]]:
    """Measures of one trial, by pitch."""
    batch = trial.batch()
    standing, ball = StandingStill(batch), BallWatch(batch)
    present = of_robots(batch, "present") == 1
    for _ in played(trial, batch):
        standing.sample(batch, live(batch)[:, None] & present)
        ball.sample(batch)
    ends = batch.ended()
    points = np.array([[_sum(end, side, "robots", "score") for side in range(2)] for end in ends])
    own = np.array([sum(player.own_goals for player in end.players) for end in ends])
    shots = np.array([sum(player.shots for player in end.players) for end in ends])
    assists = np.array([sum(player.assists for player in end.players) for end in ends])
    scored = np.array(
        [
            [_sum(end, side, "players", "goals") + _sum(end, 1 - side, "players", "own_goals") for side in (0, 1)]
            for end in ends
        ]
    )
    golden = np.array([end.golden_goal for end in ends])
    goals = column(batch, "goals")
    shares = standing.shares(present)
    ahead, more = points[:, 0] - points[:, 1], scored[:, 0] - scored[:, 1]
    return {
        name: {
            "matches": len(numbers),
            "ties": float((ahead[numbers] == 0).mean()),
            "wins of the left": float((ahead[numbers] > 0).mean()),
            "wins of the right": float((ahead[numbers] < 0).mean()),
            "points, a match": float(points[numbers].sum() / len(numbers)),
            "goals, a match": float(goals[numbers].mean()),
            "lead at the end, mean": float(np.abs(ahead[numbers]).mean()),
            "decided in overtime": float((golden[numbers] == 1).mean()),
            "won without more goals": float(((ahead != 0) & (ahead * more <= 0))[numbers].mean()),
            "own goals, of all": float(own[numbers].sum() / max(1, goals[numbers].sum())),
            "assists, of all goals": float(assists[numbers].sum() / max(1, goals[numbers].sum())),
            "shots, a match": float(shots[numbers].mean()),
            "passes, a match": float(ball.passes[numbers].mean()),
            "ball at rest": ball.share(ball.rest, numbers),
            "ball out of play": ball.share(ball.out, numbers),
            "drops, a match": float(ball.drops[numbers].mean()),
            "standing still, median": float(np.nanmedian(shares[numbers])),
        }
        for name, numbers in by_arena(trial.setups)
    }


class BallWatch:
    """Samples of the ball: at rest, out of play, passed to a mate, dropped anew without a goal."""

    def __init__(self, batch: Any) -> None:
        count = len(batch.matches)
        self.rest, self.out, self.samples, self.passes, self.drops = (np.zeros(count, int) for _ in range(5))
        self._out, self._goals, self._touched = np.ones(count, bool), np.zeros(count, int), np.zeros(count, int)
        robots = batch.ended()[0].robots
        self._sides = np.array([-1, *(side_of(robot) for robot in robots)])  # by `Ball.touched`

    def sample(self, batch: Any) -> None:
        """Count one sample of every running match."""
        running, out = live(batch), _ball(batch, "out") > 0
        goals, touched = np.array(column(batch, "goals")), np.array(_ball(batch, "touched"))
        speed = np.hypot(_ball(batch, "vx"), _ball(batch, "vy"))
        self.samples += running
        self.out += running & out
        self.rest += running & ~out & (speed < RESTING) & (_ball(batch, "holder") == 0)
        self.drops += running & out & ~self._out & (goals == self._goals)
        changed = running & (touched != self._touched) & (touched > 0) & (self._touched > 0)
        self.passes += changed & (self._sides[touched] == self._sides[self._touched])
        self._out, self._goals, self._touched = out, goals, touched

    def share(self, counted: Any, matches: list[int]) -> float:
        """The share of these samples in the playing time of some matches."""
        return float(counted[matches].sum() / max(1, self.samples[matches].sum()))


def _sum(end: Any, side: int, table: str, name: str) -> int:
    """A number of all robots of a side."""
    pairs = zip(end.robots, getattr(end, table), strict=True)
    return sum(getattr(row, name) for robot, row in pairs if robot.present and side_of(robot) == side)


def _ball(batch: Any, name: str) -> Any:
    """A number of every ball, (n,)."""
    if batch.fast:
        return batch.matches["ball"][name]
    return np.array([getattr(match.ball, name) for match in batch.matches])
