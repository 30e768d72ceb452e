"""Event detection for races, by comparing a race with its previous tick; read-only."""

from typing import NamedTuple

from pigaming_app.games.race.state import LINES, Race
from pigaming_app.sim.world import DT

SETTLE = 12  # ticks for which a new order must hold; otherwise robots side by side would swap constantly
SHOWN_FROM = 25  # ticks of driving the wrong way before it is reported


class RaceEvent(NamedTuple):
    """An event of a seat's robot.

    kind       number
    line       index of the line it has crossed in order
    lap        time of the completed lap, s
    best       the same, for its best lap so far
    last_lap   -          the last lap begins
    missed     line it must return to
    void       line it had missed when crossing its own
    wrong      -          drives the wrong way
    mud        -          has left the track
    finish     final place
    up, down   new place
    """

    kind: str
    seat: int
    number: float = 0.0


class RaceEventDetector:
    """Keeps the previous tick of one race. `order`: seats in running order, leader first."""

    def __init__(self, state: Race) -> None:
        self.seats = [i for i, robot in enumerate(state.robots) if robot.present]
        self.order = self._running(state)
        self.candidate, self.since = self.order, state.tick
        self._store(state)

    def detect(self, state: Race) -> list[RaceEvent]:
        """Events since the last call."""
        events = [event for seat in self.seats for event in self._racer(state, seat)]
        events += self._order(state)
        self._store(state)
        return events

    def _store(self, state: Race) -> None:
        self.racers = [
            (r.passed, r.missed, r.void, r.wrong > SHOWN_FROM, r.place.on, r.finished, r.best_lap) for r in state.racers
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
        """Lap events after a robot crossed its own start line."""
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
        """Accept a new order after it has held for SETTLE ticks, or when a robot finishes."""
        running = self._running(state)
        if running != self.candidate:
            self.candidate, self.since = running, state.tick
        finished = any(state.racers[seat].finished > self.racers[seat][5] for seat in self.seats)
        if running == self.order or not (finished or state.tick - self.since >= SETTLE or state.over):
            return []
        before, self.order = self.order, running
        moved = [seat for seat in running if running.index(seat) != before.index(seat)]
        return [
            RaceEvent("up" if running.index(seat) < before.index(seat) else "down", seat, 1 + running.index(seat))
            for seat in moved
        ]
