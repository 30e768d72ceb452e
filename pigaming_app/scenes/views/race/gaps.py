"""Gaps to the leader in seconds: the time since the leader passed a robot's present position."""

from bisect import bisect_left

from pigaming_app.games.race.state import Race
from pigaming_app.sim.world import DT
from pigaming_app.ui.numbers import signed

EVERY = 25  # ticks between two readings, so that the tenths are readable


class Gaps:
    """Keeps the leading distance of every tick of a race."""

    def __init__(self, state: Race) -> None:
        self.began = state.tick
        self.reached: list[float] = []  # px, leading distance at each tick
        self.shown = [0.0] * len(state.robots)
        self.follow(state)

    def follow(self, state: Race) -> None:
        """Record this tick; refresh the gaps every EVERY ticks."""
        farthest = max(racer.progress for racer, robot in zip(state.racers, state.robots, strict=True) if robot.present)
        while len(self.reached) <= state.tick - self.began:
            self.reached.append(max(farthest, self.reached[-1] if self.reached else farthest))
        if state.tick % EVERY == 0:
            self.shown = [self.gap(state, seat) for seat in range(len(state.robots))]

    def gap(self, state: Race, seat: int) -> float:
        """Gap to the leader in s; after the finish, to the winner."""
        racer = state.racers[seat]
        if racer.finished:
            first = min(other.finish for other in state.racers if other.finished)
            return (racer.finish - first) * DT
        return (len(self.reached) - 1 - bisect_left(self.reached, racer.progress)) * DT


def figure(seconds: float) -> str:
    """A gap in at most four characters: tenths below ten seconds, whole seconds above."""
    tenths = round(10 * max(0.0, seconds))
    return signed(tenths / 10, 1) if tenths < 100 else signed(seconds)
