"""What the robots of a match did: ways, turns, times. Watches a match on the screen; its rules know nothing of it."""

from collections.abc import Mapping, Sequence
from itertools import combinations
from math import dist, inf
from typing import Any

from pigaming_app.games.match import Match
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.world import DT, HZ, ROBOTS

EVERY = 5  # ticks between two samples
SAMPLE = EVERY * DT  # s
REGION = 100.0  # px, side of the squares of the arena that a robot may have been in
RESTING, STRAIGHT = 5.0, 0.1  # px/s, below which it stands; rad/s, below which it does not turn
SUMS = ("distance", "reverse", "turning", "turbo", "rest", "near")

Feats = Mapping[str, float]
"""Of one robot, as far as there are any: `distance` and `reverse` driven, px; `straight`, the longest way without a
turn, px; `turning`, rad; `turbo`, `rest` and `escape` (longest time without a hit), s; `first` (its first point), s;
`explored`, squares; `near` (mean distance to the nearest robot), px; `finish`, points in the second half; `led`: 1 if
it, or its team, was alone in the lead at half time; `comeback`: how far it was behind the best then, as the ranking
counts, if its place is better now."""


class RobotFeats:
    """What adds up for one robot, per sample."""

    def __init__(self) -> None:
        self.sums = dict.fromkeys(SUMS, 0.0)
        self.line = self.straight = 0.0  # px since the last turn, and the most
        self.regions: set[tuple[int, int]] = set()
        self.taken = 0.0  # hits
        self.samples = self.unhit = self.escape = 0  # all; those since the last hit, and the most of these

    def add(self, robot: Any, backwards: bool, near: float) -> None:
        """One sample. `backwards`: its driver wants that, it is not pushed; `near`: px to the nearest robot."""
        self.samples += 1
        sums, linear = self.sums, robot.linear
        sums["distance"] += abs(linear)
        sums["reverse"] += max(0.0, -linear) if backwards else 0.0
        sums["turning"] += abs(robot.angular)
        sums["turbo"] += robot.boosting
        sums["rest"] += abs(linear) < RESTING
        sums["near"] += near
        self.line = self.line + abs(linear) * SAMPLE if abs(robot.angular) < STRAIGHT else 0.0
        self.straight = max(self.straight, self.line)
        self.regions.add((int(robot.x // REGION), int(robot.y // REGION)))

    def count_hits(self, taken: float) -> None:
        """Begin a new escape if the robot has been hit since the last sample."""
        self.unhit = 0 if taken > self.taken else self.unhit + 1
        self.taken, self.escape = taken, max(self.escape, self.unhit)


class FeatRecorder:
    """Records the feats of a match, or of all its rounds."""

    def __init__(self) -> None:
        self.tallies = [RobotFeats() for _ in range(ROBOTS)]
        self.match: Match | None = None
        self.series: Sequence[Sequence[tuple[float, int]]] = ()  # of the first round
        self.standings: list[list[float]] = []  # ranking keys of all seats, once a second of the present round
        self.counts_hits = False

    def watch(self, match: Match) -> None:
        """Note the tick just played, if it is one to be sampled."""
        if match.state.tick % EVERY:
            return
        if match is not self.match:
            self._begin(match)
        seats = [seat for seat in range(ROBOTS) if match.state.robots[seat].present]
        near, state = nearest(match.state, seats), match.state
        for seat in seats:
            if not finished(match, seat):
                self.tallies[seat].add(state.robots[seat], state.actions[seat].linear < 0.0, near[seat])
            if self.counts_hits:
                self.tallies[seat].count_hits(match.game.stats(match.state, seat)["taken"])
        if match.state.tick % HZ == 0:
            self.standings.append(standing(match))

    def feats(self, seat: int) -> Feats:
        """The feats of a seat so far."""
        if self.match is None:
            return {}
        tally = self.tallies[seat]
        found = {name: total * SAMPLE for name, total in tally.sums.items()}
        found |= {
            "near": tally.sums["near"] / max(1, tally.samples),
            "explored": float(len(tally.regions)),
            "straight": tally.straight,
            "meters": found["distance"] * self.match.plant.mm / 1000.0,
        }
        if self.counts_hits:
            found["escape"] = tally.escape * SAMPLE
        if points := [seconds for seconds, score in self.series[seat] if score > 0]:
            found["first"] = points[0]
        if not self.match.game.timed:
            found["finish"] = second_half(self.match.series[seat], self.match.state.tick * DT)
        if self.standings:
            half, end = self.standings[len(self.standings) // 2], standing(self.match)
            found["led"] = float(leads(self.match, half, seat))
            found["comeback"] = max(half) - half[seat] if rank(end, seat) < rank(half, seat) else 0.0
        return found

    def _begin(self, match: Match) -> None:
        """The first tick of a round."""
        self.series = self.series or match.series
        self.match, self.standings = match, []
        self.counts_hits = "taken" in match.game.stats(match.state, 0)
        for tally in self.tallies:
            tally.taken, tally.unhit = 0.0, 0


def nearest(state: MatchState, seats: Sequence[int]) -> list[float]:
    """The distance of each robot to the nearest other one, px; 0 if it is alone."""
    best = [inf] * ROBOTS
    for a, b in combinations(seats, 2):
        one, other = state.robots[a], state.robots[b]
        apart = dist((one.x, one.y), (other.x, other.y))
        best[a], best[b] = min(best[a], apart), min(best[b], apart)
    return best if len(seats) > 1 else [0.0] * ROBOTS


def finished(match: Match, seat: int) -> bool:
    """True if a robot has reached the goal of a race, and waits for the others."""
    goal = match.setup.goal
    return bool(match.game.timed and goal and match.state.robots[seat].score >= goal)


def second_half(series: Sequence[tuple[float, int]], seconds: float) -> float:
    """Points made in the second half of a match of so many seconds."""
    return float(series[-1][1] - next(score for when, score in reversed(series) if when <= seconds / 2))


def standing(match: Match) -> list[float]:
    """The ranking key of each seat; of an empty one the lowest."""
    robots = match.state.robots
    return [match.game.ranking_key(match.state, i) if robots[i].present else -inf for i in range(ROBOTS)]


def leads(match: Match, keys: Sequence[float], seat: int) -> bool:
    """True if all other teams have a lower ranking key, and there are any."""
    team = match.state.robots[seat].team
    others = [key for robot, key in zip(match.state.robots, keys, strict=True) if robot.present and robot.team != team]
    return bool(others) and keys[seat] > max(others)


def rank(keys: Sequence[float], seat: int) -> int:
    """The place of a seat by its ranking key, 1 is best; a team has one place."""
    return 1 + len({key for key in keys if key > keys[seat]})
