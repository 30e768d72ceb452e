"""How far everybody is behind the leader, in seconds: how long ago somebody was first where a robot is now."""

from bisect import bisect_left

from pigaming_app.games.race.state import Race
from pigaming_app.sim.world import DT

EVERY = 25  # ticks between two readings: tenths that change all the time cannot be read


class Gaps:
    """Remembers a race from tick to tick."""

    def __init__(self, state: Race) -> None:
        self.began = state.tick
        self.reached: list[float] = []  # px: the farthest that anybody had come, for each tick since
        self.shown = [0.0] * len(state.robots)
        self.follow(state)

    def follow(self, state: Race) -> None:
        """Note this tick; read the gaps anew from time to time."""
        farthest = max(racer.progress for racer, robot in zip(state.racers, state.robots, strict=True) if robot.present)
        while len(self.reached) <= state.tick - self.began:
            self.reached.append(max(farthest, self.reached[-1] if self.reached else farthest))
        if state.tick % EVERY == 0:
            self.shown = [self.gap(state, seat) for seat in range(len(state.robots))]

    def gap(self, state: Race, seat: int) -> float:
        """Seconds behind the leader now; at the end, behind the winner."""
        racer = state.racers[seat]
        if racer.finished:
            first = min(one.finish for one in state.racers if one.finished)
            return (racer.finish - first) * DT
        return (len(self.reached) - 1 - bisect_left(self.reached, racer.progress)) * DT


def figure(seconds: float) -> str:
    """A gap in at most four characters: tenths below ten seconds, whole seconds above."""
    tenths = round(10 * max(0.0, seconds))
    return f"+{tenths / 10:.1f}" if tenths < 100 else f"+{round(seconds)}"
