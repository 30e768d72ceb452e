"""Random access to a replay: snapshots of its state, a few seconds apart, from which any tick is a short way."""

from typing import Any

from pigaming_app.games.match import Match
from pigaming_app.games.replay import BYTES_PER_TICK, Replay, to_match
from pigaming_app.sim.plant import SimPlant
from pigaming_app.sim.record import copy
from pigaming_app.sim.world import DT, HZ

EVERY = 2 * HZ  # ticks between two snapshots


class Timeline:
    """The ticks of a replay. `explore` plays ahead to take snapshots, `match_at` jumps."""

    def __init__(self, replay: Replay) -> None:
        self.replay, self.length = replay, replay.length
        self._scout = to_match(replay)
        self._snapshots: list[Any] = [copy(self._scout.state)]  # of the ticks 0, EVERY, 2 * EVERY …

    @property
    def explored(self) -> int:
        """The first tick that has not been played ahead."""
        return int(self._scout.state.tick)

    def explore(self, ticks: int) -> None:
        """Play ahead by at most this many ticks; about 0.05 ms each."""
        for _ in range(min(ticks, self.length - self.explored)):
            self._scout.tick()
            if self.explored % EVERY == 0:
                self._snapshots.append(copy(self._scout.state))

    def match_at(self, tick: int) -> Match:
        """The match after `tick` ticks, cut to the length of the replay. The nearest snapshot before it may be far from
        a tick that is unexplored; all others take at most EVERY ticks.
        """
        tick = max(0, min(tick, self.length))
        index = min(tick // EVERY, len(self._snapshots) - 1)
        match = to_match(self.replay)
        match.state = copy(self._snapshots[index])
        match.plant = SimPlant(match.state)
        match.log.ticks[:] = self.replay.ticks[: index * EVERY * BYTES_PER_TICK]
        seconds = index * EVERY * DT
        match.series = [[point for point in line if point[0] <= seconds] for line in self._scout.series]
        while match.state.tick < tick:
            match.tick()
        return match
