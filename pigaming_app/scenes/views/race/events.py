"""What happened in a tick of a race, found by comparing it with what it was before. Nothing here writes to it."""

from typing import NamedTuple

from pigaming_app.games.race.state import LINES, Race
from pigaming_app.sim.world import DT

SETTLE = 12  # ticks for which an order holds before it is believed: two side by side would swap for ever
SHOWN_FROM = 25  # ticks of driving the wrong way after which it is said


class RaceEvent(NamedTuple):
    """One thing that happened to the robot of a seat.

    kind       number
    line       which line it has passed, in order
    lap        seconds of the lap that it has ended
    best       the same, and it was its best so far
    last_lap   -          the last one begins
    missed     which line it must go back to
    void       which line it had missed when it crossed its own
    wrong      -          it drives the wrong way
    mud        -          it has left the track
    finish     its place
    up, down   its place now
    """

    kind: str
    seat: int
    number: float = 0.0


class RaceEventDetector:
    """Remembers one race from tick to tick. `order`: the seats as they run, the first leads."""

    def __init__(self, state: Race) -> None:
        self.seats = [i for i, robot in enumerate(state.robots) if robot.present]
        self.order = self._running(state)
        self.asked, self.since = self.order, state.tick
        self._remember(state)

    def look(self, state: Race) -> list[RaceEvent]:
        """What has happened since the last look."""
        found = [one for seat in self.seats for one in self._racer(state, seat)]
        found += self._order(state)
        self._remember(state)
        return found

    def _remember(self, state: Race) -> None:
        self.racers = [
            (one.passed, one.missed, one.void, one.wrong > SHOWN_FROM, one.place.on, one.finished, one.best_lap)
            for one in state.racers
        ]

    def _racer(self, state: Race, seat: int) -> list[RaceEvent]:
        passed, missed, void, wrong, on, finished, best = self.racers[seat]
        racer = state.racers[seat]
        found = []
        if racer.passed > passed:
            found.append(RaceEvent("line", seat, (seat + racer.passed - 1) % LINES))
            found += self._lap(state, seat, best)
        if racer.void > void:
            found.append(RaceEvent("void", seat, racer.missed - 1))
        elif racer.missed and racer.missed != missed:
            found.append(RaceEvent("missed", seat, racer.missed - 1))
        if racer.wrong > SHOWN_FROM and not wrong and not racer.finished:
            found.append(RaceEvent("wrong", seat))
        if on and not racer.place.on and not racer.finished:
            found.append(RaceEvent("mud", seat))
        if racer.finished and not finished:
            found.append(RaceEvent("finish", seat, racer.rank))
        return found

    def _lap(self, state: Race, seat: int, best: float) -> list[RaceEvent]:
        """What passing a line meant for the laps, if it was its own."""
        racer, laps = state.racers[seat], state.robots[seat].score
        if racer.passed % LINES != 1:
            return []
        found = []
        if racer.passed > 1:
            kind = "best" if racer.best_lap < best else "lap"
            found.append(RaceEvent(kind, seat, racer.last_lap * DT))
        if laps == state.rules.laps - 1 and laps > 0:
            found.append(RaceEvent("last_lap", seat))
        return found

    def _running(self, state: Race) -> list[int]:
        return sorted(self.seats, key=lambda seat: state.racers[seat].rank)

    def _order(self, state: Race) -> list[RaceEvent]:
        """Believe another order once it has held for a while, or when somebody has finished."""
        running = self._running(state)
        if running != self.asked:
            self.asked, self.since = running, state.tick
        finished = any(state.racers[seat].finished > self.racers[seat][5] for seat in self.seats)
        if running == self.order or not (finished or state.tick - self.since >= SETTLE or state.over):
            return []
        before, self.order = self.order, running
        moved = [seat for seat in running if running.index(seat) != before.index(seat)]
        return [
            RaceEvent("up" if running.index(seat) < before.index(seat) else "down", seat, 1 + running.index(seat))
            for seat in moved
        ]
